#!/bin/sh
# docker/rois-gateway.json holds every key of the configuration with its default, except the address to listen on and the tokens.
set -eu
cd "$(dirname "$0")/../.."

if "$ROIS_BINARY_DIR/bin/rois-gateway" --listen 0.0.0.0:8080 --tokens /access/tokens.json --print-config | diff docker/rois-gateway.json -; then exit 0; fi
echo "update it: build/release/bin/rois-gateway --listen 0.0.0.0:8080 --tokens /access/tokens.json --print-config > docker/rois-gateway.json"
exit 1
