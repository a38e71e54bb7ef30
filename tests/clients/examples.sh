#!/bin/sh
# The examples in Python and shell: what their callers may rely on (examples_test.py).
exec python3 -B "$(dirname "$0")/examples_test.py"
