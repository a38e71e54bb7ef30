"""500 commands, each with 20 events, through docs/examples/rois.py, while somebody else cuts the link to ROIS_URL. What came of it goes to
standard output as JSON; web/client/tests/python.test.ts judges it."""
import collections
import json
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples"))
from rois import Engine, M, results_of  # noqa: E402

COMMANDS, EVENTS_EACH = 500, 20


class Recorder(Engine):
    """Remembers every notification that is looked at."""

    def __init__(self, url):
        self.events, self.completed = [], collections.Counter()
        super().__init__(url)

    def next(self, wanted, seconds):
        def seen(one):
            if one.tag == M + "receive_event":
                self.events.append(int(results_of(one)["target"][0].rsplit(" ", 1)[1].removesuffix("e-9")))
            if one.tag == M + "completed":
                self.completed[one.findtext(M + "command_id")] += 1
            return wanted(one)

        return super().next(seen, seconds)


engine = Recorder(os.environ["ROIS_URL"])
engine.bind("navigation")
engine.subscribe("reached_target")
statuses = collections.Counter()
for sent in range(COMMANDS):
    places = [f"4000, 5000, {sent * EVENTS_EACH + i}e-9" for i in range(EVENTS_EACH)]
    statuses[engine.run("navigation", target_position=["string[]", *places])] += 1
engine.request("disconnect")
json.dump({"statuses": statuses, "in_order": engine.events == list(range(COMMANDS * EVENTS_EACH)), "events": len(engine.events),
           "completed": len(engine.completed), "completed_twice": [name for name, times in engine.completed.items() if times > 1],
           "lost": engine.lost}, sys.stdout)
