"""Components of a RoIS engine in a program of your own: this file and Python 3.9 suffice (docs/component-programs.md; lamp.py).
The program joins the engine as a sub engine, and joins again whenever the link is lost."""
import argparse
import asyncio
import base64
import collections
import hashlib
import logging
import os
import signal
import struct
import time
import urllib.parse
import uuid
from xml.etree import ElementTree
from xml.sax.saxutils import escape, quoteattr

M, R = "{urn:x-rois:psm:xml:message:1}", "{http://www.omg.org/spec/RoIS/20240801}"
GML, XSI = "{http://www.opengis.net/gml/3.2}", "{http://www.w3.org/2001/XMLSchema-instance}"
NAMES = f'xmlns="{M[1:-1]}" xmlns:rois="{R[1:-1]}" xmlns:xsi="{XSI[1:-1]}"'
COMMON = "urn:x-rois:def:component:OMG::RoISCommon"

log = logging.getLogger("rois")
longest_pause = 30  # seconds between two attempts to join


class Refused(Exception):
    """A command cannot be performed with these arguments, or now. The application receives the reason."""


class Component:
    """A component. Override what it can do: a coroutine for each command, and a function for each query, by the names of its
    profile. Arguments and results are dictionaries of int, float, bool, str, or lists of them."""

    profile = ""  # the profile document, or the name of its file
    moves = False  # whether commands may move the component among people; if so, it is halted when no sign of life arrives within the motion lease
    continuous = False  # `start` begins a function that goes on until it is stopped; otherwise an action that ends by itself

    def __init__(self, ref):
        self.ref = ref
        self.status = "READY"  # or UNINITIALIZED, WARNING, ERROR
        self._service = None  # set by Service
        self._running = {}  # the tasks of the commands that run, by id
        self._active = False
        text = self.profile
        if not text.lstrip().startswith("<"):
            with open(text, encoding="utf-8") as file:
                text = file.read()
        self._profile = Profile(text)

    # --- What it can do ---

    def check(self, command, arguments):
        """Called before a command is accepted. Raise Refused with a reason to refuse it. Must not change anything."""

    async def start(self, arguments):
        """The function of the component. Returns when it has completed, with its results if there are any. It is cancelled by
        `stop`, and when the engine is lost."""

    async def halt(self):
        """Called when the component must stand still: after `start` was cancelled. It must not take longer than 0.5 s."""

    # --- What it reports ---

    def event(self, event_type, results=None):
        """Reports an event of the profile."""
        self._service.event(self, event_type, results or {})

    def error(self, text):
        """Reports COMPONENT_INTERNAL_ERROR."""
        self._service.error(self, text)

    def changed(self):
        """Reports a new `status`."""
        self._service.state(self)


class Profile:
    """A component profile document: the messages with the types of their parameters."""

    def __init__(self, text):
        root = ElementTree.fromstring(text)
        if root.tag != R + "HRIComponentProfile":
            raise ValueError(f"expected an HRIComponentProfile, not {root.tag}")
        self.urn = root.findtext(GML + "identifier")
        self.messages = {"command": {}, "query": {}, "event": {}}
        for common in [each for each in root.findall(R + "SubComponentProfile") if each.text.strip() == COMMON]:
            at = list(root).index(common)
            root.remove(common)
            for name in ("start", "stop", "suspend", "resume"):  # the engine expects all messages in the document
                root.insert(at, ElementTree.Element(R + "MessageProfile", {XSI + "type": "rois:CommandMessageProfileType", R + "name": name}))
        for prefix, name in (("rois", R), ("gml", GML), ("xsi", XSI)):
            ElementTree.register_namespace(prefix, name[1:-1])
        self.text = ElementTree.tostring(root, encoding="unicode")
        for message in root.findall(R + "MessageProfile"):
            kind = message.get(XSI + "type").split(":")[-1].replace("MessageProfileType", "").lower()
            parameters = {}
            for each in list(message.findall(R + "Arguments")) + list(message.findall(R + "Results")):
                data_type = each.find(R + "data_type_ref")
                parameters[each.get(R + "name")] = (each.tag == R + "Arguments", data_type.get(R + "code"), each.get(R + "default_value"))
            self.messages[kind][message.get(R + "name")] = parameters
        self.parameters = {each.get(R + "name"): each.find(R + "data_type_ref").get(R + "code") for each in root.findall(R + "ParameterProfile")}

    def types(self, kind, name, arguments):
        return {key: code for key, (is_argument, code, _) in self.messages[kind].get(name, {}).items() if is_argument == arguments}


