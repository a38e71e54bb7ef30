"""docs/examples/rois.py against the real gateway, and the receptions without one."""
import json
import os
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "docs" / "examples"
sys.path.insert(0, str(EXAMPLES))
import rois  # noqa: E402
from cutting_proxy import CuttingProxy  # noqa: E402

NO_NUMBERS = ("abc", "0", "-3", "2abc", "1.5", "1_0", "1000000", "")
PLACES = ["string[]", "4000, 5000", "4100, 5000", "4200, 5000"]


def unused_url():
    """Returns the URL of a port without a server."""
    with socket.create_server(("127.0.0.1", 0)) as taken:
        return f"http://127.0.0.1:{taken.getsockname()[1]}"


def run(*program, url, **environment):
    """Runs an example; returns its exit code and standard error."""
    environment = os.environ | {"ROIS_URL": url} | environment
    return subprocess.run([*program], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def answer_once(server):
    """Answers the first connection with the answer to `connect`."""
    body = b'<connect_response xmlns="urn:x-rois:psm:xml:message:1" return_code="OK"><session>s</session></connect_response>'
    came, _ = server.accept()
    with came:
        came.recv(4096)
        came.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: %d\r\nConnection: close\r\n\r\n%s" % (len(body), body))


class EndlessAnswer:
    """A server whose answers to connections after the first one never end."""

    def __init__(self, piece, pause):
        self.server = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self.server.getsockname()[1]}"
        self.piece, self.pause = piece, pause
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        answer_once(self.server)
        while True:
            came, _ = self.server.accept()
            try:
                with came:
                    came.recv(4096)
                    came.sendall(b"HTTP/1.1 200 OK\r\n\r\n<")
                    while True:
                        came.sendall(self.piece)
                        time.sleep(self.pause)
            except OSError:
                pass


class WithAnEndlessAnswer(unittest.TestCase):
    def refusal(self, piece, pause, patience):
        engine = rois.Engine(EndlessAnswer(piece, pause).url)
        with self.assertRaises(rois.NoAnswer) as refused:
            engine._fetch("/rois", b"", patience)
        return str(refused.exception)

    def test_it_is_not_read_for_longer_than_an_answer_may_take(self):
        self.assertIn("does not end within 1 s", self.refusal(b" ", 0.05, 1))

    def test_it_is_not_kept_beyond_the_limit(self):
        rois.LONGEST, usual = 1_000_000, rois.LONGEST
        self.addCleanup(setattr, rois, "LONGEST", usual)
        self.assertIn("is longer than 1000000 bytes", self.refusal(b" " * 100_000, 0, 10))


class GatewayTest(unittest.TestCase):
    program = pathlib.Path(os.environ["ROIS_BINARY_DIR"]) / "bin" / "rois-gateway"
    more_arguments = ()

    @classmethod
    def setUpClass(cls):
        hall = ROOT / "tests" / "server" / "data" / "empty_hall.xml"
        cls.gateway = subprocess.Popen([cls.program, "--listen", "127.0.0.1:0", "--scenario", hall, "--sim-speed", "100",
                                        *cls.more_arguments], stderr=subprocess.PIPE, text=True)
        cls.url = next(found[1] for line in cls.gateway.stderr if (found := re.search(r"listening on (\S+)", line)))

    @classmethod
    def tearDownClass(cls):
        cls.gateway.terminate()
        cls.gateway.communicate()


