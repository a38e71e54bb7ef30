#!/bin/bash
# Runs the examples and the `rois` commands with the exact lines of the README, and compares their output. Replaces only build/release by
# the folder of the build under test.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
data=$root/tests/server/data
work=$(mktemp -d)
trap 'kill "${gateway:-}" 2>/dev/null || true; wait; rm -rf "$work"' EXIT

fail() {
    printf '%s\n' "$*"
    exit 1
}

mapfile -t lines < <(awk '/^## / { here = /^## Run an example/ } here' "$root/README.md" | sed -n 's/^|.*| `\(.*\)` |$/\1/p')
((${#lines[@]} == 4)) || fail "the README has ${#lines[@]} lines that run an example; expected 4"
grep -qxF "${lines[2]}" "$root/web/client/README.md" || fail "web/client/README.md does not show: ${lines[2]}"
grep -qxF "${lines[3]}" "$root/docs/client-cpp.md" || fail "docs/client-cpp.md does not show: ${lines[3]}"

# Starts a gateway; its URL is in $ROIS_URL.
start() {
    local line
    rm -f "$work/log"
    mkfifo "$work/log"
    "$ROIS_BINARY_DIR/bin/rois-gateway" --listen 127.0.0.1:0 --floor-plan "$data/watchful_hall.xml" --scenario "$data/three_visitors.xml" \
        --sim-speed 20 --seed 7 2>"$work/log" &
    gateway=$!
    exec 3<"$work/log"
    while read -r line <&3; do
        if [[ $line == *"listening on "* ]]; then break; fi
    done
    export ROIS_URL=${line##*listening on }
}

expected="$(head -n 1 "$data/three_visitors.txt")
visitors received: 1"
cd "$root"
for line in "${lines[@]}"; do
    start
    bash -c "${line//build\/release/$ROIS_BINARY_DIR}" >"$work/printed" 2>"$work/error" || fail "'$line' failed: $(cat "$work/printed" "$work/error")"
    [[ $(tail -n 2 "$work/printed") == "$expected" ]] || fail "'$line' printed: $(cat "$work/printed")"
    kill "$gateway"
    wait "$gateway" || true
done

# Runs the `rois` commands in a fresh shell, except the one that does not end by itself.
block=$(awk '/^## / { here = /`rois` command/ } here && /^```/ { inside = !inside; next } here && inside && !/^rois watch/' "$root/README.md")
block=${block//\$PWD\/build\/release/$ROIS_BINARY_DIR}
start
env -i HOME="$work" PATH=/usr/bin:/bin ROIS_URL="$ROIS_URL" bash -ec "$block" >"$work/printed" 2>"$work/error" ||
    fail "the commands with rois failed: $(cat "$work/printed" "$work/error")"
for expected in "^navigation *Navigation" "^position_data" "start speech_synthesis *OK" "visitors received: 2"; do
    grep -q "$expected" "$work/printed" || fail "the commands with rois did not print '$expected' but: $(cat "$work/printed" "$work/error")"
done
assignment='PATH=$PWD/build/release/bin:$PATH'
grep -qF "$assignment" "$root/docs/rois-command.md" || fail "docs/rois-command.md does not set PATH"
