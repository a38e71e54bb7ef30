"""xmlrpc_server.py PORT: a comparable call on Python's xmlrpc.server, with HTTP keep-alive and one thread for each connection."""

import socketserver
import sys
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer


class Handler(SimpleXMLRPCRequestHandler):
    protocol_version = "HTTP/1.1"


class Server(socketserver.ThreadingMixIn, SimpleXMLRPCServer):
    daemon_threads = True
    request_queue_size = 4096


def query(query_type, component_ref, engine, range_):
    return [
        "OK",
        {
            "timestamp": "2026-11-21T09:55:58.848Z",
            "robot_ref": component_ref,
            "position_data": "9498.984, 7429.98, -145.611",
            "value": 1 if query_type and engine and range_ > 0 else 0,
        },
    ]


if __name__ == "__main__":
    with Server(("127.0.0.1", int(sys.argv[1])), requestHandler=Handler, logRequests=False, allow_none=True) as server:
        server.register_function(query, "query")
        server.serve_forever()
