#!/bin/bash
# A peer that vanishes from the network without a word, as when a cable is pulled: the motion that it commanded is held soon,
# whether it listens to an event stream or waits in a long poll. In network namespaces of its own; skipped (77) where a user may
# have none.
set -euo pipefail
export LC_ALL=C

if [[ ${1:-} != inside ]]; then
    unshare --user --map-root-user --net true 2>/dev/null || { echo "skipped: no network namespace may be made here"; exit 77; }
    exec unshare --user --map-root-user --net "$0" inside
fi

work=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; wait; rm -rf "$work"' EXIT
fail() {
    echo "vanished_peer.sh: $*"
    exit 1
}

# Two machines with a cable between them.
ip link set lo up
unshare --net sleep 300 &
peer=$!
own=$(readlink /proc/$$/ns/net)
until namespace=$(readlink /proc/$peer/ns/net) && [[ $namespace != "$own" ]]; do :; done
of_peer() { nsenter --target $peer --net "$@"; }
ip link add robot type veth peer name desk netns $peer
ip address add 10.9.0.1/24 dev robot
ip link set robot up
of_peer ip address add 10.9.0.2/24 dev desk

mkfifo "$work/log"
"$ROIS_BINARY_DIR/bin/rois-gateway" --listen 0.0.0.0:8080 --allow-anyone --media '' 2>"$work/log" &
exec 3<"$work/log"
while read -r line <&3; do
    if [[ $line == *"listening on "* ]]; then break; fi
done
cat <&3 >"$work/rest" &

names='xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
ask() { of_peer curl -sS "http://10.9.0.1:8080/rois" -H 'Content-Type: application/xml' -H "RoIS-Session: ${session:-}" -d "$1"; }
errors() { curl -sS http://127.0.0.1:8080/metrics | sed -n 's/^rois_errors_total //p'; }

# held_after HOW CURL_ARGUMENT...: an application drives, listens with curl, and vanishes.
held_after() {
    local how=$1 before begun
    shift
    of_peer ip link set desk up
    session=$(ask "<connect $names/>" | sed 's/.*<session>//; s/<.*//')
    ask "<bind $names><component_ref rois:code='navigation'/></bind>" | grep -q 'return_code="OK"' || fail "$how: no bind"
    of_peer curl -sSNv "$@" -H "RoIS-Session: $session" >"$work/received" 2>&1 &
    until grep -q '^> RoIS-Session' "$work/received"; do  # the request was sent
        kill -0 $! || fail "$how: curl has ended"
        sleep 0.02
    done
    ask "<execute $names><rois:CommandUnitSequence><rois:command_unit_list xsi:type='rois:CommandMessageType' rois:command_type='start'
        rois:command_id='go'><rois:component_ref rois:code='navigation'/><rois:arguments><rois:parameter rois:name='target_position'>
        <rois:data_type_ref rois:code='string[]'/><rois:value>500, 500</rois:value></rois:parameter></rois:arguments>
        </rois:command_unit_list></rois:CommandUnitSequence></execute>" | grep -q 'return_code="OK"' || fail "$how: no start"
    before=$(errors)
    of_peer ip link set desk down
    begun=$(date +%s%N)
    while [[ $(errors) == "$before" ]]; do
        (($(date +%s%N) - begun < 20000000000)) || { cat "$work/received" "$work/rest"; fail "$how: the motion goes on after 20 s"; }
        sleep 0.05
    done
    echo "$how: held after $(((  $(date +%s%N) - begun) / 1000000)) ms"
    of_peer ip link set desk up
    ask "<disconnect $names/>" | grep -q 'return_code="OK"' || fail "$how: no disconnect"
}

held_after "event stream" -H 'Accept: text/event-stream' http://10.9.0.1:8080/rois/notifications
held_after "long poll" 'http://10.9.0.1:8080/rois/notifications?wait=30'
