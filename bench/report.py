"""The results as a table, as goals that are met or missed, and as JSON."""

import collections
import json
import statistics

from parts import choosing, client, console, crowd, engines, fanout, floods, growth, journal, memory, requests

AGAINST = collections.ChainMap(requests.AGAINST, fanout.AGAINST, client.AGAINST, engines.AGAINST, choosing.AGAINST, journal.AGAINST)  # row -> the row that it is compared with


def medians(rounds):
    """Row -> measure -> its median; `rounds` is row -> measurements."""
    return {
        row: {measure: statistics.median(one[measure] for one in all_rounds) for measure in all_rounds[0]}
        for row, all_rounds in rounds.items()
    }


def spread(rounds, row):
    """The least and the greatest CPU time, relative to the median in percent."""
    values = [one.get("cpu_us", 0) for one in rounds[row]]
    middle = statistics.median(values)
    if middle == 0 or len(values) == 1:
        return ""
    return f"{100 * (min(values) / middle - 1):+.0f} {100 * (max(values) / middle - 1):+.0f} %"


def ratio(rounds, row, other):
    """The CPU time of one row divided by that of another, measured right before or after it: the median of all pairs. None if not measured."""
    pairs = list(zip(rounds.get(row, []), rounds.get(other, [])))
    return statistics.median(one["cpu_us"] / another["cpu_us"] for one, another in pairs) if pairs else None


def number(value):
    if value is None:
        return ""
    return f"{value:,.0f}" if value >= 1_000 else f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def table(rounds, part):
    """The rows of one part."""
    middle = medians(rounds)
    lines = []
    if part == "memory":
        lines.append(f"{'memory':58} {'bytes each':>10} {'idle CPU %':>10}")
        for row, one in middle.items():
            if row == memory.AT_REST:
                lines.append(f"{row:58} {one['resident_mb']:8.1f} MB, ready after {one['ready_ms']:.0f} ms")
            else:
                lines.append(f"{row:58} {number(one['bytes_each']):>10} {one['idle_cpu_percent']:>10.1f}")
        return lines
    if part in ("console", "floods", "crowd"):
        for row, one in middle.items():
            lines.append(f"{row:58} {', '.join(f'{name} {number(value)}' for name, value in one.items())}")
        return lines
    each = {"fanout": "server a message", "micro": "program a call", "client": "client a round trip"}.get(part, "server a request")
    lines.append(f"{part:74} {'CPU µs':>7} {'spread':>10} {'ratio':>6} {'/s':>9} {'p50 µs':>8} {'p99':>8} {'p99.9':>8}")
    for row, one in middle.items():
        cpu, times = one.get("cpu_us"), ratio(rounds, row, AGAINST.get(row))
        against = "" if times is None else f"{times:.2f}"
        rate = one.get("requests_per_second", one.get("messages_per_second"))
        latencies = " ".join(f"{number(one.get(name)):>8}" for name in ("p50_us", "p99_us", "p999_us"))
        lines.append(f"{row:74} {number(cpu):>7} {spread(rounds, row):>10} {against:>6} {number(rate):>9} {latencies}")
    lines.append(f"(CPU of the {each}; ratio: CPU / CPU of the row that it is compared with)")
    return lines


class Goal:
    """`met` is None if it was not measured."""

    def __init__(self, name, wanted, measured, met):
        self.name, self.wanted, self.measured, self.met = name, wanted, measured, met

    def line(self):
        verdict = {True: "met", False: "MISSED", None: "not measured"}[self.met]
        return f"{self.name:62} {self.wanted:38} {self.measured:24} {verdict}"


def at_most(name, value, limit, unit):
    measured = "" if value is None else f"{number(value)} {unit}".strip()
    return Goal(name, f"at most {number(limit)} {unit}".strip(), measured, None if value is None else value <= limit)


def at_least(name, value, limit, unit):
    measured = "" if value is None else f"{number(value)} {unit}".strip()
    return Goal(name, f"at least {number(limit)} {unit}".strip(), measured, None if value is None else value >= limit)


def fanout_goal(rounds, middle, burst, limit):
    """Met by an absolute number, or, for slow machines, by the ratio to the prebuilt sender."""
    row = fanout.row(fanout.MANY, burst)
    name = f"3 fan-out to 1,000, {'nothing' if burst == 1 else burst} waiting: CPU a message"
    wanted = f"at most {limit} µs, or 1.25 times prebuilt"
    if row not in middle:
        return Goal(name, wanted, "", None)
    cpu, times = middle[row]["cpu_us"], ratio(rounds, row, fanout.sender_row(burst))
    return Goal(name, wanted, f"{cpu:.2f} µs, {times:.2f} times", cpu <= limit or times <= 1.25)


def validation_goal(rounds):
    """The tables (rows `validate/...`) compared with xerces-c (rows `xerces/...`)."""
    documents = [row.split("/")[1] for row in rounds if row.startswith("xerces/") and row.endswith("-20kB")]
    times = [ratio(rounds, f"validate/{name}", f"xerces/{name}") for name in documents]
    worst = max(times) if times and None not in times else None
    return at_most("2 validation of 20 kB: time, compared with xerces-c", worst, 0.25, "times")


def protections(middle):
    """The part of a query's CPU time in percent. None if not measured."""
    if "protections" not in middle or requests.HTTP not in middle:
        return None
    return 100 * middle["protections"]["cpu_us"] / middle[requests.HTTP]["cpu_us"]


def longer(middle):
    """How much longer a single query takes through a sub engine, in µs. None if not measured."""
    if engines.ONE_REMOTE not in middle:
        return None
    return middle[engines.ONE_REMOTE]["p50_us"] - middle[engines.ONE_LOCAL]["p50_us"]


