"""Components of a RoIS engine in a program of your own: this file and Python 3.9 suffice (docs/component-programs.md; lamp.py).
The program joins the engine as a sub engine, and joins again whenever the link is lost."""

import argparse
import asyncio
import base64
import collections
import concurrent.futures
import contextlib
import datetime
import hashlib
import inspect
import ipaddress
import logging
import os
import pathlib
import re
import signal
import ssl
import struct
import threading
import time
import urllib.parse
import uuid
from xml.etree import ElementTree
from xml.sax.saxutils import escape, quoteattr

# Namespaces, as ElementTree writes them: of the messages, of RoIS, of GML, and of XML Schema.
M = "{urn:x-rois:psm:xml:message:1}"
R = "{http://www.omg.org/spec/RoIS/20240801}"
GML = "{http://www.opengis.net/gml/3.2}"
XSI = "{http://www.w3.org/2001/XMLSchema-instance}"
NAMES = f'xmlns="{M[1:-1]}" xmlns:rois="{R[1:-1]}" xmlns:xsi="{XSI[1:-1]}"'
NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")

# Seconds.
LONGEST_PAUSE = 30  # between two attempts to join
PAUSE_IN_WINDOW = 0.2  # while the engine keeps the session
SHORT_LINK = 5
LONGEST_HALT = 0.5  # for which an answer waits
LONGEST_QUERY = 2
EVENT_LIFE = 60

# Bytes: of a message from the engine, and of those that it has not read.
MOST_BYTES = 16_000_000

LINK_ERRORS = (
    OSError,
    EOFError,
    asyncio.TimeoutError,
    asyncio.LimitOverrunError,
    UnicodeDecodeError,
    ElementTree.ParseError,
)

log = logging.getLogger("rois")


class Refused(Exception):
    """A command cannot be performed with these arguments, or now. The application receives the reason."""


class Component:
    """A component. Override what it can do: a coroutine for each command, and a function or coroutine for each query, by the
    names of its profile. Arguments and results are dictionaries of int, float, bool, str, or lists of them. A query that is a
    function runs in a thread. All other code runs in the event loop and must not block it."""

    profile = ""  # the profile document, or the name of its file
    # Whether commands may move the component among people. It is then halted when no sign of life arrives within the motion
    # lease.
    moves = False
    continuous = False  # `start` begins a function that goes on until it is stopped; otherwise an action that ends by itself

    def __init__(self, ref):
        self.ref = ref
        self.status = "READY"  # or UNINITIALIZED, WARNING, ERROR
        self._ref = f"<component_ref rois:code={quoteattr(ref)}/>"
        self._service = None  # set by Service
        self._running = set()  # the tasks of the commands that run
        self._active = False  # whether a function goes on after `start`
        self._halt = None  # the task of the last halt
        self._ended = set()  # the commands that it ends
        self._stands = False  # a halt has succeeded, and nothing has begun since
        self._has_failed_to_halt = False
        is_document = self.profile.lstrip().startswith("<")
        self._profile = Profile(self.profile if is_document else pathlib.Path(self.profile).read_text(encoding="utf-8"), ref)
        self.parameters = dict(self._profile.defaults)  # set by `set_parameter` and `start`; the defaults again after `release`

    def check(self, command, arguments):
        """Called before a command is accepted. Raise Refused with a reason to refuse it. Must not change anything."""

    async def start(self, arguments):
        """The function of the component. Returns when it has completed, with its results if there are any. It is cancelled by
        `stop`, and when the engine is lost."""

    async def halt(self):
        """Called when the component must stand still: after `start` was cancelled. It must not take longer than 0.5 s."""

    def event(self, event_type, results=None):
        """Reports an event of the profile. All reports may be made from any thread."""
        self._service.event(self, event_type, results or {})

    def error(self, text):
        """Reports COMPONENT_INTERNAL_ERROR."""
        self._service.error(self, text)

    def changed(self):
        """Reports a new `status`."""
        self._service.state(self)


