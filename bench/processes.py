"""Starts and stops servers and the load generator; reads their CPU time and memory from the kernel."""

import contextlib
import json
import os
import pathlib
import resource
import socket
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BIN = ROOT / "build" / "release" / "bin"
WORK = ROOT / "build" / "bench"  # documents, and the output of the servers


# Pins a server to one core and the load generator to the others. Where both run by chance on one core, the cost can double.
CORES = sorted(os.sched_getaffinity(0))
SERVER_CORES = set(CORES[:1])
LOAD_CORES = set(CORES[1:] or CORES)


class BenchError(Exception):
    """The measurement is not possible."""


def allow_many_descriptors():
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    return most


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Server:
    """A server that runs until `stop`. `seconds_to_ready`: from its start until it answered `health`, or accepted a connection.
    A server with more than one thread is not pinned. `log`: a file descriptor that gets its output, instead of a file."""

    def __init__(self, name, command, health=None, threads=1, log=None):
        self.name = name
        self.load_cores = LOAD_CORES if threads == 1 else set(CORES)
        self.port = free_port()
        whole = [str(part).replace("{port}", str(self.port)) for part in command]
        with open(WORK / f"{name}.log", "wb") as file:
            begun = time.perf_counter()
            self.process = subprocess.Popen(whole, stdout=log or file, stderr=log or file)
        self.pid = self.process.pid
        os.sched_setaffinity(self.pid, SERVER_CORES if threads == 1 else set(CORES))
        while not self._answers(health):
            if self.process.poll() is not None or time.perf_counter() - begun > 30:
                self.stop()
                raise BenchError(f"{name} did not start: see build/bench/{name}.log")
            time.sleep(0.001)
        self.seconds_to_ready = time.perf_counter() - begun

    def _answers(self, health):
        try:
            with socket.create_connection(("127.0.0.1", self.port), timeout=5) as one:
                if health is None:
                    return True
                one.sendall(f"GET {health} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n".encode())
                return one.recv(64).startswith(b"HTTP/1.1 200")
        except OSError:
            return False

    def cpu_seconds(self):
        """CPU time since its start, in steps of 10 ms."""
        user, system = pathlib.Path(f"/proc/{self.pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13]
        return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")

    def resident_bytes(self):
        """Resident memory, including shared pages."""
        return self._memory("VmRSS")

    def address_space(self):
        """The size of its address space in bytes."""
        return self._memory("VmSize")

    def _memory(self, field):
        for line in pathlib.Path(f"/proc/{self.pid}/status").read_text().splitlines():
            if line.startswith(f"{field}:"):
                return int(line.split()[1]) * 1024
        raise BenchError(f"/proc/{self.pid}/status of {self.name} has no {field}: has it ended?")

    def stop(self):
        self.process.terminate()
        try:
            self.process.wait(8)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


def gateway(threads=1, *arguments, free=False, name=None):
    """`free`: not pinned, also with one thread."""
    command = [BIN / "rois-gateway", "--listen", "127.0.0.1:{port}", "--threads", threads, "--log-level", "warning"]
    command += ["--max-sessions", 20_000, "--max-connections", 20_000, *arguments]
    return Server(name or f"gateway-{threads}{'-free' * free}", command, "/readyz", len(CORES) if free else threads)


def stage(threads=1, probes=10, bystanders=0, members=0):
    return Server("stage", [BIN / "rois-stage", "{port}", threads, probes, bystanders, members], "/readyz", threads)


@contextlib.contextmanager
def running(*servers):
    try:
        yield servers
    finally:
        for server in servers:
            server.stop()


def _start(mode, server, options, **pipes):
    command = [BIN / "rois-load", mode, "--port", server.port, "--pid", server.pid]
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        for one in value if isinstance(value, list) else [value]:
            command += [flag, one]
    if mode != "hold" and not server.load_cores & SERVER_CORES:
        command += ["--spin", "yes"]
    process = subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, text=True, **pipes)
    os.sched_setaffinity(process.pid, server.load_cores)
    return process


def document(name):
    return WORK / "documents" / f"{name}.xml"


def load(mode, server, **options):
    """Runs the load generator and returns what it measured."""
    with _start(mode, server, options, stderr=subprocess.PIPE) as process:
        try:
            said, complaint = process.communicate(timeout=300)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
    if process.returncode != 0:
        raise BenchError(f"rois-load {mode} on {server.name}: {complaint.strip()}")
    return json.loads(said)


def run_beside(server, command):
    """Runs a client program on the cores that are not the server's. Returns its output."""
    whole = [str(part) for part in command]
    pin = lambda: os.sched_setaffinity(0, server.load_cores)  # noqa: E731
    done = subprocess.run(whole, capture_output=True, text=True, timeout=300, preexec_fn=pin)
    if done.returncode != 0:
        raise BenchError(f"{command[0].name} on {server.name}: {done.stderr.strip()}")
    return done.stdout


@contextlib.contextmanager
def beside(mode, server, **options):
    """Runs the load generator while something else is measured. Begins when it is ready."""
    if mode != "hold":
        options |= {"announce": "yes"}
    process = _start(mode, server, options, stdin=subprocess.PIPE)
    try:
        if not process.stdout.readline():
            raise BenchError(f"rois-load {mode} on {server.name} ended before it was ready; see its error above")
        yield process
    finally:
        process.stdin.close()
        try:
            process.wait(60)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    if process.returncode != 0:
        raise BenchError(f"rois-load {mode} on {server.name} ended with {process.returncode}; see its error above")


def machine():
    """A description of the machine."""
    model = "unknown"
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    memory = int(pathlib.Path("/proc/meminfo").read_text().split()[1]) // 1024
    return {"cpu": model, "cores": os.cpu_count(), "memory_mb": memory, "kernel": os.uname().release, "load": os.getloadavg()}
