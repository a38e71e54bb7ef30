#!/usr/bin/env bash
# Events of component programs that occur without a session, with an engine that unsent_test.py plays.
set -euo pipefail
exec python3 -B "$(dirname "${BASH_SOURCE[0]}")/unsent_test.py"
