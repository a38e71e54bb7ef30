"""python3 bench/profile.py http|websocket|fanout|fanout-8: where the gateway spends its time, by steps. Needs linux-perf, and the
programs that ./dev bench builds. Each sample counts for the innermost step on its stack. docs/performance.md keeps the results."""

import collections
import json
import subprocess
import sys
import time

import documents
import processes
from parts.fanout import MANY, fire

# The beginning of a function's name -> its step.
STATIONS = {
    "rois::xml::Validator::objection_to": "validation (xerces-c)",
    "rois::xml::scan": "scan of the bytes",
    "pugi::xml_document::load_buffer": "pugixml",
    "rois::xml::CheckedReader::read": "reading, the rest",
    "rois::xml::decode": "decoding",
    "rois::xml::encode": "encoding of answers",
    "rois::xml::notification_": "encoding of notifications",
    "rois::Selection::compile": "compiling the condition",
    "rois::Filter::compile": "compiling the condition",
    "rois::Engine::Core::vocabulary": "condition: vocabulary",
    "rois::Declarations::add": "condition: vocabulary",
    "rois::Engine::Core::Inquiry::of_one_component": "condition: matching components",
    "rois::Filter::match": "condition: matching components",
    "rois::LocalComponent::query": "the component's answer",
    "rois::Notifier::": "events into sessions' queues",
    "rois::NotificationQueue::push": "events into sessions' queues",
    "rois::Readers::notify": "waking the readers",
    "rois::Reader::wake": "waking the readers",
    "rois::NotificationQueue::read": "taking notifications from queues",
    "rois::NotificationQueue::next": "taking notifications from queues",
    "rois::Reading::take": "taking notifications from queues",
    "rois::NotificationDocument::": "writing notifications",
    "rois::net::append_frame": "framing",
    "rois::net::MessageReader::": "framing",
    "rois::Engine::": "engine, the rest",
    "rois::Telemetry::": "telemetry",
    "rois::Gateway::perform": "engine, the rest",
    "rois::Hold": "hold of notifications",
    "rois::Gateway::answer": "Gateway::answer, the rest",
    "rois::net::Connection::take_head": "HTTP head",
    "rois::net::Connection::judge_head": "HTTP head",
    "rois::net::read_head": "HTTP head",
    "rois::net::find_head": "HTTP head",
    "rois::net::route_of": "HTTP head",
    "rois::net::refusal": "HTTP head",
    "rois::net::append": "HTTP answer",
    "rois::net::Loop::sweep": "sweep of all connections",
    "rois::Gateway::tick": "tick",
    "rois::net::Wire::receive": "receive: buffer",
    "rois::net::WebSocket::gather": "gathering of waiting output",
    "rois::net::WebSocket::": "WebSocket, the rest",
    "rois::net::Connection::": "connection, the rest",
}
KERNEL = (
    ("sendto", "kernel: send"),
    ("sendmsg", "kernel: send"),
    ("recvmsg", "kernel: receive"),
    ("recvfrom", "kernel: receive"),
    ("epoll_wait", "kernel: wait"),
)


def station(stack):
    """The step of a sample. `stack`: names of functions, the innermost first."""
    in_kernel = [name for name in stack if name.startswith(("do_syscall", "entry_SYSCALL", "__x64_sys"))]
    if in_kernel:
        names = " ".join(stack)
        if "__schedule" in stack and "epoll_wait" not in names:
            return "kernel: another process gets the core"
        return next((where for mark, where in KERNEL if mark in names), "kernel: the rest")
    for name in stack:
        for beginning, where in STATIONS.items():
            if name.startswith(beginning):
                return where
    return "Asio and coroutines"


def stacks(script):
    """Parses the output of `perf script`: empty lines separate samples, and a frame is an address and a name."""
    for sample in script.split("\n\n"):
        frames = [line.strip().split(" ", 1) for line in sample.splitlines() if line.startswith("\t")]
        if frames:
            yield [frame[1] for frame in frames if len(frame) == 2]


def start(what):
    """Starts the server. Returns it, with the mode and options of the load generator."""
    if what in ("http", "websocket"):
        options = {"via": what, "connect": "yes", "body": processes.document("query-0.6kB"), "connections": 64}
        return processes.gateway(1), "requests", options
    options = {"via": "websocket", "connect": "yes", "connections": MANY, "setup": processes.document("subscribe")}
    return processes.stage(), "fanout", {**options, **fire(8 if what.endswith("-8") else 1)}


def main(what):
    documents.write_all(processes.WORK / "documents")
    processes.allow_many_descriptors()
    data = processes.WORK / "perf.data"
    server, mode, options = start(what)
    with processes.running(server), processes.beside(mode, server, seconds=20, **options) as load:
        time.sleep(2)
        record = ["perf", "record", "-q", "-F", "997", "--call-graph", "dwarf,16384", "-p", str(server.pid), "-o", str(data)]
        subprocess.run([*record, "--", "sleep", "6"], check=True, stderr=subprocess.DEVNULL)
        cpu = json.loads(load.stdout.readline())["cpu_us"]
    script = ["perf", "script", "-i", str(data), "-F", "ip,sym", "--no-inline"]
    said = subprocess.run(script, check=True, capture_output=True, text=True).stdout
    counted = collections.Counter(station(stack) for stack in stacks(said))
    total = sum(counted.values())
    print(f"{what}: {cpu:.1f} µs of CPU each, {total} samples")
    for where, count in counted.most_common():
        print(f"{where:40} {100 * count / total:5.1f} % {cpu * count / total:6.2f} µs")


if __name__ == "__main__":
    main(sys.argv[1])
