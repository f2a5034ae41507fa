"""A rosbridge server in a process of its own, `python -m bench.support.rosbridge ours|naive|bare [tls] [large]`, that publishes on command.

`naive` is the simplest server that works: the standard library's json, encoded anew for each client, sent by
`websockets.broadcast`; `bare` is the same with texts that were encoded before. With `tls` it is reached by wss alone, with a
certificate as robots make it; `large` makes the scan 45 kB. Prints `{"port": PORT}`; then each line of JSON on the standard input is answered by one:

- `{"do": "publish", "topic": T, "count": N, "step": M}`: publishes N messages, M in each step of the loop;
  `{"cpu": SECONDS}` is the process's own time meanwhile and shortly after, less what so long a wait costs it anyhow;
- `{"do": "flow", "rates": {T: HZ}}`: publishes so often from now on, nothing else any more;
- `{"do": "cpu"}`: `{"cpu": SECONDS}` since the start, user and system;
- `{"do": "commands"}`: `{"commands": [[ARRIVED, NUMBER]…]}`: when which `linear.x` came on /cmd_vel, `time.monotonic()`.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import ssl
import sys
import tempfile
import time
from collections.abc import AsyncIterator, Callable, Mapping
from pathlib import Path
from typing import Any, Protocol

from websockets.asyncio.connection import broadcast
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from bench.support.traffic import LARGE_SCAN, MESSAGES, SCAN
from bridge.codec import to_json
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from bridge.server.server import BridgeServer
from robotside.door.door import Door
from robotside.trust.certificate import own_certificate

SETTLE = 0.05
"""After the last message until the time is taken [s]: what waited has left."""


class Speaker(Protocol):
    """A running server."""

    port: int

    def publish(self, topic: str) -> None:
        """Send the usual message of a topic to all who want it."""


class Ours:
    """The project's own server."""

    def __init__(self, server: BridgeServer) -> None:
        self.port = server.port
        self._server = server

    def publish(self, topic: str) -> None:
        """The robot itself publishes."""
        self._server.publish(topic, MESSAGES[topic])


class Naive:
    """One `json.dumps` a client and message."""

    def __init__(self) -> None:
        self.port = 0
        self._watchers: dict[str, set[ServerConnection]] = {}
        self._plain = {topic: json.loads(to_json(msg)) for topic, msg in MESSAGES.items()}

    async def serve(self, ws: ServerConnection) -> None:
        """Hear one client until it leaves."""
        with contextlib.suppress(ConnectionClosed):
            async for raw in ws:
                op = json.loads(raw)
                if op["op"] == "subscribe":
                    self._watchers.setdefault(op["topic"], set()).add(ws)
                elif op["op"] == "publish":
                    self._pass_on(op["topic"], op["msg"])
                elif op["op"] == "call_service":
                    answer = {
                        "op": "service_response",
                        "id": op["id"],
                        "service": op["service"],
                        "result": True,
                    }
                    broadcast([ws], json.dumps({**answer, "values": {"success": True}}))
        for watchers in self._watchers.values():
            watchers.discard(ws)

    def publish(self, topic: str) -> None:
        """The server itself publishes."""
        self._pass_on(topic, self._plain[topic])

    def _pass_on(self, topic: str, msg: Any) -> None:
        for ws in self._watchers.get(topic, ()):
            broadcast([ws], json.dumps({"op": "publish", "topic": topic, "msg": msg}))


class Bare(Naive):
    """Sends texts that were encoded before."""

    def __init__(self) -> None:
        super().__init__()
        self._texts = {
            topic: json.dumps({"op": "publish", "topic": topic, "msg": msg})
            for topic, msg in self._plain.items()
        }

    def publish(self, topic: str) -> None:
        """As it is, to each."""
        for ws in self._watchers.get(topic, ()):
            broadcast([ws], self._texts[topic])


class Commands(list[tuple[float, float]]):
    """When which drive command came."""

    def handle(self, session: Operator, topic: str, msg: Any, stamp: float | None) -> None:
        """Note it."""
        if topic == "/cmd_vel":
            self.append((time.monotonic(), msg.linear.x))


def _stop(*_: object) -> CommandResponse:
    return CommandResponse(success=True, message="Stopped.")


@contextlib.asynccontextmanager
async def ours(commands: Commands, tls: ssl.SSLContext | None) -> AsyncIterator[Speaker]:
    """Serve with the robot's own table of topics and a STOP."""
    stop = Service("/stop", "pilothouse_msgs/Command", CommandRequest, CommandResponse, _stop)
    server = BridgeServer(Door(services=[stop], on_message=commands.handle))
    await server.start(port=0, tls=tls)
    try:
        yield Ours(server)
    finally:
        await server.close()


@contextlib.asynccontextmanager
async def naive(made: Naive, tls: ssl.SSLContext | None) -> AsyncIterator[Speaker]:
    """Serve the simple way."""
    options: dict[str, Any] = {"compression": None, "max_size": None, "ssl": tls}
    async with serve(made.serve, "127.0.0.1", 0, **options) as server:
        made.port = next(iter(server.sockets)).getsockname()[1]
        yield made


async def flow(publish: Callable[[str], None], topic: str, rate: float) -> None:
    """Publish on one topic `rate` times a second until cancelled; up to a second that was missed is made up for."""
    loop = asyncio.get_running_loop()
    due = loop.time()
    while True:
        publish(topic)
        due = max(due + 1 / rate, loop.time() - 1)
        await asyncio.sleep(max(0.0, due - loop.time()))


async def burst(publish: Callable[[str], None], asked: Mapping[str, Any]) -> float:
    """The process's own time [s] that publishing takes, without what waiting for the last message costs by itself."""
    topic, step = asked["topic"], asked["step"]
    rested = time.process_time()
    await asyncio.sleep(SETTLE)
    began = time.process_time()
    for _ in range(asked["count"] // step):
        for _ in range(step):
            publish(topic)
        await asyncio.sleep(0)
    await asyncio.sleep(SETTLE)
    return time.process_time() - began - (began - rested)


async def run(kind: str, *, encrypted: bool) -> None:
    """Serve until the standard input ends."""
    commands = Commands()
    flows: list[asyncio.Task[None]] = []
    tls = _certified() if encrypted else None
    ways = {
        "ours": lambda: ours(commands, tls),
        "naive": lambda: naive(Naive(), tls),
        "bare": lambda: naive(Bare(), tls),
    }
    async with ways[kind]() as speaker:
        _print({"port": speaker.port})
        while line := await asyncio.to_thread(sys.stdin.readline):
            asked = json.loads(line)
            if asked["do"] == "publish":
                _print({"cpu": await burst(speaker.publish, asked)})
            elif asked["do"] == "flow":
                await _end(flows)
                flows[:] = [
                    asyncio.create_task(flow(speaker.publish, topic, rate))
                    for topic, rate in asked["rates"].items()
                ]
                _print({})
            elif asked["do"] == "commands":
                _print({"commands": commands})
            else:
                _print({"cpu": time.process_time()})
        await _end(flows)


def _certified() -> ssl.SSLContext:
    with tempfile.TemporaryDirectory() as folder:
        return own_certificate(Path(folder)).context()


async def _end(flows: list[asyncio.Task[None]]) -> None:
    for each in flows:
        each.cancel()
    await asyncio.gather(*flows, return_exceptions=True)


def _print(value: object) -> None:
    print(json.dumps(value), flush=True)


if __name__ == "__main__":
    if "large" in sys.argv[2:]:
        MESSAGES[SCAN] = LARGE_SCAN
    asyncio.run(run(sys.argv[1], encrypted="tls" in sys.argv[2:]))
