#!/bin/sh
# The programs of a release are built against exploits of errors in memory: position-independent, with a stack protector and checked
# functions of the C library; their tables of functions are read-only, and their stack cannot be executed.
set -eu
cd "$ROIS_BINARY_DIR"
grep -q '^CMAKE_BUILD_TYPE:STRING=Release' CMakeCache.txt || { echo "not a release: skipped"; exit 0; }

status=0
expect() { # PROGRAM WHAT COMMAND...: the output of the command has a line that matches WHAT
    program=$1 what=$2
    shift 2
    "$@" "bin/$program" | grep -Eq -- "$what" && return
    echo "$program: expected '$what' from $*"
    status=1
}
for program in rois-gateway rois rois-lamp; do
    expect $program 'Type: +DYN \(Position-Independent Executable file\)' readelf -hW
    expect $program 'GNU_RELRO' readelf -lW
    expect $program 'GNU_STACK .* RW +0x' readelf -lW
    expect $program 'BIND_NOW|Flags: NOW' readelf -dW
    expect $program ' __stack_chk_fail' readelf --dyn-syms -W
    expect $program ' __[a-z]+_chk@' readelf --dyn-syms -W
done
exit $status
