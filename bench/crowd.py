"""Many sub engines in one process, for the part `crowd` of ./dev bench: `crowd.py URL COMPONENTS NAME...`. Each line of standard
input is a new number of events a second, of all engines together; `reconnect` lets the engine join 100 times a second."""

import asyncio
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "components" / "sdk" / "python"))
import lamp  # noqa: E402
import rois_component as rois  # noqa: E402


class Crowd:
    def __init__(self, names, components):
        self.services = [rois.Service(name, [lamp.Lamp(f"lamp{i}") for i in range(components)]) for name in names]
        self.rate = 0
        self.reconnects = False

    async def join(self, url):
        await asyncio.gather(self.report(), *(rois.keep_joined(service, url) for service in self.services))

    async def report(self):
        """Events at this rate, in portions of 10 ms."""
        loop, due, turn = asyncio.get_running_loop(), 0.0, 0
        loop.add_reader(sys.stdin, self.read_line)
        while True:
            if self.reconnects and self.services[0].socket:
                self.services[0].socket.writer.transport.abort()
            begun = loop.time()
            await asyncio.sleep(0.01)
            due += self.rate * (loop.time() - begun)
            while due >= 1:
                due -= 1
                turn += 1
                service = self.services[turn % len(self.services)]
                next(iter(service.components.values())).event("switched", {"is_on": True})

    def read_line(self):
        line = sys.stdin.readline().strip()
        if not line:
            sys.exit()
        self.reconnects = line == "reconnect"
        self.rate = 0 if self.reconnects else float(line)


if __name__ == "__main__":
    if "reconnects" in sys.argv:
        rois.LONGEST_PAUSE = rois.PAUSE_IN_WINDOW = 0.01
    asyncio.run(Crowd(sys.argv[3:], int(sys.argv[2])).join(sys.argv[1]))
