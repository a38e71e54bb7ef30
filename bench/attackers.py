"""The floods of docs/safety.md, and clients that move the robot, each as a program: `attackers.py KIND PORT`. It runs until it is killed."""

import base64
import collections
import itertools
import os
import resource
import socket
import ssl
import struct
import sys
import threading
import time

from documents import MESSAGE, ROIS, execute, is_equal, is_like, parameter, query, subscribe, unit

BIG = 880_000  # bytes of one text, below the limit of a document
HOST = "127.0.0.1"


def bind(component):
    return f'<bind xmlns="{MESSAGE}" xmlns:rois="{ROIS}"><component_ref rois:code="{component}"/></bind>'


class Line:
    """One connection, with a token if the gateway wants one, and with TLS if it is `secure`. After any failure it reconnects: an
    attacker does not give up."""

    def __init__(self, port, token="", secure=False):
        self.port = port
        self.token = token
        self.secure = secure
        self.session = ""
        self.socket = None
        self.open()

    def open(self):
        if self.socket:
            self.socket.close()
        self.session = ""
        self.socket = socket.create_connection((HOST, self.port))
        self.socket.settimeout(5)
        if self.secure:
            self.socket = any_certificate().wrap_socket(self.socket)

    def head(self, length, path="/rois"):
        session = f"RoIS-Session: {self.session}\r\n" if self.session else ""
        session += f"Authorization: Bearer {self.token}\r\n" if self.token else ""
        kind = "Content-Type: text/xml\r\n" if length else ""
        return f"POST {path} HTTP/1.1\r\nHost: {HOST}\r\n{session}{kind}Content-Length: {length}\r\n\r\n"

    def post(self, body, path="/rois"):
        """Returns the answer's head and body as one text, or "" if the connection was closed."""
        try:
            self.socket.sendall((self.head(len(body), path) + body).encode())
            return self.take_answer()
        except OSError as error:
            print(f"a connection broke: {error}", file=sys.stderr)
            time.sleep(0.001)
            self.open()
            return ""

    def get(self, path):
        session = f"RoIS-Session: {self.session}\r\n" if self.session else ""
        self.socket.sendall(f"GET {path} HTTP/1.1\r\nHost: {HOST}\r\n{session}\r\n".encode())
        return self.take_answer()

    def take_answer(self):
        text = b""
        while b"\r\n\r\n" not in text:
            part = self.socket.recv(65_536)
            if not part:
                raise OSError
            text += part
        head, rest = text.split(b"\r\n\r\n", 1)
        length = 0
        for line in head.lower().split(b"\r\n"):
            if line.startswith(b"content-length:"):
                length = int(line[15:])
        while len(rest) < length:
            part = self.socket.recv(65_536)
            if not part:
                raise OSError
            rest += part
        return (head + b"\r\n\r\n" + rest).decode()

    def connect(self, attributes=""):
        answer = self.post(f'<connect xmlns="{MESSAGE}"{attributes}/>')
        if "<session>" in answer:
            self.session = answer.split("<session>")[1].split("<")[0]
        return bool(self.session)

    def is_connected(self):
        return bool(self.session) or self.connect()


def any_certificate():
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    return context


def each(port, count, act):
    """Opens `count` connections and calls `act(connection, turn)` for each of them again and again. `turn` counts from 0."""

    def go_on():
        one = Line(port)
        for turn in itertools.count():
            act(one, turn)

    for _ in range(count):
        threading.Thread(target=go_on, daemon=True).start()
    threading.Event().wait()


def send_together(one, bodies):
    """Sends requests without waiting for the answers, and then reads these."""
    try:
        one.socket.sendall("".join(one.head(len(body)) + body for body in bodies).encode())
        answers = 0
        while answers < len(bodies):
            part = one.socket.recv(65_536)
            answers += part.count(b"HTTP/1.1 ") if part else len(bodies)
    except OSError:
        one.open()


def requests(port):
    """Short requests, 16 at a time on each of 64 connections."""
    body = query("engine_status")
    each(port, 64, lambda one, _: one.is_connected() and send_together(one, [body] * 16))


def unread(port):
    """300 connections that request documents, 3,000 at a time, and read no answer."""
    asked = f"GET /rois/profile HTTP/1.1\r\nHost: {HOST}\r\n\r\n".encode() * 3_000

    def act(one, _):
        try:
            one.open()
            one.socket.sendall(asked)
            time.sleep(5)
        except OSError:
            time.sleep(0.01)

    each(port, 300, act)


def connections(port):
    """Connections that send nothing, opened as fast as possible; the last 12,000 stay open."""
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)
    opened = collections.deque()
    while True:
        try:
            opened.append(socket.create_connection((HOST, port)))
        except OSError:
            time.sleep(0.001)
        if len(opened) > 12_000:
            opened.popleft().close()


