"""A client of a RoIS gateway over HTTP, with Python's standard library alone; docs/clients.md says how one is written."""
import http.client
import itertools
import math
import sys
import time
import urllib.error
import urllib.request
from xml.etree import ElementTree
from xml.sax.saxutils import escape

M, R = "{urn:x-rois:psm:xml:message:1}", "{http://www.omg.org/spec/RoIS/20240801}"
NAMES = f'xmlns="{M[1:-1]}" xmlns:rois="{R[1:-1]}" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'


class Refused(Exception):
    """The engine answered with another return code than OK, or with a fault."""


class NoAnswer(Exception):
    """The gateway did not answer within the deadline. Whether it did what it was asked is not known."""


class Status(str):
    """How a command ended: OK, ERROR, ABORT, OUT_OF_RESOURCES or TIMEOUT. If it is not OK, `reason` says why, as the engine does."""

    reason = ""


class Engine:
    """A session. What gets lost on the way is asked for again, for as long as `deadline` seconds; commands have names, so that none
    is executed twice.

    A robot that moves for this session is held when nothing was heard from this program for `motion_lease` seconds: from 1 to what
    the gateway has (None), which is 10 unless it was told otherwise. While `run` waits it asks once a second, which is sign enough."""

    most_kept = 1000  # notifications that nobody wanted until now; the oldest make room

    longest_poll = 1  # seconds: a poll that waits counts as a sign of life, also when this program has been stopped

    def __init__(self, url, deadline=10, motion_lease=None):
        self.url, self.deadline = url.rstrip("/"), deadline
        self.session = ""
        self.after = 0  # the sequence of the last notification that came
        self.lost = 0  # how many the engine has dropped
        self.dropped = 0  # how many made room here
        self.news = []  # notifications that came and were not looked at
        self.kept = []  # those that were looked at, and not wanted yet
        self.names = (f"step-{n}" for n in itertools.count(1))
        lease = f'motion_lease_http="{round(motion_lease * 1000)}"' if motion_lease else ""
        self.session = self.request("connect", attributes=lease).findtext(M + "session")

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        """Ends the session, and what the robot does for it; also when something went wrong, unless that was that nobody answers."""
        if kind is NoAnswer:
            return
        try:
            self.request("disconnect")
        except (Refused, NoAnswer):
            if kind is None:
                raise

    def request(self, operation, content="", attributes=""):
        """The answer's document; Refused when it is not OK."""
        answer = self._fetch("/rois", f"<{operation} {NAMES} {attributes}>{content}</{operation}>".encode())
        if answer.get("return_code") != "OK":
            raise Refused(f"{operation}: {answer.get('return_code')}: {answer.findtext(M + 'reason')}")
        return answer

    def bind(self, component):
        self.request("bind", f'<component_ref rois:code="{component}"/>')

    def subscribe(self, event_type):
        self.request("subscribe", f"<event_type>{event_type}</event_type>", 'inline_results="true"')

    def query(self, query_type):
        return results_of(self.request("query", f"<query_type>{query_type}</query_type>"))

    def run(self, component, command="start", **arguments):
        """Executes one command, waits for its end and returns its Status. An argument is a list: its type and its texts."""
        name, given = next(self.names), ""
        for argument, (kind, *texts) in arguments.items():
            values = "".join(f"<rois:value>{escape(text)}</rois:value>" for text in texts)
            given += f'<rois:parameter rois:name="{argument}"><rois:data_type_ref rois:code="{kind}"/>{values}</rois:parameter>'
        unit = (f'<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="{command}" rois:command_id="{name}">'
                f'<rois:component_ref rois:code="{component}"/>{given and f"<rois:arguments>{given}</rois:arguments>"}'
                f'</rois:command_unit_list>')
        try:
            self.request("execute", f"<rois:CommandUnitSequence>{unit}</rois:CommandUnitSequence>")
        except Refused as refused:  # perhaps because an earlier try was accepted, and its answer got lost
            try:
                self.request("get_command_result", f"<command_id>{name}</command_id>")
            except Refused:
                raise refused from None
        status = Status(self.next(lambda one: one.findtext(M + "command_id") == name, math.inf).findtext(M + "status"))
        if status != "OK":
            try:
                results = results_of(self.request("get_command_result", f"<command_id>{name}</command_id>"))
                status.reason = results.get("reason", [""])[0]
            except Refused:  # the session has ended
                pass
        return status

    def event(self, event_type, seconds, wanted=lambda results: True):
        """The results of the first event of this type that `wanted` says yes to, also of those that came while something else was
        waited for; None when none comes within the time."""
        one = self.next(lambda one: one.findtext(M + "event_type") == event_type and wanted(results_of(one)), seconds)
        return None if one is None else results_of(one)

    def skip(self):
        """Forgets what came until now: `engine.skip().run(...)`, and then `event` tells only what comes of that."""
        self.news, self.kept = [], []
        return self

    def next(self, wanted, seconds):
        """The first notification that `wanted` says yes to; None when none comes within the time. Others are kept."""
        for one in self.kept:
            if wanted(one):
                self.kept.remove(one)
                return one
        end = time.monotonic() + seconds
        while True:
            while self.news:
                one = self.news.pop(0)
                if wanted(one):
                    return one
                self.kept.append(one)
                if len(self.kept) > self.most_kept:
                    self.kept.pop(0)
                    self.dropped += 1
            left = end - time.monotonic()
            if left <= 0:
                return None
            wait = math.ceil(min(self.longest_poll, left))
            for one in self._fetch(f"/rois/notifications?after={self.after}&wait={wait}", patience=wait + 10):
                self.after = int(one.get("sequence"))
                if one.tag == M + "lost":
                    self.lost += int(one.get("count"))
                else:
                    self.news.append(one)

    def _fetch(self, path, body=None, patience=10):
        headers = {"Content-Type": "application/xml", "RoIS-Session": self.session}
        end = None  # of asking again
        for pause in itertools.chain((0.01, 0.1), itertools.repeat(1)):
            came = b""
            try:
                with urllib.request.urlopen(urllib.request.Request(self.url + path, body, headers), timeout=patience) as answer:
                    while piece := answer.read1():
                        came += piece
                    return ElementTree.fromstring(came)
            except urllib.error.HTTPError as fault:
                raise Refused(reason_of(fault)) from None
            except (OSError, http.client.HTTPException, ElementTree.ParseError) as trouble:  # the last: cut off in its head
                if body is None and (news := whole_children_of(came)):
                    return news  # notifications that arrived before the link broke; the next request asks for the rest
                end = end or time.monotonic() + self.deadline
                if time.monotonic() >= end:
                    raise NoAnswer(f"{self.url} does not answer: {trouble}") from None
                print(f"asking again after {trouble!r}", file=sys.stderr)
                time.sleep(pause)


def reason_of(error):
    """A fault's code and reason; the status alone where it was no gateway that answered."""
    try:
        fault = ElementTree.fromstring(error.read())
    except (OSError, http.client.HTTPException, ElementTree.ParseError):
        return str(error)
    return f"{fault.get('code')}: {fault.findtext(M + 'reason')}" if fault.tag == M + "fault" else str(error)


def whole_children_of(text):
    """The root's children that are complete in a document whose end is missing."""
    parser, depth, children = ElementTree.XMLPullParser(("start", "end")), 0, []
    try:
        parser.feed(text)
        for event, element in parser.read_events():
            depth += 1 if event == "start" else -1
            if event == "end" and depth == 1:
                children.append(element)
    except ElementTree.ParseError:  # not a document of XML
        pass
    return children


def results_of(document):
    """The results in an answer or an event: a list of texts for each name."""
    return {one.get(R + "name"): [value.text or "" for value in one.iter(R + "value")] for one in document.iter(M + "result")}
