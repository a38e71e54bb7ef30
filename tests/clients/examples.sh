#!/bin/sh
# Tests the examples in Python and shell (examples_test.py).
exec python3 -B "$(dirname "$0")/examples_test.py"