class Profile:
    """The profile document of a component: the messages with the types of their parameters."""

    def __init__(self, text, ref):
        root = ElementTree.fromstring(text)
        root.set(GML + "id", f"profile.{ref}")  # components of one type are in one document
        if root.tag != R + "HRIComponentProfile":
            raise ValueError(f"expected an HRIComponentProfile, not {root.tag}")
        self.urn = root.findtext(GML + "identifier")
        self.include_common_messages(root)
        for prefix, name in (("rois", R), ("gml", GML), ("xsi", XSI)):
            ElementTree.register_namespace(prefix, name[1:-1])
        self.text = ElementTree.tostring(root, encoding="unicode")
        self.messages = {"command": {}, "query": {}, "event": {}}  # by name: the types of the arguments and of the results
        for message in root.findall(R + "MessageProfile"):
            kind = message.get(XSI + "type").split(":")[-1].replace("MessageProfileType", "").lower()
            self.messages[kind][message.get(R + "name")] = (self.types(message, "Arguments"), self.types(message, "Results"))
        self.parameters = self.types(root, "ParameterProfile")
        self.defaults = {}
        for each in root.findall(R + "ParameterProfile"):
            name, value = each.get(R + "name"), each.get(R + "default_value")
            if value is not None:
                self.defaults[name] = read_value(f"the default of {name}", self.parameters[name], [value], True)

    @staticmethod
    def types(owner, element):
        return {each.get(R + "name"): each.find(R + "data_type_ref").get(R + "code") for each in owner.findall(R + element)}

    @staticmethod
    def include_common_messages(root):
        """Replaces the reference to RoISCommon by its messages: the engine expects all messages in the document."""
        for profile in root.findall(R + "SubComponentProfile"):
            if profile.text.strip() != "urn:x-rois:def:component:OMG::RoISCommon":
                continue
            at = list(root).index(profile)
            root.remove(profile)
            for name in ("start", "stop", "suspend", "resume"):
                attributes = {XSI + "type": "rois:CommandMessageProfileType", R + "name": name}
                root.insert(at, ElementTree.Element(R + "MessageProfile", attributes))


# The forms of values, by the names of their types in lower case (decision 26). Any text is a value of another type.
RANGES = {  # of whole numbers: the lowest, and the first that is too high
    "byte": (-(2**7), 2**7),
    "short": (-(2**15), 2**15),
    "int": (-(2**31), 2**31),
    "integer": (-(2**31), 2**31),
    "long": (-(2**63), 2**63),
    "unsignedbyte": (0, 2**8),
    "unsignedshort": (0, 2**16),
    "unsignedint": (0, 2**32),
    "unsignedlong": (0, 2**63),
    "unlimitednatural": (0, 2**31),
    "nonnegativeinteger": (0, 2**31),
    "positiveinteger": (1, 2**31),
    "nonpositiveinteger": (-(2**31), 1),
    "negativeinteger": (-(2**31), 0),
}
REALS = ("double", "real", "float", "decimal", "number")
BOOLS = ("bool", "boolean")
DATE = r"\d{4}-\d\d-\d\d"
TIME = r"([01]\d|2[0-3]):[0-5]\d:[0-5]\d(\.\d+)?"
ZONE = r"(Z|[+-]((0\d|1[0-3]):[0-5]\d|14:00))"
FORMS = {
    **dict.fromkeys(RANGES, r"[+-]?\d+"),
    **dict.fromkeys(BOOLS, "true|false|1|0"),
    **dict.fromkeys(REALS, r"[+-]?(INF|(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?)|NaN"),
    "datetime": f"{DATE}T{TIME}{ZONE}",
    "date": f"{DATE}{ZONE}?",
    "time": f"{TIME}{ZONE}?",
    "roisidentifier": "(?s:.+)",
    "rois_identifier": "(?s:.+)",
    **dict.fromkeys(("component_status", "componentstatus"), "UNINITIALIZED|READY|BUSY|WARNING|ERROR"),
    **dict.fromkeys(("stream_status", "streamstatus"), "STREAMING_(NOT_RUNNING|NOT_CONNECTED|RUNNING|SUSPENDED|RESUMED)"),
}


def data_type(code):
    """The name of a type or of a list's items, whether it is a list, and whether one text has all items of the list."""
    item = re.fullmatch(r"(?:Set|List|Sequence|seq)\s*<(.+)>|(.+)\[\]", code.strip(), re.IGNORECASE)
    name = re.split("[:#/]", ((item[1] or item[2]) if item else code).strip())[-1].lower()
    return name, item is not None, item is not None and (name in RANGES or name in REALS or name in BOOLS)


