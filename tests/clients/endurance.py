"""Runs 500 commands, each with 20 events, through docs/examples/rois.py, while the caller cuts the link to ROIS_URL. Prints the outcome as
JSON; web/client/tests/gateway/python.test.ts checks it."""
import collections
import json
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples"))
from rois import Engine, M  # noqa: E402

COMMANDS, EVENTS_EACH = 500, 20


class Counter(Engine):
    """Counts how often each command has completed."""

    def __init__(self, url):
        self.completed = collections.Counter()
        super().__init__(url)

    def next(self, wanted, seconds):
        one = super().next(wanted, seconds)
        if one is not None and one.tag == M + "completed":
            self.completed[one.findtext(M + "command_id")] += 1
        return one


def number_of(results):
    return int(results["target"][0].rsplit(" ", 1)[1].removesuffix("e-9"))


engine = Counter(os.environ["ROIS_URL"])
engine.bind("navigation")
engine.subscribe("reached_target")
statuses, events = collections.Counter(), []
for sent in range(COMMANDS):
    places = [f"4000, 5000, {sent * EVENTS_EACH + i}e-9" for i in range(EVENTS_EACH)]
    statuses[engine.run("navigation", target_position=["string[]", *places])] += 1
    while (results := engine.event("reached_target", 0)) is not None:  # they arrived before `completed`
        events.append(number_of(results))
engine.request("disconnect")
engine.completed.update(one.findtext(M + "command_id") for one in engine.kept)  # those that `run` did not wait for
json.dump({"statuses": statuses, "in_order": events == list(range(COMMANDS * EVENTS_EACH)), "events": len(events),
           "completed": len(engine.completed), "completed_twice": [name for name, times in engine.completed.items() if times > 1],
           "lost": engine.lost + engine.dropped}, sys.stdout)
