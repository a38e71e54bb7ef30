"""The cost of the journal: the same requests to a gateway with one and to a gateway without."""

import tempfile

from processes import document, gateway, load, running

QUERY, QUERY_WITHOUT = "query 0.6 kB, with a journal", "query 0.6 kB, without a journal"
EXECUTE, EXECUTE_WITHOUT = "execute, with a journal", "execute, without a journal"
AGAINST = {QUERY: QUERY_WITHOUT}

CONNECTIONS = 64
COMMANDS = 200  # a second
TURNS = 3  # more than of other rows: the queries must cost the same within 2 %


def round(keep, settings):
    with tempfile.TemporaryDirectory(prefix="rois-bench-") as folder:
        with running(gateway(1, *settings.gateway), gateway(1, "--state", folder, *settings.gateway, name="gateway-journal")) as (without, kept):
            for _ in range(settings.turns * TURNS):
                for row, server in ((QUERY_WITHOUT, without), (QUERY, kept)):
                    keep(row, load("requests", server, via="http", connections=CONNECTIONS, seconds=settings.seconds, **ok("query-0.6kB")))
            for row, server in ((EXECUTE_WITHOUT, without), (EXECUTE, kept)):
                speaking = {"setup": document("bind-speech"), "rate": COMMANDS, "connections": 1}
                keep(row, load("requests", server, via="http", seconds=settings.seconds * 3, **speaking, **ok("execute-speech")))


def ok(body):
    return {"connect": "yes", "expect": '"OK"', "body": document(body)}
