"""Search of the widget tree for what takes a finger now: in sight or to be scrolled to, enabled, not covered."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from kivy.core.window import Window
from kivy.uix.scrollview import ScrollView
from kivy.uix.widget import Widget

from app.inputs.switch_access.window.kinds import kind_of
from widgets.core.language import mark, tr

__all__ = ["Box", "Found", "find", "in_window"]

Box = tuple[float, float, float, float]
"""Left, low, right and top [px, window]."""
SPOTS = (
    (0.5, 0.5),
    (0.15, 0.5),
    (0.85, 0.5),
    (0.5, 0.15),
    (0.5, 0.85),
    (0.1, 0.1),
    (0.9, 0.1),
    (0.1, 0.9),
    (0.9, 0.9),
)
"""Where a finger would be tried, in shares of width and height."""
LINE = 0.5
"""Two things are in one row where their middles are no farther apart than this share of the lower one's height."""
WHOLE = ("press", "hold", "step", "field", "stick", "area", "slide", "fader", "handle", "map")
"""Kinds that keep a finger to themselves: what lies below them takes none there."""

GROUPS = {
    "TopBar": mark("Top bar"),
    "Rail": mark("Screens"),
    "Notices": mark("Messages"),
    "StopList": "STOP ALL",
    "ActionColumn": mark("Actions"),
    "ActionButtons": mark("Actions"),
    "ActButtons": mark("Task"),
    "TaskButtons": mark("Task"),
    "MissionPanel": mark("Panel"),
    "OrderPane": mark("Order"),
    "SettingsPane": mark("Settings"),
    "PlacePane": mark("Place"),
    "MissionPane": mark("Missions"),
    "NowList": mark("Now"),
    "EventList": mark("Events"),
    "EventLog": mark("Events"),
    "TaskTabs": mark("Pages"),
    "Segmented": mark("Choice"),
    "Stepper": mark("Number"),
    "RobotCard": mark("Robot"),
    "QuestionCard": mark("Question"),
    "HandoverCard": mark("Control"),
    "ModeCard": mark("Mode"),
    "PausedCard": mark("Paused"),
    "SelectionBar": mark("Selection"),
    "SpeedCard": "Speed",
    "ArmPanel": mark("Arm"),
    "CheckCard": mark("Checks"),
    "CheckList": mark("Checks"),
    "TopicDetail": mark("Topic"),
    "IntentCard": mark("Asked"),
}
"""Class of a container to what its members have in common."""


@dataclass(slots=True)
class Found:
    """One thing that takes a finger."""

    widget: Any
    kind: str
    """As in `app.inputs.switch_access.window.kinds`."""
    box: Box
    """Where it is; of what must be scrolled to, where it would be."""
    group: tuple[str, ...]
    path: tuple[str, ...]
    """Ids of what it is in and its own, outermost first; empty ids left out."""
    scrolled: bool = False
    """It is in something that scrolls."""


def in_window(widget: Widget) -> Box:
    """Where a widget is [px, window]."""
    left, low = widget.to_window(*widget.pos)
    right, top = widget.to_window(widget.right, widget.top)
    return left, low, right, top


def find(roots: list[Any], over: Any = None) -> list[Found]:
    """All that takes a finger in these, in the order of their places; each lies on top of those that come after it.

    `over` is the one of them that lies on top of all, wherever it comes.
    """
    found: list[Found] = []
    top = list(_walk(over, _Where(window()))) if over is not None else []
    for root in roots:
        known = {id(one.widget) for one in found}
        here = [one for one in _walk(root, _Where(window())) if id(one.widget) not in known]
        above = here if root is over else [*top, *found, *here]
        found += _in_rows([one for one in here if one.scrolled or _free(one, above)])
    return found


def window() -> Box:
    """The whole glass [px]."""
    return 0.0, 0.0, float(Window.width), float(Window.height)


