"""The letters by which the places where a robot may be are called on the glass: the same on the map and on its card."""

from __future__ import annotations

from collections.abc import Sequence

from bridge.msgs.pilothouse_msgs import PlaceCandidate
from widgets.core.quantities import NO_BREAK

__all__ = ["candidate_letters", "share_words"]


def candidate_letters(candidates: Sequence[PlaceCandidate]) -> list[str]:
    """What each candidate is called: a letter that it keeps, or its number where two have the same letter."""
    letters = [chr(ord("A") + (each.id - 1) % 26) for each in candidates]
    unique = len(set(letters)) == len(letters)
    return letters if unique else [str(each.id) for each in candidates]


def share_words(share: float) -> str:
    """How likely a candidate is, 0 to 1, as in `61 %`."""
    return f"{100 * share:.0f}{NO_BREAK}%"
