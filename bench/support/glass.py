"""Who looks at a camera, `python -m bench.support.glass KIND URL SECONDS VIEWERS`: prints how old the pictures were, as a line of JSON [s].

The first viewer decodes each picture and reads its clock; the others take what comes and look at nothing. KIND is `ws`, a
camera's own WebSocket, `plain`, one without acknowledgements, or the ending of a stream's URL.
"""

from __future__ import annotations

import asyncio
import io
import json
import sys
import threading
import time
import urllib.request
from typing import Any
from urllib.parse import urlsplit

import numpy as np
from PIL import Image
from websockets.asyncio.client import connect

from bench.support.painted import age
from bridge.core.camera_frames import unpack

__all__ = ["SETTLING"]

SETTLING = 2.0
"""Until what was loaded and asked for first is behind everybody [s]; not counted."""


class Watch:
    """What the first viewer saw."""

    def __init__(self, seconds: float) -> None:
        self._from = time.monotonic() + SETTLING
        self.until = self._from + seconds
        self.ages: list[float] = []

    def see(self, grey: Any) -> bool:
        """Note the age of a picture; False when it is time to go."""
        if time.monotonic() >= self._from:
            self.ages.append(age(grey))
        return time.monotonic() < self.until

    def see_jpeg(self, jpeg: bytes) -> bool:
        """The same of a file."""
        picture = Image.open(io.BytesIO(jpeg))
        picture.draft("L", picture.size)
        return self.see(np.asarray(picture))


async def socket(url: str, watch: Watch, *, reads: bool, acknowledges: bool) -> None:
    """Look by a WebSocket."""
    async with (
        connect(url, max_size=None, compression=None) as ws,
        asyncio.timeout_at(_loop_time(watch.until)),
    ):
        async for raw in ws:
            data = raw if isinstance(raw, bytes) else raw.encode()
            if acknowledges:
                frame = unpack(data)
                await ws.send(f"ack {frame.seq}")
                data = frame.jpeg
            if reads:
                watch.see_jpeg(data)


async def drained(url: str, watch: Watch) -> None:
    """Take a stream and look at nothing."""
    place = urlsplit(url)
    reader, writer = await asyncio.open_connection(place.hostname, place.port, limit=1 << 20)
    writer.write(f"GET {place.path}?{place.query} HTTP/1.1\r\nHost: {place.netloc}\r\n\r\n".encode())
    async with asyncio.timeout_at(_loop_time(watch.until)):
        while await reader.read(1 << 20):
            pass
    writer.close()


def _loop_time(monotonic: float) -> float:
    return asyncio.get_running_loop().time() + monotonic - time.monotonic()


def multipart(url: str, watch: Watch) -> None:
    """Look at MJPEG."""
    with urllib.request.urlopen(url) as stream:  # noqa: S310 - our own server's
        while head := _part(stream):
            if not watch.see_jpeg(stream.read(head)):
                return


def _part(stream: Any) -> int:
    """The length of the next picture; 0 when there is none."""
    length = 0
    while line := stream.readline():
        if line.lower().startswith(b"content-length:"):
            length = int(line[15:])
        if line == b"\r\n" and length:
            return length
    return 0


class _Stream:
    """What a demuxer reads, as it comes."""

    def __init__(self, url: str) -> None:
        self._stream = urllib.request.urlopen(url)  # noqa: S310 - our own server's

    def read(self, size: int) -> bytes:
        """As much as there is."""
        data: bytes = self._stream.read1(size)
        return data


def film(url: str, watch: Watch) -> None:
    """Look at MP4 or WebM."""
    import av

    with av.open(_Stream(url), options={"analyzeduration": "0"}) as file:
        stream = file.streams.video[0]
        stream.codec_context.thread_count = 1
        stream.codec_context.flags |= av.codec.context.Flags.low_delay
        for frame in file.decode(stream):
            if not watch.see(frame.to_ndarray(format="gray")):
                return


async def many(kind: str, url: str, watch: Watch, viewers: int) -> None:
    """Those who look at nothing."""
    async with asyncio.TaskGroup() as group:
        for _ in range(viewers):
            group.create_task(one(kind, url, watch, reads=False))


async def one(kind: str, url: str, watch: Watch, *, reads: bool) -> None:
    """One of them, until the time is over."""
    try:
        if kind in {"ws", "plain"}:
            await socket(url, watch, reads=reads, acknowledges=kind == "ws")
        else:
            await drained(url, watch)
    except TimeoutError:
        pass


def main(kind: str, url: str, seconds: str, viewers: str) -> None:
    """Look for as long as was asked."""
    watch = Watch(float(seconds))
    others = threading.Thread(target=lambda: asyncio.run(many(kind, url, watch, int(viewers) - 1)))
    others.start()
    if kind in {"ws", "plain"}:
        asyncio.run(one(kind, url, watch, reads=True))
    elif kind == "mjpeg":
        multipart(url, watch)
    else:
        film(url, watch)
    others.join()
    print(json.dumps(watch.ages), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
