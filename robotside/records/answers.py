"""Answers to commands that changed something: a command that is sent again after a crash is not done again."""

from __future__ import annotations

from robotside.records.database.rows import Answered
from robotside.records.ledger import Ledger

__all__ = ["MAX_ANSWERS", "Answers"]

MAX_ANSWERS = 256
"""Answers that are kept."""


class Answers:
    """The newest answers, kept in the transaction of the change that they answer."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger

    def all(self) -> list[Answered]:
        """Oldest first."""
        rows = self._ledger.rows("answers")
        return [rows[key] for key in sorted(rows)]

    def keep(self, answered: Answered) -> None:
        """Keep one with what is changed together with it.

        Where that is only facts it is one too: what was done is not refused because its answer could not be kept.
        """
        ledger = self._ledger
        with ledger.together() as job:
            number = ledger.count("last answer")
            change = ledger.order if job.orders else ledger.fact
            change("answers", number, answered)
            for old in sorted(ledger.rows("answers"))[:-MAX_ANSWERS]:
                ledger.fact("answers", old, None)