def longer_to_store(middle):
    """How much longer the slowest percent of the commands takes with a journal, in ms. None if not measured."""
    if journal.EXECUTE not in middle:
        return None
    return (middle[journal.EXECUTE]["p99_us"] - middle[journal.EXECUTE_WITHOUT]["p99_us"]) / 1_000


def goals(rounds):
    """The goals of ./dev bench. `rounds`: row -> measurements, of all parts."""
    middle = medians(rounds)
    value_of = lambda row, measure: middle.get(row, {}).get(measure)  # noqa: E731
    session = value_of(f"idle {memory.SESSION}", "bytes_each")
    growing = {axis: growth.growth(rounds, axis) for axis in growth.AXES}
    latencies = [middle[row]["p99_us"] for row in fanout.REQUESTS.values() if row in middle]
    stops = [value for row in middle for name, value in middle[row].items() if name in floods.STOPS]
    return [
        at_most("1 query 0.6 kB, HTTP: CPU, compared with bare Beast", ratio(rounds, requests.HTTP, requests.BARE_HTTP), 1.45, "times"),
        at_least("1 gSOAP's CPU, compared with the query's", ratio(rounds, requests.GSOAP, requests.FREE), 3.0, "times"),
        at_least("1 xmlrpc.server's CPU, compared with the query's", ratio(rounds, requests.XMLRPC, requests.FREE), 10, "times"),
        at_most(
            "1 query 0.6 kB, WebSocket: CPU, compared with a bare echo",
            ratio(rounds, requests.WEBSOCKET, requests.BARE_WEBSOCKET),
            1.6,
            "times",
        ),
        validation_goal(rounds),
        fanout_goal(rounds, middle, 1, 5.5),
        fanout_goal(rounds, middle, 8, 1.2),
        at_least("4 idle WebSocket sessions held at once", value_of(f"idle {memory.SESSION}", "held"), 10_000, ""),
        at_most("4 memory of an idle WebSocket session", None if session is None else session / 1024, 6, "KB"),
        at_most("4 ready after the start", value_of(memory.AT_REST, "ready_ms"), 500, "ms"),
        at_most("4 memory at rest", value_of(memory.AT_REST, "resident_mb"), 30, "MB"),
        *(
            at_most(f"5 growth of a request's CPU: {axis}", None if grown is None else 100 * grown, 20, "%")
            for axis, grown in growing.items()
        ),
        at_most("6 p99 of requests beside 20 events/s to 1,000", max(latencies) / 1_000 if latencies else None, 5, "ms"),
        at_most("7 C++ client: CPU a query, compared with a bare client", ratio(rounds, client.LIBRARY, client.BARE), 1.3, "times"),
        at_most("8 console: all of it with gzip", value_of(console.VIEW, "all_kib"), 300, "KiB"),
        at_most("8 console: complete map after", value_of(console.VIEW, "stands_ms"), 1_000, "ms"),
        at_least("8 console: pictures a second, 20 people at 20 Hz", value_of(console.PEOPLE, "pictures_per_second"), 59, "/s"),
        at_most("8 console: the page's process at rest", value_of(console.REST, "page_percent"), 5, "% of a core"),
        at_most("9 all protections: CPU, compared with that of a query", protections(middle), 3, "%"),
        at_most("9 p99 of every way to stop, under every flood", max(stops) if stops else None, 50, "ms"),
        at_most("10 query of a sub engine: CPU of the main engine", ratio(rounds, engines.MAIN, engines.LOCAL), 2.3, "times"),
        at_most("10 query of a sub engine: CPU of both engines", ratio(rounds, engines.BOTH, engines.LOCAL), 3.4, "times"),
        at_most("10 event of a sub engine: CPU of the main engine", ratio(rounds, engines.EVENT_MAIN, engines.EVENT_LOCAL), 1.5, "times"),
        at_most("10 event of a sub engine: CPU of both engines", ratio(rounds, engines.EVENT_BOTH, engines.EVENT_LOCAL), 2.6, "times"),
        at_most("10 query of a sub engine, alone: p50 longer by", longer(middle), 200, "µs"),
        at_most("11 100 sub engines join within", value_of(crowd.JOINING, "seconds"), 5, "s"),
        at_most("11 p99 of another client meanwhile", value_of(crowd.JOINING, "neighbour_p99_ms"), 10, "ms"),
        *(
            at_most(f"11 p99 beside one that {special}, compared with before", value_of(crowd.with_one(special), "times_before"), 1.1, "times")
            for special in crowd.SPECIAL
        ),
        at_most("11 memory of a further sub engine", value_of(crowd.AT_REST, "kb_each"), 300, "kB"),
        at_most("11 threads of 100 further sub engines", value_of(crowd.AT_REST, "threads"), 0, ""),
        *(
            at_most(f"12 {logical}, compared with one", ratio(rounds, logical, member), 1.3, "times")
            for logical, member in choosing.QUERIES + choosing.EVENTS
        ),
        at_most("13 query with a journal: CPU, compared with one without", ratio(rounds, journal.QUERY, journal.QUERY_WITHOUT), 1.02, "times"),
        at_most("13 execute with a journal: p99 longer by", longer_to_store(middle), 2, "ms"),
        at_most("13 ready after the start with 100,000 records", value_of(journal.START, "ready_ms"), 2_000, "ms"),
    ]


def write_json(path, machine, version, kept):
    """`kept`: part -> row -> measurements."""
    together = dict(collections.ChainMap(*kept.values()))
    middle = medians(together)
    parts = {part: {row: {"median": middle[row], "rounds": rounds[row]} for row in rounds} for part, rounds in kept.items()}
    report = {"machine": machine, "version": version, "goals": [vars(goal) for goal in goals(together)], "parts": parts}
    path.write_text(json.dumps(report, indent=1) + "\n")
