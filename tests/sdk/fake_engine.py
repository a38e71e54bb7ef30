"""An engine that a test plays: it accepts a component program, asks it, and collects what it reports."""
import asyncio
import base64
import hashlib
import itertools
import pathlib
import sys
from xml.etree import ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "components" / "sdk" / "python"))
import rois_component as rois  # noqa: E402

patience = 5  # seconds, for what must happen


class Link:
    """The engine's end of a link."""

    def __init__(self, reader, writer):
        self.reader, self.writer = reader, writer
        self.numbers = itertools.count(1)
        self.waiting = {}  # request_id -> future of the answer
        self.answered = []  # the request_ids, in the order of the answers
        self.reports = []  # notifications
        self.pongs = 0

    async def open(self):
        await self.accept_join()
        self.reading = asyncio.ensure_future(self.read())

    async def accept_join(self):
        head = (await self.reader.readuntil(b"\r\n\r\n")).decode()
        key = next(line.split(": ")[1] for line in head.split("\r\n") if line.startswith("Sec-WebSocket-Key"))
        accept = base64.b64encode(hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()).decode()
        self.writer.write(
            "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Accept: {accept}\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n\r\n".encode()
        )
        await self.message()  # join
        self.send(f'<join_response {rois.NAMES} return_code="OK" window="200"/>'.encode())

    async def message(self):
        first, second = await self.reader.readexactly(2)
        size = second & 0x7F
        if size > 125:
            size = int.from_bytes(await self.reader.readexactly(2 if size == 126 else 8), "big")
        mask = await self.reader.readexactly(4)
        payload = bytes(byte ^ mask[i % 4] for i, byte in enumerate(await self.reader.readexactly(size)))
        self.pongs += first & 0x0F == 10
        if first & 0x0F == 9:
            self.send(payload, 10)
        return ElementTree.fromstring(payload) if first & 0x0F == 1 else None

    async def read(self):
        try:
            while True:
                document = await self.message()
                if document is None:
                    continue
                if document.get("request_id") is None:
                    self.reports.append(document)
                    continue
                self.answered.append(document.get("request_id"))
                self.waiting.pop(document.get("request_id")).set_result(document)
        except (asyncio.IncompleteReadError, OSError):
            pass

    def send(self, payload, opcode=1, is_end=True):
        size = len(payload)
        self.writer.write(bytes([0x80 * is_end | opcode]) + (bytes([size]) if size < 126 else b"\x7e" + size.to_bytes(2, "big")) + payload)

    def request(self, name, content="", attributes=""):
        """Sends a request. Returns the future of its answer."""
        number = str(next(self.numbers))
        self.waiting[number] = asyncio.get_running_loop().create_future()
        answer = self.waiting[number]
        self.send(f'<{name} {rois.NAMES} request_id="{number}" {attributes}>{content}</{name}>'.encode())
        return answer

    async def ask(self, name, content="", attributes=""):
        return await asyncio.wait_for(self.request(name, content, attributes), patience)

    async def connect(self, window=200, lease=0):
        answer = await self.ask("connect", attributes=f'window="{window}" motion_lease="{lease}"')
        return answer.findtext(rois.M + "session")

    def execute(self, ref, command, id="", check_only=False, **arguments):
        """The future of the answer. An argument is a pair of its type and its text."""
        values = "".join(
            f'<rois:parameter rois:name="{name}"><rois:data_type_ref rois:code="{code}"/><rois:value>{text}</rois:value></rois:parameter>'
            for name, (code, text) in arguments.items()
        )
        given = f"<rois:arguments>{values}</rois:arguments>" if values else ""
        return self.request(
            "execute",
            f'<rois:CommandUnitSequence><rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="{command}" '
            f'rois:command_id="{id or command}"><rois:component_ref rois:code="{ref}"/>{given}'
            "</rois:command_unit_list></rois:CommandUnitSequence>",
            'check_only="true"' if check_only else "",
        )

    def query(self, ref, name):
        return self.request("query", f"<query_type>{name}</query_type><condition><f:Literal xmlns:f='f'>{ref}</f:Literal></condition>")

    def bind(self, ref):
        return self.request("bind", f'<component_ref rois:code="{ref}"/>')

    def release(self, ref):
        return self.request("release", f'<component_ref rois:code="{ref}"/>')

    def subscribe(self, event_type):
        return self.request("subscribe", f"<event_type>{event_type}</event_type>", 'inline_results="true"')

    async def report(self, name, **texts):
        """Waits for a notification with these texts of its elements."""
        for _ in range(patience * 100):
            for each in self.reports:
                if each.tag == rois.M + name and all(each.findtext(rois.M + key) == text for key, text in texts.items()):
                    return each
            await asyncio.sleep(0.01)
        raise AssertionError(f"no {name} with {texts}, but {[ElementTree.tostring(each) for each in self.reports]}")

    def values(self, event_type):
        """The values of all events of this type."""
        events = [each for each in self.reports if each.findtext(rois.M + "event_type") == event_type]
        return [value.text for each in events for value in each.iter(rois.R + "value")]

    def cut(self):
        self.writer.transport.abort()


class Engine:
    """Accepts links on a free port."""

    async def open(self):
        self.links, self.writers = asyncio.Queue(), []
        self.server = await asyncio.start_server(self.accept, "127.0.0.1", 0)
        self.url = "ws://127.0.0.1:%d" % self.server.sockets[0].getsockname()[1]
        return self

    def accept(self, reader, writer):
        self.writers.append(writer)
        self.links.put_nowait((reader, writer))

    def close(self):
        self.server.close()
        for writer in self.writers:
            writer.transport.abort()

    async def link(self):
        """The next link, on which the program has joined."""
        link = Link(*await asyncio.wait_for(self.links.get(), patience))
        await link.open()
        return link