class WithAGateway(GatewayTest):
    def setUp(self):
        self.engine = rois.Engine(self.url)
        self.addCleanup(self.engine.request, "disconnect")
        self.engine.bind("navigation")
        self.engine.subscribe("reached_target")

    def reached(self):
        """Returns the target of the next `reached_target` that has arrived."""
        return (self.engine.event("reached_target", 0) or {}).get("target", [None])[0]

    def test_events_before_the_end_of_a_command_are_kept(self):
        self.assertEqual(self.engine.run("navigation", target_position=PLACES), "OK")
        self.assertEqual([self.reached() for _ in range(4)], PLACES[1:] + [None])

    def test_events_that_a_filter_rejects_are_kept(self):
        self.engine.run("navigation", target_position=PLACES)
        second = self.engine.event("reached_target", 0, lambda results: results["target"] == [PLACES[2]])
        self.assertEqual(second["target"], [PLACES[2]])
        self.assertEqual([self.reached() for _ in range(3)], [PLACES[1], PLACES[3], None])

    def test_kept_events_can_be_skipped(self):
        self.engine.run("navigation", target_position=PLACES)
        self.assertEqual(self.engine.skip().run("navigation", target_position=["string[]", "4300, 5000"]), "OK")
        self.assertEqual([self.reached() for _ in range(2)], ["4300, 5000", None])
        self.assertEqual(self.engine.dropped, 0, "skipped events do not count as dropped")

    def test_the_oldest_events_are_dropped_and_counted(self):
        self.engine.most_kept = 2
        self.engine.run("navigation", target_position=PLACES)
        self.assertEqual([self.reached() for _ in range(3)], [PLACES[2], PLACES[3], None])
        self.assertEqual(self.engine.dropped, 1)

    def test_the_reception_reports_a_refusal_in_one_line_and_ends_its_session(self):
        end = run("python3", "-B", EXAMPLES / "reception.py", url=self.url)  # navigation is bound here
        self.assertEqual(end.returncode, 1)
        self.assertRegex(end.stderr, r"\Areception\.py: bind: OUT_OF_RESOURCES: .*\n\Z")
        self.engine.bind("person_detection")  # the reception had bound it

    def test_the_reception_reports_a_missing_gateway_in_one_line(self):
        end = run("python3", "-B", EXAMPLES / "reception.py", url=f"{self.url}/nowhere")
        self.assertEqual(end.returncode, 1)
        self.assertRegex(end.stderr, r"\Areception\.py: not_found: .*\n\Z")


