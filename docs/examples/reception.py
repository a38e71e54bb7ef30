#!/usr/bin/env python3
"""The reception scenario of the specification (figure 1): wait for a person, go there, find out who it is, give this visitor their message
or ask, bow, say goodbye, return to the start. The history goes to standard output, one line a visitor.

    reception.py [VISITORS]     the number of visitors to receive, default 1; ROIS_URL: the gateway; ROIS_TOKEN: a token for it"""
import math, os, re, sys, time
from rois import Engine, NoAnswer, Refused

MESSAGES = {
    "tanaka": "Mr. Tanaka, your meeting is in room 3.", "suzuki": "Ms. Suzuki, your taxi is waiting at the entrance.",
    "somebody": "Welcome. How can I help you?",
}
met = set()  # temporary names and permanent ids of received visitors


def look():
    """Measures once. Returns person -> position."""
    engine.skip().run("person_localization")
    seen = engine.event("person_localized", 3)
    engine.run("person_localization", "stop")
    places = zip(seen["person_ref"], seen["position_data"]) if seen else ()
    return {person: [float(part) for part in place.split(",")] for person, place in places}


def go_before(x, y, th):
    """Goes to 1 m in front of a person, or beside that point if there is no way to it."""
    for side in (th, th + 60, th - 60, th + 120, th - 120):
        angle = math.radians(side)
        place = f"{x + 1000 * math.cos(angle):.0f}, {y + 1000 * math.sin(angle):.0f}, {side + 180:.0f}"
        if engine.run("navigation", target_position=["string[]", place], time_limit=["int", "90000"]) == "OK":
            return True
    return False


def approach():
    """Goes to the first new person who stands: two measurements a second apart give the same place, and so does a third."""
    def near(a, b, millimetres):
        return a is not None and b is not None and math.dist(a[:2], b[:2]) <= millimetres
    before = look()
    time.sleep(1)
    for person, pose in look().items():
        if person not in met and near(before.get(person), pose, 300):
            return person if go_before(*pose) and near(pose, look().get(person), 600) else None


def say(text):
    engine.run("speech_synthesis", speech_text=["string", text])


def ask(question):
    """Asks, and returns the answer, or None."""
    engine.skip().run("speech_recognition")
    say(question)
    recognized = engine.event("speech_recognized", 10)
    engine.run("speech_recognition", "stop")
    if recognized is not None:
        say("I shall tell my colleagues at the desk.")
    return recognized and recognized["recognized_text"][0]


def receive(visitors):
    for component in ("person_detection", "person_localization", "person_identification", "speech_recognition", "speech_synthesis",
                      "reaction", "navigation"):
        engine.bind(component)
    for event_type in ("person_detected", "person_localized", "person_identified", "speech_recognized"):
        engine.subscribe(event_type)
    start = engine.query("robot_position")["position_data"][0]
    received = 0
    while received < visitors:
        engine.run("navigation", target_position=["string[]", start])  # from there the robot sees the hall
        engine.skip().run("person_detection")
        engine.event("person_detected", 30, lambda results: int(results["number"][0]) > 0)
        engine.run("person_detection", "stop")
        if (person := approach()) is None:
            continue
        engine.skip().run("person_identification")
        visitor = (engine.event("person_identified", 8) or {}).get("person_ref", ["somebody"])[0]
        engine.run("person_identification", "stop")
        met.add(person)
        if visitor not in met:
            message = MESSAGES.get(visitor, "Welcome. There is no message for you today.")
            answer = ask(message) if visitor == "somebody" else say(message)
            met.update({visitor} - {"somebody"})
            engine.run("reaction", reaction_ref=["RoISIdentifier", "9"])
            say("Goodbye.")
            print(f'{visitor}: told "{message}"' + (f', heard "{answer}"' if answer else ""), flush=True)
            received += 1
    engine.run("navigation", target_position=["string[]", start])
    print(f"visitors received: {visitors}")


given = sys.argv[1] if len(sys.argv) > 1 else "1"
if not re.fullmatch("[1-9][0-9]{0,5}", given):
    sys.exit(f"reception.py: VISITORS is a whole number, 1 to 999999, not '{given}'")
try:
    with Engine(os.environ.get("ROIS_URL", "http://127.0.0.1:8080"), token=os.environ.get("ROIS_TOKEN")) as engine:
        receive(int(given))
except (NoAnswer, Refused, ValueError) as wrong:
    sys.exit(f"reception.py: {wrong}")
