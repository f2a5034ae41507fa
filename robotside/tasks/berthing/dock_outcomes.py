"""Sentences of how docking ended other than with a charge; all kinds of docks share them."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from robotside.core.notice import Notice

__all__ = ["blocked", "dead", "given_up", "missed", "no_contact", "not_in_time", "silent", "taken", "unseen"]


def taken(name: str) -> Notice:
    """Something stands where the robot would stand."""
    return Notice(Code.DOCK_TAKEN, f"{name} is taken: something stands in it.", place=name)


def unseen(name: str, *, by_laser: bool) -> Notice:
    """Nothing that looks like a dock is there."""
    what = "no two reflecting strips 0.30 m apart are" if by_laser else "no tag of a dock is"
    return Notice(Code.DOCK_UNSEEN, f"{name} is not seen: {what} where it should be.", place=name)


def blocked(name: str) -> Notice:
    """Something stands in the way up to it."""
    said = f"{name} cannot be reached: something stands before it."
    return Notice(Code.DOCK_BLOCKED, said, place=name)


def given_up(why: Notice, tries: int) -> Notice:
    """The last of so many `tries` ended for `why`."""
    return why.reworded(f"{str(why)[:-1]}; after {tries} tries the robot stands before it.")


def dead(name: str) -> Notice:
    """The charger gives nothing."""
    said = f"{name} gives no charge: the contacts meet, but no current flows; the robot stays there."
    return Notice(Code.DOCK_DEAD, said, place=name)


def silent(name: str, heard: float) -> Notice:
    """In contact, the battery was last heard so long ago [s]; infinite for never."""
    since = f"has said nothing for {heard:.0f} s" if heard < math.inf else "says nothing"
    said = f"{name} was reached, but the battery {since}, so nobody knows whether it charges; the robot stays there."
    return Notice(Code.CHARGE_UNKNOWN, said, place=name, seconds=heard)


def missed(name: str, aside: float) -> Notice:
    """Its front came out `aside` of the dock's line [m]."""
    said = f"No charge: the line to {name} was missed by {abs(aside) * 100:.0f} cm."
    return Notice(Code.DOCK_MISSED, said, place=name)


def no_contact(name: str, by: str) -> Notice:
    """It stands at the dock, and no battery takes charge; `by` is what it went by."""
    return Notice(Code.DOCK_MISSED, f"{name} was reached {by}, but its contacts did not meet.", place=name)


def not_in_time(name: str, seconds: float) -> Notice:
    """The approach took longer than `seconds` [s]."""
    return Notice(Code.DOCK_MISSED, f"{name} was not reached within {seconds:.0f} s.", place=name)
