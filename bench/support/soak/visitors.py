"""Honest clients of every kind in a process of their own, `python -m bench.support.soak.visitors BRIDGE_URL SITE_URL`.

Ours and roslibpy watch for as long as it lasts; a browser reads the camera's stream and another asks pages; three are flaky: they come, watch
something and go, with a goodbye or without; one reads slowly. Each line of JSON on the standard input is answered by `{"gap":
SECONDS, "poses": N, "their_poses": N, "pictures": N, "pages": N, "visits": N, "slow": N, "faults": [TEXT…]}` of the time since the line
before; `gap` is the longest between two poses at ours.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import random
import sys
import threading
import time
from collections.abc import Awaitable, Callable
from typing import Any
from urllib.parse import urlsplit

import httpx
from websockets.asyncio.client import connect
from websockets.exceptions import WebSocketException

from bridge.client.remote_robot import RemoteRobot

__all__ = ["Visits"]

TOPICS = ("/pose", "/odom", "/scan", "/map", "/task/status", "/events", "/imu/data", "/control/status", "/tf")
PAGES = ("/", "/healthz", "/snapshot/camera.jpg?width=320")
STAY = (0.5, 8.0)
"""So long a flaky client stays [s]."""
FLAKY = 3
SLOW_PERIOD = 0.5
"""Between two messages that the slow reader takes [s]."""
PAGE_PERIOD = 2.0
AGAIN = 1.0
"""After a fault [s]."""
FAULTS = (OSError, httpx.HTTPError, WebSocketException, TimeoutError)


class Visits:
    """What the clients have seen."""

    def __init__(self, bridge: str, site: str) -> None:
        self._bridge, self._site = bridge, site
        self._rng = random.Random(5)
        self._lock = threading.Lock()
        self._count: dict[str, Any] = self._fresh()
        self._last: float | None = None

    @staticmethod
    def _fresh() -> dict[str, Any]:
        counted = ("poses", "their_poses", "pictures", "pages", "visits", "slow")
        return {"gap": 0.0, "faults": [], **dict.fromkeys(counted, 0)}

    def report(self) -> dict[str, Any]:
        """Since the last call."""
        with self._lock:
            if self._last is not None:
                self._count["gap"] = max(self._count["gap"], time.monotonic() - self._last)
            found, self._count = self._count, self._fresh()
        return found

    def add(self, name: str) -> None:
        """One more of those."""
        with self._lock:
            self._count[name] += 1

    def on_pose(self, _: object) -> None:
        """Ours has got a pose."""
        now = time.monotonic()
        with self._lock:
            if self._last is not None:
                self._count["gap"] = max(self._count["gap"], now - self._last)
            self._last = now
            self._count["poses"] += 1

    async def run(self) -> None:
        """All that are coroutines, until cancelled."""
        async with asyncio.TaskGroup() as group:
            for visit in (self._stream, self._browse, self._slow, *[self._flaky] * FLAKY):
                group.create_task(self._again(visit))

    async def _again(self, visit: Callable[[], Awaitable[None]]) -> None:
        while True:
            try:
                await visit()
            except FAULTS as fault:
                with self._lock:
                    self._count["faults"] = [*self._count["faults"], f"{visit.__name__}: {fault!r}"][-5:]
                await asyncio.sleep(AGAIN)

    async def _stream(self) -> None:
        async with (
            httpx.AsyncClient(base_url=self._site, timeout=30.0) as web,
            web.stream("GET", "/stream/camera.mjpeg?width=320&rate=5") as answer,
        ):
            answer.raise_for_status()
            async for piece in answer.aiter_bytes():
                for _ in range(piece.count(b"Content-Type: image/jpeg")):
                    self.add("pictures")

    async def _browse(self) -> None:
        async with httpx.AsyncClient(base_url=self._site, timeout=10.0) as web:
            for page in PAGES:
                (await web.get(page)).raise_for_status()
                self.add("pages")
                await asyncio.sleep(PAGE_PERIOD)

    async def _flaky(self) -> None:
        ws = await connect(self._bridge, compression=None, max_size=None, proxy=None)
        try:
            for topic in self._rng.sample(TOPICS, 3):
                await ws.send(json.dumps({"op": "subscribe", "topic": topic}))
            await ws.send(json.dumps({"op": "call_service", "service": "/rosapi/topics", "id": "a"}))
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(self._rng.uniform(*STAY)):
                    while True:
                        await ws.recv(decode=False)
            self.add("visits")
        finally:
            if self._rng.random() < 0.5:
                await ws.close()
            else:
                ws.transport.abort()

    async def _slow(self) -> None:
        async with connect(self._bridge, compression=None, max_size=None, max_queue=1, proxy=None) as ws:
            await ws.send(json.dumps({"op": "subscribe", "topic": "/scan"}))
            while True:
                await ws.recv(decode=False)
                self.add("slow")
                await asyncio.sleep(SLOW_PERIOD)


def _theirs(url: str, visits: Visits) -> Any:
    """One by roslibpy; what ends it, or None where it is not installed."""
    try:
        from roslibpy import Ros, Topic
    except ImportError:
        return None
    address = urlsplit(url)
    ros = Ros(address.hostname, address.port)
    ros.run()
    topic = Topic(ros, "/pose", "geometry_msgs/PoseWithCovarianceStamped")
    topic.subscribe(lambda _: visits.add("their_poses"))
    return ros.terminate


async def _answer(visits: Visits) -> None:
    running = asyncio.create_task(visits.run())
    print("[]", flush=True)
    while await asyncio.to_thread(sys.stdin.readline):
        print(json.dumps(visits.report()), flush=True)
    running.cancel()
    await asyncio.gather(running, return_exceptions=True)


def main(bridge: str, site: str) -> None:
    """Visit until the standard input ends."""
    visits = Visits(bridge, site)
    with RemoteRobot(bridge) as robot:
        robot.wait(10.0)
        robot.on("/pose", visits.on_pose)
        for topic in ("/scan", "/odom", "/events", "/task/status"):
            robot.on(topic, lambda _: None)
        end = _theirs(bridge, visits)
        asyncio.run(_answer(visits))
        if end is not None:
            end()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
