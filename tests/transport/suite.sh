#!/bin/bash
# The WebSockets of the gateway, in an endpoint that returns each message, against RFC 6455.
set -euo pipefail

work=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; wait; rm -rf "$work"' EXIT
mkfifo "$work/url"
"${ROIS_BINARY_DIR:?}/bin/rois-echo" >"$work/url" &
read -r url <"$work/url"
"$(dirname "$0")/suite.py" "$url"
