"""The cost of the console for its user, in Chromium: its first view, the floor map with many people, and the page at rest."""

import json
import os
import subprocess

from processes import BIN, ROOT, BenchError

VIEW = "console, first view"
PEOPLE = "console, 20 people at 20 Hz"
REST = "console, at rest"


def round(keep, settings):
    console = ROOT / "web" / "console"
    command = ["npx", "vite-node", "tests/measure/console.ts", str(settings.seconds * 10)]
    environment = os.environ | {"ROIS_BINARY_DIR": str(BIN.parent)}
    done = subprocess.run(command, cwd=console, env=environment, capture_output=True, text=True, timeout=300)
    if done.returncode != 0:
        raise BenchError(f"console: {done.stderr.strip()}")
    for line in done.stdout.splitlines():
        measured = json.loads(line)
        keep(f"console, {measured.pop('row')}", measured)
