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
        """`asker` wants `topic` from now on, or no longer; saying it twice changes nothing."""
        askers = self._askers.setdefault(topic, set())
        before = bool(askers)
        (askers.add if wanted else askers.discard)(asker)
        if bool(askers) != before:
            self._want(topic, bool(askers))
