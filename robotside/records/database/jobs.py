"""Jobs for the writing thread: the rows of one transaction, and who waits for them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field

from robotside.core.notice import Notice
from robotside.records.database.rows import Put

__all__ = ["Job", "NotRecorded"]


class NotRecorded(Exception):
    """It was not recorded and is not remembered either, for the reason that its notice gives."""

    def __init__(self, notice: Notice) -> None:
        super().__init__(notice)
        self.notice = notice
        """One sentence for the operator, with its code."""


@dataclass(slots=True, eq=False)
class Job:
    """Rows that are written together or not at all."""

    orders: list[Put] = field(default_factory=list)
    """Changes that a client asked for: given up, with an answer, when they cannot be written."""
    facts: list[Put] = field(default_factory=list)
    """Facts: they stay in memory and are tried again if the disk fails."""
    then: list[Callable[[], object]] = field(default_factory=list)
    """Called once the orders are on the disk; never when they are not."""
    after: list[Callable[[], object]] = field(default_factory=list)
    """Called once it was tried, written or not."""
    done: bool = False
    """It was tried."""
    problem: str = ""
    """Why the orders are not on the disk, as one sentence; empty when they are or there were none."""
    trouble: str = ""
    """Why nothing of it is on the disk yet, orders or facts, as one sentence; empty when all is."""
    given_up: bool = False
    """The client that waited was answered that the outcome is unknown: if it is written after all, nothing may move for it."""
    urgent: bool = False
    """Its client waits for it, though it has no orders."""
    _waiting: list[asyncio.Future[None]] = field(default_factory=list)

    @property
    def puts(self) -> list[Put]:
        """All rows."""
        return self.orders + self.facts

    @property
    def binding(self) -> bool:
        """Nothing may be answered before it was tried."""
        return self.urgent or bool(self.orders)

    def settle(self, problem: str) -> None:
        """Note the outcome and answer those who wait."""
        self.done, self.trouble, self.problem = True, problem, problem if self.orders else ""
        for future in self._waiting:
            if not future.done():
                future.set_result(None)
        for call in (*(() if self.problem else self.then), *self.after):
            call()

    async def kept(self, patience: float) -> str:
        """Wait until it was tried; returns why the orders are not on the disk, empty when they are or there were none.

        After `patience` [s] the answer is that the outcome is unknown, and `trouble` says so.
        """
        if not self.done:
            future = asyncio.get_running_loop().create_future()
            self._waiting.append(future)
            try:
                async with asyncio.timeout(patience):
                    await future
            except TimeoutError:
                self.given_up = True
                self.trouble = (
                    f"The database has not answered for {patience:g} s; it may or may not be stored."
                )
                return self.trouble if self.orders else ""
        return self.problem
