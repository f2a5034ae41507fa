"""The tile server of the examples, with every fault that a server on the internet has."""

from __future__ import annotations

import threading
from http.server import BaseHTTPRequestHandler

from bridge.core.geo import Datum
from examples.tile_server import TileServer

DATUM = Datum(45.5069, -73.579)
ZOOM = 17


def key(east: int = 0, north: int = 0) -> tuple[int, int, int]:
    """A tile beside the one about the datum: zoom level, column, row from the south."""
    return ZOOM, 38746 + east, 2**ZOOM - 1 - 46877 + north


class FaultyServer(TileServer):
    """Answers as a test says by `fault`; counts who asked for what."""

    def __init__(self) -> None:
        super().__init__(DATUM)
        self.fault = ""
        self.asked: list[str] = []
        self.headers: list[dict[str, str]] = []
        self.extra: dict[str, str] = {}
        self.begun = threading.Event()
        """Somebody has asked for something."""
        self.may = threading.Event()
        """Set by the test: what hangs goes on."""

    def answer(self, asked: BaseHTTPRequestHandler) -> None:
        self.asked.append(asked.path)
        self.headers.append(dict(asked.headers))
        self.begun.set()
        if self.fault:
            getattr(self, f"_{self.fault}")(asked)
        else:
            super().answer(asked)

    def send(self, asked, status, body, kind, **more):
        super().send(asked, status, body, kind, **(self.extra | more))

    def _html(self, asked):
        self.send(asked, 200, b"<html>Welcome to the hotel's network</html>", "text/html")

    def _cut(self, asked):
        whole = self.tile(ZOOM, 1, 1)
        self.send(asked, 200, whole[: len(whole) // 2], "image/png")

    def _short(self, asked):
        asked.send_response(200)
        asked.send_header("Content-Length", "50000")
        asked.end_headers()
        asked.wfile.write(b"\x89PNG")
        asked.close_connection = True

    def _huge(self, asked):
        asked.send_response(200)
        asked.send_header("Content-Length", str(10**9))
        asked.end_headers()
        try:
            for _ in range(1000):
                asked.wfile.write(bytes(65536))
        except OSError:
            pass
        asked.close_connection = True

    def _loop(self, asked):
        self.send(asked, 302, b"", "text/plain", Location=asked.path + "x")

    def _busy(self, asked):
        self.send(asked, 429, b"", "text/plain", Retry_After="77")

    def _refuses(self, asked):
        self.send(asked, 403, b"", "text/plain")

    def _broken(self, asked):
        self.send(asked, 500, b"", "text/plain")

    def _none(self, asked):
        self.send(asked, 404, b"", "text/plain")

    def _hangs(self, asked):
        self.may.wait(60)
        asked.close_connection = True

    def _drips(self, asked):
        asked.send_response(200)
        asked.end_headers()
        try:
            for _ in range(200):
                asked.wfile.write(b"\x89")
                asked.wfile.flush()
                if self.may.wait(0.01):
                    break
        except OSError:
            pass
        asked.close_connection = True
