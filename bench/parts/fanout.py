"""One event to many subscribers, and the latency of requests meanwhile."""

import json

from processes import BIN, WORK, BenchError, Server, beside, document, load, running, stage

MANY = 1_000
BURSTS = (1, 8)


def row(subscribers, burst, threads=1):
    waiting = "nothing waiting" if burst == 1 else f"{burst} waiting"
    many = "s" if subscribers > 1 else ""
    return f"{subscribers:,} subscriber{many}, {waiting}" + ("" if threads == 1 else f", {threads} threads")


def sender_row(burst):
    return f"prebuilt frames to {MANY:,}, " + ("nothing waiting" if burst == 1 else f"{burst} waiting")


AGAINST = {row(MANY, burst): sender_row(burst) for burst in BURSTS}
REQUESTS = {
    via: f"query 0.6 kB at 500/s, {name}, beside 20 events/s to {MANY:,} subscribers, 2 threads"
    for via, name in (("http", "HTTP"), ("websocket", "WebSocket"))
}


def fire(burst):
    """The options of a fan-out. The connection that fires binds probe0 first."""
    folder = WORK / "documents" / "micro"
    return {"fire_setup": folder / "bind-probe0.xml", "fire": folder / f"fire-{burst}.xml", "burst": burst}


def send_events(server, subscribers, burst, seconds):
    options = {"via": "websocket", "connect": "yes", "connections": subscribers, "setup": document("subscribe")}
    return load("fanout", server, seconds=seconds, **options, **fire(burst))


def round(keep, settings):
    for burst in BURSTS:
        for subscribers in (1, 100, 5_000):
            with running(stage()) as (server,):
                keep(row(subscribers, burst), send_events(server, subscribers, burst, settings.seconds))
        for _ in range(settings.turns):
            with running(stage()) as (server,):
                measured = send_events(server, MANY, burst, settings.seconds)
            keep(row(MANY, burst), measured)
            with running(Server("sender", [BIN / "rois-prebuilt-sender", "{port}", int(measured["message_bytes"])])) as (server,):
                (WORK / "burst").write_text(str(burst))
                options = {"via": "websocket", "connections": MANY, "fire": WORK / "burst", "burst": burst}
                keep(sender_row(burst), load("fanout", server, seconds=settings.seconds, **options))
        with running(stage(threads=2)) as (server,):
            keep(row(MANY, burst, 2), send_events(server, MANY, burst, settings.seconds))
    for via, name in REQUESTS.items():
        keep(name, requests_beside_events(settings, via))


def requests_beside_events(settings, via):
    seconds = 4 * settings.seconds
    with running(stage(threads=2)) as (server,):
        options = {"via": "websocket", "connect": "yes", "connections": MANY, "setup": document("subscribe"), "rate": 20}
        with beside("fanout", server, seconds=seconds + 3, **options, **fire(1)) as events:
            requests = {"via": via, "connect": "yes", "expect": '"OK"', "connections": 16, "rate": 500}
            measured = load("requests", server, body=document("reading-0.6kB"), seconds=seconds, **requests)
            if events.poll() is not None:
                raise BenchError("the events ended before the measurement of the requests")
            reached = json.loads(events.stdout.readline())["messages_per_second"]
            if reached < 0.975 * 20 * MANY:
                raise BenchError(f"only {reached:.0f} notifications a second reached {MANY} subscribers; expected at least {0.975 * 20 * MANY:.0f}")
            return {name: value for name, value in measured.items() if name != "cpu_us"}  # it includes that of the events
