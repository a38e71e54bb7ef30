"""The cost of a request when there is more of something. The row of a point is "axis: number"."""

import statistics

from parts.fanout import fire
from processes import beside, document, load, running, stage

OTHERS = "components of other types"
SAME = "components of the same type"
TYPE = "components, asked for by type"
SESSIONS = "sessions"
SUBSCRIPTIONS = "subscriptions of others"
ELSEWHERE = "subscriptions of the event to others"
EVENTS = "events so far"
AXES = {
    OTHERS: (10, 100, 1_000, 10_000),
    SAME: (10, 100, 1_000, 10_000),
    TYPE: (10, 100, 1_000, 10_000),
    SESSIONS: (1, 10, 100, 1_000, 10_000),
    SUBSCRIPTIONS: (10, 100, 1_000, 10_000),
    ELSEWHERE: (10, 100, 1_000, 10_000),
    EVENTS: (0, 7_200, 72_000),  # an hour of 20 a second
}
CONNECTIONS = 16


def row(axis, number):
    return f"{axis}: {number:,}"


def round(keep, settings):
    def ask(axis, number, server, query="reading"):
        options = {"via": "http", "connect": "yes", "connections": CONNECTIONS, "expect": '"OK"'}
        keep(row(axis, number), load("requests", server, body=document(query), seconds=settings.seconds, **options))

    for number in AXES[OTHERS]:
        with running(stage(probes=1, bystanders=number - 1)) as (server,):
            ask(OTHERS, number, server)
    for number in AXES[SAME]:
        with running(stage(probes=number)) as (server,):
            ask(SAME, number, server, "reading-by-ref")
    for number in AXES[TYPE]:
        with running(stage(probes=1, bystanders=number - 1)) as (server,):
            ask(TYPE, number, server, "status-by-type")
    for number in AXES[SESSIONS]:
        with running(stage()) as (server,), beside("hold", server, via="websocket", connect="yes", connections=number):
            ask(SESSIONS, number, server)
    for number in AXES[SUBSCRIPTIONS]:
        with running(stage()) as (server,), subscribed(server, number, "subscribe-elsewhere"):
            ask(SUBSCRIPTIONS, number, server)
    beside_others(keep, settings)
    after_events(ask)


def subscribed(server, number, subscription):
    options = {"via": "websocket", "connect": "yes", "setup": document(subscription)}
    return beside("hold", server, **options, connections=min(number, 100), repeat=max(1, number // 100))


def beside_others(keep, settings):
    """A command that fires a hundred events of probe0, while `number` subscriptions demand those of probe1."""
    options = {"via": "websocket", "connect": "yes", "expect": '"OK"', "setup": fire(100)["fire_setup"], "body": fire(100)["fire"]}
    for number in AXES[ELSEWHERE]:
        with running(stage()) as (server,), subscribed(server, number, "subscribe-another"):
            keep(row(ELSEWHERE, number), load("requests", server, seconds=settings.seconds, **options))


def after_events(ask):
    with running(stage()) as (server,):
        happened = 0
        for number in AXES[EVENTS]:
            while happened < number:
                options = {"via": "websocket", "connect": "yes", "connections": 1, "setup": document("subscribe")}
                measured = load("fanout", server, seconds=0.1, warm_up=0, **options, **fire(100))
                happened += measured["messages"]
            ask(EVENTS, number, server)


def growth(rounds, axis):
    """The relative growth of a request's cost from the first to the last point of the axis, as the median of the rounds: 0.2 is 20 %.
    None if it was not measured."""
    first, last = (rounds.get(row(axis, AXES[axis][i]), []) for i in (0, -1))
    return statistics.median(b["cpu_us"] / a["cpu_us"] - 1 for a, b in zip(first, last)) if first and last else None
