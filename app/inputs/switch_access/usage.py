"""Counts of what is used how often: taken while the app runs, used from the next start on, so that nothing moves in a session."""

from __future__ import annotations

from collections.abc import Mapping

from app.core.checked_settings import number

__all__ = ["Usage"]

FADE = 0.9
"""Each start everything counts so much less than before: what is not used any more makes room."""
MIN_COUNT = 0.5
"""What counts less is forgotten."""
MAX_COUNT = 1e9
"""Nobody has done anything more often."""
PLACES, NAMES = 40, 80
"""So many places are remembered, and names in each; the most used ones stay."""


class Usage:
    """`frozen` is what was learned until the start; everything later is only counted."""

    def __init__(self, kept: object) -> None:
        """`kept` is what `save` gave; whatever in it is no count is left out."""
        self.frozen = _read(kept)
        self._now = {place: dict(names) for place, names in self.frozen.items()}

    def used(self, place: str, name: str, times: int = 1) -> None:
        """Something was done there; the place of an intent, whichever method asked for it, is `""`."""
        names = self._now.setdefault(place, {})
        names[name] = names.get(name, 0.0) + times

    def save(self) -> dict[str, dict[str, float]]:
        """For the next start."""
        busiest = sorted(self._now, key=lambda place: (place != "", -sum(self._now[place].values())))
        return {place: _most(self._now[place]) for place in busiest[:PLACES]}


def _most(names: Mapping[str, float]) -> dict[str, float]:
    return {name: round(names[name], 2) for name in sorted(names, key=lambda name: -names[name])[:NAMES]}


def _read(kept: object) -> dict[str, dict[str, float]]:
    if not isinstance(kept, Mapping):
        return {}
    found = {str(place): _counts(names) for place, names in list(kept.items())[:PLACES]}
    return {place: names for place, names in found.items() if names}


def _counts(names: object) -> dict[str, float]:
    if not isinstance(names, Mapping):
        return {}
    return {
        str(name): times * FADE
        for name, counted in list(names.items())[:NAMES]
        if (times := number(counted, MIN_COUNT / FADE, MAX_COUNT)) is not None
    }
