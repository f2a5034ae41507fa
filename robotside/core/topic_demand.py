"""The demand for on-demand topics: the robot makes one while at least one client wants it."""

from __future__ import annotations

from collections.abc import Callable, Hashable

__all__ = ["Demand"]


class Demand:
    """Calls the robot when the first client wants a topic, and when the last one does no longer."""

    def __init__(self, want: Callable[[str, bool], None]) -> None:
        self._want = want
        self._askers: dict[str, set[Hashable]] = {}

    def set(self, topic: str, asker: Hashable, wanted: bool) -> None:
        """`asker` wants `topic` from now on, or no longer; saying it twice changes nothing.

        A robot that fails to make the topic leaves it unwanted, so that the next asker has it asked for again.
        """
        askers = self._askers.setdefault(topic, set())
        before = bool(askers)
        (askers.add if wanted else askers.discard)(asker)
        if bool(askers) != before:
            try:
                self._want(topic, bool(askers))
            except Exception:
                askers.discard(asker)
                raise
