"""Attackers of a robot side in a process of their own, `python -m bench.support.attack.attacker`.

One line of JSON on the standard input says what to do: `{"host": H, "bridge": PORT, "http": PORT, "frames": N, "requests": M,
"seed": S, "first": A, "token": T}`. Three of ten connections are by TLS, and each comes from an address of its own (127.0.0.A and on; other hosts than
loopback see the machine's own). It goes on beyond these numbers until a second line
comes. A line `{"frames": …, "requests": …, "connections": …, "refused": …}` follows each second, with
`"done": true` the last one.

A frame counts when the robot has read it: a ping goes behind every hundred, and its pong must come, or the robot has ended the
connection. A request counts when it was answered or its connection was ended.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import random
import sys
from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from websockets.client import ClientProtocol
from websockets.frames import Frame, Opcode
from websockets.uri import parse_uri

from bench.support.attack.frames import BREAKING, hostile
from bench.support.attack.requests import hostile_handshake, hostile_request
from bridge.client.tls import context

__all__ = ["Attack"]

WEBSOCKETS, BROWSERS = 10, 16
"""Connections at a time in one process."""
BATCH = 100
TLS_SHARE = 0.3
"""Of the connections."""
BREAKING_SHARE = 0.15
"""Of the batches that end with bytes after which a connection is of no use."""
ANSWER_TIMEOUT = 5.0
"""As long an answer may take until the next one is tried [s]."""
HOLD_TIME = 1.0
"""A connection that says half a thing waits so long for what becomes of it [s]."""
REFUSED_PAUSE = 0.02
"""After a connection that was not let in [s]."""
REPORT_PERIOD = 1.0
KEPT_ALIVE = 20
"""Requests on one connection at most."""


class Attack:
    """What one process does, and how much of it is done."""

    def __init__(self, asked: Mapping[str, Any]) -> None:
        self._asked = asked
        self._rng = random.Random(asked["seed"])
        self._context = context()
        self._places = 0
        self.enough = False
        """It may end as soon as all was sent."""
        self.count = {"frames": 0, "requests": 0, "connections": 0, "refused": 0, "unanswered": 0}

    async def run(self) -> None:
        """Until all frames and requests were sent, and that is enough."""
        async with asyncio.TaskGroup() as group:
            for _ in range(WEBSOCKETS):
                group.create_task(self._until("frames", self._socket))
            for _ in range(BROWSERS):
                group.create_task(self._until("requests", self._browse))

    async def _until(self, counted: str, attack: Callable[[str], Awaitable[None]]) -> None:
        place = f"127.0.0.{self._asked['first'] + self._places}"
        self._places += 1
        while self._going_on(counted):
            try:
                await attack(place)
            except (OSError, EOFError, asyncio.IncompleteReadError, TimeoutError):
                self.count["refused"] += 1
                await asyncio.sleep(REFUSED_PAUSE)

    def _going_on(self, counted: str) -> bool:
        return not self.enough or self.count[counted] < self._asked[counted]

    async def _open(self, place: str, port: int) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
        host = self._asked["host"]
        local = (place, 0) if host.startswith("127.") else None
        self.count["connections"] += 1
        tls = self._context if self._rng.random() < TLS_SHARE else None
        async with asyncio.timeout(ANSWER_TIMEOUT):
            return await asyncio.open_connection(host, port, ssl=tls, local_addr=local)

    async def _socket(self, place: str) -> None:
        """One connection to the rosbridge socket: floods it, or does not even shake hands."""
        reader, writer = await self._open(place, self._asked["bridge"])
        try:
            if self._rng.random() < BREAKING_SHARE:
                writer.write(hostile_handshake(self._rng))
                self.count["frames"] += 1
                await _ended(reader, HOLD_TIME)
                return
            talk = await _Talk.begin(reader, writer, self._asked)
            while self._going_on("frames"):
                data, number = hostile(self._rng, BATCH)
                self.count["frames"] += await talk.send(data, number)
                if self._rng.random() < BREAKING_SHARE:
                    writer.write(self._rng.choice(list(BREAKING.values()))(self._rng))
                    self.count["frames"] += 1
                    await _ended(reader, HOLD_TIME * self._rng.random())
                    return
        finally:
            writer.transport.abort()

    async def _browse(self, place: str) -> None:
        """One connection to the web site, with several requests as long as it is let."""
        reader, writer = await self._open(place, self._asked["http"])
        try:
            for _ in range(KEPT_ALIVE):
                writer.write(hostile_request(self._rng))
                try:
                    async with asyncio.timeout(
                        ANSWER_TIMEOUT if self._rng.random() < 0.02 else HOLD_TIME / 4
                    ):
                        going_on = await _answer(reader)
                except TimeoutError:
                    self.count["unanswered"] += 1  # half a request: it waits for the rest
                    going_on = False
                self.count["requests"] += 1
                if not going_on:
                    return
        finally:
            writer.transport.abort()


class _Talk:
    """A WebSocket connection that was agreed to."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, url: str) -> None:
        self._reader, self._writer = reader, writer
        self._protocol = ClientProtocol(parse_uri(url), max_size=None)

    @classmethod
    async def begin(
        cls, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, asked: Mapping[str, Any]
    ) -> _Talk:
        """Shake hands. EOFError when that is refused."""
        scheme = "ws" if writer.get_extra_info("ssl_object") is None else "wss"
        talk = cls(reader, writer, f"{scheme}://{asked['host']}:{asked['bridge']}")
        request = talk._protocol.connect()
        if asked.get("token"):
            request.headers["Authorization"] = f"Bearer {asked['token']}"
        talk._protocol.send_request(request)
        writer.writelines(talk._protocol.data_to_send())
        async with asyncio.timeout(ANSWER_TIMEOUT):
            while not talk._protocol.events_received():
                await talk._read()
        if talk._protocol.handshake_exc is not None:
            raise EOFError
        return talk

    async def send(self, data: bytes, number: int) -> int:
        """Send so many frames; how many of them the robot has read for sure. EOFError when it ended the connection."""
        self._writer.write(data + Frame(Opcode.PING, b"?").serialize(mask=True))
        pong = False
        async with asyncio.timeout(ANSWER_TIMEOUT * 4):
            while not pong:
                await self._read()
                frames = self._protocol.events_received()
                pong = any(
                    isinstance(each, Frame) and each.opcode is Opcode.PONG and each.data == b"?"
                    for each in frames
                )
        return number

    async def _read(self) -> None:
        data = await self._reader.read(1 << 16)
        if not data:
            raise EOFError
        self._protocol.receive_data(data)
        self._writer.writelines(each for each in self._protocol.data_to_send() if each)


