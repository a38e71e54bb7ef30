"""The cost of the journal: the same requests to a gateway with one and to a gateway without."""

import os
import pathlib
import sqlite3
import tempfile
import time
import zlib

from processes import document, gateway, load, running

QUERY, QUERY_WITHOUT = "query 0.6 kB, with a journal", "query 0.6 kB, without a journal"
EXECUTE, EXECUTE_WITHOUT = "execute, with a journal", "execute, without a journal"
DISK = "the disk alone: 12 kB and fdatasync"
START = "start with 100,000 records"
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
            for _ in range(settings.turns):
                for row, server in ((EXECUTE_WITHOUT, without), (EXECUTE, kept)):
                    speaking = {"setup": document("bind-speech"), "rate": COMMANDS, "connections": 1}
                    keep(row, load("requests", server, via="http", seconds=settings.seconds * 3, **speaking, **ok("execute-speech")))
                keep(DISK, write_alone(pathlib.Path(folder) / "alone", settings.seconds * 3))
    with tempfile.TemporaryDirectory(prefix="rois-bench-") as folder:
        with running(gateway(1, "--state", folder, name="gateway-new")):
            pass
        fill(pathlib.Path(folder) / "journal.db")
        with running(gateway(1, "--state", folder, name="gateway-full")) as (server,):
            keep(START, {"ready_ms": 1_000 * server.seconds_to_ready})


def write_alone(name, seconds):
    """Writes to a file of 1 MB at the rate of the commands, with three writes for each, as the journal does; measures the first of the
    three, which is the one that the answer waits for."""
    part, parts = b"x" * 4_096 * 3, 85
    times = []
    with open(name, "wb", buffering=0) as file:
        file.write(part * parts)
        os.fsync(file)
        begun = time.perf_counter()
        for number in range(int(seconds * COMMANDS)):
            time.sleep(max(0, begun + number / COMMANDS - time.perf_counter()))
            for nth in range(3):
                before = time.perf_counter()
                os.pwrite(file.fileno(), part, len(part) * ((3 * number + nth) % parts))
                os.fdatasync(file)
                if nth == 0:
                    times.append(1e6 * (time.perf_counter() - before))
    times.sort()
    return {"p50_us": times[len(times) // 2], "p99_us": times[len(times) * 99 // 100]}


def fill(file):
    """Adds 100 sessions with 1,000 notifications each, as the gateway would have stored them."""
    session = '{"bindings":[],"id":"%d","is_engine":false,"last_stop":0,"lease":2000,"lease_http":10000,"links_count":true,"owns_stop":false,'
    session += '"receives_switches":false,"rights":"","window":30000}'
    completed = '<completed sequence="%d" xmlns="urn:x-rois:psm:xml:message:1"><command_id>c-%d</command_id><status>OK</status></completed>'
    records = [("session", number, "", session % number) for number in range(1, 101)]
    records += [("notification", of, f"{i:020}", completed % (i, i)) for of in range(1, 101) for i in range(1, 1_000)]
    with sqlite3.connect(file) as database:
        for record in records:
            check = zlib.crc32("{} {} {} {}".format(*record).encode())
            database.execute("INSERT INTO record VALUES (?, ?, ?, ?, ?)", (*record, check))
    database.close()


def ok(body):
    return {"connect": "yes", "expect": '"OK"', "body": document(body)}
