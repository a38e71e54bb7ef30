"""Connections to the gateway that break after each byte that a client sends, over HTTP and WebSocket. A command whose last byte has
not come does not run. One that has come runs once, however often the client repeats it, and completes once."""

import base64
import os
import re
import socket
import struct
import subprocess
import unittest

NAMESPACE = "urn:x-rois:psm:xml:message:1"
PATIENCE = 20  # s


def request(operation, content="", **attributes):
    text = "".join(f' {name}="{value}"' for name, value in attributes.items())
    return f'<{operation} xmlns="{NAMESPACE}" xmlns:rois="http://www.omg.org/spec/RoIS/20240801"{text}>{content}</{operation}>'


def start(command):
    text = '<rois:parameter rois:name="speech_text"><rois:data_type_ref rois:code="string"/><rois:value>Hello.</rois:value></rois:parameter>'
    unit = f"""<rois:command_unit_list xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:type="rois:CommandMessageType"
        rois:command_type="start" rois:command_id="{command}"><rois:component_ref rois:code="speech_synthesis"/>
        <rois:arguments>{text}</rois:arguments></rois:command_unit_list>"""
    return request("execute", f"<rois:CommandUnitSequence>{unit}</rois:CommandUnitSequence>")


class Gateway:
    def __init__(self):
        program = os.path.join(os.environ["ROIS_BINARY_DIR"], "bin", "rois-gateway")
        self.process = subprocess.Popen([program, "--listen", "127.0.0.1:0", "--sim-speed", "100", "--media", ""], stderr=subprocess.PIPE, text=True)
        for line in self.process.stderr:
            if found := re.search(r"listening on http://127.0.0.1:(\d+)", line):
                self.port = int(found[1])
                break
        self.link = self.connect()

    def connect(self):
        link = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE)
        link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return link

    def http(self, body, session="", path="/rois", method="POST"):
        head = f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/xml\r\nContent-Length: {len(body)}\r\n"
        return (head + (f"RoIS-Session: {session}\r\n" if session else "") + "\r\n" + body).encode()

    def ask(self, body, session=""):
        return self.answer(self.http(body, session))

    def answer(self, octets):
        """On a connection that nothing breaks."""
        self.link.sendall(octets)
        received = b""
        while b"\r\n\r\n" not in received:
            received += self.link.recv(65536)
        head, body = received.split(b"\r\n\r\n", 1)
        length = int(re.search(rb"(?i)content-length: (\d+)", head)[1])
        while len(body) < length:
            body += self.link.recv(65536)
        return body.decode()

    def stop(self):
        self.link.close()
        self.process.terminate()
        self.process.stderr.close()
        return self.process.wait(PATIENCE)


def masked(text):
    payload = text.encode()
    return bytes([0x81, 0x80 | 126]) + struct.pack("!H", len(payload)) + bytes(4) + payload


def handshake():
    key = base64.b64encode(bytes(16)).decode()
    return (f"GET /rois HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n").encode()


class Cuts(unittest.TestCase):
    def setUp(self):
        self.gateway = Gateway()
        self.session = re.search("<session>(.*?)</session>", self.gateway.ask(request("connect")))[1]
        self.ok(self.ask(request("bind", '<component_ref rois:code="speech_synthesis"/>')))
        self.last = 0

    def tearDown(self):
        self.assertEqual(self.gateway.stop(), 0)

    def ask(self, body):
        return self.gateway.ask(body, self.session)

    def ok(self, answer):
        self.assertIn('return_code="OK"', answer)

    def completions(self):
        """Reads until a command has completed. Returns the ids of all commands that have."""
        while True:
            path = f"/rois/notifications?after={self.last}&wait=10"
            text = self.gateway.answer(self.gateway.http("", self.session, path, "GET"))
            numbers = [int(number) for number in re.findall(r'sequence="(\d+)"', text)]
            self.last = max([self.last, *numbers])
            if ended := re.findall("<command_id>(.*?)</command_id>", text):
                return ended
            self.assertTrue(numbers, text)

    def cut_at_each_byte(self, bytes_for):
        """`bytes_for`: what a client sends to start a command with this id."""
        for count in range(1, len(bytes_for("c00000")) + 1):
            command = f"c{count:05}"
            octets = bytes_for(command)
            with self.gateway.connect() as link:
                link.sendall(octets[:count])
                received = b""
                while count == len(octets) and b"execute_response" not in received:
                    received += link.recv(65536)
            again = self.ask(start(command))
            if count < len(octets):
                self.ok(again)
            else:
                self.assertIn("is in use", again)
            self.assertEqual(self.completions(), [command])

    def test_over_http(self):
        self.cut_at_each_byte(lambda command: self.gateway.http(start(command), self.session))

    def test_over_a_websocket(self):
        def octets(command):
            return handshake() + masked(request("resume", session=self.session, last_sequence=self.last)) + masked(start(command))

        self.cut_at_each_byte(octets)


if __name__ == "__main__":
    unittest.main()