async def _ended(reader: asyncio.StreamReader, patience: float) -> None:
    """Wait until the other end has closed, but no longer than that [s]."""
    with contextlib.suppress(TimeoutError, OSError):
        async with asyncio.timeout(patience):
            while await reader.read(1 << 16):
                pass


async def _answer(reader: asyncio.StreamReader) -> bool:
    """Read one answer; whether another request may follow on this connection."""
    try:
        head = await reader.readuntil(b"\r\n\r\n")
    except (asyncio.IncompleteReadError, asyncio.LimitOverrunError, OSError):
        return False
    lines = head.lower().split(b"\r\n")
    lengths = [line.partition(b":")[2] for line in lines if line.startswith(b"content-length:")]
    if not lengths or b"connection: close" in lines or b" 200 " not in lines[0]:
        return False
    with contextlib.suppress(asyncio.IncompleteReadError, OSError):
        await reader.readexactly(int(lengths[0]))
        return True
    return False


async def _report(attack: Attack) -> None:
    while True:
        await asyncio.sleep(REPORT_PERIOD)
        print(json.dumps(attack.count), flush=True)


async def _listen(attack: Attack) -> None:
    await asyncio.to_thread(sys.stdin.readline)
    attack.enough = True


async def _main() -> None:
    attack = Attack(json.loads(sys.stdin.readline()))
    beside = [asyncio.create_task(_report(attack)), asyncio.create_task(_listen(attack))]
    try:
        await attack.run()
    finally:
        for task in beside:
            task.cancel()
    print(json.dumps({**attack.count, "done": True}), flush=True)


if __name__ == "__main__":
    asyncio.run(_main())
