#!/usr/bin/env bash
# The lamps of components/sdk, in Python and C++, in a gateway, as docs/component-programs.md shows them. Then a robot in a program.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
bin=$ROIS_BINARY_DIR/bin
work=$(mktemp -d)
running=()
end() {
    kill "${running[@]}" 2>/dev/null || true
    rm -rf "$work"
}
trap end EXIT

fail() {
    printf '%s\n' "$1" >&2
    cat "$work"/*.log >&2
    exit 1
}
# wait_for TEXT FILE [TIMES]: until the file has the text in as many lines.
wait_for() {
    for _ in $(seq 200); do
        [ "$(grep -c "$1" "$2" || true)" -ge "${3:-1}" ] && return
        sleep 0.05
    done
    fail "'$1' did not come"
}
# expect TEXT COMMAND...: the output of the command has the text.
expect() {
    local text=$1 said
    shift
    said=$("$@" 2>&1) || true
    [[ $said == *"$text"* ]] || fail "expected '$text' from: $*"$'\n'"$said"
}

printf '{"engines": [{"name": "lamps", "joins": "lamps", "window": 1}]}' >"$work/engines.json"
start_gateway() {
    "$bin/rois-gateway" --listen "127.0.0.1:${1:-0}" --robots none --media "" --engines "$work/engines.json" >"$work/gateway.log" 2>&1 &
    gateway=$!
    running+=("$gateway")
    wait_for 'listening on' "$work/gateway.log"
    ROIS_URL=$(sed -n 's/.*listening on //p' "$work/gateway.log")
    export ROIS_URL
}

# play PROGRAM...: the lamp of this program.
play() {
    start_gateway
    "$@" --url "$ROIS_URL" >"$work/lamp.log" 2>&1 &
    lamp=$!
    running+=("$lamp")
    wait_for 'present with' "$work/gateway.log"
    expect 'false' "$bin/rois" query light
    expect 'OK' "$bin/rois" execute lamps.lamp blink times=1
    expect 'times must be a number from 1 to 100, not 101' "$bin/rois" execute lamps.lamp blink times=101
    expect 'is_on=true' timeout 2 "$bin/rois" watch switched --start lamps.lamp
    # It goes out and joins again after application and gateway were killed, and ends cleanly.
    "$bin/rois" watch --start lamps.lamp >"$work/watch.log" 2>&1 &
    watch=$!
    running+=("$watch")
    wait_for 'switched.*is_on=true' "$work/watch.log"
    kill -KILL "$watch" "$gateway"
    start_gateway "${ROIS_URL##*:}"
    wait_for 'present with' "$work/gateway.log"
    for _ in $(seq 60); do
        said=$("$bin/rois" query light)
        [[ $said == *false* ]] && break
        sleep 0.1
    done
    expect 'false' "$bin/rois" query light
    expect 'OK' "$bin/rois" execute lamps.lamp blink times=1
    kill -TERM "$lamp"
    wait "$lamp" || fail "the lamp ended with $?"
    kill -TERM "$gateway"
}
play python3 -B "$root/components/sdk/python/lamp.py"
play "$bin/rois-lamp"

# Its frame is placed in that of the engine.
printf '{"engines": [{"name": "lamps", "joins": "lamps", "position": [1000, 0, 0]}]}' >"$work/engines.json"
start_gateway
"$bin/rois-test-robot" --name lamps --url "$ROIS_URL" >"$work/robot.log" 2>&1 &
robot=$!
running+=("$robot")
wait_for 'present with 15 components' "$work/gateway.log"
expect '2001, 2000, 0' "$bin/rois" query robot_position
expect 'OK' "$bin/rois" start lamps.navigation target_position=desk
expect "'cellar'" "$bin/rois" start lamps.navigation target_position=cellar
kill -TERM "$robot"
wait "$robot" || fail "the robot ended with $?"
