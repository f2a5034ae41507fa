"""The robot side that says how much it holds, `python -m bench.support.soak.counted serve …`.

Prints a line of JSON every ten seconds: `{"tasks": N, "late": SECONDS, "blocks": N}`: tasks of the serving loop, by how much
it was late at most since the line before, and blocks of memory that Python has handed out.
"""

from __future__ import annotations

import asyncio
import json
import sys
from collections.abc import Coroutine
from typing import Any

from robotside.__main__ import main

PERIOD = 10.0
"""[s]"""
LOOK_PERIOD = 0.1
"""[s]"""


async def _count() -> None:
    loop = asyncio.get_running_loop()
    while True:
        late, end = 0.0, loop.time() + PERIOD
        while (began := loop.time()) < end:
            await asyncio.sleep(LOOK_PERIOD)
            late = max(late, loop.time() - began - LOOK_PERIOD)
        counts = {"tasks": len(asyncio.all_tasks()), "late": late, "blocks": sys.getallocatedblocks()}
        print(json.dumps(counts), flush=True)


async def _beside(serving: Coroutine[Any, Any, Any]) -> Any:
    counting = asyncio.create_task(_count())
    try:
        return await serving
    finally:
        counting.cancel()


if __name__ == "__main__":
    run = asyncio.run
    asyncio.run = lambda serving, **options: run(_beside(serving), **options)  # type: ignore[assignment]
    sys.exit(main())
