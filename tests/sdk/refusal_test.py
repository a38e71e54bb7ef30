"""What joins an engine that ends each link at once, as one does that refuses the profile, tries less and less often."""
import asyncio
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

from fake_engine import Link, patience, rois

BIN = pathlib.Path(os.environ["ROIS_BINARY_DIR"], "bin")
LAMP = pathlib.Path(__file__).resolve().parents[2] / "components" / "sdk" / "python" / "lamp.py"


class Refusals(unittest.IsolatedAsyncioTestCase):
    async def expect_rare_joins(self, *command):
        times = []
        enough = asyncio.Event()

        async def refuse(reader, writer):
            link = Link(reader, writer)
            await link.accept_join()
            times.append(time.monotonic())
            writer.close()
            if len(times) == 6:
                enough.set()

        server = await asyncio.start_server(refuse, "127.0.0.1", 0)
        url = f"ws://127.0.0.1:{server.sockets[0].getsockname()[1]}"
        with tempfile.TemporaryFile() as log:
            program = subprocess.Popen([str(part).replace("URL", url) for part in command], stdout=log, stderr=log)
            try:
                await asyncio.wait_for(enough.wait(), 4 * patience)
            finally:
                program.terminate()
                await asyncio.to_thread(program.wait)
                server.close()
        self.assertGreater(times[5] - times[4], 1)

    async def test_a_gateway(self):
        await self.expect_rare_joins(
            BIN / "rois-gateway", "--listen", "127.0.0.1:0", "--media", "", "--join", "URL", "--join-as", "robot"
        )

    async def test_a_program_in_cpp(self):
        await self.expect_rare_joins(BIN / "rois-lamp", "--url", "URL")

    async def test_a_program_in_python(self):
        await self.expect_rare_joins(sys.executable, "-B", LAMP, "--url", "URL")


if __name__ == "__main__":
    unittest.main(warnings="ignore")
