"""Names of targets: in words for the operator, and one that is the same in every session."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from kivy.uix.label import Label
from kivy.uix.widget import Widget

from widgets.parts.buttons import PushButton

__all__ = ["intent_of", "slug", "words_of"]

ICON_WORDS = {
    "add": "Zoom in",
    "remove": "Zoom out",
    "my_location": "Centre on the robot",
    "fit_screen": "Show all",
    "layers": "Other map",
    "undo": "Undo",
    "redo": "Redo",
    "arrow_back": "Back",
    "close": "Close",
    "delete": "Delete",
    "edit": "Edit",
    "more_vert": "More",
    "more_horiz": "More",
    "expand_more": "Unfold",
    "expand_less": "Fold",
    "chevron_left": "Before",
    "chevron_right": "Next",
    "arrow_upward": "Up",
    "arrow_downward": "Down",
}
"""Icon of a button without words to what it does."""
SAYS = ("scan_words", "text", "title", "words", "label", "hint_text", "question")
"""Properties that say what a widget is, the best first."""
INTENTS = {
    "pause": "pause",
    "resume": "resume",
    "go on": "resume",
    "go home": "go_home",
    "home": "go_home",
    "start": "start",
    "start patrol": "patrol",
    "patrol": "patrol",
    "end task": "end_task",
    "surface": "surface",
    "take off": "take_off",
    "land": "land",
    "lights": "lights",
    "snapshot": "snapshot",
    "take control": "take_control",
}
"""Words of a button to the intent that it is the button of."""
KINDS = {
    "StopButton": "Release STOP",
    "GridMap": "Map",
    "GeoMap": "Map",
    "Joystick": "Stick",
    "RudderThrottle": "Throttle and rudder",
    "LiftLever": "Lift",
    "TiltCircle": "Tilt circle",
    "GoalPad": "Goal",
    "CourseDial": "Course",
    "HeadingDial": "Heading",
    "ArmPanel": "Arm",
    "SheetGrip": "Sheet",
}
"""Class of what says nothing that would name it."""
OWNERS = ("RobotCard",)
"""Containers whose title says whose button it is."""
MAX_LETTERS = 60
"""Letters of what is said of one thing."""


def words_of(widget: Widget) -> str:
    """What a press on it would do, in words; its kind where it says nothing of itself."""
    if known := KINDS.get(type(widget).__name__):
        return known
    for name in SAYS:
        said = getattr(widget, name, "")
        if isinstance(said, str) and said.strip():
            return _cut(f"{_CLOCK.sub('', said).strip() or said} {_whose(widget)}")
    beside = " ".join(_labels(widget))
    if beside:
        return _cut(beside)
    icon = str(getattr(widget, "icon", "") or "").removesuffix("_fill")
    if not icon and isinstance(widget, Label):
        icon = str(getattr(widget, "name", "") or "")
    return ICON_WORDS.get(icon, icon.replace("_", " ").capitalize()) or _kind(widget)


def beside(widget: Widget) -> str:
    """What stands next to a thing that has no words of its own, such as the title of the row that a switch ends."""
    child, parent = widget, widget.parent
    while parent is not None and parent is not child and len(parent.children) < 2:
        child, parent = parent, parent.parent
    if parent is None or parent is child:
        return ""
    title = str(getattr(parent, "title", "") or "")
    said = title or " ".join(
        text for other in reversed(parent.children) if other is not child for text in _labels(other)
    )
    return _cut(said)


def intent_of(widget: Widget, words: str) -> str:
    """The intent that it is the button of; empty for none, as for what only chooses something of that name."""
    said = getattr(widget, "intent", "")
    if said or not isinstance(widget, PushButton):
        return str(said)
    return INTENTS.get(words.casefold(), "")


def slug(text: str) -> str:
    """Words as part of a name."""
    return re.sub(r"[^a-z0-9]+", "_", text.casefold()).strip("_")[:24]


_CLOCK = re.compile(r"\b\d+:\d\d(:\d\d)?\b")
"""What counts time: words that change with each second could never be pressed."""


def _whose(widget: Widget) -> str:
    parent = widget.parent
    while parent is not None and parent.parent is not parent:
        if type(parent).__name__ in OWNERS:
            return str(getattr(parent, "title", ""))
        parent = parent.parent
    return ""


def _labels(widget: Widget) -> Iterable[str]:
    """What can be read in it, without the signs of icons, the first few texts."""
    found: list[str] = []
    for one in widget.walk(restrict=True):
        if not isinstance(one, Label) or not one.opacity:
            continue
        text = str(one.text).strip()
        if text and (len(text) > 1 or text.isalnum()) and all(ord(letter) < 0xE000 for letter in text):
            found.append(text)
    return found[:2]


def _kind(widget: Any) -> str:
    parts = re.findall("[A-Z][a-z]*", type(widget).__name__)
    return " ".join(parts).capitalize()


def _cut(text: str) -> str:
    line = " ".join(text.replace("\u200a", "").split())
    return line if len(line) <= MAX_LETTERS else f"{line[: MAX_LETTERS - 1].rstrip()}…"
