"""Component programs in both languages keep the events that occur without a session for the next subscription."""
import asyncio
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from fake_engine import Engine, patience

BIN = pathlib.Path(os.environ["ROIS_BINARY_DIR"], "bin")
LAMP = pathlib.Path(__file__).resolve().parents[2] / "components" / "sdk" / "python" / "lamp.py"
WINDOW = 1  # seconds


async def switched(link, *values):
    for _ in range(patience * 100):
        if link.values("switched") == list(values):
            return
        await asyncio.sleep(0.01)
    raise AssertionError(f"expected the events {values}, got {link.values('switched')}")


class Unsent(unittest.IsolatedAsyncioTestCase):
    async def connect(self):
        """A link on which the program has joined, with a new session."""
        link = await self.engine.link()
        attributes = f'role="engine" window="{WINDOW}000" motion_lease="1000" motion_proof="request"'
        answer = await link.ask("connect", attributes=attributes)
        self.assertEqual(answer.get("return_code"), "OK")
        return link

    async def expect_the_end_of_the_session_as_an_event(self, *command):
        self.engine = await Engine().open()
        with tempfile.TemporaryFile() as log:
            program = subprocess.Popen([*command, "--url", self.engine.url], stdout=log, stderr=log)
            try:
                link = await self.connect()
                await link.bind("lamp")
                await link.subscribe("switched")
                await link.execute("lamp", "start")
                await switched(link, "true")
                link.cut()
                await asyncio.sleep(WINDOW + 1)  # the session ends: the lamp goes out
                link = await self.connect()
                await link.subscribe("switched")
                await switched(link, "false")
                await link.bind("lamp")
                await link.execute("lamp", "start")
                await switched(link, "false", "true")
            finally:
                program.terminate()
                await asyncio.to_thread(program.wait)
                self.engine.close()

    async def test_in_python(self):
        await self.expect_the_end_of_the_session_as_an_event(sys.executable, "-B", LAMP)

    async def test_in_cpp(self):
        await self.expect_the_end_of_the_session_as_an_event(BIN / "rois-lamp")


if __name__ == "__main__":
    unittest.main(warnings="ignore")
