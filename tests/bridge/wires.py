"""Doubles for the network: a clock that only the test moves, a record to wait on, a wire that can be cut or freeze."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Any

from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.core.robot_catalogue import Service
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from bridge.server.server import BridgeServer
from robotside.door.door import Door

TIMEOUT = 60.0
"""How long a test waits for what must happen [s]; a fault, not a delay, uses it up."""


class Clock:
    """Time that the test moves [s]."""

    def __init__(self, start: float = 1000.0) -> None:
        self.time = start

    def __call__(self) -> float:
        return self.time


async def until(true: Callable[[], object]) -> None:
    """Wait for what no event tells of."""
    async with asyncio.timeout(TIMEOUT):
        while not true():  # noqa: ASYNC110 - there is no event to wait for
            await asyncio.sleep(0.005)


async def arrived() -> None:
    """Whatever was on its way through this process has arrived: each turn of its loop takes what the sockets hold."""
    for _ in range(50):
        await asyncio.sleep(0)


class FakeNetwork:
    """A machine whose address and sleep the test decides."""

    def __init__(self) -> None:
        self.address: str | None = "192.168.1.20"
        """From which it reaches everybody."""
        self.kept = True
        """It still has the address of a connection that was opened before."""
        self.sleep = 0.0
        """[s]"""
        self.asked: list[tuple[str, int]] = []

    def source(self, address: tuple[str, int]) -> str | None:
        self.asked.append(address)
        return self.address

    def has(self, local: str) -> bool:
        return self.kept

    def slept(self) -> float:
        return self.sleep


class Record(list[Any]):
    """Keeps what it is called with and wakes who waits for it."""

    def __init__(self) -> None:
        super().__init__()
        self._changed = asyncio.Event()

    def __call__(self, *args: Any) -> None:
        self.append(args[0] if len(args) == 1 else args)
        self._changed.set()

    async def until(self, condition: Callable[[Record], bool]) -> Record:
        async with asyncio.timeout(TIMEOUT):
            while not condition(self):
                self._changed.clear()
                await self._changed.wait()
        return self

    async def reach(self, count: int) -> Record:
        return await self.until(lambda record: len(record) >= count)


class Link:
    """A running client and what it told."""

    def __init__(self, url: str, **options: Any) -> None:
        self.states = Record()
        options = {"backoff": (0.01, 0.02)} | options
        self.client = BridgeClient(url, on_state=self.states, **options)
        self.running = asyncio.create_task(self.client.run())

    async def sentence(self, phase: Phase) -> str:
        """Of the next state with this phase."""
        states = await self.states.until(lambda seen: any(state.phase is phase for state in seen))
        found: LinkState = next(state for state in states if state.phase is phase)
        states.clear()
        return found.sentence

    async def heard_at(self, time: float) -> None:
        """Something came when the client's clock showed `time`, or the link is lost."""
        beating = self.client._heartbeat
        assert beating is not None
        await until(lambda: beating.liveness._heard == time or self.client._heartbeat is not beating)

    async def connected(self) -> BridgeClient:
        await self.states.until(lambda _: self.client.state.phase is Phase.CONNECTED)
        self.states.clear()
        return self.client


@asynccontextmanager
async def link(url: str, **options: Any) -> AsyncIterator[Link]:
    """A client that runs until the end of the block."""
    made = Link(url, **options)
    try:
        yield made
    finally:
        await made.client.close()
        await made.running


def accept(session: Any, request: CommandRequest) -> CommandResponse:
    return CommandResponse(success=True, message=f"Accepted {request.command_id}.")


def service(name: str = "/stop", call: Callable[..., Any] = accept) -> Service:
    return Service(name, "pilothouse_msgs/Command", CommandRequest, CommandResponse, call)


def door(options: dict[str, Any]) -> Door:
    """The door of a robot with a STOP, made of those of the options that are a door's; the server's are left."""
    parts = ("services", "actions", "topics", "on_message", "on_demand", "on_gone", "now", "gate")
    own = {part: options[part] for part in parts if part in options}
    for part in own:
        if part != "now":
            del options[part]
    return Door(**{"services": [service()], "on_message": Record()} | own)


@asynccontextmanager
async def server(**options: Any) -> AsyncIterator[BridgeServer]:
    """A server on a free port of loopback."""
    port = options.pop("port", 0)
    made = BridgeServer(door(options), **options)
    await made.start(port=port)
    try:
        yield made
    finally:
        await made.close()


def url(made: BridgeServer | Wire) -> str:
    return f"ws://127.0.0.1:{made.port}"


class Wire:
    """A stretch of cable to a port: passes everything on until it is frozen or cut."""

    def __init__(self, to: int) -> None:
        self.port = 0
        self._to = to
        self._open: set[asyncio.StreamWriter] = set()
        self._tasks: set[asyncio.Task[None]] = set()
        self._thawed = asyncio.Event()
        self._thawed.set()

    def cut(self) -> None:
        """Every connection through it breaks; new ones may come."""
        for writer in self._open:
            writer.transport.abort()

    def freeze(self) -> None:
        """Nothing passes any more, and nobody is told."""
        self._thawed.clear()

    def thaw(self) -> None:
        """Everything that waited passes, late."""
        self._thawed.set()

    async def _join(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._open.add(writer)
        try:
            far_reader, far_writer = await asyncio.open_connection("127.0.0.1", self._to)
        except OSError:
            writer.close()
            return
        self._open.add(far_writer)
        for source, sink in ((reader, far_writer), (far_reader, writer)):
            self._tasks.add(asyncio.create_task(self._pump(source, sink)))

    def _joined(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._tasks.add(asyncio.create_task(self._join(reader, writer)))

    async def _pump(self, source: asyncio.StreamReader, sink: asyncio.StreamWriter) -> None:
        try:
            while data := await source.read(65536):
                await self._thawed.wait()
                sink.write(data)
                await sink.drain()
        except OSError:
            pass
        finally:
            sink.close()


@asynccontextmanager
async def wire(to: int) -> AsyncIterator[Wire]:
    made = Wire(to)
    listening = await asyncio.start_server(made._joined, "127.0.0.1", 0)
    made.port = listening.sockets[0].getsockname()[1]
    try:
        yield made
    finally:
        listening.close()
        made.cut()
        for task in made._tasks:
            task.cancel()
        await asyncio.gather(*made._tasks, return_exceptions=True)
        await listening.wait_closed()
