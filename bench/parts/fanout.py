"""One event to many subscribers, and what requests feel of it meanwhile."""

import time

from processes import BIN, WORK, Server, beside, document, load, running, stage

MANY = 1_000
BURSTS = (1, 8)


def row(subscribers, burst, threads=1):
    waiting = "nothing waiting" if burst == 1 else f"{burst} waiting"
    many = "s" if subscribers > 1 else ""
    return f"{subscribers:,} subscriber{many}, {waiting}" + ("" if threads == 1 else f", {threads} threads")


def sender_row(burst):
    return f"prebuilt frames to {MANY:,}, " + ("nothing waiting" if burst == 1 else f"{burst} waiting")


AGAINST = {row(MANY, burst): sender_row(burst) for burst in BURSTS}
REQUESTS = f"query 0.6 kB at 500/s beside 20 events/s to {MANY:,} subscribers, 2 threads"


def fire(burst):
    """The fan-out's options: the connection that fires has bound probe0."""
    folder = WORK / "documents" / "micro"
    return {"fire_setup": folder / "bind-probe0.xml", "fire": folder / f"fire-{burst}.xml", "burst": burst}


def hear(server, subscribers, burst, seconds):
    options = {"via": "websocket", "connect": "yes", "connections": subscribers, "setup": document("subscribe")}
    return load("fanout", server, seconds=seconds, **options, **fire(burst))


def round(keep, settings):
    for burst in BURSTS:
        message_bytes = 0
        for subscribers in (1, 100, MANY, 5_000):
            with running(stage()) as (server,):
                heard = hear(server, subscribers, burst, settings.seconds)
            keep(row(subscribers, burst), heard)
            message_bytes = int(heard["message_bytes"])
        with running(Server("sender", [BIN / "rois-prebuilt-sender", "{port}", message_bytes])) as (server,):
            (WORK / "burst").write_text(str(burst))
            options = {"via": "websocket", "connections": MANY, "fire": WORK / "burst", "burst": burst}
            keep(sender_row(burst), load("fanout", server, seconds=settings.seconds, **options))
        with running(stage(threads=2)) as (server,):
            keep(row(MANY, burst, 2), hear(server, MANY, burst, settings.seconds))
    keep(REQUESTS, requests_beside_events(settings))


def requests_beside_events(settings):
    seconds = max(2.0, 2 * settings.seconds)
    with running(stage(threads=2)) as (server,):
        events = {"via": "websocket", "connect": "yes", "connections": MANY, "setup": document("subscribe"), "rate": 20}
        with beside("fanout", server, seconds=seconds + 2, **events, **fire(1)):
            time.sleep(1.5)
            requests = {"via": "http", "connect": "yes", "expect": '"OK"', "connections": 16, "rate": 500}
            measured = load("requests", server, body=document("reading-0.6kB"), seconds=seconds, **requests)
            return {name: value for name, value in measured.items() if name != "cpu_us"}  # that of the events is in it
