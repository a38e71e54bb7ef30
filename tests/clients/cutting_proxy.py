"""A proxy that cuts every connection once it has carried a number of bytes to the client."""
import socket
import socketserver
import threading


class CuttingProxy(socketserver.ThreadingTCPServer):
    """Forwards connections to `port` of this host. `cuts` counts those that were cut after `most_bytes`."""

    daemon_threads = True

    def __init__(self, port, most_bytes):
        super().__init__(("127.0.0.1", 0), Connection)
        self.port, self.most_bytes, self.cuts = port, most_bytes, 0
        self.url = f"http://127.0.0.1:{self.server_address[1]}"
        threading.Thread(target=self.serve_forever, args=(0.01,), daemon=True).start()

    def stop(self):
        self.shutdown()
        self.server_close()


class Connection(socketserver.BaseRequestHandler):
    def handle(self):
        with socket.create_connection(("127.0.0.1", self.server.port)) as far:
            forwarding = threading.Thread(target=self._forward_requests, args=(far,))
            forwarding.start()
            self._forward_answers(far)
            for end in (self.request, far):
                try:
                    end.shutdown(socket.SHUT_RDWR)  # wakes the other thread
                except OSError:  # the peer was faster
                    pass
            forwarding.join()

    def _forward_requests(self, far):
        try:
            while piece := self.request.recv(65536):
                far.sendall(piece)
            far.shutdown(socket.SHUT_WR)
        except OSError:  # the connection was cut
            pass

    def _forward_answers(self, far):
        left = self.server.most_bytes
        try:
            while left > 0 and (piece := far.recv(left)):
                self.request.sendall(piece)
                left -= len(piece)
        except OSError:  # the client has gone
            return
        self.server.cuts += left == 0
