"""The link between a gateway and a component program breaks after each of its bytes, in both directions: while the program joins and
its session is resumed, and while its session is restored. Then the link returns, and each command has ended once."""
import asyncio
import collections
import contextlib
import contextvars
import http.client
import json
import logging
import os
import pathlib
import subprocess
import tempfile
import threading
import unittest
from xml.etree import ElementTree

from fake_engine import patience, rois

WHOLE = 10**9  # bytes
MOST_LINKS = 1_500
AT_ONCE = 8  # links

bytes_of_next_link = contextvars.ContextVar("bytes_of_next_link")


class Pump(rois.Component):
    profile = (
        f'<rois:HRIComponentProfile xmlns:rois="{rois.R[1:-1]}" xmlns:gml="{rois.GML[1:-1]}" gml:id="pump">'
        "<gml:identifier>urn:x-example:def:component:Pump</gml:identifier><gml:name>pump</gml:name>"
        "<rois:SubComponentProfile>urn:x-rois:def:component:OMG::RoISCommon</rois:SubComponentProfile>"
        "</rois:HRIComponentProfile>"
    )

    def __init__(self, ref):
        super().__init__(ref)
        self.begun, self.done = asyncio.Event(), asyncio.Event()

    async def start(self, arguments):
        self.begun.set()
        await self.done.wait()


class Cut:
    """A link's reader and writer. Only its first `left` bytes pass, of both directions together."""

    def __init__(self, link, left):
        self.reader, self.writer, self.left = link.reader, link.writer, left
        link.reader = link.writer = self
        self.transport = self.writer.transport

    def passing(self, data):
        part = data[: self.left]
        self.left -= len(part)
        if self.left == 0:
            self.writer.close()
        return part

    def write(self, data):
        if part := self.passing(data):
            self.writer.write(part)

    async def readexactly(self, size):
        data = await self.reader.readexactly(size)
        if self.passing(data) != data:
            raise ConnectionError("cut")
        return data

    def close(self):
        self.writer.close()


open_whole = rois.WebSocket.open


async def open_cut(url, token=""):
    link = await open_whole(url, token)
    Cut(link, bytes_of_next_link.get())
    return link


