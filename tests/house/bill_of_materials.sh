#!/bin/sh
# The bill of materials names what the gateway contains and loads, with the versions that are installed.
set -eu
cd "$(dirname "$0")/../.."

python3 - "$ROIS_BINARY_DIR/bin/rois-gateway.spdx.json" <<'END'
import json
import subprocess
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    bill = json.load(file)
assert bill["spdxVersion"] == "SPDX-2.3" and bill["SPDXID"] == "SPDXRef-DOCUMENT" and bill["dataLicense"] == "CC0-1.0"
packages = {package["name"]: package for package in bill["packages"]}
used = {relation["relatedSpdxElement"]: relation["relationshipType"] for relation in bill["relationships"]}
assert len({package["SPDXID"] for package in packages.values()}) == len(bill["packages"]) == len(used)

for name, how in (("libssl3", "DYNAMIC_LINK"), ("libxerces-c3.2", "DYNAMIC_LINK"), ("libc6", "DYNAMIC_LINK"),
                  ("libboost1.81-dev", "STATIC_LINK"), ("nlohmann-json3-dev", "STATIC_LINK")):
    installed = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", name], capture_output=True, text=True, check=True).stdout
    assert packages[name]["versionInfo"] == installed, f"{name}: {packages[name]['versionInfo']}, not {installed}"
    assert used[packages[name]["SPDXID"]] == how, f"{name}: {how}"
with open("web/package-lock.json", encoding="utf-8") as file:
    locked = json.load(file)["packages"]
for path, entry in locked.items():
    name = path.removeprefix("node_modules/")
    contained = path.startswith("node_modules/") and not entry.get("dev") and not entry.get("link")
    assert contained == (name in packages), f"{name}: contained: {contained}"
    assert not contained or packages[name]["versionInfo"] == entry["version"], name
END
