"""The cost of a round trip for the client: the C++ client beside a program written by hand for this one query."""

import json

from processes import BIN, document, gateway, run_beside, running

LIBRARY = "query 0.6 kB, C++ client, coroutine"
BARE = "query 0.6 kB, bare Beast client, callbacks"
LIBRARY_BLOCKING = "query 0.6 kB, C++ client, Blocking"
BARE_BLOCKING = "query 0.6 kB, bare Beast client, blocking"

AGAINST = {LIBRARY: BARE, LIBRARY_BLOCKING: BARE_BLOCKING}
PROGRAMS = {
    BARE: ("rois-bare-client",),
    LIBRARY: ("rois-library-client",),
    BARE_BLOCKING: ("rois-bare-client", "blocking"),
    LIBRARY_BLOCKING: ("rois-library-client", "blocking"),
}


def round(keep, settings):
    with running(gateway(1, *settings.gateway)) as (server,):
        for _ in range(settings.turns):
            for row, (program, *how) in PROGRAMS.items():
                command = [BIN / program, server.port, document("query-0.6kB"), settings.seconds, *how]
                keep(row, json.loads(run_beside(server, command)))