@dataclass(frozen=True, slots=True)
class _Where:
    """What holds for everything in a container."""

    seen: Box
    group: tuple[str, ...] = ()
    path: tuple[str, ...] = ()
    scrolled: bool = False


def _walk(widget: Any, where: _Where) -> Iterator[Found]:
    """Topmost first, as fingers are offered."""
    if widget.disabled or not widget.opacity:
        return
    kind = kind_of(widget)
    box = in_window(widget)
    solid = box[2] - box[0] >= 1 and box[3] - box[1] >= 1
    if isinstance(widget, ScrollView):
        if not solid or not _overlap(box, where.seen):
            return
        inner = _Where(_cut(box, where.seen), where.group, where.path, scrolled=True)
    else:
        word = str(getattr(widget, "scan_group", "") or tr(GROUPS.get(type(widget).__name__, "")))
        inner = _Where(where.seen, (*where.group, word) if word else where.group, where.path, where.scrolled)
    ids = {id(_plain(one)): name for name, one in getattr(widget, "ids", {}).items()}
    for child in _plain(widget).children:
        own = ids.get(id(child), "")
        yield from _walk(
            child, _Where(inner.seen, inner.group, (*inner.path, own) if own else inner.path, inner.scrolled)
        )
    if kind and solid and (where.scrolled or _overlap(box, where.seen)):
        if kind == "scroll":  # after what is in it
            box = box[0], box[1], box[2], box[1] + 1
        yield Found(widget, kind, box, inner.group, where.path, where.scrolled)


def _plain(widget: Any) -> Any:
    """kv holds ids weakly."""
    return getattr(widget, "__self__", widget)


def _free(one: Found, all_: list[Found]) -> bool:
    """A finger finds a spot on it that nothing above it takes."""
    above = all_[: next(index for index, other in enumerate(all_) if other is one)]
    boxes = [other.box for other in above if other.kind in WHOLE and not _kin(other.widget, one.widget)]
    left, low, right, top = _cut(one.box, window())
    for across, up in SPOTS:
        x, y = left + across * (right - left), low + up * (top - low)
        if not any(box[0] <= x <= box[2] and box[1] <= y <= box[3] for box in boxes):
            return True
    return False


def _kin(one: Any, other: Any) -> bool:
    """One is in the other: what a container leaves free is its own."""
    return _holds(one, other) or _holds(other, one)


def _holds(one: Any, other: Any) -> bool:
    while other is not None and other.parent is not other:
        if other is one:
            return True
        other = other.parent
    return False


def _in_rows(found: list[Found]) -> list[Found]:
    """Neighbours of one container together; rows from the top, each from the left."""
    heads: dict[tuple[str, ...], list[Found]] = {}
    for one in found:
        heads.setdefault(one.group[:1] or ("",), []).append(one)
    places = sorted(heads.values(), key=lambda members: -max(one.box[3] for one in members))
    return [one for members in places for one in _rows(members)]


def _rows(members: list[Found]) -> list[Found]:
    ordered = sorted(members, key=lambda one: -(one.box[1] + one.box[3]))
    rows: list[list[Found]] = []
    for one in ordered:
        middle = (one.box[1] + one.box[3]) / 2
        if rows:
            first = rows[-1][0].box
            least = min(first[3] - first[1], one.box[3] - one.box[1])
            if abs((first[1] + first[3]) / 2 - middle) <= LINE * least:
                rows[-1].append(one)
                continue
        rows.append([one])
    return [one for row in rows for one in sorted(row, key=lambda one: one.box[0])]


def _overlap(one: Box, other: Box) -> bool:
    return one[0] < other[2] - 1 and other[0] < one[2] - 1 and one[1] < other[3] - 1 and other[1] < one[3] - 1


def _cut(one: Box, other: Box) -> Box:
    return max(one[0], other[0]), max(one[1], other[1]), min(one[2], other[2]), min(one[3], other[3])