class Gateway:
    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        # They leave soon, so that few are present at a time.
        engines = [{"name": f"e{number}", "joins": f"e{number}", "resume_window": 3} for number in range(MOST_LINKS)]
        pathlib.Path(self.folder.name, "engines.json").write_text(json.dumps({"engines": engines}))
        program = pathlib.Path(os.environ["ROIS_BINARY_DIR"], "bin", "rois-gateway")
        arguments = [
            "--listen",
            "127.0.0.1:0",
            "--robots",
            "none",
            "--media",
            "",
            "--engines",
            f"{self.folder.name}/engines.json",
        ]
        self.process = subprocess.Popen([program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.port = int(next(line for line in self.process.stdout if "listening on" in line).rsplit(":", 1)[1])
        threading.Thread(target=self.process.stdout.read, daemon=True).start()

    def end(self):
        self.process.terminate()
        self.process.wait()
        self.folder.cleanup()


class Desk:
    """An application, over HTTP. `ended`: the ends of its commands, by their ids."""

    def __init__(self, port):
        self.port, self.session, self.read = port, "", 0
        self.ended = collections.defaultdict(list)
        self.session = self.post("<connect {0}/>").findtext(rois.M + "session")

    def exchange(self, *request):
        with contextlib.closing(http.client.HTTPConnection("127.0.0.1", self.port, timeout=patience)) as link:
            link.request(*request, {"Content-Type": "application/xml", "RoIS-Session": self.session})
            return ElementTree.fromstring(link.getresponse().read())

    def post(self, document):
        return self.exchange("POST", "/rois", document.format(rois.NAMES))

    def bind(self, ref):
        return self.post(f'<bind {{0}}><component_ref rois:code="{ref}"/></bind>').get("return_code")

    def start(self, ref, id):
        unit = f'<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id="{id}">'
        unit += f'<rois:component_ref rois:code="{ref}"/></rois:command_unit_list>'
        sequence = f"<rois:CommandUnitSequence>{unit}</rois:CommandUnitSequence>"
        return self.post(f"<execute {{0}}>{sequence}</execute>").get("return_code")

    def poll(self):
        for each in self.exchange("GET", f"/rois/notifications?after={self.read}&wait=1", None):
            self.read = int(each.get("sequence"))
            if each.tag == rois.M + "completed":
                self.ended[each.findtext(rois.M + "command_id")].append(each.findtext(rois.M + "status"))


class BoundService(rois.Service):
    def __init__(self, name, components):
        super().__init__(name, components)
        self.bound = asyncio.Event()

    async def on_bind(self, request):
        await super().on_bind(request)
        self.bound.set()


class Program:
    """A component program of its own, with its commands."""

    def __init__(self, case, number):
        self.case, self.name, self.commands = case, f"e{number}", 0
        self.url = f"ws://127.0.0.1:{case.gateway.port}"
        self.pump = Pump("pump")
        self.service = BoundService(self.name, [self.pump])

    async def join(self, left=WHOLE):
        """Joins by a link on which `left` bytes pass. Returns when the session goes on, or the link has ended."""
        bytes_of_next_link.set(left)
        self.link = asyncio.ensure_future(rois.join(self.service, self.url))
        while not self.link.done() and not self.service.is_attached:
            await asyncio.wait([self.link], timeout=0.001)
        if left < WHOLE:
            await asyncio.wait([self.link], timeout=patience)
        self.case.assertEqual(self.link.done(), left < WHOLE, self.link)

    async def bytes_until_bound(self):
        """Of the present link."""
        await asyncio.wait_for(self.service.bound.wait(), patience)
        return self.bytes_so_far()

    async def lose_link(self):
        self.service.bound.clear()
        self.service.socket.writer.transport.abort()
        await asyncio.wait([self.link])

    def bytes_so_far(self):
        return WHOLE - self.service.socket.writer.left

    async def until_ok(self, ask, *arguments):
        for _ in range(patience * 100):
            if await asyncio.to_thread(ask, f"{self.name}.pump", *arguments) == "OK":
                return
            await asyncio.sleep(0.01)
        self.case.fail("the gateway did not answer with OK")

    async def begin(self):
        """Joins, and begins a command."""
        await self.join()
        await self.until_ok(self.case.desk.bind)
        await self.start()

    async def start(self):
        self.pump.begun.clear()
        self.pump.done.clear()
        self.commands += 1
        await self.until_ok(self.case.desk.start, f"{self.name} {self.commands}")
        await asyncio.wait_for(self.pump.begun.wait(), patience)

    async def expect_end(self, status):
        ends = self.case.desk.ended[f"{self.name} {self.commands}"]
        for _ in range(patience * 100):
            if ends:
                break
            await asyncio.sleep(0.01)
        self.case.assertEqual(ends, [status])


class Cuts(unittest.IsolatedAsyncioTestCase):
    async def asyncSetUp(self):
        logging.disable(logging.CRITICAL)
        asyncio.get_running_loop().set_debug(False)  # it is slow
        rois.WebSocket.open = open_cut
        self.addCleanup(setattr, rois.WebSocket, "open", open_whole)
        self.gateway = Gateway()
        self.addCleanup(self.gateway.end)
        self.desk = Desk(self.gateway.port)
        self.polling = asyncio.ensure_future(self.poll())

    async def asyncTearDown(self):
        self.polling.cancel()
        await asyncio.wait([self.polling])

    async def poll(self):
        while True:
            await asyncio.to_thread(self.desk.poll)

    async def cut_at_each_byte(self, play, step=1):
        """Calls `play` with a program and the number of bytes that pass: first all of them, then each smaller number, or those
        that lie `step` apart."""

        async def play_with(number, left):
            program = Program(self, number)
            size = await play(program, left)
            await program.lose_link()
            return size

        size = await play_with(0, WHOLE)
        self.assertLess(size // step, MOST_LINKS - 1)
        lanes = asyncio.Semaphore(AT_ONCE)

        async def play_one(number, left):
            async with lanes:
                await play_with(number, left)

        plays = [play_one(number, left) for number, left in enumerate(range(1, size, step), 1)]
        for played in asyncio.as_completed(plays):
            await played
        self.assertEqual({len(each) for each in self.desk.ended.values()}, {1})

    async def test_a_session_that_is_resumed(self):
        async def play(program, left):
            await program.begin()
            await program.lose_link()
            program.pump.done.set()  # the program reports it on the next link
            await program.join(left)
            if left < WHOLE:
                await program.join()
            await program.expect_end("OK")
            return program.bytes_so_far()

        await self.cut_at_each_byte(play)

    # These are more bytes than there are engines.
    async def test_a_session_that_is_restored(self):
        async def play(program, left):
            await program.begin()
            await program.lose_link()
            await program.service.end_session()  # the gateway tries to resume it, and opens another one on the same link
            await program.join(left)
            if left < WHOLE:
                await program.join()
            size = await program.bytes_until_bound() if left == WHOLE else left
            await program.expect_end("ABORT")
            await program.start()
            program.pump.done.set()
            await program.expect_end("OK")
            return size

        await self.cut_at_each_byte(play, step=3)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
