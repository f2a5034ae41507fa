"""The camera the other way, `python -m bench.support.naive_camera`: every viewer has a thread, an encoder and a library's file writer.

Prints `{"ws": PORT, "http": PORT}`; ends when its standard input does.
"""

from __future__ import annotations

import contextlib
import io
import json
import subprocess
import sys
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import av
from PIL import Image
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import ServerConnection, serve

from bench.support.painted import HEIGHT, QUALITY, RATE, WIDTH

__all__ = ["Camera"]

FILMS = {
    "mp4": (
        "libx264",
        {"movflags": "frag_every_frame+empty_moov+default_base_moof"},
        {"preset": "ultrafast", "tune": "zerolatency"},
    ),
    "webm": (
        "libvpx",
        {"live": "1", "cluster_time_limit": "100"},
        {"deadline": "realtime", "cpu-used": "8", "lag-in-frames": "0"},
    ),
}
"""Codec, and the options of the file and of the codec, that are usual for little delay."""


class Camera:
    """The newest picture, decoded."""

    def __init__(self) -> None:
        self._came = threading.Condition()
        self._number, self._picture = 0, Image.new("RGB", (WIDTH, HEIGHT))
        threading.Thread(target=self._film, daemon=True).start()

    def _film(self) -> None:
        command = [sys.executable, "-m", "bench.support.painted"]
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE) as camera:
            made = camera.stdout
            while made is not None and (length := made.read(4)):
                picture = Image.open(io.BytesIO(made.read(int.from_bytes(length, "big"))))
                picture.load()
                with self._came:
                    self._number, self._picture = self._number + 1, picture
                    self._came.notify_all()

    def pictures(self) -> Iterator[Image.Image]:
        """The newest one whenever there is another."""
        seen = 0
        while True:
            with self._came:
                self._came.wait_for(lambda: self._number > seen)  # noqa: B023 - it is asked here
                seen, picture = self._number, self._picture
            yield picture

    def files(self) -> Iterator[bytes]:
        """The same as JPEG files."""
        for picture in self.pictures():
            file = io.BytesIO()
            picture.save(file, "JPEG", quality=QUALITY)
            yield file.getvalue()


class Pages(BaseHTTPRequestHandler):
    """Its streams."""

    camera: Camera

    def do_GET(self) -> None:
        """Stream until the viewer is gone."""
        kind = self.path.rpartition(".")[2]
        self.send_response(200)
        self.end_headers()
        with contextlib.suppress(OSError, av.FFmpegError):
            (self._film if kind in FILMS else self._show)(kind)

    def log_message(self, *_: Any) -> None:
        """Say nothing."""

    def _show(self, _: str) -> None:
        for jpeg in self.camera.files():
            head = f"--picture\r\nContent-Type: image/jpeg\r\nContent-Length: {len(jpeg)}\r\n\r\n"
            self.wfile.write(head.encode() + jpeg + b"\r\n")

    def _film(self, kind: str) -> None:
        codec, file_options, codec_options = FILMS[kind]
        with av.open(self.wfile, "w", format=kind, options=file_options) as file:
            stream: Any = file.add_stream(codec, rate=int(RATE), options=codec_options)
            stream.width, stream.height, stream.pix_fmt = WIDTH, HEIGHT, "yuv420p"
            stream.bit_rate, stream.codec_context.thread_count = 2_000_000, 1
            for picture in self.camera.pictures():
                file.mux(stream.encode(av.VideoFrame.from_image(picture)))


def main() -> None:
    """Serve until standard input ends."""
    Pages.camera = camera = Camera()

    def show(connection: ServerConnection) -> None:
        with contextlib.suppress(ConnectionClosed):
            for jpeg in camera.files():
                connection.send(jpeg)

    http = ThreadingHTTPServer(("127.0.0.1", 0), Pages)
    http.daemon_threads = True
    with serve(show, "127.0.0.1", 0) as sockets:
        for each in (http, sockets):
            threading.Thread(target=each.serve_forever, daemon=True).start()
        port = sockets.socket.getsockname()[1]
        print(json.dumps({"ws": port, "http": http.server_address[1]}), flush=True)
        sys.stdin.read()
        http.shutdown()
        sockets.shutdown()


if __name__ == "__main__":
    main()
