"""A hundred sub engines with ten components each: how fast they join, and whether another client notices them."""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import time
import urllib.request

from processes import ROOT, WORK, BenchError, beside, document, gateway, load, running

ENGINES, COMPONENTS = 100, 10
SPECIAL = ("hangs", "floods", "reconnects")  # one more engine each
JOINING = f"{ENGINES} sub engines with {ENGINES * COMPONENTS:,} components join"
AT_REST = "a client beside them"
EVENTS = "a client beside 5,000 events/s of them"


def with_one(special):
    return f"a client beside 5,000 events/s of them, and one that {special}"


def round(keep, settings):
    with running(main_engine()) as (main,):
        calm = neighbour(main, settings)
        before, threads = main.resident_bytes(), count_threads(main)
        with beside("requests", main, body=document("query-0.6kB"), seconds=5, **quiet()) as client, crowd(main, names()) as them:
            joined = await_present(main, ENGINES)
            meanwhile = json.loads(client.stdout.readline())
            keep(JOINING, {"seconds": joined, "neighbour_p99_ms": meanwhile["p99_us"] / 1_000})
            each = (main.resident_bytes() - before) / ENGINES / 1_000
            keep(AT_REST, p99(neighbour(main, settings), calm) | {"kb_each": each, "threads": count_threads(main) - threads})
            say(them, "5000")
            busy = neighbour(main, settings)
            keep(EVENTS, p99(busy, calm))
            for special in SPECIAL:
                with elsewhere(special):
                    before = neighbour(main, settings)
                with one_that(special, main):
                    keep(with_one(special), p99(neighbour(main, settings), before))


def names():
    return [f"e{i}" for i in range(ENGINES)]


def main_engine(name="crowd-main"):
    file = WORK / "crowd.json"
    file.write_text(json.dumps({"engines": [{"name": name, "joins": name} for name in (*names(), *SPECIAL)]}))
    return gateway(2, "--engines", file, name=name)


def quiet():
    return {"via": "http", "connect": "yes", "expect": '"OK"', "connections": 16, "rate": 2_000}


def neighbour(main, settings):
    return load("requests", main, body=document("query-0.6kB"), seconds=8 * settings.seconds, **quiet())


def p99(measured, before):
    return {"p99_ms": measured["p99_us"] / 1_000, "times_before": measured["p99_us"] / before["p99_us"]}


def count_threads(main):
    return len(os.listdir(f"/proc/{main.pid}/task"))


def say(them, line):
    them.stdin.write(line + "\n")
    them.stdin.flush()


def lowest_priority(task=0):
    """Sub engines run elsewhere. Here they share the cores, and must not take time that the gateway wants."""
    os.sched_setscheduler(task, os.SCHED_IDLE, os.sched_param(0))


@contextlib.contextmanager
def elsewhere(special):
    """The engine at another gateway, of lowest priority: its program keeps the cores as busy."""
    if special == "hangs":
        yield
        return
    with running(main_engine("crowd-other")) as (other,):
        for thread in os.listdir(f"/proc/{other.pid}/task"):
            lowest_priority(int(thread))
        with one_that(special, other, 1):
            yield


@contextlib.contextmanager
def crowd(main, engines):
    command = [sys.executable, "-B", ROOT / "bench" / "crowd.py", f"ws://127.0.0.1:{main.port}", COMPONENTS, *engines]
    with open(WORK / "crowd.log", "ab") as log:
        process = subprocess.Popen([str(part) for part in command], stdin=subprocess.PIPE, stderr=log, text=True, preexec_fn=lowest_priority)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGCONT)
        process.kill()
        process.wait()


@contextlib.contextmanager
def one_that(special, main, engines=ENGINES + 1):
    with crowd(main, [special]) as one:
        await_present(main, engines)
        if special == "hangs":
            one.send_signal(signal.SIGSTOP)
        else:
            say(one, "20000" if special == "floods" else "reconnect")
        yield


def await_present(main, engines):
    """Waits until so many sub engines are present. Returns the seconds."""
    begun = time.monotonic()
    while time.monotonic() - begun < 30:
        with urllib.request.urlopen(f"http://127.0.0.1:{main.port}/metrics") as answer:
            if len(re.findall(r"^rois_engine_present\{.*\} 1$", answer.read().decode(), re.MULTILINE)) >= engines:
                return time.monotonic() - begun
        time.sleep(0.02)
    raise BenchError(f"{engines} sub engines did not come within 30 s: see build/bench/crowd.log")
