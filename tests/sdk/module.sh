#!/usr/bin/env bash
# The Python module for component programs, with an engine that module_test.py plays.
set -euo pipefail
exec python3 -B "$(dirname "${BASH_SOURCE[0]}")/module_test.py"
