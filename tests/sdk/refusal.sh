#!/usr/bin/env bash
# Engines and component programs that another engine refuses.
set -euo pipefail
exec python3 -B "$(dirname "${BASH_SOURCE[0]}")/refusal_test.py"