def read_item(name, text):
    if name not in FORMS:
        return text
    text = text.strip(" \t\r\n")
    if not re.fullmatch(FORMS[name], text, re.ASCII):
        raise ValueError(text)
    if name in ("date", "datetime"):
        datetime.date.fromisoformat(text[:10])  # raises ValueError if there is no such day
    if name in BOOLS:
        return text in ("true", "1")
    if name in RANGES:
        if int(text) not in range(*RANGES[name]):
            raise ValueError(text)
        return int(text)
    if name in REALS:
        if abs(float(text)) == float("inf") and "INF" not in text:
            raise ValueError(text)
        return float(text)
    return text


def read_value(what, code, texts, is_default=False):
    """The Python value of a parameter of this type. Raises Refused if the texts are not a value of the type."""
    name, is_list, is_packed = data_type(code)
    try:
        if len(texts) != 1 and (not is_list or is_packed and texts):
            raise ValueError(texts)
        items = re.findall("[^ \t\r\n]+", "".join(texts)) if is_packed or is_list and is_default else texts
        values = [read_item(name, each) for each in items]
        return values if is_list else values[0]
    except ValueError:
        raise Refused(f"{what} must be of type {code}, not {', '.join(map(repr, texts)) or 'empty'}") from None


def text_of(value):
    """The text of a value, as XML Schema writes it."""
    text = str(value)
    if isinstance(value, bool):
        return text.lower()
    if isinstance(value, float):
        return text.replace("inf", "INF").replace("nan", "NaN")
    return text


def results(types, values):
    """A `results` element. Raises ValueError for a result that the profile does not have."""
    content = ""
    for name, value in values.items():
        if name not in types:
            raise ValueError(f"the profile has no result {name!r}: expected {', '.join(types) or 'none'}")
        items = value if isinstance(value, (list, tuple)) else [value]
        texts = [text_of(each) for each in items]
        _, _, is_packed = data_type(types[name])
        if is_packed:
            texts = [" ".join(texts)]
        content += f"<result rois:name={quoteattr(name)}><rois:data_type_ref rois:code={quoteattr(types[name])}/>"
        content += "".join(f"<rois:value>{escape(text)}</rois:value>" for text in texts) + "</result>"
    return f"<results>{content}</results>"


def with_status(status, reason="", content="<results/>"):
    """The `results` of a command as get_command_result returns them: its status, why it failed, and then its own."""
    told = {"status": status, "reason": reason} if reason else {"status": status}
    own = content.removeprefix("<results/>").removeprefix("<results>")
    return results(dict.fromkeys(told, "string"), told).removesuffix("</results>") + (own or "</results>")


async def within(seconds, task):
    """The result of a task. Before Python 3.12, asyncio.wait_for may lose a cancellation."""
    done, _ = await asyncio.wait([task], timeout=seconds)
    if not done and task.cancel():
        raise asyncio.TimeoutError(f"no end within {seconds} s")
    return task.result()


def in_thread(function):
    """The result of a function that may block. The end of the program does not wait for its thread."""
    future = concurrent.futures.Future()
    future.set_running_or_notify_cancel()

    def call():
        try:
            future.set_result(function())
        except Exception as problem:
            future.set_exception(problem)

    threading.Thread(target=call, daemon=True).start()
    return asyncio.wrap_future(future)


def trusted():
    """TLS that trusts the certificates of the system and of the file ROIS_CA_FILE, and shows the one in ROIS_CERTIFICATE_FILE."""
    context = ssl.create_default_context()
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    if os.environ.get("ROIS_CA_FILE"):
        context.load_verify_locations(os.environ["ROIS_CA_FILE"])
    if os.environ.get("ROIS_CERTIFICATE_FILE"):
        context.load_cert_chain(os.environ["ROIS_CERTIFICATE_FILE"])
    return context