def read_value(code, texts):
    """The Python value of a parameter with this data type."""
    kinds = {"int": int, "Integer": int, "float": float, "double": float, "Real": float, "bool": lambda text: text in ("true", "1"), "Boolean": lambda text: text in ("true", "1")}
    one = kinds.get(code.split("[")[0], str)
    values = [one(text) for text in texts]
    return values if code.endswith("[]") else values[0] if values else None


def texts_of(value):
    return [str(each).lower() if isinstance(each, bool) else str(each) for each in (value if isinstance(value, (list, tuple)) else [value])]


def parameter(element, name, code, value):
    values = "".join(f"<rois:value>{escape(text)}</rois:value>" for text in texts_of(value))
    return f'<{element} rois:name={quoteattr(name)}><rois:data_type_ref rois:code={quoteattr(code)}/>{values}</{element}>'


def results(types, values):
    """A `results` element. Raises ValueError for a result that the profile does not have."""
    for name in values:
        if name not in types:
            raise ValueError(f"the profile has no result {name!r}: expected {', '.join(types) or 'none'}")
    return "<results>" + "".join(parameter("result", name, types[name], value) for name, value in values.items()) + "</results>"


class WebSocket:
    """The client's side of a WebSocket (RFC 6455)."""

    def __init__(self, reader, writer):
        self.reader, self.writer, self.last_received = reader, writer, time.monotonic()

    @classmethod
    async def open(cls, url):
        parts = urllib.parse.urlsplit(url)
        secure = parts.scheme in ("wss", "https")
        port = parts.port or (443 if secure else 80)
        reader, writer = await asyncio.open_connection(parts.hostname, port, ssl=secure or None)
        key = base64.b64encode(os.urandom(16)).decode()
        writer.write(
            f"GET {parts.path.rstrip('/')}/rois/engines HTTP/1.1\r\nHost: {parts.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n\r\n".encode()
        )
        head = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1")
        status, _, fields = head.partition("\r\n")
        expected = base64.b64encode(hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()).decode()
        if " 101 " not in status + " " or f"sec-websocket-accept: {expected}".lower() not in fields.lower():
            writer.close()
            raise ConnectionError(f"no WebSocket: {status}")
        return cls(reader, writer)

    def send(self, payload, opcode=1):
        size, mask = len(payload), os.urandom(4)
        length = bytes([0x80 | size]) if size < 126 else struct.pack(">BH", 0xFE, size) if size < 65536 else struct.pack(">BQ", 0xFF, size)
        padded = mask * (size // 4 + 1)
        masked = (int.from_bytes(payload, "big") ^ int.from_bytes(padded[:size], "big")).to_bytes(size, "big")
        self.writer.write(bytes([0x80 | opcode]) + length + mask + masked)

    async def next(self):
        """The next text message. Raises ConnectionError at the end."""
        message = b""
        while True:
            first, second = await self.reader.readexactly(2)
            size = second & 0x7F
            if size > 125:
                size = int.from_bytes(await self.reader.readexactly(2 if size == 126 else 8), "big")
            if size > 16_000_000:
                raise ConnectionError(f"received a message of {size} bytes: expected at most 16000000")
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
    """Answers the engine's requests. The session survives a lost link for `window` seconds."""

    def __init__(self, name, components):
        self.name, self.instance = name, uuid.uuid4().hex
        self.components = {each.ref: each for each in components}
        self.socket = None
        self.session, self.subscribed = "", {}
        self.window, self.lease = 3.0, 0
        self.sequence = 0
        self.sent = collections.deque(maxlen=10_000)  # (sequence, document): kept for a link that returns
        self.performed = collections.OrderedDict()  # ids of accepted commands
        self.last_request = time.monotonic()
        for each in components:
            each._service = self

    # --- Notifications ---

    def notify(self, element, content, attributes=""):
        self.sequence += 1
        document = f'<{element} {NAMES} sequence="{self.sequence}"{attributes}>{content}</{element}>'
        self.sent.append((self.sequence, document))
        if self.socket:
            self.socket.send(document.encode())

    def event(self, component, event_type, values):
        types = component._profile.messages["event"].get(event_type)
        if types is None:
            raise ValueError(f"the profile has no event {event_type!r}")
        content = results({name: code for name, (_, code, _) in types.items()}, values)
        if event_type not in self.subscribed:
            return
        expire = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(time.time() + 60))
        self.notify(
            "receive_event",
            f"<event_id>{uuid.uuid4().hex}</event_id><event_type>{escape(event_type)}</event_type>"
            f"<subscribe_id>{self.subscribed[event_type]}</subscribe_id><expire>{expire}</expire>{self.ref(component)}{content}",
        )

    def error(self, component, text):
        if self.session:
            self.notify(
                "receive_error",
                f"<error_id>{uuid.uuid4().hex}</error_id><error_type>COMPONENT_INTERNAL_ERROR</error_type>{self.ref(component)}<text>{escape(text)}</text>",
            )

    def state(self, component):
        if self.session:
            self.notify("component_changed", f"{self.ref(component)}<status>{component.status}</status><results/>")

    def ref(self, component):
        return f"<component_ref rois:code={quoteattr(component.ref)}/>"

    # --- Requests ---

    async def serve(self, socket):
        """Answers until the link ends."""
        self.socket, self.is_attached = socket, False  # whether the session uses this link
        try:
            while True:
                request = ElementTree.fromstring(await socket.next())
                self.last_request = time.monotonic()
                name = request.tag.replace(M, "")
                answer = getattr(self, "on_" + name, None)
                if answer is None:
                    self.reply(name, request, "UNSUPPORTED", reason=f"a component program does not answer {name}")
                else:
                    await answer(request)
                await socket.writer.drain()
        finally:
            self.socket = None

    def reply(self, name, request, code="OK", content="", reason="", attributes=""):
        request_id = request.get("request_id")
        if request_id is not None:
            attributes += f" request_id={quoteattr(request_id)}"
        content = content if code == "OK" else f"<reason>{escape(reason)}</reason>"
        self.socket.send(f'<{name}_response {NAMES} return_code="{code}"{attributes}>{content}</{name}_response>'.encode())

    async def on_connect(self, request):
        is_new, self.is_attached = not self.is_attached, True
        if is_new:
            await self.end_session()  # of an engine that has restarted
            self.session = uuid.uuid4().hex
            self.sequence = 0
            self.sent.clear()
            self.window = int(request.get("window", 3_000)) / 1_000
            self.lease = int(request.get("motion_lease", 0)) / 1_000
        attributes = f' window="{round(self.window * 1_000)}"'
        self.reply("connect", request, content=f"<session>{self.session}</session>", attributes=attributes)
        for component in self.components.values() if is_new else ():
            self.state(component)

    async def on_resume(self, request):
        if request.get("session") != self.session or not self.session:
            id = quoteattr(request.get("request_id", ""))
            return self.socket.send(f'<fault {NAMES} code="no_session" request_id={id}><reason>unknown session</reason></fault>'.encode())
        self.is_attached = True
        self.reply("resume", request)
        for sequence, document in self.sent:
            if sequence > int(request.get("last_sequence")):
                self.socket.send(document.encode())

    async def on_disconnect(self, request):
        await self.end_session()
        self.reply("disconnect", request)

    async def on_get_profile(self, request):
        names = "".join(f"<rois:HRIComponent>{escape(ref)}</rois:HRIComponent>" for ref in self.components)
        engine = (
            f'<rois:HRIEngineProfile xmlns:gml="{GML[1:-1]}" gml:id="engine.{uuid.uuid5(uuid.NAMESPACE_URL, self.name).hex}">'
            f'<gml:identifier codeSpace="urn:ietf:rfc:2141">urn:x-rois:def:HRIEngine:program::{escape(self.name)}</gml:identifier>'
            f"<gml:name>{escape(self.name)}</gml:name>{names}"
            f'<rois:ParameterProfile rois:name="instance" rois:default_value="{self.instance}"><rois:data_type_ref rois:code="string"/></rois:ParameterProfile>'
            "</rois:HRIEngineProfile>"
        )
        entries = "".join(
            f"<component ref={quoteattr(ref)} type={quoteattr(each._profile.urn)} engine={quoteattr(self.name)} "
            f'moves="{"true" if each.moves else "false"}" when_stopped="ABORT"/>'
            for ref, each in self.components.items()
        )
        profiles = "".join(each._profile.text for each in self.components.values())
        self.reply("get_profile", request, content=f"{engine}<components>{entries}</components>{profiles}")

    def component(self, element):
        return self.components.get(element.get(R + "code")) if element is not None else None

    async def on_bind(self, request):
        component = self.component(request.find(M + "component_ref"))
        if component is None:
            return self.reply("bind", request, "BAD_PARAMETER", reason="there is no such component")
        self.reply("bind", request)

    async def on_release(self, request):
        component = self.component(request.find(M + "component_ref"))
        if component is not None:
            await self.halt(component)
        self.reply("release", request)

    async def on_subscribe(self, request):
        event_type = request.findtext(M + "event_type")
        self.subscribed[event_type] = uuid.uuid4().hex
        self.reply("subscribe", request, content=f"<subscribe_id>{self.subscribed[event_type]}</subscribe_id>")

    async def on_query(self, request):
        name = request.findtext(M + "query_type")
        literal = next((each.text for each in request.iter() if each.tag.endswith("}Literal")), None)
        component = self.components.get(literal)
        function = getattr(component, name, None) if component and name in component._profile.messages["query"] else None
        if function is None:
            return self.reply("query", request, "UNSUPPORTED", reason=f"no component answers the query {name!r}")
        try:
            content = results(component._profile.types("query", name, False), function())
        except Exception as problem:
            return self.reply("query", request, "ERROR", reason=f"the component could not answer: {problem}")
        self.reply("query", request, content=self.ref(component) + content)

    async def on_get_command_result(self, request):
        known = (command := request.findtext(M + "command_id")) in self.performed
        self.reply("get_command_result", request, "OK" if known else "BAD_PARAMETER", "<results/>", f"there is no command {command!r}")

    async def on_execute(self, request):
        sequence = request.find(R + "CommandUnitSequence")
        unit = sequence.find(R + "command_unit_list")
        component = self.component(unit.find(R + "component_ref"))
        command, id = unit.get(R + "command_type"), unit.get(R + "command_id")
        if component is None:
            return self.reply("execute", request, "BAD_PARAMETER", reason="there is no such component")
        try:
            arguments = self.arguments(component, command, unit)
            component.check(command, arguments)
        except Refused as refused:
            return self.reply("execute", request, "BAD_PARAMETER", reason=str(refused))
        accepted = ElementTree.tostring(sequence, encoding="unicode")
        if request.get("check_only") in ("true", "1"):
            return self.reply("execute", request, content=accepted)
        self.performed[id] = True
        if len(self.performed) > 1_000:
            self.performed.popitem(last=False)
        self.reply("execute", request, content=accepted)
        if command == "stop":
            await self.halt(component)
            return self.completed(component, id, "OK")
        component._running[id] = asyncio.ensure_future(self.perform(component, id, command, arguments))

    def arguments(self, component, command, unit):
        """The arguments of a command. Raises Refused for a wrong one."""
        profile = component._profile
        types = profile.messages["command"].get(command)
        if types is None:
            raise Refused(f"the component has no command {command!r}")
        if command not in ("stop", "set_parameter") and not hasattr(component, command):
            raise Refused(f"the component does not implement {command!r}")
        codes = {**profile.parameters, **{name: code for name, (is_argument, code, _) in types.items() if is_argument}}
        values = {}
        for each in unit.findall(f"{R}arguments/{R}parameter"):
            name = each.get(R + "name")
            if name not in codes:
                raise Refused(f"the command {command!r} has no argument {name!r}")
            texts = [(value.text or "").strip() for value in each.findall(R + "value")]
            try:
                values[name] = read_value(codes[name], texts)
            except ValueError:
                raise Refused(f"the argument {name!r} must be of type {codes[name]}, not {', '.join(map(repr, texts))}")
        return values

    async def perform(self, component, id, command, arguments):
        function = getattr(component, command, None)
        try:
            values = await function(arguments) if function else {}
            if command == "start":
                component._active = component.continuous
            self.completed(component, id, "OK", values or {}, command)
        except asyncio.CancelledError:
            self.completed(component, id, "ABORT", reason="it was stopped")
        except Exception as problem:
            log.exception("%s: %s failed", component.ref, command)
            self.completed(component, id, "ERROR", reason=f"{type(problem).__name__}: {problem}")
        finally:
            component._running.pop(id, None)

    def completed(self, component, id, status, values=None, command="", reason=""):
        types = component._profile.types("command", command, False) if command else {}
        try:
            content = results(types, values or {})
        except ValueError as problem:
            status, content, reason = "ERROR", "<results/>", str(problem)
        why = f"<reason>{escape(reason)}</reason>" if reason else ""
        active = ' active="true"' if component._active else ' active="false"'
        if self.session:
            self.notify("completed", f"<command_id>{escape(id)}</command_id><status>{status}</status>{content}{why}", active)

    async def halt(self, component):
        """Ends what the component does, and waits for it."""
        running = list(component._running.values())
        for task in running:
            task.cancel()
        await asyncio.gather(*running, return_exceptions=True)
        await component.halt()
        component._active = False

    async def end_session(self):
        self.session = ""
        self.subscribed.clear()
        for component in self.components.values():
            if component._running or component._active:
                await self.halt(component)

    async def watch(self):
        """Ends the session when its link is lost for longer than the window, and holds what moves without signs of life."""
        while True:
            await asyncio.sleep(0.1)
            silence = time.monotonic() - self.last_request
            last_sign = self.socket.last_received if self.socket else self.last_request
            if self.session and time.monotonic() - last_sign > 2 + self.window:
                log.warning("the engine is lost: everything is halted")
                await self.end_session()
            if self.lease and silence > self.lease:
                for component in self.components.values():
                    if component.moves and (component._running or component._active):
                        log.warning("%s is halted: no sign of life from the engine", component.ref)
                        await self.halt(component)


