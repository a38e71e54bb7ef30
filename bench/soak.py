"""python3 bench/soak.py MINUTES: mixed load with faults, for as long as one likes. Memory, open files and latency must stay flat: compares the
second quarter of the time with the last one, and draws build/soak.svg."""

import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import attackers
import plot
from processes import BIN, CORES, ROOT, Server, running

WORKERS = 12
PROBES = 20  # queries a second whose latency is measured
BETWEEN_HANGUPS = 20  # seconds
COMPONENTS = ("navigation", "speech_synthesis", "move", "reaction", "system_information", "lamps.lamp")
GARBAGE = (b"\0" * 64, b"GET / HTTP/1.1\r\n\r\n", b"POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n\r\n<connect ", b"\x16\x03\x01")

# Measure -> its unit, and how much the last quarter may exceed the second one: a factor, and an absolute allowance.
MEASURES = {"memory": ("MB", 1.05, 1), "open files": ("", 1, 8), "latency of a query, p50": ("ms", 1.5, 0.5)}


def work(port, seed, over):
    """An application that uses a few components, and that fails now and then in one of several ways."""
    chance = random.Random(seed)
    line = attackers.Line(port)
    while not over.is_set():
        try:
            use(line, chance)
            fail(line, chance)
        except (OSError, IndexError):
            time.sleep(0.05)
            line.open()


def use(line, chance):
    line.is_connected()
    component = chance.choice(COMPONENTS)
    line.post(attackers.bind(component))
    line.post(attackers.subscribe("person_detected"))
    for _ in range(chance.randrange(1, 20)):
        line.post(attackers.query("engine_status"))
        line.post(attackers.execute([attackers.unit(component, "stop")]))
        if component == "speech_synthesis":
            text = attackers.parameter("rois:parameter", "speech_text", "string", "Good morning.")
            line.post(attackers.execute([attackers.unit(component, "start", text)]))
        if component == "lamps.lamp":
            line.post(attackers.execute([attackers.unit(component, "start")]))
        line.get("/rois/notifications?after=0&wait=0")
        time.sleep(0.01)


def fail(line, chance):
    way = chance.randrange(4)
    if way == 0:
        line.post(f'<disconnect xmlns="{attackers.MESSAGE}"/>')
        line.session = ""
    elif way == 1:
        line.open()  # the connection is lost, and its session with it
    elif way == 2:
        line.socket.sendall(chance.choice(GARBAGE))
        line.open()
    else:
        line.post("<" * chance.randrange(1, 2_000))


def lose_programs(port, over):
    """A component program that is killed again and again; half of the times it hangs before."""
    chance = random.Random(1)
    while not over.is_set():
        command = [BIN / "rois-lamp", "--url", f"ws://127.0.0.1:{port}", "--name", "lamps"]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as program:
            over.wait(chance.uniform(0.5, 4))
            if chance.randrange(2):
                program.send_signal(signal.SIGSTOP)
                over.wait(chance.uniform(0.5, 4))
            program.kill()


def sample(server, line):
    times = []
    for _ in range(PROBES):
        begun = time.perf_counter()
        line.post(attackers.query("engine_status"))
        times.append(1_000 * (time.perf_counter() - begun))
        time.sleep(1 / PROBES / 2)
    return server.resident_bytes() / 1e6, len(os.listdir(f"/proc/{server.pid}/fd")), statistics.median(times)


def soak(server, minutes):
    """Returns measure -> its value in each second."""
    values = {name: [] for name in MEASURES}
    over = threading.Event()
    workers = [threading.Thread(target=work, args=(server.port, seed, over)) for seed in range(WORKERS)]
    workers.append(threading.Thread(target=lose_programs, args=(server.port, over)))
    for worker in workers:
        worker.start()
    probe = attackers.Line(server.port)
    begun = hung_up = time.monotonic()
    while time.monotonic() - begun < 60 * minutes:
        probe.is_connected()
        for name, value in zip(MEASURES, sample(server, probe)):
            values[name].append(value)
        if time.monotonic() - hung_up > BETWEEN_HANGUPS:
            os.kill(server.pid, signal.SIGHUP)
            hung_up = time.monotonic()
        time.sleep(max(0, begun + len(values["memory"]) - time.monotonic()))
    over.set()
    for worker in workers:
        worker.join()
    return values


def verdicts(values):
    """Measure -> its medians in the second and the last quarter, and whether it stayed flat."""
    found = {}
    for name, (_, factor, more) in MEASURES.items():
        series = values[name]
        quarter = len(series) // 4
        early, late = statistics.median(series[quarter : 2 * quarter]), statistics.median(series[3 * quarter :])
        found[name] = early, late, late <= early * factor + more
    return found


def main(minutes):
    with tempfile.TemporaryDirectory(prefix="rois-soak-") as folder:
        engines = pathlib.Path(folder) / "engines.json"
        engines.write_text('{"engines": [{"name": "lamps", "joins": "lamps"}]}')
        command = [BIN / "rois-gateway", "--listen", "127.0.0.1:{port}", "--state", folder, "--engines", engines]
        command += ["--log-level", "error", "--resume-window", "2", "--session-timeout", "2"]
        with running(Server("gateway-soak", command, "/readyz", len(CORES))) as (server,):
            values = soak(server, minutes)
    found = verdicts(values)
    (ROOT / "build" / "soak.svg").write_text(plot.series(values, {name: unit for name, (unit, *_) in MEASURES.items()}))
    for name, (early, late, is_flat) in found.items():
        print(f"{name:28} {early:8.2f} in the second quarter, {late:8.2f} in the last: {'flat' if is_flat else 'NOT FLAT'}")
    return all(is_flat for *_, is_flat in found.values())


if __name__ == "__main__":
    sys.exit(0 if main(float(sys.argv[1])) else 1)
