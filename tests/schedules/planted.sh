#!/bin/sh
# The bugs that planted.py plants into a copy of the project have a place in the present source.
set -eu
exec python3 "$(dirname "$0")/planted.py" --check
