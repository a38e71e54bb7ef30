#!/usr/bin/env bash
# Installs the client library, builds a program outside the tree with CMake and with pkg-config, and runs both against the gateway. Does
# the same with the example of the C++ PSM in docs/client-cpp.md, in C++17.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=${ROIS_BINARY_DIR:?}
work=$(mktemp -d)
gateway=
trap 'test -z "$gateway" || kill "$gateway"; rm -rf "$work"' EXIT
prefix="$work/some where"  # spaces in names must work

cmake --install "$build" --component client --prefix "$prefix" >"$work/install.log"
for header in "$prefix"/include/*; do
    test "$(basename "$header")" = rois || { echo "installed.sh: $header is outside of rois/"; exit 1; }
done

sanitize=$(sed -n 's/^ROIS_SANITIZE:STRING=//p' "$build/CMakeCache.txt")
flags="-Wall -Wextra -Wpedantic -Werror ${sanitize:+-fsanitize=$sanitize -Wno-maybe-uninitialized}"
cmake -G Ninja -S "$here/outside" -B "$work/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="$flags" >"$work/configure.log"
cmake --build "$work/cmake" >"$work/build.log" || { cat "$work/build.log"; exit 1; }

export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name rois.pc)")
# shellcheck disable=SC2086  # flags are words
eval "g++ -std=c++20 $flags '$here/outside/outside.cpp' -o '$work/by-pkg-config' $(pkg-config --cflags --libs rois)"

# shellcheck disable=SC2086
eval "g++ -std=c++20 $flags '$here/outside/outside_psm.cpp' -o '$work/psm-by-pkg-config' $(pkg-config --cflags --libs rois-psm)"

awk '/^## / { here = /The C\+\+ PSM/ } here && /^```/ { example = $0 == "```cpp"; next } here && example' "$here/../../docs/client-cpp.md" >"$work/documented.cpp"
# shellcheck disable=SC2086
eval "g++ -std=c++17 $flags '$work/documented.cpp' -o '$work/documented' $(pkg-config --cflags --libs rois-psm)"

"$build/bin/rois-gateway" --listen 127.0.0.1:0 --sim-speed 10 2>"$work/gateway.log" &
gateway=$!
until url=$(grep -o 'http://127.0.0.1:[0-9]*' "$work/gateway.log"); do kill -0 "$gateway"; sleep 0.05; done
for program in "$work/cmake/outside" "$work/by-pkg-config" "$work/cmake/outside_psm" "$work/psm-by-pkg-config"; do
    said=$(ROIS_URL=$url "$program")
    test "$said" = navigation || { echo "installed.sh: $program said '$said'"; exit 1; }
done
ROIS_URL=$url timeout 60 "$work/documented" >"$work/said"
grep -q "welcomed visitors$" "$work/said" || { echo "installed.sh: the example in docs/client-cpp.md said:"; cat "$work/said"; exit 1; }
