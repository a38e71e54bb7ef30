"""Micro benchmarks of the steps of a request (Google Benchmark)."""

import json
import subprocess

from processes import BIN, WORK, BenchError


def round(keep, settings):
    command = [str(BIN / "rois-micro"), str(WORK / "documents" / "micro"), "--benchmark_format=json"]
    command.append(f"--benchmark_min_time={settings.seconds / 20}")
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        raise BenchError(f"rois-micro: {done.stderr.strip()}")
    for one in json.loads(done.stdout)["benchmarks"]:
        if one.get("error_occurred"):
            raise BenchError(f"rois-micro: {one['name']}: {one['error_message']}")
        keep(one["name"], {"cpu_us": one["cpu_time"] / 1_000})
