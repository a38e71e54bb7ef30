"""The cost of a flood, of motion leases and of faults: memory, CPU, the p99 of a neighbour's query and of all ways to stop."""

import os
import resource
import shutil
import subprocess
import sys
import time

import attackers
from processes import BIN, CORES, ROOT, WORK, BenchError, Server, running

WAYS = ("stop", "release", "disconnect", "stop-all", "stop-all-anew")  # the last one on a connection that is opened for it
STOPS = [f"{way}_p99_ms" for way in WAYS]


UNSTOPPABLE = """<scenario xmlns="urn:x-rois:simulation:hall:1" name="An unstoppable robot">
  <fault component="move" kind="unstoppable" from="1"/>
</scenario>
"""


def round(keep, settings):
    for kind in ("none", *attackers.FLOODS):
        arguments, client = needs(kind)
        with gateway(kind, settings, *arguments) as (server,):
            keep(f"flood: {kind}", measured(server, kind, settings.seconds * 10, client=client))
    with gateway("leases", settings) as (server,):
        keep("lease: held and resumed", measured(server, "leases", settings.seconds * 10, WAYS[:3]))  # a stop of everything would end the motion
    scenario = WORK / "unstoppable.xml"
    scenario.write_text(UNSTOPPABLE)
    with gateway("unstoppable", settings, "--scenario", scenario) as (server,):
        keep("fault: a component does not halt", measured(server, "motions", settings.seconds * 10))
    reader, writer = os.pipe()
    with gateway("unread-log", settings, log=writer) as (server,):
        keep("fault: standard error is not read", measured(server, "speeches", settings.seconds * 10))
    os.close(reader)
    os.close(writer)
    with gateway("no-memory", settings) as (server,):
        most = server.address_space() + 1024 * 1024
        resource.prlimit(server.pid, resource.RLIMIT_AS, (most, resource.RLIM_INFINITY))
        keep("fault: no memory from the system", measured(server, "bodies", settings.seconds * 10, WAYS[3:4]))  # no new sessions or connections then


def needs(kind):
    """The arguments of the gateway for this flood, and what its clients need: a token, TLS."""
    if kind == "wrong_tokens":
        file = WORK / "tokens.json"
        file.unlink(missing_ok=True)
        add = [BIN / "rois-gateway", "token", "add", "bench", "--role", "administrator", "--tokens", file]
        token = subprocess.run(add, check=True, capture_output=True, text=True).stdout.strip()
        return ["--tokens", file], {"token": token}
    if kind == "stored":
        folder = WORK / "state"
        shutil.rmtree(folder, ignore_errors=True)
        return ["--state", folder], {}
    if kind == "handshakes":
        certificate, key = WORK / "bench.pem", WORK / "bench.key"
        make = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2"]
        subprocess.run([*make, "-subj", "/CN=localhost", "-keyout", key, "-out", certificate], check=True, capture_output=True)
        return ["--tls-certificate", certificate, "--tls-key", key], {"secure": True}
    return [], {}


def gateway(name, settings, *arguments, log=None):
    command = [BIN / "rois-gateway", "--listen", "127.0.0.1:{port}", "--log-level", "debug", *arguments, *settings.gateway]
    health = None if "--tls-key" in arguments else "/readyz"
    return running(Server(f"gateway-{name}", command, health, len(CORES), log))


def measured(server, kind, seconds, ways=WAYS, client=None):
    neighbour, stopper = Client(server.port, **(client or {})), Client(server.port, **(client or {}))
    open_session(neighbour)
    open_session(stopper)
    attack = None
    if kind != "none":
        attack = subprocess.Popen([sys.executable, ROOT / "bench" / "attackers.py", kind, str(server.port)], stderr=subprocess.DEVNULL)
    try:
        time.sleep(0.5)
        if "disconnect" in ways:  # sessions that were idle meanwhile may have been replaced
            open_session(neighbour)
            open_session(stopper)
        return probe(server, seconds, neighbour, stopper, ways, lambda: Client(server.port, **(client or {})))
    finally:
        if attack:
            attack.kill()
            attack.wait()


class Client(attackers.Line):
    """Reconnects and asks again if its connection was cut: without memory, the gateway cuts connections that wait."""

    def post(self, *request):
        session = self.session
        for _ in range(100):
            if answer := super().post(*request):
                return answer
            self.session = session
        return ""


def probe(server, seconds, neighbour, stopper, ways, new_client):
    """Alternates between a neighbour that sends queries and a client that stops, on separate connections."""
    clock = (~server.pid << 3) | 2
    begun, used, most = time.perf_counter(), time.clock_gettime(clock), 0
    times = {"neighbour": [], **{way: [] for way in ways}}

    def timed(name, line, *request):
        if name not in times:
            return
        sent = time.perf_counter()
        answer = (line or new_client()).post(*request)
        times[name].append(time.perf_counter() - sent)
        if "200 OK" not in answer or ("return_code" in answer and '"OK"' not in answer):
            raise BenchError(f"{name}: {answer or 'the connection was closed'}")

    while time.perf_counter() - begun < seconds:
        timed("neighbour", neighbour, attackers.query("engine_status"))
        if "disconnect" in ways:
            if not stopper.session:
                open_session(stopper)
            stopper.post(attackers.bind("navigation"))
            timed("stop", stopper, attackers.execute([attackers.unit("navigation", "stop")]))
            timed("release", stopper, attackers.bind("navigation").replace("bind", "release"))
            timed("disconnect", stopper, f'<disconnect xmlns="{attackers.MESSAGE}"/>')
            stopper.session = ""
        timed("stop-all", stopper, "", "/rois/stop")
        timed("stop-all-anew", None, "", "/rois/stop")
        stopper.post("", "/rois/clear")
        most = max(most, server.resident_bytes())
        time.sleep(0.005)
    spent = time.perf_counter() - begun
    result = {f"{name}_p99_ms": percentile(all_times, 0.99) * 1_000 for name, all_times in times.items()}
    return {
        "resident_mb": most / 1e6,
        "cpu_percent": 100 * (time.clock_gettime(clock) - used) / spent,
        "asked": len(times["neighbour"]),
        **result,
    }


def open_session(line):
    line.session = ""
    while not line.connect():
        pass


def percentile(times, part):
    return sorted(times)[min(len(times) - 1, int(len(times) * part))]


