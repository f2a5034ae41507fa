"""The kinds of robots, as `/robot/info` tells them, and what is different with each.

What else goes by the kind has a table of its own, since it is made of what is defined there: `guide.GOINGS`, `coursing.MANNERS`,
`tracks.HANDLING`, `safe_state.USUAL`. A test holds all of them to have every kind.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

__all__ = ["KINDS", "Kind", "kind_of", "unknown"]


@dataclass(frozen=True, slots=True)
class Kind:
    """What robots of one kind do and cannot do."""

    on_the_ground: bool = False
    """It drives by itself only while it sees what is in the way."""
    docks: bool = False
    """It can drive up to a charger."""
    dives: bool = False
    """It keeps a depth, and may lie any way up."""
    flies: bool = False
    """It keeps a height, goes where it leans to, and has to be kept where it is."""
    comes_about: bool = False
    """It turns only by going, however slowly."""
    at_rest: tuple[float, float] = (0.01, 0.03)
    """Measured speeds below which it stands still [m/s, rad/s]: what current, waves and wind carry never quite does."""
    astray: float = math.inf
    """Where it holds its place it comes back from farther away than this [m]."""


KINDS = {
    "wheels": Kind(on_the_ground=True, docks=True),
    "ackermann": Kind(on_the_ground=True),
    "boat": Kind(comes_about=True, at_rest=(0.15, 0.10), astray=4.0),
    "hexapod": Kind(dives=True, at_rest=(0.08, 0.08), astray=1.5),
    "quadrotor": Kind(flies=True, at_rest=(0.08, 0.08)),
}

_UNKNOWN = Kind(on_the_ground=True)


def kind_of(name: str) -> Kind:
    """What is so with a kind: one without a name is on wheels, and so is one that nobody knows, but for chargers."""
    return KINDS.get(name or "wheels", _UNKNOWN)


def unknown(name: str) -> str:
    """What is to be said of a kind that nobody knows, as one sentence; empty of the others."""
    if not name or name in KINDS:
        return ""
    return f"A robot of the kind {name!r} is not known here; it is driven as if on wheels. Known are {', '.join(KINDS)}."