async def join(service, url):
    """Joins, and answers until the link ends."""
    socket = await WebSocket.open(url)
    try:
        socket.send(f"<join {NAMES} name={quoteattr(service.name)} instance={quoteattr(service.instance)}/>".encode())
        response = ElementTree.fromstring(await asyncio.wait_for(socket.next(), 5))
        if response.get("return_code") != "OK":
            raise ConnectionError(f"refused: {response.findtext(M + 'reason')}")
        log.info("joined %s as %s", url, service.name)
        await service.serve(socket)
    finally:
        socket.writer.close()


async def keep_joined(service, url):
    pause, said = 0.1, ""
    watch = asyncio.ensure_future(service.watch())
    try:
        while True:
            begun = time.monotonic()
            try:
                await join(service, url)
            except (OSError, ConnectionError, asyncio.IncompleteReadError, asyncio.TimeoutError, ElementTree.ParseError) as problem:
                if str(problem) != said:
                    log.warning("%s: %s", url, problem or "the link broke")
                said = str(problem)
            pause = 0.1 if time.monotonic() - begun > 5 else min(2 * pause, longest_pause)
            await asyncio.sleep(pause)
    finally:
        watch.cancel()
        await service.end_session()


def run(url, name, components):
    """Serves the components until SIGTERM or SIGINT. --url and --name, or ROIS_URL and ROIS_NAME, replace the given ones."""
    parser = argparse.ArgumentParser(description="Components of a RoIS engine.")
    parser.add_argument("--url", default=os.environ.get("ROIS_URL", url), help="the gateway to join")
    parser.add_argument("--name", default=os.environ.get("ROIS_NAME", name), help="the name by which the program joins")
    arguments = parser.parse_args()
    logging.basicConfig(level=logging.INFO, format="%(levelname)s %(message)s")
    service = Service(arguments.name, components)

    async def until_signal():
        task = asyncio.ensure_future(keep_joined(service, arguments.url))
        for number in (signal.SIGTERM, signal.SIGINT):
            asyncio.get_running_loop().add_signal_handler(number, task.cancel)
        await asyncio.wait([task])

    asyncio.run(until_signal())
