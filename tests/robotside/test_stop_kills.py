"""`kill -9` of the real robot side right after it answered STOP: after the restart STOP is pressed.

It serves two robots, so that one start stands for two; they weigh nothing (`bench/support/bodies.py`), so that it starts soon.
"""

from __future__ import annotations

import asyncio
import json
import re
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from websockets.asyncio.client import connect

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
START_TIMEOUT = 60.0
"""How long the robot's process may take to start [s]."""
COMMAND = (
    "-m bench.support.bodies serve --robot sim:patrol,patrol --port 0 --http-port 0 --with-parent --state"
)
READY = re.compile(r"^robotside: ready bridge=\S*?:(\d+) http=\S*?:(\d+) ")


@asynccontextmanager
async def robot_side(state: Path) -> AsyncIterator[list[tuple[int, int]]]:
    """A robot side on what is kept in `state`, killed at the end; of each robot the ports of its bridge and its web site."""
    process = await asyncio.create_subprocess_exec(
        sys.executable, *COMMAND.split(), str(state), stdout=asyncio.subprocess.PIPE, cwd=ROOT
    )
    try:
        assert process.stdout is not None
        ports: list[tuple[int, int]] = []
        async with asyncio.timeout(START_TIMEOUT):
            while len(ports) < 2:
                line = (await process.stdout.readline()).decode()
                assert line, "it ended"
                if ready := READY.match(line):
                    ports.append((int(ready[1]), int(ready[2])))
        yield ports
    finally:
        process.kill()
        await process.wait()


async def by_bridge(port: int) -> bool:
    """Press STOP on the rosbridge socket; whether it was answered as done and saved, not as done and not saved yet."""
    async with connect(f"ws://127.0.0.1:{port}", max_size=None) as socket:
        await socket.send(json.dumps({"op": "call_service", "service": "/stop", "id": "stop"}))
        async for text in socket:
            told = json.loads(text)
            if told.get("id") == "stop":
                return bool(told["values"]["success"] and told["values"]["message"] == "Stopped.")
    return False


async def by_page(port: int) -> bool:
    """Press STOP on the web site; as above."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    request = (
        f"POST /stop HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"
    )
    writer.write(request.encode())
    answer = await reader.read()
    writer.close()
    return b" 200 " in answer and answer.endswith(b"Stopped.\n")


async def status(port: int) -> dict[str, Any]:
    """The first `/control/status` that it tells."""
    async with connect(f"ws://127.0.0.1:{port}", max_size=None) as socket:
        await socket.send(json.dumps({"op": "subscribe", "topic": "/control/status"}))
        async for text in socket:
            told = json.loads(text)
            if told["op"] == "publish":
                return dict(told["msg"])
    return {}


async def test_a_stop_that_was_answered_is_pressed_after_a_kill(tmp_path: Path) -> None:
    """Each way is the last before a kill once."""
    for last in ("bridge", "page"):
        async with robot_side(tmp_path / last) as ((bridge, _), (_, web)):
            for way in sorted(("bridge", "page"), key=lambda way: way == last):
                while not await (by_bridge(bridge) if way == "bridge" else by_page(web)):
                    continue  # the disk takes longer than the answer waits, and the answer said so
        async with robot_side(tmp_path / last) as ports:
            for bridge, _ in ports:
                assert (await status(bridge))["stopped"]
