"""Memory at rest, time until ready, and memory and CPU for idle connections and sessions."""

import time

from processes import beside, document, gateway, load, running

AT_REST = "at rest"
SESSION = "WebSocket with a session"
KINDS = {
    "HTTP connection": {"via": "http"},
    "HTTP connection with a session": {"via": "http", "connect": "yes"},
    "WebSocket": {"via": "websocket"},
    SESSION: {"via": "websocket", "connect": "yes"},
    "event stream with its session": {"via": "stream", "connect": "yes"},
}


def round(keep, settings):
    for kind, options in KINDS.items():
        with running(gateway(1, *settings.gateway)) as (server,):
            time.sleep(0.2)
            if kind == SESSION:
                keep(AT_REST, {"resident_mb": server.resident_bytes() / 1e6, "ready_ms": server.seconds_to_ready * 1_000})
            warm = {"via": options["via"] if options["via"] != "stream" else "http", "connect": "yes", "expect": '"OK"'}
            load("requests", server, body=document("query-0.6kB"), connections=8, seconds=0.2, **warm)
            before = server.resident_bytes()
            with beside("hold", server, connections=settings.connections, **options):
                time.sleep(0.5)
                used = server.resident_bytes() - before
                cpu = idle_cpu(server)
            each = used / settings.connections
            keep(f"idle {kind}", {"bytes_each": each, "idle_cpu_percent": cpu, "held": settings.connections})


def idle_cpu(server):
    """Percent of one core while all connections are silent."""
    clock = (~server.pid << 3) | 2  # CLOCK_PROCESS_CPUTIME_ID of that process, as clock_getcpuclockid makes it
    begun, used = time.perf_counter(), time.clock_gettime(clock)
    time.sleep(0.5)
    return 100 * (time.clock_gettime(clock) - used) / (time.perf_counter() - begun)
