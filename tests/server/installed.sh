#!/usr/bin/env bash
# The gateway as others get it: installs it into a folder, looks at its manual page, completion and sample configuration, and runs it.
set -euo pipefail

build=${ROIS_BINARY_DIR:?}
work=$(mktemp -d)
gateway=
trap 'test -z "$gateway" || kill "$gateway"; rm -rf "$work"' EXIT
fail() {
    echo "installed.sh: $*"
    exit 1
}
prefix="$work/some where"  # a path with a space must work
program="$prefix/bin/rois-gateway"
sample="$prefix/share/doc/rois-gateway/rois-gateway.json"

cmake --install "$build" --component gateway --prefix "$prefix" >"$work/install.log"
[[ $("$program" --version) == "rois-gateway "* ]] || fail "--version says '$("$program" --version)'"

flags=$({ "$program" --help && "$program" token add --help; } | grep -oE '^ +(-h,)?--[a-z-]+' | grep -oE -- '--.*')
page=$(sed 's/\\-/-/g' "$prefix/share/man/man1/rois-gateway.1")
for flag in $flags; do
    grep -qwF -- "$flag" <<<"$page" || fail "the manual page does not explain $flag"
done
while read -r flag; do
    grep -qxF -- "$flag" <<<"$flags" || fail "the manual page explains $flag, which the program does not know"
done < <(sed -nE 's/^\.(B|BI|BR) .*(--[a-z-]+).*/\2/p' <<<"$page" | sort -u)

# completed WORD...: what bash offers for the last one.
completed() {
    PATH="$prefix/bin:$PATH" bash -c '
        source "$1/share/bash-completion/completions/rois-gateway"
        shift
        COMP_WORDS=(rois-gateway "$@") COMP_CWORD=$#
        _rois_gateway
        echo "${COMPREPLY[*]}"' - "$prefix" "$@"
}
[[ $(completed --log-f) == --log-format ]] || fail "--log-f is completed with '$(completed --log-f)'"
[[ $(completed token a) == add ]] || fail "token a is completed with '$(completed token a)'"
[[ $(completed token add x --ro) == --role ]] || fail "token add x --ro is completed with '$(completed token add x --ro)'"
[[ $(completed --log-level de) == debug ]] || fail "--log-level de is completed with '$(completed --log-level de)'"
[[ $(completed --config "$sample") == "$sample" ]] || fail "a file is not completed"
[[ $(completed '') == *--listen*--version* || $(completed '') == *--version*--listen* ]] || fail "not every flag is offered"

grep -q '"listen": "127.0.0.1:8080"' "$sample" || fail "the sample configuration listens elsewhere than on the loopback"
"$program" --config "$sample" --check-config >/dev/null

"$program" --config "$sample" --listen 127.0.0.1:0 2>"$work/gateway.log" &
gateway=$!
until url=$(grep -o 'http://127.0.0.1:[0-9]*' "$work/gateway.log"); do
    kill -0 "$gateway" || fail "it does not start: $(cat "$work/gateway.log")"
    sleep 0.05
done
[[ $(curl -sS "$url/readyz") == ready ]] || fail "it is not ready"
kill "$gateway"
wait "$gateway" || fail "it ended with $?"
gateway=
