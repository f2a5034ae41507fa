"""An asyncio loop whose time passes only when everything waits: an hour of timeouts takes no time."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any, TypeVar

T = TypeVar("T")


class VirtualLoop(asyncio.SelectorEventLoop):
    """Jumps to the next timer instead of waiting for it; sockets are never waited for."""

    def __init__(self) -> None:
        super().__init__()
        self._virtual = 1000.0
        select = self._selector.select

        def jump(timeout: float | None = None) -> Any:
            if timeout is None:
                raise RuntimeError("Everything waits and nothing will ever happen.")
            self._virtual += max(0.0, timeout)
            return select(0)

        self._selector.select = jump  # type: ignore[method-assign]

    def time(self) -> float:
        return self._virtual


def run(main: Coroutine[Any, Any, T]) -> T:
    """Run `main` to its end in virtual time; its tasks are ended with it."""
    with asyncio.Runner(loop_factory=VirtualLoop) as runner:
        return runner.run(main)


def now() -> float:
    """The running loop's time [s]."""
    return asyncio.get_running_loop().time()
