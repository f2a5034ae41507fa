"""Names of targets: in words for the operator, and one that is the same in every session."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from typing import Any

from kivy.uix.label import Label
from kivy.uix.widget import Widget

from widgets.core.language import language, mark, tr
from widgets.parts.buttons import PushButton

__all__ = ["intent_of", "slug", "words_of"]

ICON_WORDS = {
    "add": mark("Zoom in"),
    "remove": mark("Zoom out"),
    "my_location": mark("Centre on the robot"),
    "navigation": mark("North up"),
    "straighten": mark("Measure"),
    "fit_screen": mark("Show all"),
    "layers": mark("Other map"),
    "undo": mark("Undo"),
    "redo": mark("Redo"),
    "arrow_back": mark("Back"),
    "close": mark("Close"),
    "delete": mark("Delete"),
    "edit": mark("Edit"),
    "more_vert": mark("More"),
    "more_horiz": mark("More"),
    "expand_more": mark("Unfold"),
    "expand_less": mark("Fold"),
    "chevron_left": mark("Before"),
    "chevron_right": mark("Next"),
    "arrow_upward": mark("Up"),
    "arrow_downward": mark("Down"),
}
"""Icon of a button without words to what it does."""
SAYS = ("scan_words", "text", "title", "words", "label", "hint_text", "question")
"""Properties that say what a widget is, the best first."""
INTENTS = {
    mark("Pause"): "pause",
    mark("Resume"): "resume",
    mark("Go on"): "resume",
    mark("Go home"): "go_home",
    mark("Home"): "go_home",
    mark("Start"): "start",
    mark("Start patrol"): "patrol",
    mark("Patrol"): "patrol",
    mark("End task"): "end_task",
    mark("Surface"): "surface",
    mark("Take off"): "take_off",
    mark("Land"): "land",
    mark("Lights"): "lights",
    mark("Snapshot"): "snapshot",
    mark("Take control"): "take_control",
}
"""Words of a button to the intent that it is the button of."""
KINDS = {
    "StopButton": mark("Release STOP"),
    "GridMap": mark("Map"),
    "GeoMap": mark("Map"),
    "Joystick": mark("Stick"),
    "RudderThrottle": mark("Throttle and rudder"),
    "LiftLever": mark("Lift"),
    "TiltCircle": mark("Tilt circle"),
    "GoalPad": "Goal",
    "CourseDial": mark("Course"),
    "HeadingDial": mark("Heading"),
    "ArmPanel": mark("Arm"),
    "SheetGrip": mark("Sheet"),
}
"""Class of what says nothing that would name it."""
OWNERS = ("RobotCard",)
"""Containers whose title says whose button it is."""
MAX_LETTERS = 60
"""Letters of what is said of one thing."""


def words_of(widget: Widget) -> str:
    """What a press on it would do, in words; its kind where it says nothing of itself."""
    if known := KINDS.get(type(widget).__name__):
        return tr(known)
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
    return tr(ICON_WORDS.get(icon, icon.replace("_", " ").capitalize())) or _kind(widget)


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
    return _intents(language.name).get(words.casefold(), "")


@cache
def _intents(_name: str) -> dict[str, str]:
    """`INTENTS` in the language of that name, which is that of the glass."""
    return {tr(text).casefold(): intent for text, intent in INTENTS.items()}


def slug(text: str) -> str:
    """Words as part of a name."""
    return re.sub(r"\W+", "_", text.casefold()).strip("_")[:24]


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
