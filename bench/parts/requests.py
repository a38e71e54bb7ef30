"""The cost of a request: the gateway beside bare servers, gSOAP and xmlrpc.server."""

from processes import BIN, ROOT, Server, document, gateway, load, running, stage

# Rows that others are compared with.
BARE_HTTP = "bare Beast server, HTTP"
BARE_WEBSOCKET = "bare Beast echo, WebSocket"
GSOAP = "gSOAP, HTTP"
XMLRPC = "xmlrpc.server, HTTP"
HTTP = "query 0.6 kB, HTTP"
WEBSOCKET = "query 0.6 kB, WebSocket"
FREE = "query 0.6 kB, HTTP, not pinned"
OTHER_HEADS = "query 0.6 kB, HTTP, alternating heads"

# Row -> the row that it is compared with.
AGAINST = {HTTP: BARE_HTTP, OTHER_HEADS: BARE_HTTP, GSOAP: FREE, XMLRPC: FREE, WEBSOCKET: BARE_WEBSOCKET}

MODES = {"HTTP": "http", "WebSocket": "websocket"}
ANSWER_BYTES = 557  # of the gateway's answer to the query
CONNECTIONS = 64  # gSOAP and xmlrpc.server have one thread for each
PYTHON = "/usr/bin/python3"  # Debian's, not another Python in PATH
MANY_VARIANTS = 2_500  # for each of 64 connections: more than are sent in a measurement


def round(keep, settings):
    def ask(row, server, body, connections=CONNECTIONS, connect=True, **options):
        options = {"via": "http", "connections": connections, "seconds": settings.seconds, **options}
        if connect:
            options |= {"connect": "yes", "expect": '"OK"'}
        keep(row, load("requests", server, body=document(body), **options))

    compare(ask, settings)
    vary_size_and_connections(ask, settings)
    with running(gateway(2, *settings.gateway)) as (server,):
        for name, via in MODES.items():
            with running(bare_on_two_threads(name)) as (bare,):
                beside_bare(ask, f"0.6 kB, {name}, 2 threads", bare, server, "query-0.6kB", via=via)
    operations(ask)


def beside_bare(ask, row, bare, server, query, **options):
    AGAINST[f"query {row}"] = f"bare, {row}"
    ask(f"bare, {row}", bare, query, connect=False, **options)
    ask(f"query {row}", server, query, **options)


def bare_on_two_threads(name):
    if name == "HTTP":
        return Server("bare-http-2", [BIN / "rois-bare-http", "{port}", ANSWER_BYTES, 2], threads=2)
    return Server("bare-websocket-2", [BIN / "rois-bare-websocket", "{port}", 2], threads=2)


def compare(ask, settings):
    """Alternates between the servers that are compared, so that all meet the same load of the machine. No other server runs beside
    them: even at rest, each has threads that wake up."""
    query = "query-0.6kB"
    bare_servers = (
        Server("bare-http", [BIN / "rois-bare-http", "{port}", ANSWER_BYTES]),
        Server("bare-websocket", [BIN / "rois-bare-websocket", "{port}"]),
    )
    with running(gateway(1, *settings.gateway), *bare_servers) as (rois, bare, echo):
        for _ in range(settings.turns):
            ask(BARE_HTTP, bare, query, connect=False)
            ask(HTTP, rois, query)
            ask(OTHER_HEADS, rois, query, other_heads="yes")
            ask(BARE_WEBSOCKET, echo, query, connect=False, via="websocket")
            ask(WEBSOCKET, rois, query, via="websocket")
    others = (
        Server("gsoap", [BIN / "rois-gsoap", "{port}"], threads=CONNECTIONS),
        Server("xmlrpc", [PYTHON, ROOT / "bench" / "xmlrpc_server.py", "{port}"], threads=CONNECTIONS),
    )
    with running(gateway(1, *settings.gateway, free=True), *others) as (free, gsoap, xmlrpc):
        for _ in range(settings.turns):
            ask(FREE, free, query)
            ask(GSOAP, gsoap, "call-of-gsoap", connect=False, path="/", expect=">OK<")
            ask(XMLRPC, xmlrpc, "call-of-xmlrpc", connect=False, path="/RPC2", expect="9498.984")


def vary_size_and_connections(ask, settings):
    bare = Server("bare-http", [BIN / "rois-bare-http", "{port}", ANSWER_BYTES])
    echo = Server("bare-websocket", [BIN / "rois-bare-websocket", "{port}"])
    others = {"HTTP": bare, "WebSocket": echo}
    with running(gateway(1, *settings.gateway), bare, echo) as (server, *_):
        for size in ("0.3", "3", "20"):
            for name, other in others.items():
                beside_bare(ask, f"{size} kB, {name}", other, server, f"query-{size}kB", via=MODES[name])
        for connections in (1, 16, 1_000):
            many = f"{connections:,} connection" + ("s" if connections > 1 else "")
            for name, other in others.items():
                row = f"0.6 kB, {name}, {many}"
                beside_bare(ask, row, other, server, "query-0.6kB", connections=connections, via=MODES[name])


def operations(ask):
    """On the stage, where each session binds its own component."""
    with running(stage(probes=64)) as (server,):
        for name, via in MODES.items():
            ask(f"stage: set_parameter, {name}", server, "set_parameter", via=via, setup=document("bind"))
            options = {"setup": document("bind"), "await": "<completed"}
            ask(f"stage: execute until completed, {name}", server, "execute", via=via, **options)
            ask(f"stage: subscribe again, {name}", server, "subscribe", via=via)
        for name, via in MODES.items():
            ask(f"stage: new subscription, {name}", server, "subscribe-elsewhere", via=via, variants=MANY_VARIANTS)
