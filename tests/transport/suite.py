#!/usr/bin/env python3
"""Tests the WebSockets of a server that returns each message (RFC 6455).

    suite.py URL [CASE...]

Each case sends frames and compares what comes back: messages, pongs, and the code of the close frame. It runs three times: the
bytes in one piece, one by one (unless there are many), and in random pieces. Prints the cases that fail, and how many there are.
"""

import base64
import hashlib
import os
import random
import socket
import struct
import sys
import urllib.parse

LONGEST = 16 << 20  # bytes of a message that the server accepts
FRAGMENT, TEXT, BINARY, CLOSE, PING, PONG = 0, 1, 2, 8, 9, 10
FIN = 0x80


# --- What a client sends ---


def frame(opcode, payload=b"", fin=FIN, reserved=0, mask=b"mask", length=None):
    """`length`: None, or the form of the length: 7, 16 or 64 bits."""
    size = len(payload)
    length = length or (7 if size < 126 else 16 if size < 65536 else 64)
    bit = 0x80 if mask else 0
    sizes = {7: lambda: bytes([bit | size]), 16: lambda: struct.pack("!BH", bit | 126, size), 64: lambda: struct.pack("!BQ", bit | 127, size)}
    head = bytes([fin | reserved << 4 | opcode]) + sizes[length]()
    if not mask:
        return head + payload
    key = (mask * (size // 4 + 1))[:size]
    return head + mask + (int.from_bytes(payload, "big") ^ int.from_bytes(key, "big")).to_bytes(size, "big")


def text(payload, **form):
    return frame(TEXT, payload if isinstance(payload, bytes) else payload.encode(), **form)


def fragments(*parts, opcode=TEXT):
    """A message in frames."""
    last = len(parts) - 1
    return b"".join(frame(FRAGMENT if i else opcode, part, fin=FIN if i == last else 0) for i, part in enumerate(parts))


def close(code=None, reason=b""):
    return frame(CLOSE, b"" if code is None else struct.pack("!H", code) + reason)


# --- What must come back ---


def message(payload):
    return ("message", payload if isinstance(payload, bytes) else payload.encode())


def pong(payload=b""):
    return ("pong", payload)


def closed(code):
    """The code of the close frame. Then the connection ends."""
    return ("close", code)


BROKEN, NOT_UTF8, TOO_LONG, NO_BINARY = closed(1002), closed(1007), closed(1009), closed(1003)
BYE = close(1000)
ENDED = closed(1000)


def cases():
    """Yields name, bytes to send, and what must come back. Cases that end well say goodbye."""
    for size in (0, 1, 125, 126, 127, 128, 65535, 65536, 65537, 1 << 20, LONGEST):
        yield f"message of {size} bytes", text(b"*" * size) + BYE, [message(b"*" * size), ENDED]
    yield "message that is too long", text(b"*" * (LONGEST + 1)), [TOO_LONG]
    yield "fragments that are too long", fragments(b"*" * LONGEST, b"*"), [TOO_LONG]
    yield "binary message", frame(BINARY, b"data"), [NO_BINARY]
    yield "binary fragment", frame(BINARY, b"data", fin=0), [NO_BINARY]
    yield "100 messages at once", b"".join(text(str(i)) for i in range(100)) + BYE, [message(str(i)) for i in range(100)] + [ENDED]

    for payload in (b"", b"hello", bytes(range(125)), b"\x00\xff\xfe\xfd", b"*" * 125):
        yield f"ping with {len(payload)} bytes, {payload[:4].hex()}", frame(PING, payload) + BYE, [pong(payload), ENDED]
    yield "ping with 126 bytes", frame(PING, b"*" * 126), [BROKEN]
    yield "pong without a ping", frame(PONG, b"unasked") + text("on") + BYE, [message("on"), ENDED]
    yield "pong with 126 bytes", frame(PONG, b"*" * 126), [BROKEN]
    yield "ten pings", b"".join(frame(PING, b"%d" % i) for i in range(10)) + BYE, [pong(b"%d" % i) for i in range(10)] + [ENDED]

    for bits in range(1, 8):
        for opcode in (TEXT, PING, PONG, CLOSE):
            yield f"reserved bits {bits} of opcode {opcode}", frame(opcode, b"", reserved=bits), [BROKEN]
        yield f"reserved bits {bits} after a message", text("one") + frame(TEXT, b"two", reserved=bits), [message("one"), BROKEN]
        yield f"reserved bits {bits} of a fragment", frame(TEXT, b"a", fin=0) + frame(FRAGMENT, b"b", reserved=bits), [BROKEN]
    for opcode in (3, 4, 5, 6, 7, 11, 12, 13, 14, 15):
        yield f"unknown opcode {opcode}", frame(opcode), [BROKEN]
        yield f"unknown opcode {opcode} after a message", text("one") + frame(opcode, b"x") + frame(PING), [message("one"), BROKEN]

    yield "message in two fragments", fragments(b"one ", b"two") + BYE, [message("one two"), ENDED]
    yield "message in three, with a ping", frame(TEXT, b"1", fin=0) + frame(PING, b"p") + frame(FRAGMENT, b"2", fin=0) + frame(FRAGMENT, b"3") + BYE, [pong(b"p"), message("123"), ENDED]
    yield "message in fragments, with ten pings", frame(TEXT, b"1", fin=0) + b"".join(frame(PING, b"%d" % i) for i in range(10)) + frame(FRAGMENT, b"2") + BYE, [pong(b"%d" % i) for i in range(10)] + [message("12"), ENDED]
    yield "message in a thousand fragments", fragments(*[b"*"] * 1000) + BYE, [message(b"*" * 1000), ENDED]
    yield "message of 1 MiB in frames of 64 bytes", fragments(*[b"*" * 64] * 16384) + BYE, [message(b"*" * (1 << 20)), ENDED]
    yield "empty fragments", fragments(b"", b"", b"") + BYE, [message(""), ENDED]
    yield "empty first and last fragment", fragments(b"", b"all", b"") + BYE, [message("all"), ENDED]
    yield "two messages in fragments", fragments(b"a", b"b") + fragments(b"c", b"d") + BYE, [message("ab"), message("cd"), ENDED]
    yield "ping in fragments", frame(PING, b"a", fin=0) + frame(FRAGMENT, b"b"), [BROKEN]
    yield "pong in fragments", frame(PONG, b"a", fin=0) + frame(FRAGMENT, b"b"), [BROKEN]
    yield "close in fragments", frame(CLOSE, b"\x03\xe8", fin=0), [BROKEN]
    yield "fragment without a beginning", frame(FRAGMENT, b"x"), [BROKEN]
    yield "fragment without a beginning, not the last", frame(FRAGMENT, b"x", fin=0), [BROKEN]
    yield "fragment after the end", fragments(b"a", b"b") + frame(FRAGMENT, b"c"), [message("ab"), BROKEN]
    yield "message inside a message", frame(TEXT, b"a", fin=0) + text("b"), [BROKEN]
    yield "message in fragments inside a message", frame(TEXT, b"a", fin=0) + frame(TEXT, b"b", fin=0), [BROKEN]
    yield "close inside a message", frame(TEXT, b"a", fin=0) + BYE, [ENDED]

    for point in (0x00, 0x7F, 0x80, 0x7FF, 0x800, 0xD7FF, 0xE000, 0xFFFD, 0xFFFE, 0xFFFF, 0x10000, 0x1F916, 0x10FFFE, 0x10FFFF):
        character = chr(point).encode()
        yield f"U+{point:04X}", text(character) + BYE, [message(character), ENDED]
        if len(character) > 1:
            yield f"U+{point:04X}, a byte in each frame", fragments(*[bytes([b]) for b in character]) + BYE, [message(character), ENDED]
    yield "all of the basic plane", text(every_character()) + BYE, [message(every_character()), ENDED]
    bad = ("80", "bf", "c0", "c080", "c1bf", "c2", "c220", "e0", "e08080", "e09fbf", "e0a0", "eda080", "edbfbf", "eda080edb080", "ee80", "f08080", "f0808080",
           "f08fbfbf", "f09080", "f4908080", "f5808080", "f888808080", "fc8480808080", "fe", "ff", "fe80", "ffff")
    for digits in bad:
        octets = bytes.fromhex(digits)
        yield f"bytes {digits}", text(octets), [NOT_UTF8]
        yield f"bytes {digits} between characters", text("κόσμε".encode() + octets + b"edited"), [NOT_UTF8]
        yield f"bytes {digits} in two fragments", fragments(b"ok" + octets[:1], octets[1:]), [NOT_UTF8]
    yield "ping inside a character", frame(TEXT, b"\xce", fin=0) + frame(PING, b"\xff") + frame(FRAGMENT, b"\xba") + BYE, [pong(b"\xff"), message("κ"), ENDED]

    yield "close without a code", close(), [ENDED]
    yield "close with half a code", frame(CLOSE, b"\x03"), [BROKEN]
    yield "close with a reason", close(1000, b"r" * 123), [ENDED]
    yield "close with a reason that is too long", frame(CLOSE, b"\x03\xe8" + b"r" * 124), [BROKEN]
    yield "close with a reason that is not UTF-8", close(1000, b"\xce\xba\xff"), [NOT_UTF8]
    for code in (1000, 1001, 1002, 1003, 1007, 1008, 1009, 1010, 1011, 1012, 1013, 1014, 3000, 3999, 4000, 4999):
        yield f"close with {code}", close(code), [closed(code)]
    for code in (0, 999, 1004, 1005, 1006, 1015, 1016, 1100, 2000, 2999, 5000, 65535):
        yield f"close with {code}", close(code), [BROKEN]
    yield "two closes", BYE + BYE, [ENDED]
    yield "message after the close", BYE + text("late"), [ENDED]
    yield "ping after the close", BYE + frame(PING, b"late"), [ENDED]
    yield "broken frame after the close", BYE + frame(3), [ENDED]

    yield "frame without a mask", text("open", mask=b""), [BROKEN]
    yield "close without a mask", frame(CLOSE, b"\x03\xe8", mask=b""), [BROKEN]
    yield "mask of zeros", text("zeros", mask=b"\0\0\0\0") + BYE, [message("zeros"), ENDED]
    for size, length in ((5, 16), (125, 16), (5, 64), (126, 64), (65535, 64)):
        yield f"{size} bytes with a length of {length} bits", text(b"*" * size, length=length), [BROKEN]
    yield "length with the highest bit", bytes([FIN | TEXT, 0xFF]) + b"\x80" + bytes(7) + b"mask", [BROKEN]
    yield "length of an exabyte", bytes([FIN | TEXT, 0xFF]) + b"\x10" + bytes(7) + b"mask", [TOO_LONG]


def every_character():
    return "".join(chr(point) for point in range(1, 0x10000) if not 0xD800 <= point < 0xE000)


# --- The connection ---


class Peer:
    def __init__(self, address):
        self.socket = socket.create_connection(address, timeout=10)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        key = base64.b64encode(os.urandom(16))
        self.socket.sendall(b"GET /rois HTTP/1.1\r\nHost: %s:%d\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: %s\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: rois.xml.v1\r\n\r\n" % (address[0].encode(), address[1], key))
        self.received = b""
        while b"\r\n\r\n" not in self.received:
            if not self.more():
                raise RuntimeError("no answer to the handshake")
        head, self.received = self.received.split(b"\r\n\r\n", 1)
        accept = base64.b64encode(hashlib.sha1(key + b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11").digest())
        if not head.startswith(b"HTTP/1.1 101 ") or accept not in head:
            raise RuntimeError(f"the handshake failed: {head.decode()}")

    def send(self, pieces):
        try:
            for piece in pieces:
                self.socket.sendall(piece)
        except (BrokenPipeError, ConnectionResetError):
            pass  # it has closed: what it sent before counts

    def more(self):
        try:
            got = self.socket.recv(1 << 20)
        except ConnectionResetError:  # after a close frame it need not read the rest
            got = b""
        self.received += got
        return got

    def take(self, count):
        while len(self.received) < count:
            if not self.more():
                raise EOFError
        taken, self.received = self.received[:count], self.received[count:]
        return taken

    def frames(self):
        """What has come until the end of the connection."""
        try:
            while True:
                first, size = self.take(2)
                if size == 126:
                    (size,) = struct.unpack("!H", self.take(2))
                elif size == 127:
                    (size,) = struct.unpack("!Q", self.take(8))
                payload = self.take(size)
                kind = {FIN | TEXT: message, FIN | PONG: pong}.get(first)
                if kind:
                    yield kind(payload)
                elif first == FIN | CLOSE:
                    yield closed(struct.unpack("!H", payload[:2])[0] if payload else None)
                else:
                    yield ("frame", bytes([first]) + payload)
        except EOFError:
            if self.received:
                yield ("a part of a frame", self.received)


def in_pieces(octets, rng):
    """The ways to send the bytes."""
    yield "at once", [octets]
    if len(octets) <= 2_000:
        yield "byte by byte", [octets[i : i + 1] for i in range(len(octets))]
    cuts = sorted({rng.randrange(len(octets)) for _ in range(20)} | {0, len(octets)})
    yield "in pieces", [octets[a:b] for a, b in zip(cuts, cuts[1:])]


def shown(answers):
    return ", ".join(f"{kind} {value if not isinstance(value, bytes) or len(value) < 40 else str(len(value)) + ' bytes'}" for kind, value in answers) or "nothing"


def run(address, name, octets, expected, rng):
    """Returns the first difference, or None."""
    for way, pieces in in_pieces(octets, rng):
        peer = Peer(address)
        with peer.socket:
            peer.send(pieces)
            try:
                came = list(peer.frames())
            except TimeoutError:
                return f"{name}, {way}: the connection did not end"
        if came != expected:
            return f"{name}, {way}: expected {shown(expected)}; got {shown(came)}"
    return None


def main(url, *wanted):
    parts = urllib.parse.urlsplit(url)
    rng = random.Random(7)
    chosen = [case for case in cases() if not wanted or any(word in case[0] for word in wanted)]
    wrong = [problem for case in chosen if (problem := run((parts.hostname, parts.port), *case, rng))]
    for problem in wrong:
        print(problem)
    print(f"{len(chosen) - len(wrong)} of {len(chosen)} cases passed")
    return 1 if wrong or not chosen else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