class WithTokens(GatewayTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.more_arguments = ("--tokens", f"{folder.name}/tokens.json")
        adding = [cls.program, "token", "add", "reception", "--role", "operator", *cls.more_arguments]
        cls.token = subprocess.run(adding, check=True, capture_output=True, text=True).stdout.strip()
        super().setUpClass()

    def test_the_client_sends_its_token(self):
        with rois.Engine(self.url, token=self.token) as engine:
            self.assertIn("position_data", engine.query("robot_position"))

    def test_a_missing_or_wrong_token_is_reported(self):
        for token in (None, "wrong"):
            with self.assertRaisesRegex(rois.Refused, "^unauthorized: "):
                rois.Engine(self.url, token=token)

    def test_the_receptions_send_the_token_of_the_environment(self):
        with rois.Engine(self.url, token=self.token) as engine:
            engine.bind("navigation")
            for program in (("python3", "-B", EXAMPLES / "reception.py"), ("sh", EXAMPLES / "reception.sh")):
                end = run(*program, url=self.url, ROIS_TOKEN=self.token)
                self.assertRegex(end.stderr, "bind: .*OUT_OF_RESOURCES")


class BehindAProxyThatCuts(GatewayTest):
    """All notifications arrive although each connection breaks before the answer with them is complete."""

    def setUp(self):
        self.proxy = CuttingProxy(int(self.url.rsplit(":", 1)[1]), 4_000)
        self.addCleanup(self.proxy.stop)

    def test_the_shell_client_reads_the_complete_notifications(self):
        end = subprocess.run(["sh", ROOT / "tests" / "clients" / "endurance.sh", "2"],  # 20 events of 800 bytes each a command
                             env=os.environ | {"ROIS_URL": self.proxy.url}, capture_output=True, text=True)
        self.assertEqual(end.returncode, 0, end.stderr)
        self.assertEqual(json.loads(end.stdout), {"good": 2, "events": 40, "out_of_order": 0, "completed": 2, "completed_twice": 0,
                                                  "twice": 0, "missed": 0, "lost": 0})
        self.assertGreaterEqual(self.proxy.cuts, 4)

    def test_the_python_client_reads_the_complete_notifications(self):
        places = [f"4000, 5000, {i}e-9" for i in range(20)]
        with rois.Engine(self.proxy.url) as engine:
            engine.bind("navigation")
            engine.subscribe("reached_target")
            self.assertEqual(engine.run("navigation", target_position=["string[]", *places]), "OK")
            self.assertEqual([engine.event("reached_target", 0)["target"] for _ in places], [[place] for place in places])
        self.assertGreaterEqual(self.proxy.cuts, 2)


class WithoutAGateway(unittest.TestCase):
    def test_the_receptions_reject_an_invalid_number(self):
        for *program, name, code in (("python3", "-B", "reception.py", 1), ("sh", "reception.sh", 2)):
            for visitors in NO_NUMBERS:
                end = run(*program, EXAMPLES / name, visitors, url=unused_url())
                self.assertEqual(end.stderr, f"{name}: VISITORS is a whole number, 1 to 999999, not '{visitors}'\n")
                self.assertEqual(end.returncode, code)

    def refusal_after(self, head):
        """The client's report after a server has answered its first request with this."""
        def answer(server):
            came, _ = server.accept()
            with came:
                came.recv(4096)
                came.sendall(head)

        with socket.create_server(("127.0.0.1", 0)) as server:
            threading.Thread(target=answer, args=(server,), daemon=True).start()
            with self.assertRaises(rois.Refused) as refused:
                rois.Engine(f"http://127.0.0.1:{server.getsockname()[1]}", token="secret")
        return str(refused.exception)

    def test_another_server_is_reported_by_its_status(self):
        head = b"HTTP/1.1 502 Bad Gateway\r\nContent-Length: 14\r\nConnection: close\r\n\r\n<html>\n<hr>\n\n "
        self.assertEqual(self.refusal_after(head), "HTTP Error 502: Bad Gateway")

    def test_a_redirect_is_not_followed(self):
        head = b"HTTP/1.1 307 Temporary Redirect\r\nLocation: /elsewhere\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"
        self.assertIn("307", self.refusal_after(head))

    def test_a_token_is_sent_to_other_machines_only_with_tls(self):
        for url in ("http://192.0.2.1:8080", "http://127.0.0.1.example", "http://localhost:80@192.0.2.1"):
            for *program, name in (("python3", "-B", "reception.py"), ("sh", "reception.sh")):
                end = run(*program, EXAMPLES / name, url=url, ROIS_TOKEN="secret")
                self.assertEqual(end.stderr, f"{name}: a token cannot be sent to {url}: use https\n")
        for url in ("https://192.0.2.1", "http://localhost:8080", "http://127.0.0.1/", "http://[::1]:80"):
            self.assertTrue(rois.is_safe(url), url)

    def test_a_call_ends_at_its_deadline(self):
        with self.assertRaisesRegex(rois.NoAnswer, "refused"):
            rois.Engine(unused_url(), deadline=0)

    def test_a_wait_for_notifications_ends_at_its_deadline(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            opening = threading.Thread(target=answer_once, args=(server,))
            opening.start()
            engine = rois.Engine(f"http://127.0.0.1:{server.getsockname()[1]}", deadline=0)
            opening.join()
        with self.assertRaises(rois.NoAnswer):
            engine.next(lambda one: True, 1_000_000)

    def test_the_receptions_report_a_missing_gateway(self):
        environment = os.environ | {"ROIS_URL": unused_url()}
        ends = [subprocess.Popen([*program, EXAMPLES / name], env=environment, stderr=subprocess.PIPE, text=True)
                for *program, name in (("python3", "-B", "reception.py"), ("sh", "reception.sh"))]
        for end in ends:
            said = end.communicate()[1].splitlines()
            self.assertEqual(end.returncode, 1, said)
            self.assertIn(environment["ROIS_URL"], said[-1])
            self.assertNotIn("Traceback", "".join(said))


if __name__ == "__main__":
    unittest.main()
