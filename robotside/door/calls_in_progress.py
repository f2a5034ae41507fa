"""The calls that wait for their answer, counted for each operator and bounded in time."""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Awaitable

from bridge.core.errors import Refused
from bridge.msgs import Msg

__all__ = ["MAX_CALLS", "CallsInProgress"]

MAX_CALLS = 256
"""Calls of one operator that may wait for their answer at a time; urgent ones always may."""


class CallsInProgress:
    """Counts calls from their beginning to their answer."""

    def __init__(self) -> None:
        self._count: Counter[str] = Counter()

    def check_room(self, operator_id: str) -> None:
        """Raises Refused when the operator has MAX_CALLS in progress."""
        if self._count[operator_id] >= MAX_CALLS:
            raise Refused(f"{MAX_CALLS} calls of this client wait for their answer already.")

    async def answer(
        self, operator_id: str, service: str, answer: Awaitable[Msg], timeout: float | None
    ) -> Msg:
        """Wait for the answer of a call that `begin` counted; Refused when `timeout` [s] is over.

        None, NaN and what is not above 0 wait for as long as it takes.
        """
        deadline = asyncio.timeout(timeout if timeout and timeout > 0 else None)
        try:
            async with deadline:
                return await answer
        except TimeoutError:
            if not deadline.expired():
                raise
            raise Refused(f"{service} gave no answer within {timeout or 0:g} s.") from None
        finally:
            self._end(operator_id)

    def begin(self, operator_id: str) -> None:
        """A call begins whose answer comes later."""
        self._count[operator_id] += 1

    def forget(self, operator_id: str) -> None:
        """The operator is gone; nothing of it counts any more."""
        self._count.pop(operator_id, None)

    def _end(self, operator_id: str) -> None:
        if self._count[operator_id] > 1:
            self._count[operator_id] -= 1
        else:
            del self._count[operator_id]