def send_on_new_connections(port, count, request):
    """`count` clients that each connect, send `request(turn)`, and wait until the gateway answers or cuts; again and again."""

    def act(one, turn):
        try:
            one.open()
            one.socket.sendall(request(turn))
            one.socket.recv(1_000)
        except OSError:
            time.sleep(0.01)

    each(port, count, act)


def headers(port):
    """800 heads of 16 kB: half of them are unfinished, half are too long."""
    unfinished = f"GET /rois/profile HTTP/1.1\r\nHost: {HOST}\r\nX: ".encode() + b"x" * 16_000
    send_on_new_connections(port, 800, lambda turn: unfinished + b"x" * 1_000 * (turn % 2))


def garbage(port):
    """800 connections that send an invalid request, again and again."""
    send_on_new_connections(port, 800, lambda _: b"garbage\r\n\r\n")


def predicates(port):
    """30 sessions that subscribe with conditions of 1,000 predicates, beyond their limit."""
    every = [
        subscribe("person_detected", [is_equal("number", f"{number}") for number in range(first, first + 1_000)])
        for first in range(0, 30_000, 1_000)
    ]
    each(port, 30, lambda one, turn: one.is_connected() and one.post(every[turn % 30]))


def subscriptions(port):
    """4 sessions with 10,000 subscriptions each, that unsubscribe from something else, 16 times at once on each of 64 connections."""
    owners = []
    for first in range(0, 40_000, 10_000):
        owner = Line(port)
        owner.connect()
        for number in range(first, first + 10_000, 100):
            send_together(owner, [subscribe("person_detected", [is_equal("number", f"{one}")]) for one in range(number, number + 100)])
        owners.append(owner.session)
    turns = itertools.cycle(owners)
    body = f'<unsubscribe xmlns="{MESSAGE}"><subscribe_id>s-0</subscribe_id></unsubscribe>'

    def act(one, _):
        one.session = one.session or next(turns)
        send_together(one, [body] * 16)

    each(port, 64, act)


def stored(port):
    """60 sessions that change subscriptions with conditions of 28 kB again and again, which a journal stores."""
    every = [subscribe("person_detected", [is_equal("number", "1"), is_equal("component_ref", f"{number}" + "x" * 28_000)]) for number in range(8)]
    every += [body.replace('inline_results="true"', 'inline_results="false"') for body in every]
    each(port, 60, lambda one, _: one.is_connected() and send_together(one, every))


def literals(port):
    """60 sessions that send conditions with a literal of 0.9 MB, in subscriptions and queries."""

    def act(one, turn):
        equal = [is_equal("component_ref", f"{turn}" + "x" * BIG)]
        if one.is_connected():
            one.post(subscribe("person_detected", equal) if turn % 2 else query("engine_status", equal))

    each(port, 60, act)


def patterns(port):
    """A session that compares 16 kB with 250 patterns, on 16 connections."""
    owner = Line(port)
    owner.connect()
    owner.post(bind("speech_synthesis"))
    text = parameter("rois:parameter", "speech_text", "string", "x" * 16_000)
    owner.post(execute([unit("speech_synthesis", "set_parameter", text)]))
    search = query("component_status", [is_like("speech_text", f"*no{number}") for number in range(250)])

    def act(one, _):
        one.session = owner.session
        one.post(search)

    each(port, 16, act)


def bodies(port):
    """200 bodies of 0.9 MB that are never finished."""
    head = Line(port).head(BIG + 1)
    send_on_new_connections(port, 200, lambda _: (head + "<" + " " * (BIG - 1)).encode())


def commands(port):
    """Commands with arguments of 0.9 MB that complete at once."""

    def act(one, turn):
        if not one.session and one.connect():
            one.post(bind("speech_synthesis"))
        text = parameter("rois:parameter", "speech_text", "string", f"{turn} " + "x" * BIG)
        one.post(execute([unit("speech_synthesis", "set_parameter", text)]))

    each(port, 8, act)


def sessions(port):
    """Opens as many sessions as a connection may, then reconnects; and opens WebSockets without a session."""
    idle = []

    def act(one, _):
        for _ in range(20):
            one.session = ""
            one.connect()
        one.open()
        idle.append(websocket(port))
        if len(idle) > 300:
            idle.pop(0).close()

    each(port, 4, act)


def speeches(port):
    """Speeches one after another; each writes a line to the log."""
    one = Line(port)
    while True:
        if not one.session and one.connect():
            one.post(bind("speech_synthesis"))
        say = unit("speech_synthesis", "start", parameter("rois:parameter", "speech_text", "string", "x"))
        one.post(execute([say, unit("speech_synthesis", "stop")]))


