"""./dev bench: measures the gateway beside other servers in several rounds, and prints the results. docs/performance.md explains them."""

import argparse
import importlib
import subprocess
import sys
import time

import documents
import plot
import processes
import report
from parts import Settings

PARTS = ("requests", "fanout", "memory", "growth", "micro", "client", "console", "floods", "engines", "crowd", "choosing", "journal")


def read_arguments():
    parser = argparse.ArgumentParser(prog="./dev bench", description=__doc__)
    parser.add_argument("what", nargs="*", metavar="WHAT", help=f"the parts to run: {', '.join(PARTS)}; default: all")
    parser.add_argument("--quick", action="store_true", help="one short round: tests the benchmarks, but the numbers mean nothing")
    parser.add_argument("--rounds", type=int, help="number of rounds; default: 5")
    parser.add_argument("--plots", action="store_true", help="draw docs/performance-growth.svg again")
    parser.add_argument("--gateway", action="append", default=[], metavar="ARGUMENT", help="a further argument of rois-gateway")
    arguments = parser.parse_args()
    for part in arguments.what:
        if part not in PARTS:
            parser.error(f"unknown part '{part}': expected one of {', '.join(PARTS)}")
    return arguments


def version():
    command = ["git", "-C", str(processes.ROOT), "describe", "--always", "--dirty"]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip() or "unknown"


def measure(parts, rounds, settings):
    """Returns part -> row -> the measurements of all rounds."""
    kept = {part: {} for part in parts}
    for number in range(rounds):
        for part in parts:
            begun = time.monotonic()
            rows = kept[part]
            importlib.import_module(f"parts.{part}").round(lambda row, measured: rows.setdefault(row, []).append(measured), settings)
            print(f"round {number + 1} of {rounds}: {part}, {time.monotonic() - begun:.0f} s", file=sys.stderr, flush=True)
    return kept


def main():
    arguments = read_arguments()
    parts = [part for part in PARTS if part in arguments.what or not arguments.what]
    rounds = arguments.rounds or (1 if arguments.quick else 5)
    most = processes.allow_many_descriptors()
    settings = Settings(
        seconds=0.3 if arguments.quick else 0.8,
        turns=1 if arguments.quick else 3,
        connections=min(1_000 if arguments.quick else 10_000, most - 100),
        gateway=tuple(arguments.gateway),
    )
    documents.write_all(processes.WORK / "documents")
    machine = processes.machine()
    kept = measure(parts, rounds, settings)
    together = {row: rounds_of_it for part in kept.values() for row, rounds_of_it in part.items()}
    for part, rows in kept.items():
        print("\n".join(report.table(rows, part)), end="\n\n")
    print("\n".join(goal.line() for goal in report.goals(together)))
    print(f"\nmedians of {rounds} round{'s' if rounds > 1 else ''} on {machine['cores']} cores, {machine['cpu']}, {version()}")
    report.write_json(processes.ROOT / "build" / "bench.json", machine, version(), kept)
    if arguments.plots and "growth" in parts:
        (processes.ROOT / "docs" / "performance-growth.svg").write_text(plot.svg(report.medians(together)))


if __name__ == "__main__":
    try:
        main()
    except (processes.BenchError, subprocess.TimeoutExpired) as error:
        sys.exit(f"bench: {error}")
