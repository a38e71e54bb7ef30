#!/usr/bin/env bash
# Plays the sections of README.md with a second robot and a component in Python, word for word, but on free ports. Each section runs
# in a shell of its own, with the PATH of the system, in a folder like a fresh clone whose build is up to date.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Prints two free ports below those that the system gives to connections: another test that runs now cannot be given one of them.
free_ports() {
    python3 - <<'PYTHON'
import random, socket
taken = []
while len(taken) < 2:
    try:
        taken.append(socket.create_server(("127.0.0.1", random.randrange(20000, 32768))))
    except OSError:
        pass
print(*(each.getsockname()[1] for each in taken))
PYTHON
}

# Makes a folder with the files of the project. Its build folder is that of this test.
make_clone() {
    local each
    rm -rf "$work/clone"
    mkdir -p "$work/clone/build"
    for each in "$root"/*; do
        case ${each##*/} in build | engines.json) ;; *) ln -s "$each" "$work/clone/" ;; esac
    done
    ln -s "$ROIS_BINARY_DIR" "$work/clone/build/release"
}

# play SECTION EXPECTED...: the lines of the section print these texts, and end all that they have started.
play() {
    local section=$1 first second status=0
    shift
    read -r first second < <(free_ports)
    make_clone
    {
        echo "trap 'kill \$(jobs -p) 2>/dev/null' EXIT"
        awk -v title="## $section" '/^## / { here = $0 == title } here && /^```/ { block = !block; next } here && block' "$root/README.md" |
            sed "s/8080/$first/g; s/8081/$second/g"
        echo wait
    } >"$work/session.sh"
    [ "$(wc -l <"$work/session.sh")" -ge 7 ] || { echo "README.md has no lines in '$section'" >&2; exit 1; }
    (
        cd "$work/clone"
        env -i HOME="$work" PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
            ROIS_LISTEN="127.0.0.1:$first" ROIS_URL="http://127.0.0.1:$first" timeout 120 bash "$work/session.sh" >"$work/printed" 2>&1
    ) || status=$?
    for expected in "$@"; do
        grep -qF "$expected" "$work/printed" || { echo "'$section' did not print '$expected', but:" >&2; cat "$work/printed" >&2; exit 1; }
    done
    [ "$status" = 0 ] || { echo "'$section': exit code $status, after:" >&2; cat "$work/printed" >&2; exit 1; }
}
play "A second robot" "start robot2.speech_synthesis  OK"
play "Your own component in Python" "blink lamps.lamp  OK" "is_on  bool  false"
