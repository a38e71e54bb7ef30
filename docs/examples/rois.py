"""A client of a RoIS gateway over HTTP, with Python's standard library only. docs/clients.md explains how to write a client."""
import http.client
import ipaddress
import itertools
import math
import sys
import time
import urllib.error
import urllib.parse
import urllib.request
from xml.etree import ElementTree
from xml.sax.saxutils import escape

M, R = "{urn:x-rois:psm:xml:message:1}", "{http://www.omg.org/spec/RoIS/20240801}"
NAMES = f'xmlns="{M[1:-1]}" xmlns:rois="{R[1:-1]}" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
LONGEST = 64_000_000  # bytes of an answer


class Refused(Exception):
    """The engine answered with a return code other than OK, or with a fault."""


class NoAnswer(Exception):
    """The gateway did not answer within the deadline. It is unknown whether the request was performed."""


class NoRedirects(urllib.request.HTTPRedirectHandler):
    """The token is for the gateway alone."""

    def redirect_request(self, *_):
        return None


class Status(str):
    """The status of a completed command: OK, ERROR, ABORT, OUT_OF_RESOURCES or TIMEOUT. If it is not OK, `reason` is the engine's reason."""

    reason = ""


class Engine:
    """A session. Requests whose answers are lost are repeated for up to `deadline` seconds. Commands have ids, so none is executed
    twice.

    The gateway holds a robot that moves for this session if it receives no request for `motion_lease` seconds: from 1 up to the
    gateway's own value, which is the default (None) and usually 10. While `run` waits, it sends a request once a second.

    `token`: for a gateway with tokens. It is sent only with https, or to this machine."""

    most_kept = 1000  # notifications that no call has wanted yet; the oldest are dropped first

    longest_poll = 1  # seconds: a waiting poll counts as a sign of life, even if this program has been stopped

    def __init__(self, url, deadline=10, motion_lease=None, token=None):
        if token and not is_safe(url):
            raise ValueError(f"a token cannot be sent to {url}: use https")
        self.url, self.deadline = url.rstrip("/"), deadline
        self.opener = urllib.request.build_opener(NoRedirects, urllib.request.ProxyHandler({}))
        self.headers = {"Content-Type": "application/xml"} | ({"Authorization": f"Bearer {token}"} if token else {})
        self.session = ""
        self.after = 0  # the sequence of the last received notification
        self.lost = 0  # notifications that the engine has dropped
        self.dropped = 0  # notifications that this object has dropped
        self.news = []  # received notifications that were not examined yet
        self.kept = []  # examined notifications that no call has wanted yet
        self.names = (f"step-{n}" for n in itertools.count(1))
        lease = f'motion_lease_http="{round(motion_lease * 1000)}"' if motion_lease else ""
        self.session = self.request("connect", attributes=lease).findtext(M + "session")

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        """Ends the session, and with it the robot's actions, also after an error. Does nothing if the gateway does not answer."""
        if kind is NoAnswer:
            return
        try:
            self.request("disconnect")
        except (Refused, NoAnswer):
            if kind is None:
                raise

    def request(self, operation, content="", attributes=""):
        """Sends a request and returns the answer's document. Raises Refused if it is not OK."""
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
        except Refused as refused:  # an earlier attempt may have been accepted and its answer lost
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
        """The results of the first event of this type for which `wanted` returns true, including events that came during earlier calls.
        None if there is none within the time."""
        one = self.next(lambda one: one.findtext(M + "event_type") == event_type and wanted(results_of(one)), seconds)
        return None if one is None else results_of(one)

    def skip(self):
        """Forgets all received notifications. After `engine.skip().run(...)`, `event` returns only later events."""
        self.news, self.kept = [], []
        return self

    def next(self, wanted, seconds):
        """The first notification for which `wanted` returns true; None if there is none within the time. Others are kept."""
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
        headers = self.headers | {"RoIS-Session": self.session}
        end = None  # of the attempts
        for pause in itertools.chain((0.01, 0.1), itertools.repeat(1)):
            came = bytearray()
            latest = time.monotonic() + patience
            try:
                with self.opener.open(urllib.request.Request(self.url + path, body, headers), timeout=patience) as answer:
                    while piece := answer.read1(65536):
                        came += piece
                        if len(came) > LONGEST:
                            raise NoAnswer(f"the answer of {self.url} is longer than {LONGEST} bytes")
                        if time.monotonic() > latest:
                            raise NoAnswer(f"the answer of {self.url} does not end within {patience} s")
                    return ElementTree.fromstring(came)
            except urllib.error.HTTPError as fault:
                raise Refused(reason_of(fault)) from None
            except (OSError, http.client.HTTPException, ElementTree.ParseError) as trouble:  # ParseError: truncated in its head
                if body is None and (news := whole_children_of(came)):
                    return news  # notifications that arrived before the link broke; the next request fetches the rest
                end = end or time.monotonic() + self.deadline
                if time.monotonic() >= end:
                    raise NoAnswer(f"{self.url} does not answer: {trouble}") from None
                print(f"asking again after {trouble!r}", file=sys.stderr)
                time.sleep(pause)


def is_safe(url):
    """Whether a token may be sent there: with TLS, or to this machine."""
    parts = urllib.parse.urlsplit(url)
    try:
        return parts.scheme == "https" or ipaddress.ip_address(parts.hostname or "").is_loopback
    except ValueError:
        return parts.hostname == "localhost"


def reason_of(error):
    """Code and reason of a fault; only the HTTP status if the answer is not from a gateway."""
    try:
        fault = ElementTree.fromstring(error.read(LONGEST))
    except (OSError, http.client.HTTPException, ElementTree.ParseError):
        return str(error)
    return f"{fault.get('code')}: {fault.findtext(M + 'reason')}" if fault.tag == M + "fault" else str(error)


def whole_children_of(text):
    """The complete children of the root in a truncated document."""
    parser, depth, children = ElementTree.XMLPullParser(("start", "end")), 0, []
    try:
        parser.feed(text)
        for event, element in parser.read_events():
            depth += 1 if event == "start" else -1
            if event == "end" and depth == 1:
                children.append(element)
    except ElementTree.ParseError:  # not an XML document
        pass
    return children


def results_of(document):
    """The results in an answer or an event: a list of texts for each name."""
    return {one.get(R + "name"): [value.text or "" for value in one.iter(R + "value")] for one in document.iter(M + "result")}
