#!/bin/bash
# Plays the sessions with curl of README.md and docs/curl.md, word for word. Each line that these documents show, apart from its numbers,
# must be among the lines printed.
set -euo pipefail
export LC_ALL=C
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'kill "${gateway:-}" 2>/dev/null || true; wait; rm -rf "$work"' EXIT

# code DOCUMENT KIND...: the contents of the code blocks of these kinds. Of the README only those of the section with the session.
code() {
    local document=$1
    shift
    awk -v kinds=" $* " -v readme="${document##*README.md}" '/^## / { section = /session with curl/ } readme == "" && !section { next }
        /^```/ { block = block == "" ? substr($0, 4) : ""; next }
        block != "" && index(kinds, " " block " ")' "$root/$document"
}
# Replaces numbers, with their signs and fractions, by N.
without_numbers() { sed -E 's/-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?/N/g'; }

# The scenario is the shipped one, faster: its first visitor stands in front of the desk after some ten seconds.
mkfifo "$work/log"
"$ROIS_BINARY_DIR/bin/rois-gateway" --listen 127.0.0.1:0 --sim-speed "${ROIS_TEST_SIM_SPEED:-4}" 2>"$work/log" &
gateway=$!
exec 3<"$work/log"
while read -r line <&3; do
    if [[ $line == *"listening on "* ]]; then break; fi
done
url=${line##*listening on }

# Waits until the visitor stands there.
names='xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
ask() { curl -sS "$url/rois" -H 'Content-Type: application/xml' -H "RoIS-Session: ${session:-}" -d "$1" | grep 'return_code="OK"'; }
ref='<component_ref rois:code="person_localization"/>'
session=$(ask "<connect $names/>" | sed 's/.*<session>//; s/<.*//')
ask "<bind $names>$ref</bind>" >/dev/null
ask "<subscribe $names inline_results='true'><event_type>person_localized</event_type></subscribe>" >/dev/null
ask "<execute $names><rois:CommandUnitSequence><rois:command_unit_list xsi:type='rois:CommandMessageType' rois:command_type='start' rois:command_id='find'>
    ${ref//component_ref/rois:component_ref}</rois:command_unit_list></rois:CommandUnitSequence></execute>" >/dev/null
after=0
until [[ ${news:=} =~ value\>9[3-7]..,\ 7[3-7].. ]]; do
    news=$(curl -sS "$url/rois/notifications?after=$after&wait=30" -H "RoIS-Session: $session")
    after=$(sed 's/.* sequence="//; s/".*//' <<<"$news")
done
ask "<disconnect $names/>" >/dev/null

fail() {
    printf '%s\n\nIt printed:\n' "$1"
    cat "$work/printed"
    exit 1
}
for document in docs/curl.md README.md; do
    code "$document" sh | sed "s|^GATEWAY=.*|GATEWAY=$url|" >"$work/session.sh"
    bash "$work/session.sh" >"$work/printed" 2>&1
    code "$document" xml text | without_numbers | sort -u >"$work/shown"
    without_numbers <"$work/printed" | sort -u >"$work/lines"
    missing=$(comm -23 "$work/shown" "$work/lines")
    [[ -z $missing && -s $work/shown ]] || fail "$document shows lines that its session did not print: $missing"
done
code docs/curl.md sh | sed "s|^GATEWAY=.*|GATEWAY=$url|" >"$work/session.sh"

# A reader who begins again in the same terminal gets the components that the previous session had bound.
sed '/^for event/,$d' "$work/session.sh" >"$work/begin.sh"
for _ in 1 2; do cat "$work/begin.sh"; done >"$work/twice.sh"
bash "$work/twice.sh" >"$work/printed" 2>&1
[[ $(grep -c '<bind_response .*return_code="OK"' "$work/printed") -eq 8 ]] || fail "A session that begins again does not bind all components."

# The terminal is closed: its session lasts for another 90 s. The next session reports this at once, and ends.
for shell in bash sh; do
    timeout 20 "$shell" "$work/session.sh" >"$work/printed" 2>&1 || fail "In $shell, a session that finds no free component does not end."
    [[ $(grep -c "^Another session holds navigation" "$work/printed") -eq 1 ]] || fail "In $shell, the session does not report once that another session holds the components."
    grep -q "^The engine rejected 'execute'" "$work/printed" || fail "In $shell, the session does not report that 'execute' was rejected."
    grep -q "^The robot has not greeted" "$work/printed" || fail "In $shell, the session does not report that the robot has not greeted."
done

# A robot without requests of its session is held after two seconds, and continues when the reader does.
kill "$gateway" && wait "$gateway" || true
"$ROIS_BINARY_DIR/bin/rois-gateway" --listen "${url#http://}" --scenario "$root/tests/server/data/empty_hall.xml" --sim-speed 1 --motion-lease-http 2 2>"$work/log" &
gateway=$!
exec 3<"$work/log"
until read -r line <&3 && [[ $line == *"listening on "* ]]; do :; done
sed 's/^notifications()/sleep 3; &/' "$work/session.sh" >"$work/slow.sh"
timeout 60 bash "$work/slow.sh" >"$work/printed" 2>&1 || fail "A session in which the robot is held does not end."
[[ $(grep -c "^The gateway held the robot" "$work/printed") -eq 1 ]] || fail "The session does not report once that the robot was held."
grep -q "its motion is held: " "$work/printed" || fail "The session does not show why the robot was held."
grep -q "<command_id>greet</command_id><status>OK" "$work/printed" || fail "The robot that was held does not greet."
[[ $(grep -c "^<receive_error" "$work/printed") -eq 1 ]] || fail "The error is not printed on a separate line."

# A robot that is stopped with all others is not reported as held.
sed "s|^notifications()|curl -sS -X POST $url/rois/stop; echo; &|" "$work/session.sh" >"$work/stopped.sh"
timeout 60 bash "$work/stopped.sh" >"$work/printed" 2>&1 || fail "A session in which everything is stopped does not end."
! grep -q "^The gateway held the robot" "$work/printed" || fail "A robot that was stopped is reported as held."
grep -q "<command_id>greet</command_id><status>ABORT" "$work/printed" || fail "The session does not show that its commands were stopped."

# waits ASSIGNMENTS LINE: the loop that waits, after these assignments, ends and prints a line that begins with LINE.
waits() {
    { printf 'GATEWAY=%s %s\n' "$url" "$1"; sed -n '/^notifications()/,/has not greeted/p' "$work/session.sh"; } >"$work/wait.sh"
    for shell in bash sh; do
        timeout 20 "$shell" "$work/wait.sh" >"$work/printed" 2>&1 || fail "In $shell, the waiting loop does not end with $1."
        grep -q "^$2" "$work/printed" || fail "In $shell, the waiting loop does not print '$2' with $1."
    done
}
# The session has ended; a command never ends (with 2 s instead of 90 s).
waits "SESSION=over WAIT=90" "The session has ended"
session=$(ask "<connect $names/>" | sed 's/.*<session>//; s/<.*//')
waits "SESSION=$session WAIT=2" "The robot has not greeted"