class WebSocket:
    """The client's side of a WebSocket (RFC 6455)."""

    def __init__(self, reader, writer):
        self.reader = reader
        self.writer = writer
        self.last_received = time.monotonic()

    @classmethod
    async def open(cls, url, token=""):
        if token and not is_safe(url):
            raise ValueError("a token is not sent to another machine without TLS: expected wss://...")
        parts = urllib.parse.urlsplit(url)
        secure = parts.scheme in ("wss", "https")
        port = parts.port or (443 if secure else 80)
        reader, writer = await asyncio.open_connection(parts.hostname, port, ssl=trusted() if secure else None)
        key = base64.b64encode(os.urandom(16)).decode()
        bearer = f"Authorization: Bearer {token}\r\n" if token else ""
        writer.write(
            f"GET {parts.path.rstrip('/')}/rois/engines HTTP/1.1\r\nHost: {parts.netloc}\r\n"
            "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n{bearer}\r\n".encode()
        )
        status, _, fields = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1").partition("\r\n")
        expected = base64.b64encode(hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()).decode()
        if " 101 " not in status + " " or f"sec-websocket-accept: {expected}".lower() not in fields.lower():
            writer.close()
            raise ConnectionError(f"no WebSocket: {status}")
        return cls(reader, writer)

    def send(self, payload, opcode=1):
        size = len(payload)
        mask = os.urandom(4)
        if size < 126:
            length = bytes([0x80 | size])
        elif size < 65536:
            length = struct.pack(">BH", 0xFE, size)
        else:
            length = struct.pack(">BQ", 0xFF, size)
        key = (mask * (size // 4 + 1))[:size]
        masked = (int.from_bytes(payload, "big") ^ int.from_bytes(key, "big")).to_bytes(size, "big")
        self.writer.write(bytes([0x80 | opcode]) + length + mask + masked)
        if self.writer.transport.get_write_buffer_size() > MOST_BYTES:
            log.warning("the engine does not read: the link is cut")
            self.writer.transport.abort()

    async def next(self):
        """The next text message. Raises ConnectionError at the end."""
        message = b""
        while True:
            first, second = await self.reader.readexactly(2)
            size = second & 0x7F
            if size > 125:
                size = int.from_bytes(await self.reader.readexactly(2 if size == 126 else 8), "big")
            if len(message) + size > MOST_BYTES:
                raise ConnectionError(f"received a message of {len(message) + size} bytes: expected at most {MOST_BYTES}")
            payload = await self.reader.readexactly(size)
            self.last_received = time.monotonic()
            opcode = first & 0x0F
            if opcode == 8:
                raise ConnectionError("closed by the engine: " + payload[2:].decode("utf-8", "replace"))
            if opcode == 9:
                self.send(payload, 10)
            if opcode in (0, 1):
                message += payload
                if first & 0x80:
                    return message.decode()


class Service:
    """Answers the engine's requests, each in a task of its own. The session survives a lost link for `window` seconds."""

    def __init__(self, name, components, token=""):
        self.name = name
        self.token = token  # that the gateway expects; empty: none
        self.instance = uuid.uuid4().hex
        self.components = {each.ref: each for each in components}
        self.loop = None
        self.thread = threading.get_ident()
        self.tasks = set()  # the event loop does not own its tasks
        # The link.
        self.socket = None
        self.unanswered = set()  # its requests
        self.last_request = time.monotonic()
        # The session.
        self.session = ""
        self.is_attached = False  # whether the link uses it
        self.detached_at = time.monotonic()
        self.window = 3.0
        self.lease = 0
        self.subscribed = {}
        self.performed = {}  # of the last accepted commands, by id: what get_command_result returns
        self.sequence = 0  # of the last notification
        self.written = 0  # of the last one given to a link
        self.sent = collections.deque(maxlen=10_000)  # (sequence, document, event or None): kept for a link that returns
        self.kept = collections.deque(maxlen=10_000)  # events without a subscription
        for each in components:
            each._service = self

    def begin(self, coroutine):
        self.tasks.add(task := asyncio.ensure_future(coroutine))
        task.add_done_callback(self.tasks.discard)
        return task

    def notify(self, element, content, attributes="", event=None):
        if self.loop and threading.get_ident() != self.thread:
            return self.loop.call_soon_threadsafe(self.notify, element, content, attributes, event)
        self.sequence += 1
        document = NOT_XML.sub("?", f'<{element} {NAMES} sequence="{self.sequence}"{attributes}>{content}</{element}>')
        self.sent.append((self.sequence, document, event))
        if self.is_attached:
            self.written = self.sequence
            self.socket.send(document.encode())

    def event(self, component, event_type, values):
        if event_type not in component._profile.messages["event"]:
            raise ValueError(f"the profile has no event {event_type!r}")
        content = results(component._profile.messages["event"][event_type][1], values)
        expire = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(time.time() + EVENT_LIFE))
        head = f"<event_id>{uuid.uuid4().hex}</event_id><event_type>{escape(event_type)}</event_type><subscribe_id>"
        tail = f"</subscribe_id><expire>{expire}</expire>{component._ref}{content}"
        self.publish((time.monotonic() + EVENT_LIFE, event_type, head, tail))

    def publish(self, event):
        """Sends an event, or keeps it for a subscription until it expires."""
        end, event_type, head, tail = event
        if event_type not in self.subscribed:
            self.kept.append(event)
        elif time.monotonic() < end:
            self.notify("receive_event", head + self.subscribed[event_type] + tail, event=event)

    def error(self, component, text):
        what = f"<error_id>{uuid.uuid4().hex}</error_id><error_type>COMPONENT_INTERNAL_ERROR</error_type>{component._ref}"
        if self.session:
            self.notify("receive_error", f"{what}<text>{escape(text)}</text>")

    def state(self, component):
        if self.session:
            self.notify("component_changed", f"{component._ref}<status>{component.status}</status><results/>")

    async def serve(self, socket):
        """Reads requests until the link ends. Never waits for a component."""
        self.loop = asyncio.get_running_loop()
        self.socket = socket
        try:
            while True:
                request = ElementTree.fromstring(await socket.next())
                self.last_request = time.monotonic()
                self.unanswered.add(request)
                self.begin(self.handle(request))
        finally:
            if self.is_attached:
                self.detached_at = time.monotonic()
            self.is_attached = False
            self.socket = None
            self.unanswered = set()

    async def handle(self, request):
        name = request.tag.replace(M, "")
        try:
            if hasattr(self, "on_" + name):
                return await getattr(self, "on_" + name)(request)
            self.reply(name, request, "UNSUPPORTED", reason=f"a component program does not answer {name}")
        except (Exception, asyncio.CancelledError) as problem:
            log.exception("%s failed", name)
            self.reply(name, request, "ERROR", reason=f"{type(problem).__name__}: {problem}")

    def reply(self, name, request, code="OK", content="", reason="", attributes=""):
        if request.get("request_id") is not None:
            attributes += f" request_id={quoteattr(request.get('request_id'))}"
        content = content if code == "OK" else f"<reason>{escape(reason)}</reason>"
        self.answer(request, f'<{name}_response {NAMES} return_code="{code}"{attributes}>{content}</{name}_response>')

    def answer(self, request, document):
        """Drops the answer if the link of its request has ended."""
        if request in self.unanswered:
            self.unanswered.remove(request)
            self.socket.send(NOT_XML.sub("?", document).encode())

    async def on_connect(self, request):
        if not self.is_attached:
            await self.end_session()  # of an engine that has restarted
        is_new = request in self.unanswered and not (self.session and self.is_attached)
        if is_new:
            self.session = uuid.uuid4().hex
            self.is_attached = True
            self.sequence = self.written = 0
            self.window = int(request.get("window", 3_000)) / 1_000
            self.lease = int(request.get("motion_lease", 0)) / 1_000
        window = f' window="{round(self.window * 1_000)}"'
        self.reply("connect", request, "OK", f"<session>{self.session}</session>", attributes=window)
        if is_new:
            for component in self.components.values():
                self.state(component)

    async def on_resume(self, request):
        if request.get("session") != self.session or not self.session:
            attributes = f'code="no_session" request_id={quoteattr(request.get("request_id", ""))}'
            return self.answer(request, f"<fault {NAMES} {attributes}><reason>unknown session</reason></fault>")
        self.is_attached = True
        last = int(request.get("last_sequence"))
        if last > 0:  # otherwise the engine has restarted: it asks about its commands, and passes no events on
            self.written = self.sequence
        self.reply("resume", request)
        for sequence, document, _ in self.sent:
            if sequence > last:
                self.socket.send(document.encode())

    async def on_disconnect(self, request):
        await self.end_session()
        self.reply("disconnect", request)

    async def on_get_profile(self, request):
        entries, names, profiles = "", "", ""
        for ref, each in self.components.items():
            names += f"<rois:HRIComponent>{escape(ref)}</rois:HRIComponent>"
            entries += f"<component ref={quoteattr(ref)} type={quoteattr(each._profile.urn)} engine={quoteattr(self.name)} "
            entries += f'moves="{str(each.moves).lower()}" when_stopped="ABORT"/>'
            profiles += each._profile.text
        identifier = f"urn:x-rois:def:HRIEngine:program::{escape(self.name)}"
        engine = (
            f'<rois:HRIEngineProfile xmlns:gml="{GML[1:-1]}" gml:id="engine.{uuid.uuid5(uuid.NAMESPACE_URL, self.name).hex}">'
            f'<gml:identifier codeSpace="urn:ietf:rfc:2141">{identifier}</gml:identifier>'
            f"<gml:name>{escape(self.name)}</gml:name>{names}"
            f'<rois:ParameterProfile rois:name="instance" rois:default_value="{self.instance}">'
            '<rois:data_type_ref rois:code="string"/></rois:ParameterProfile></rois:HRIEngineProfile>'
        )
        self.reply("get_profile", request, content=f"{engine}<components>{entries}</components>{profiles}")

    async def on_bind(self, request):
        ref = request.find(M + "component_ref").get(R + "code")
        self.reply("bind", request, "OK" if ref in self.components else "BAD_PARAMETER", reason=self.unknown(ref))

    def unknown(self, ref):
        return f"unknown component {ref!r}; there are {', '.join(self.components)}"

    async def on_release(self, request):
        component = self.components.get(request.find(M + "component_ref").get(R + "code"))
        if component is not None:
            await asyncio.wait([self.halt(component, True)], timeout=LONGEST_HALT)
        self.reply("release", request)

    async def on_subscribe(self, request):
        event_type = request.findtext(M + "event_type")
        self.subscribed[event_type] = uuid.uuid4().hex
        kept, self.kept = self.kept, collections.deque(maxlen=10_000)
        for event in kept:
            self.publish(event)  # before the answer: events after it are new
        self.reply("subscribe", request, content=f"<subscribe_id>{self.subscribed[event_type]}</subscribe_id>")

    async def on_query(self, request):
        name = request.findtext(M + "query_type")
        component = self.components.get(next((each.text for each in request.iter() if each.tag.endswith("}Literal")), None))
        function = getattr(component, name, None) if component and name in component._profile.messages["query"] else None
        if function is None:
            return self.reply("query", request, "UNSUPPORTED", reason=f"no component answers the query {name!r}")
        answer = function() if inspect.iscoroutinefunction(function) else in_thread(function)
        values = await within(LONGEST_QUERY, self.begin(answer))
        self.reply("query", request, content=component._ref + results(component._profile.messages["query"][name][1], values))

    async def on_get_command_result(self, request):
        id = request.findtext(M + "command_id")
        code = "OK" if id in self.performed else "BAD_PARAMETER"
        self.reply("get_command_result", request, code, self.performed.get(id), f"unknown command {id!r}")

    async def on_execute(self, request):
        sequence = request.find(R + "CommandUnitSequence")
        unit = sequence.find(R + "command_unit_list")
        component = self.components.get(unit.find(R + "component_ref").get(R + "code"))
        command, id = unit.get(R + "command_type"), unit.get(R + "command_id")
        try:
            arguments = self.arguments(component, command, unit)
            if command != "stop":
                component.check(command, arguments)
        except Refused as refused:
            return self.reply("execute", request, "BAD_PARAMETER", reason=str(refused))
        self.reply("execute", request, content=ElementTree.tostring(sequence, encoding="unicode"))
        if request.get("check_only") in ("true", "1"):
            return
        self.performed[id] = with_status("RUNNING")
        if len(self.performed) > 1_000:
            self.performed.pop(next(iter(self.performed)))
        await self.perform(component, id, command, arguments)

    def arguments(self, component, command, unit):
        """The arguments of a command. Raises Refused for a wrong one."""
        if component is None:
            raise Refused(self.unknown(unit.find(R + "component_ref").get(R + "code")))
        profile = component._profile
        if command not in profile.messages["command"]:
            raise Refused(f"the component has no command {command!r}")
        if command not in ("stop", "set_parameter") and not hasattr(component, command):
            raise Refused(f"the component does not implement {command!r}")
        codes = {**profile.parameters, **profile.messages["command"][command][0]}
        values = {}
        for each in unit.findall(f"{R}arguments/{R}parameter"):
            name = each.get(R + "name")
            if name not in codes:
                raise Refused(f"the command {command!r} has no argument {name!r}")
            texts = [value.text or "" for value in each.findall(R + "value")]
            values[name] = read_value(f"the argument {name!r}", codes[name], texts)
        return values

    async def perform(self, component, id, command, arguments):
        session = self.session
        task = asyncio.current_task()
        status, values, reason = "OK", {}, ""
        try:
            if command == "stop":
                reason = await self.halt(component)
                status = "ERROR" if reason else "OK"
            else:
                component._running.add(task)
                if component._halt:
                    await asyncio.wait([component._halt])  # a halt ends first
                component._stands = False
                given = {name: value for name, value in arguments.items() if name in component._profile.parameters}
                if command == "start":
                    component.parameters.update(given)
                values = await getattr(component, command)(arguments) if hasattr(component, command) else {}
                if command == "set_parameter":
                    component.parameters.update(given)
                if command == "start":
                    component._active = component.continuous
        except asyncio.CancelledError:
            status, reason = "ABORT", "it was stopped"
        except Exception as problem:
            log.exception("%s: %s failed", component.ref, command)
            status, reason = "ERROR", f"{type(problem).__name__}: {problem}"
        component._running.discard(task)
        if session and session == self.session:
            self.completed(component, id, status, values, command, reason)  # its engine waits

    def completed(self, component, id, status, values=None, command="", reason=""):
        try:
            content = results(component._profile.messages["command"][command][1], values or {})
        except Exception as problem:
            status, content, reason = "ERROR", "<results/>", f"{type(problem).__name__}: {problem}"
        if id in self.performed:
            self.performed[id] = with_status(status, reason, content)
        why = f"<reason>{escape(reason)}</reason>" if reason else ""
        what = f"<command_id>{escape(id)}</command_id><status>{status}</status>{content}{why}"
        self.notify("completed", what, f' active="{str(component._active).lower()}"')

    def halt(self, component, is_released=False):
        """Begins to end what the component does. The task ends when it stands still, and returns why that failed. A halt that is
        under way is enough, unless a command has come since: an engine repeats a `stop` that takes long. A component that stands
        still is not halted for its release."""
        for task in component._running:
            task.cancel()
        is_halting = component._halt and not component._halt.done() and component._running <= component._ended
        if not is_halting and not (is_released and component._stands and not component._running):
            component._ended = set(component._running)
            component._halt = self.begin(self.finish(component, component._ended, component._halt))
        if is_released:
            component._halt = self.begin(self.restore_defaults(component, component._halt))
        return component._halt

    async def finish(self, component, running, last_halt):
        if last_halt:
            await asyncio.wait([last_halt])
        if running:
            await asyncio.wait(running, timeout=LONGEST_HALT)
        reason = await self.call(component, component.halt, is_again=component._has_failed_to_halt)
        component._active = component._has_failed_to_halt = bool(reason)  # after an exception, it may still move
        component._stands = not reason
        await asyncio.gather(*running, return_exceptions=True)
        return reason

    async def restore_defaults(self, component, halt):
        reason = await halt if halt else ""
        if component.parameters != component._profile.defaults:
            component.parameters = dict(component._profile.defaults)
            if hasattr(component, "set_parameter"):
                await self.call(component, component.set_parameter, dict(component.parameters))
        return reason

    async def call(self, component, function, *arguments, is_again=False):
        """Calls a function of the component. Returns the text of its exception, and reports it unless it failed before, too."""
        try:
            return await function(*arguments) and ""
        except (Exception, asyncio.CancelledError) as problem:
            text = f"{type(problem).__name__}: {problem}"
            if not is_again:
                log.exception("%s: %s failed", component.ref, function.__name__)
                self.error(component, f"{function.__name__} failed: {text}")
            return text

    async def end_session(self, patience=LONGEST_HALT):
        """Ends the session, halts its components, and waits at most this time for them. Keeps the events that no link has
        taken."""
        self.session = ""
        self.is_attached = False
        self.subscribed = {}
        self.performed.clear()
        self.kept.extend(event for sequence, _, event in self.sent if event and sequence > self.written)
        self.sent.clear()
        used = [each for each in self.components.values() if self.is_used(each)]
        if used:
            await asyncio.wait([self.halt(each, True) for each in used], timeout=patience)

    @staticmethod
    def is_used(component):
        return component._running or component._active or component.parameters != component._profile.defaults

    async def watch(self):
        """Ends the session when its link is lost for longer than the window, and halts moving components without signs of life."""
        is_held = False
        while True:
            await asyncio.sleep(0.1)
            now = time.monotonic()
            is_silent = self.socket and now > self.socket.last_received + 2 + self.window
            if is_silent:
                self.socket.writer.transport.abort()
            if self.session and (is_silent or not self.is_attached and now > self.detached_at + self.window):
                log.warning("the engine is lost: everything is halted")
                self.begin(self.end_session())
            was_held, is_held = is_held, 0 < self.lease < now - self.last_request
            moving = [each for each in self.components.values() if each.moves and (each._running or each._active)]
            for component in moving if is_held and not was_held else ():
                log.warning("%s is halted: no sign of life from the engine", component.ref)
                self.halt(component)


async def join(service, url):
    """Joins, and answers until the link ends."""
    socket = await within(5, asyncio.ensure_future(WebSocket.open(url, service.token)))
    try:
        socket.send(f"<join {NAMES} name={quoteattr(service.name)} instance={quoteattr(service.instance)}/>".encode())
        response = ElementTree.fromstring(await within(5, asyncio.ensure_future(socket.next())))
        if response.get("return_code") != "OK":
            raise ConnectionError(f"refused: {response.findtext(M + 'reason')}")
        log.info("joined %s as %s", url, service.name)
        await service.serve(socket)
    finally:
        socket.writer.close()


async def join_again(service, url):
    """Joins when there is no link: often while the engine keeps the session, otherwise less and less often."""
    pause = 0.1
    soon_until = 0.0
    said = ""
    while True:
        begun = time.monotonic()
        try:
            await join(service, url)
        except LINK_ERRORS as problem:
            if str(problem) != said:
                log.warning("%s: %s", url, problem or "the link broke")
            said = str(problem)
        now = time.monotonic()
        if now - begun > SHORT_LINK:  # not a link that the engine ended at once, perhaps because of the profiles
            pause = 0.1
            soon_until = now + service.window
        await asyncio.sleep(PAUSE_IN_WINDOW if now < soon_until else pause)
        if now >= soon_until:
            pause = min(2 * pause, LONGEST_PAUSE)


async def keep_joined(service, url):
    """Joins whenever there is no link. Ends only when it is cancelled, or with an exception of this module."""
    try:
        await asyncio.gather(service.watch(), join_again(service, url))
    finally:
        await service.end_session(1.5)  # the gateway kills a program after 2 s


def is_safe(url):
    """Whether others on the network cannot read a token that is sent there."""
    parts = urllib.parse.urlsplit(url)
    host = parts.hostname or ""
    if parts.scheme in ("wss", "https") or host == "localhost":
        return True
    with contextlib.suppress(ValueError):  # not an address: "127.0.0.1.example" is a name like any other
        return ipaddress.ip_address(host).is_loopback
    return False


def run(url, name, components):
    """Serves the components until SIGTERM or SIGINT. --url and --name, or ROIS_URL and ROIS_NAME, replace the given ones.
    ROIS_TOKEN is the token that the gateway expects, if it expects one; ROIS_CA_FILE has certificates that it may have,
    ROIS_CERTIFICATE_FILE the certificate and the key that the program shows."""
    parser = argparse.ArgumentParser(description="Components of a RoIS engine.")
    parser.add_argument("--url", default=os.environ.get("ROIS_URL", url), help="the gateway to join")
    parser.add_argument("--name", default=os.environ.get("ROIS_NAME", name), help="the name by which the program joins")
    arguments = parser.parse_args()
    logging.basicConfig(level=logging.INFO, format="%(levelname)s %(message)s")

    token = os.environ.get("ROIS_TOKEN", "")
    if token and not is_safe(arguments.url):
        parser.error("ROIS_TOKEN is not sent to another machine without TLS: expected --url wss://...")

    async def until_signal():
        loop, task = asyncio.get_running_loop(), asyncio.current_task()

        def end(*_):
            for number in (signal.SIGTERM, signal.SIGINT):
                signal.signal(number, signal.SIG_IGN)  # a second one must not interrupt the halt
            loop.call_soon_threadsafe(task.cancel)

        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, end)
        await keep_joined(Service(arguments.name, components, token), arguments.url)

    with contextlib.suppress(asyncio.CancelledError):  # another exception ends the program with an exit code that is not 0
        asyncio.run(until_signal())
