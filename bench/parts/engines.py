"""The cost of a sub engine: the same query to a component of the gateway, and to one of its sub engine; the same for events."""

import json
import time
import urllib.error
import urllib.request

from processes import WORK, BenchError, document, gateway, load, running, stage

LOCAL = "query 0.6 kB, own component"
MAIN = "query 0.6 kB, sub engine: CPU of the main engine"
BOTH = "query 0.6 kB, sub engine: CPU of both engines"
ONE_LOCAL = "query 0.6 kB, own component, 1 connection"
ONE_REMOTE = "query 0.6 kB, sub engine, 1 connection"

SUBSCRIBERS = 64  # as many as requests in flight
BURST = 100  # events of one command, so that the command hardly counts
RATE = 40  # commands a second: 4,000 events, below the limit of 5,000 for one sub engine
EVENT_LOCAL = f"event to {SUBSCRIBERS} subscribers, own component"
EVENT_MAIN = f"event to {SUBSCRIBERS} subscribers, sub engine: CPU of the main engine"
EVENT_BOTH = f"event to {SUBSCRIBERS} subscribers, sub engine: CPU of both engines"

AGAINST = {MAIN: LOCAL, BOTH: LOCAL, ONE_REMOTE: ONE_LOCAL, EVENT_MAIN: EVENT_LOCAL, EVENT_BOTH: EVENT_LOCAL}


def round(keep, settings):
    with running(gateway(1, name="sub-engine")) as (hall,):
        with running(above(hall), gateway(1)) as (main, own):
            await_component(main, "hall.system_information")
            for _ in range(settings.turns):
                ask(keep, LOCAL, own, "query-0.6kB", settings)
                with_hall(keep, BOTH, hall, "requests", lambda: ask(keep, MAIN, main, "query-0.6kB-hall", settings))
            ask(keep, ONE_LOCAL, own, "query-0.6kB", settings, connections=1)
            ask(keep, ONE_REMOTE, main, "query-0.6kB-hall", settings, connections=1)

    with running(stage()) as (hall,), running(above(hall), stage()) as (main, own):
        await_component(main, "hall.probe0")
        for _ in range(settings.turns):
            send_events(keep, EVENT_LOCAL, own, "", settings)
            with_hall(keep, EVENT_BOTH, hall, "messages", lambda: send_events(keep, EVENT_MAIN, main, "-hall", settings))


def with_hall(keep, row, hall, counted, measure):
    """A row with the CPU time of the sub engine added to that of the measured main engine."""
    before = hall.cpu_seconds()
    measured = measure()
    used = 1e6 * (hall.cpu_seconds() - before) / measured[counted]
    keep(row, measured | {"cpu_us": measured["cpu_us"] + used})


def above(hall):
    """A gateway whose only components are those of this sub engine."""
    file = WORK / "engines.json"
    file.write_text(json.dumps({"engines": [{"name": "hall", "url": f"ws://127.0.0.1:{hall.port}"}]}))
    return gateway(1, "--robots", "none", "--engines", file, name="main-engine")


def send_events(keep, row, server, suffix, settings):
    options = {"via": "websocket", "connect": "yes", "connections": SUBSCRIBERS, "setup": document("subscribe"), "burst": BURST, "rate": RATE}
    folder = WORK / "documents" / "micro"
    firing = {"fire_setup": folder / f"bind-probe0{suffix}.xml", "fire": folder / f"fire-{BURST}{suffix}.xml"}
    measured = load("fanout", server, seconds=settings.seconds, **options, **firing)
    keep(row, measured)
    return measured


def ask(keep, row, server, body, settings, connections=64):
    options = {"via": "http", "connections": connections, "seconds": settings.seconds, "connect": "yes", "expect": '"OK"'}
    measured = load("requests", server, body=document(body), **options)
    keep(row, measured)
    return measured


def await_component(main, component):
    """The sub engine is there soon after the start."""
    for _ in range(1_000):
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{main.port}/rois/profile/{component}"):
                return
        except urllib.error.HTTPError:
            time.sleep(0.01)
    raise BenchError("the components of the sub engine did not come")
