"""The cost of a flood for the gateway and its other clients: memory, CPU, the p99 of a neighbour's query and of all ways to stop."""

import subprocess
import sys
import time

import attackers
from processes import BIN, CORES, ROOT, Server, running

WAYS = ("stop", "release", "disconnect", "stop-all")
STOPS = [f"{way}_p99_ms" for way in WAYS]


def round(keep, settings):
    for kind in ("none", *attackers.KINDS):
        command = [BIN / "rois-gateway", "--listen", "127.0.0.1:{port}", "--log-level", "debug", *settings.gateway]
        with running(Server(f"gateway-{kind}", command, "/readyz", len(CORES))) as (server,):
            keep(f"flood: {kind}", measured(server, kind, settings.seconds * 10))


def measured(server, kind, seconds):
    attack = None
    if kind != "none":
        attack = subprocess.Popen([sys.executable, ROOT / "bench" / "attackers.py", kind, str(server.port)], stderr=subprocess.DEVNULL)
    try:
        time.sleep(0.5)
        return probe(server, seconds)
    finally:
        if attack:
            attack.kill()
            attack.wait()


def probe(server, seconds):
    """Alternates between a neighbour that sends queries and a client that stops, on separate connections."""
    neighbour, stopper = attackers.Line(server.port), attackers.Line(server.port)
    clock = (~server.pid << 3) | 2
    begun, used, most = time.perf_counter(), time.clock_gettime(clock), 0
    times = {"neighbour": [], **{way: [] for way in WAYS}}

    def timed(name, line, *request):
        sent = time.perf_counter()
        answer = line.post(*request)
        times[name].append(time.perf_counter() - sent)
        if "200 OK" not in answer or ("return_code" in answer and '"OK"' not in answer):
            raise RuntimeError(f"{name}: {answer}")

    while time.perf_counter() - begun < seconds:
        if len(times["neighbour"]) % 500 == 0:  # a new session: each "stop-all" queues an error for the old one, which reads nothing
            open_session(neighbour)
        timed("neighbour", neighbour, attackers.query("engine_status"))
        if not stopper.session:
            open_session(stopper)
            stopper.post(attackers.bind("navigation"))
        timed("stop", stopper, attackers.execute([attackers.unit("navigation", "stop")]))
        timed("release", stopper, attackers.bind("navigation").replace("bind", "release"))
        timed("disconnect", stopper, f'<disconnect xmlns="{attackers.MESSAGE}"/>')
        stopper.session = ""
        timed("stop-all", stopper, "", "/rois/stop")
        stopper.post("", "/rois/clear")
        most = max(most, server.resident_bytes())
        time.sleep(0.005)
    spent = time.perf_counter() - begun
    result = {f"{name}_p99_ms": percentile(all_times, 0.99) * 1_000 for name, all_times in times.items()}
    return {
        "resident_mb": most / 1e6,
        "cpu_percent": 100 * (time.clock_gettime(clock) - used) / spent,
        "asked": len(times["stop"]),
        **result,
    }


def open_session(line):
    line.session = ""
    while not line.connect():
        pass


def percentile(times, part):
    return sorted(times)[min(len(times) - 1, int(len(times) * part))]


