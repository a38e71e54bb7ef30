"""The cost of a sub engine: the same query to a component of the gateway, and to one of its sub engine."""

import json
import time
import urllib.error
import urllib.request

from processes import WORK, BenchError, document, gateway, load, running

LOCAL = "query 0.6 kB, own component"
MAIN = "query 0.6 kB, sub engine: CPU of the main engine"
BOTH = "query 0.6 kB, sub engine: CPU of both engines"
ONE_LOCAL = "query 0.6 kB, own component, 1 connection"
ONE_REMOTE = "query 0.6 kB, sub engine, 1 connection"

AGAINST = {MAIN: LOCAL, BOTH: LOCAL, ONE_REMOTE: ONE_LOCAL}

COMPONENT = "hall.system_information"


def round(keep, settings):
    file = WORK / "engines.json"
    with running(gateway(1, name="sub-engine")) as (hall,):
        file.write_text(json.dumps({"engines": [{"name": "hall", "url": f"ws://127.0.0.1:{hall.port}"}]}))
        with running(gateway(1, "--robots", "none", "--engines", file, name="main-engine"), gateway(1)) as (main, own):
            await_component(main)
            for _ in range(settings.turns):
                ask(keep, LOCAL, own, "query-0.6kB", settings)
                before = hall.cpu_seconds()
                through = ask(keep, MAIN, main, "query-0.6kB-hall", settings)
                used = 1e6 * (hall.cpu_seconds() - before) / through["requests"]
                keep(BOTH, through | {"cpu_us": through["cpu_us"] + used})
            ask(keep, ONE_LOCAL, own, "query-0.6kB", settings, connections=1)
            ask(keep, ONE_REMOTE, main, "query-0.6kB-hall", settings, connections=1)


def ask(keep, row, server, body, settings, connections=64):
    options = {"via": "http", "connections": connections, "seconds": settings.seconds, "connect": "yes", "expect": '"OK"'}
    measured = load("requests", server, body=document(body), **options)
    keep(row, measured)
    return measured


def await_component(main):
    """The sub engine is there soon after the start."""
    for _ in range(1_000):
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{main.port}/rois/profile/{COMPONENT}"):
                return
        except urllib.error.HTTPError:
            time.sleep(0.01)
    raise BenchError("the components of the sub engine did not come")
