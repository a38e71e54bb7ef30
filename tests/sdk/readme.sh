#!/usr/bin/env bash
# Plays the sections of README.md with a second robot and a component in Python, word for word, but on free ports.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

free_ports() { python3 -c 'import socket; all = [socket.socket() for _ in range(2)]; [one.bind(("127.0.0.1", 0)) for one in all]; print(*(one.getsockname()[1] for one in all))'; }

# play SECTION EXPECTED...: the lines of the section print these texts.
play() {
    local section=$1 first second
    shift
    read -r first second < <(free_ports)
    awk -v title="## $section" '/^## / { here = $0 == title } here && /^```/ { block = !block; next } here && block' "$root/README.md" |
        sed "s|build/release/|$ROIS_BINARY_DIR/|
            s|^./dev run|$ROIS_BINARY_DIR/bin/rois-gateway --listen 127.0.0.1:8080 --media ''|
            s|components/|$root/components/|; s|lamp.py|& --url ws://127.0.0.1:8080|; s/8080/$first/g; s/8081/$second/g" >"$work/session.sh"
    [ "$(wc -l <"$work/session.sh")" -ge 5 ] || { echo "README.md has no lines in '$section'" >&2; exit 1; }
    (
        cd "$work"
        export PATH=$ROIS_BINARY_DIR/bin:$PATH ROIS_URL=http://127.0.0.1:$first
        echo "trap 'kill \$(jobs -p)' EXIT" | cat - session.sh >ending.sh
        timeout 60 bash ending.sh >printed 2>&1 || true
    )
    for expected in "$@"; do
        grep -qF "$expected" "$work/printed" || { echo "'$section' did not print '$expected', but:" >&2; cat "$work/printed" >&2; exit 1; }
    done
}
play "A second robot" "start robot2.speech_synthesis  OK"
play "Your own component in Python" "blink lamps.lamp  OK" "is_on  bool  false"
