#!/usr/bin/env bash
# The Python module for component programs, with an engine that the tests play.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
exec python3 -B -W ignore -m unittest module_test values_test
