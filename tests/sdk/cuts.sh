#!/usr/bin/env bash
# Links between a gateway and component programs that break after each of their bytes.
set -euo pipefail
exec python3 -B "$(dirname "${BASH_SOURCE[0]}")/cuts_test.py"
