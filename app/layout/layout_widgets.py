"""Checks that the widget named by a layout can do what the layout wants of it; each fault is one sentence."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable
from typing import Any

import widgets
from app.layout.layout_faults import LayoutError
from bridge.core.toml_files import shown
from bridge.core.topics import topic
from bridge.msgs.geometry_msgs import PoseStamped
from widgets.controls.finger_grip import Grip
from widgets.controls.sticks.stick import Stick
from widgets.core.base import Control
from widgets.core.icons import ICONS

__all__ = [
    "check_control",
    "check_icon",
    "check_instrument",
    "check_shows",
    "confirms",
    "drives",
    "is_hand",
    "only_shows",
    "tells",
]

FIGURES, SENSES = "readouts", "senses"
"""Places for figures only, and for small sensors that look after themselves."""
FIGURE = "Readout"
"""The widget that shows a figure."""


def check_instrument(where: str, slot: str, name: str, topics: Iterable[str], known: Iterable[str]) -> None:
    """The widget of that name only shows, is of the kind that goes into `slot`, and shows those topics; `known`: all names."""

    def goes(one: str) -> bool:
        kind = getattr(widgets, one)
        if slot == FIGURES or one == FIGURE:
            return slot == FIGURES and one == FIGURE
        return only_shows(one) and (slot != SENSES or hasattr(kind, "card"))

    if not goes(name):
        raise LayoutError(f"{where}: an instrument in {slot} is one of {_listed(known, goes)}, not {name}.")
    check_shows(where, name, topics)


def check_control(where: str, name: str, topics: Iterable[str], known: Iterable[str]) -> None:
    """The widget of that name drives or asks for something by a finger, and shows those topics; `known`: all names."""
    if not is_hand(name):
        raise LayoutError(f"{where}: a control is one of {_listed(known, is_hand)}, not {name}.")
    check_shows(where, name, topics)


def confirms(name: str) -> bool:
    """The widget of that name does one action, once it is slid to its end."""
    return hasattr(getattr(widgets, name), "on_confirm")


def drives(name: str) -> bool:
    """The widget of that name says at every moment how the robot is to move."""
    return issubclass(getattr(widgets, name), Stick)


def check_icon(where: str, name: str) -> None:
    """There is a picture of that name."""
    if name not in ICONS:
        near = difflib.get_close_matches(name, ICONS, 3, 0.4)
        hint = f", as {', '.join(near)}" if near else ""
        raise LayoutError(f"{where}: icon is a name in widgets/core/icons.py{hint}, not {shown(name)}.")


def only_shows(name: str) -> bool:
    """The widget of that name shows messages, and commands nothing."""
    kind = getattr(widgets, name)
    return bool(kind.accepts) and not issubclass(kind, Control)


def tells(name: str) -> bool:
    """The widget of that name sends what a finger says to a topic of the robot's own, and does not drive."""
    kind = getattr(widgets, name)
    return issubclass(kind, Control) and kind.to_topic and hasattr(kind, "at_rest")


def is_hand(name: str) -> bool:
    """A screen knows what to do with it: it drives, is slid, or gives a course or a goal."""
    kind = getattr(widgets, name)
    asks = (
        hasattr(kind, "on_confirm") or hasattr(kind, "on_course") or PoseStamped in getattr(kind, "sends", ())
    )
    return drives(name) or (issubclass(kind, Grip) and asks)


def _listed(known: Iterable[str], able: Callable[[str], bool]) -> str:
    return ", ".join(sorted(name for name in known if able(name))) or "none"


def check_shows(where: str, widget: str, topics: Iterable[str]) -> None:
    """The widget of that name shows these topics of the table."""
    kind: Any = getattr(widgets, widget)
    for name in topics:
        wanted = topic(name).type
        if not issubclass(wanted, kind.accepts):
            allowed = ", ".join(one.MSGTYPE for one in kind.accepts) or "no topic"
            raise LayoutError(
                f"{where}: {kind.__name__} shows {allowed}, not {name}, which is {wanted.MSGTYPE}."
            )
