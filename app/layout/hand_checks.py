"""Checks of a control that a finger drives or asks with, the same on a drive screen and in a view."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Protocol

from app.layout.layout_faults import LayoutError, one_of
from app.layout.layout_tables import ACTIONS, PADS
from app.layout.layout_widgets import check_control, check_icon, confirms
from app.link.control_mixer import PARTS

__all__ = ["Check", "Hand", "check_hand", "check_hand_keys", "refuse"]

Check = Callable[..., bool]
"""Checks one key of a table: the key, the check and what that takes; whether nothing is wrong with it."""


class Hand(Protocol):
    """A control of either, as far as these checks need it; its keys are those of `app.layout.layout_tables.Control`."""

    @property
    def widget(self) -> str:
        """Name in the widget catalogue."""

    @property
    def topics(self) -> tuple[str, ...]:
        """What it shows beside what it says."""

    @property
    def forward(self) -> str:
        """What it says when it is pushed away from the operator."""

    @property
    def left(self) -> str:
        """What it says when it is pushed to the left."""

    @property
    def pad(self) -> str:
        """The stick of a gamepad that pushes it too."""

    @property
    def action(self) -> str:
        """What it does once, of one that does."""

    @property
    def icon(self) -> str:
        """Name of its icon; empty for the usual one."""


def check_hand_keys(check: Check, where: str, made: Hand) -> None:
    """What its keys say is known."""
    check("forward", one_of, where, "forward", made.forward, PARTS)
    check("left", one_of, where, "left", made.left, ("", *PARTS))
    check("pad", one_of, where, "pad", made.pad, ("", *PADS))
    if made.action:
        check("action", one_of, where, "action", made.action, ACTIONS)
    if made.icon:
        check("icon", check_icon, where, made.icon)


def check_hand(check: Check, where: str, made: Hand, widgets: Iterable[str]) -> None:
    """Its widget is one that a finger drives or asks with, and has an action where that is what it does."""
    if not check("widget", check_control, where, made.widget, made.topics, widgets):
        return
    if confirms(made.widget):
        check("action", one_of, where, "action", made.action or None, ACTIONS)
    elif made.action:
        check("action", refuse, f"{where}: {made.widget} confirms nothing, so it has no action.")


def refuse(sentence: str) -> None:
    """Raise LayoutError with that sentence."""
    raise LayoutError(sentence)
