"""Records the session in `session.py` at a rosbridge_server that runs with `robot.py` beside it.

    python tests/bridge/transcripts/record.py ws://127.0.0.1:9090 tests/bridge/transcripts/NAME.jsonl

A line for each frame, in the order in which they passed: `t` since the start [s], `link` the connection's number,
`from` who said it, and the `text` or the bytes in `base64`.
"""

from __future__ import annotations

import argparse
import asyncio
import base64
import contextlib
import itertools
import json
import sys
import time
from pathlib import Path
from typing import Any

from websockets.asyncio.client import connect
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))

from tests.bridge.transcripts.session import session


async def record(url: str) -> list[dict[str, Any]]:
    """Every frame that passed between our clients and the server at `url`."""
    lines: list[dict[str, Any]] = []
    numbers = itertools.count()
    start = time.monotonic()

    async def pass_on(number: int, who: str, source: Any, sink: Any) -> None:
        async for frame in source:
            said = {"text": frame} if isinstance(frame, str) else {"base64": base64.b64encode(frame).decode()}
            lines.append({"t": round(time.monotonic() - start, 3), "link": number, "from": who, **said})
            with contextlib.suppress(ConnectionClosed):
                await sink.send(frame)

    async def between(near: ServerConnection) -> None:
        number = next(numbers)
        async with connect(url, compression=None, proxy=None) as far:
            with contextlib.suppress(ConnectionClosed):
                ways = [pass_on(number, "client", near, far), pass_on(number, "server", far, near)]
                await asyncio.wait(
                    [asyncio.ensure_future(way) for way in ways], return_when="FIRST_COMPLETED"
                )

    async with serve(between, "127.0.0.1", 0, compression=None) as listening:
        port = next(iter(listening.sockets)).getsockname()[1]
        for name, value in (await session(f"ws://127.0.0.1:{port}", 1.0)).items():
            print(f"{name}: {value!r}"[:200])  # noqa: T201 - who records wants to see what came
    return lines


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("url")
    parser.add_argument("out", type=Path)
    asked = parser.parse_args()
    asked.out.write_text("".join(json.dumps(line) + "\n" for line in asyncio.run(record(asked.url))))
