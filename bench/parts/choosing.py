"""The cost of a logical component: the same query and the same events, through it and through its member by ref."""

from processes import document, load, running, stage

MEMBERS = (2, 10, 100)
SUBSCRIBERS = 64
BURST = 100  # events of one command, so that the command hardly counts
RATE = 40  # commands a second


def row(what, through, members):
    return f"{what} {through} of {members} members"


def rows(what):
    """The rows that are compared: through the logical component, and through the member."""
    return [(row(what, "through the logical component", members), row(what, "through one", members)) for members in MEMBERS]


QUERIES, EVENTS = rows("query 0.6 kB"), rows(f"event to {SUBSCRIBERS} subscribers")
AGAINST = dict(QUERIES + EVENTS)


def round(keep, settings):
    for members, queries, events in zip(MEMBERS, QUERIES, EVENTS):
        with running(stage(probes=1, members=members)) as (server,):
            for _ in range(settings.turns):
                for name, document_name in zip(queries, ("logical", "member")):
                    ask(keep, name, server, f"reading-0.6kB-{document_name}", settings)
        with running(stage(probes=1, members=members)) as (server,):
            for _ in range(settings.turns):
                for name, document_name in zip(events, ("logical", "member")):
                    send_events(keep, name, server, document_name, settings)


def ask(keep, name, server, body, settings):
    keep(name, load("requests", server, via="http", connections=64, seconds=settings.seconds, connect="yes", expect='"OK"', body=document(body)))


def send_events(keep, name, server, component, settings):
    options = {"via": "websocket", "connect": "yes", "connections": SUBSCRIBERS, "setup": document(f"subscribe-{component}")}
    firing = {"fire_setup": document(f"bind-{component}"), "fire": document(f"fire-{BURST}-{component}")}
    keep(name, load("fanout", server, seconds=settings.seconds, burst=BURST, rate=RATE, **options, **firing))