def websocket(port):
    one = socket.create_connection((HOST, port))
    one.settimeout(5)
    key = base64.b64encode(os.urandom(16)).decode()
    one.sendall(
        f"GET /rois HTTP/1.1\r\nHost: {HOST}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n\r\n".encode()
    )
    answer = one.recv(4_096)
    if not answer.startswith(b"HTTP/1.1 101 "):
        raise OSError(f"no WebSocket: {answer[:100]!r}")
    return one


def frame(opcode, content, final=True):
    head = bytes([(0x80 if final else 0) | opcode])
    size = len(content)
    head += bytes([0x80 | size]) if size < 126 else bytes([0x80 | 126]) + struct.pack(">H", size)
    return head + b"\0\0\0\0" + content


def controls(port):
    """Pings as fast as possible, on 8 WebSockets."""
    pings = frame(9, b"x") * 100
    every = [websocket(port) for _ in range(8)]
    for turn in itertools.count():
        place = turn % len(every)
        try:
            every[place].sendall(pings)
        except OSError:
            every[place].close()
            try:
                every[place] = websocket(port)
            except OSError:
                pass


def trickles(port):
    """Empty lines before a request that is never sent, and messages in fragments of one byte."""
    blank = [Line(port) for _ in range(32)]
    fragments = [websocket(port) for _ in range(32)]
    for one in fragments:
        one.sendall(frame(1, b"<", final=False))
    for turn in itertools.count():
        place = turn % 32
        try:
            blank[place].socket.sendall(b"\r\n" * 500)
            fragments[place].sendall(frame(0, b" ", final=False) * 100)
        except OSError:
            try:
                blank[place].open()
                fragments[place].close()
                fragments[place] = websocket(port)
                fragments[place].sendall(frame(1, b"<", final=False))
            except OSError:
                pass


def namespaces(port):
    """Documents of 0.6 MB with 60 namespace declarations in scope, and with 20,000."""
    allowed = "".join(f'<a xmlns:n{number}="urn:{number}">' for number in range(60)) + "<n1:b/>" * 80_000
    many = "".join(f'<a xmlns:n{number}="urn:{number}">' for number in range(20_000))
    each(port, 8, lambda one, turn: one.post(f'<query xmlns="{MESSAGE}">{allowed if turn % 2 else many}</query>'))


def long_documents(port):
    """Documents of 0.9 MB whose error is near their end, so that they are validated completely."""
    wrong = query("engine_status", [is_equal("component_ref", f"x{number}") for number in range(6_000)])
    wrong = wrong.replace("</query>", "<more/></query>")
    each(port, 8, lambda one, _: one.is_connected() and one.post(wrong))


def wrong_tokens(port):
    """Wrong tokens, a different one each time."""

    def act(one, turn):
        one.token = f"{turn:043}"
        one.post(f'<connect xmlns="{MESSAGE}"/>')

    each(port, 32, act)


def handshakes(port):
    """TLS handshakes, each on a new connection, and 100 that are begun and not continued."""
    waiting = [socket.create_connection((HOST, port)) for _ in range(100)]
    for one in waiting:
        one.sendall(b"\x16\x03\x01")
    context = any_certificate()

    def go_on():
        while True:
            try:
                with socket.create_connection((HOST, port)) as one:
                    one.settimeout(5)
                    context.wrap_socket(one, do_handshake_on_connect=True).close()
            except OSError:
                time.sleep(0.001)

    for _ in range(8):
        threading.Thread(target=go_on, daemon=True).start()
    threading.Event().wait()


TURN = unit("move", "start", parameter("rois:parameter", "curve", "int[]", "0 36000"))  # on the spot, a hundred times


def leases(port):
    """Starts motion, is silent until it is held, and resumes it."""
    one = Line(port)
    while True:
        if not one.session and one.connect(' motion_lease_http="1000"'):
            one.post(bind("move"))
        one.post(execute([TURN]))
        for _ in range(3):
            time.sleep(1.4)
            one.post(execute([unit("move", "resume")]))


def motions(port):
    """Starts and stops motion, again and again."""
    one = Line(port)
    while True:
        if one.is_connected():
            one.post(bind("move"))
            one.post(execute([TURN]))
            time.sleep(0.02)
            one.post(execute([unit("move", "stop")]))


FLOODS = {
    one.__name__: one
    for one in (
        requests,
        unread,
        connections,
        headers,
        garbage,
        predicates,
        subscriptions,
        stored,
        literals,
        patterns,
        bodies,
        commands,
        sessions,
        speeches,
        controls,
        trickles,
        namespaces,
        long_documents,
        wrong_tokens,
        handshakes,
    )
}

if __name__ == "__main__":
    {**FLOODS, "leases": leases, "motions": motions}[sys.argv[1]](int(sys.argv[2]))
