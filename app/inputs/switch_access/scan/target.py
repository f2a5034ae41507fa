"""Targets of the scan, the mark on them, and the window as the scan sees it.

    targets ─ plan (a tree of groups, the frequent cheap) ─ scan (which one is marked) ─ ring
    presses (keys, pads, switch boxes ─ clean presses of A and B) ─┘        STOP goes past all of it

Two halves that know each other by this file only. The *engine* (`presses`, `plan`, `scan`, `switches`) is pure but for the
last, knows no widget, and asks the `Glass` what there is; the *glass* (`targets.WindowTargets(app)`, `ring`) knows the widgets, draws
the mark, and knows nothing of switches. Everything in the UI thread.

STOP is never a target: B held, or A and B together, is STOP on every screen whatever is marked. So nothing may need B to be
held: what drives is a target that drives for a moment, is pressed again to go on, and rests as soon as the mark moves. And
nothing may be done at the press of B, which may become STOP: whatever it does is done when it is let go.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

__all__ = ["Glass", "Mark", "Target"]


@dataclass(frozen=True, slots=True)
class Target:
    """One thing that can be done on the glass now."""

    name: str
    """What it is, the same in every session, as `drive.action.task.go_home`: how often it is used is kept under it. Unique
    within a place; what a list brings forth is named by its kind and its place in the list, not by its contents."""
    words: str
    """What it would do now, as said and spoken: `Go home`. Half a second after they change no press is taken."""
    act: Callable[[], None]
    """Do it, once, as a finger's press and release would."""
    repeatable: bool = False
    """Done several times in a row, as a step of a slider: the mark stays on it."""
    group: tuple[str, ...] = ()
    """Containers that it is in, outermost first, in words: `("Top bar",)`. Neighbours of one container stay together."""
    fixed: bool = False
    """Its innermost group stays as it is given, in its order and however large, as a row of a keyboard."""
    weight: float = 1.0
    """How much more likely than its neighbours it is before anything has been learned; above 0."""
    intent: str = ""
    """The intent that it is the button of, if any: refused where the operator has forbidden it to the switches."""
    key: object = None
    """Whatever the glass needs to find it again, as its widget; nothing to the engine."""


@dataclass(frozen=True, slots=True)
class Mark:
    """What stands out now."""

    targets: tuple[Target, ...]
    """One, or all those of a group."""
    kind: Literal["item", "group", "back"]
    """B does it, goes into the group, or goes back up out of the group whose targets these are."""
    words: str
    """What to say of it: the target's words, or those of a group's targets."""
    position: int = 0
    """Its number among those stepped over on this level, from 0."""
    count: int = 1
    """How many those are."""
    step: int = 0
    """Grows with each step that is taken: a mark with the same number is the same one, shown again after the glass changed."""
    until: float = float("nan")
    """When the mark moves on by itself [s, monotonic]; NaN where it waits for a press."""


class Glass(Protocol):
    """What the engine asks of the screen, and tells it."""

    @property
    def place(self) -> str:
        """The screen or the dialog on top, as `drive` or `dialog.confirm`: what is learned is learned for each of them.

        Another place begins at its first group.
        """
        ...

    def targets(self) -> Sequence[Target]:
        """All that can be done now, in the order of their places (rows from the top, from the left), never STOP.

        Those of what lies on top alone where a card or dialog keeps a finger from the rest. Disabled ones are left out, those that
        must be scrolled to are in. Asked before each press is acted upon, and about four times a second while something is marked.
        """
        ...

    def mark(self, mark: Mark | None) -> None:
        """Show it, scrolled into view, above everything but never over STOP; None: nothing stands out.

        Whatever a target has set in motion for a moment comes to rest when another one is marked.
        """
        ...
