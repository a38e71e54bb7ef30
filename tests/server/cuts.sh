#!/bin/bash
# Connections that break after each byte that a client sends: what it asked for is done as a whole or not at all.
set -euo pipefail
exec python3 -B "$(dirname "$0")/cuts_test.py"
