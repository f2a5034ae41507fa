"""The seam between the writing thread and a kind of database."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from bridge.core.errors import BridgeError
from robotside.records.database.audit_rows import Audited
from robotside.records.database.rows import Content, Put

__all__ = ["CannotOpen", "Opened", "Store"]


class CannotOpen(BridgeError):
    """There are no records to work with; the text is one sentence."""

    def __init__(self, said: str, *, around: bool = False) -> None:
        super().__init__(said)
        self.around = around
        """The robot could be served without them: it is the disk or a permission that is in the way."""


class Opened(NamedTuple):
    """A database that was opened, with all that is in it."""

    content: Content
    problems: list[str]
    """Sentences for the operator."""
    skip: int
    """Numbers of events to leave out: they may have been published and are not in it."""


class Store:
    """The database as the writing thread uses it."""

    def open(self) -> Opened:
        """Read all that it has. Raises CannotOpen and NotWritten."""
        raise NotImplementedError

    def write(self, puts: list[Put]) -> None:
        """Write rows, all or none. Raises NotWritten."""
        raise NotImplementedError

    def rebuild(self, puts: list[Put]) -> str:
        """Start fresh in the place of a broken database, with these rows; returns what was done, as one sentence.

        Raises NotWritten.
        """
        raise NotImplementedError

    def audit(self) -> Iterable[Audited]:
        """The rows of the audit log that are on the disk, oldest first; from any thread. Raises NotWritten."""
        return ()

    def back_up(self) -> None:
        """Make a backup. Raises NotWritten."""

    def backup_age(self) -> float:
        """Of the newest backup [s]; infinite when there is none."""
        return math.inf

    def close(self) -> None:
        """Let go of everything."""
