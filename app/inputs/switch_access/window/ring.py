"""The mark over what the switches would do: a thick frame with a shape of its own for a thing, a group and the way back.

It is drawn above everything else and takes no finger. It never covers STOP.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from kivy.graphics import Color, InstructionGroup, Line, Mesh, Rectangle, RoundedRectangle
from kivy.metrics import dp, sp

from app.inputs.switch_access.window.finding import Box
from app.inputs.switch_access.window.window_app import WindowApp
from widgets.core.base import text_texture
from widgets.core.language import tr
from widgets.core.theme import theme

__all__ = ["THICK", "Ring"]

THICK = 8.0
"""Of the frame [dp]."""
CASING = 2.0
"""Round the frame, so that it stands out on any ground [dp]."""
CORNER = 28.0
"""Length of the corners that frame a group [dp]."""
ARROW = 22.0
"""Of the arrow that points at a thing [dp]."""
FULL = 0.8
"""Things lie together that fill so much of the rectangle round them: it then holds nothing that is not marked."""
NEAR = 6
"""At so many frames of a group a place for its words is looked for."""
STOP_COUNTS = 1000.0
"""So much worse than on anything else are words on STOP."""
OWN_COUNTS = 30.0
"""So much worse than on anything else are words on what they name."""


class Ring:
    """`show` draws it; without boxes it is gone."""

    def __init__(self, app: WindowApp, stops: Callable[[], list[Box]]) -> None:
        """`app` is asked for its `root` and its size; `stops` says where STOP is [px]."""
        self._app, self._stops = app, stops
        self._group = InstructionGroup()
        self._shown: tuple[Any, ...] = ()
        self.box: Box | None = None
        """What holds all that is framed now [px, window]; None for nothing."""
        self.frames: list[Box] = []
        """Each frame: of things that lie together there is one."""
        self.said = ""
        """The words beside it."""

    def show(
        self,
        boxes: Sequence[Box],
        kind: str,
        words: str = "",
        others: Callable[[], Sequence[Box]] | None = None,
        *,
        named: bool = False,
    ) -> None:
        """Frame each of `boxes`, those that lie together as one; none means nothing is marked.

        `others` tells what else is read or pressed on the glass: the words beside the frame cover as little of it as they can.
        A thing has no words beside it unless it is to be `named`.
        """
        root = self._app.root
        box = _around(boxes, (0, 0, root.width, root.height)) if boxes else None
        shown = (tuple(boxes), kind, words, theme.name, named, (root.width, root.height))
        if shown == self._shown:
            return
        self._shown, self.box = shown, box
        self.said = words if kind != "item" or named else ""
        self.frames = []
        self._group.clear()
        if self._group not in root.canvas.after.children:
            root.canvas.after.add(self._group)
        if box is None:
            return
        parts = [self._outside_stop(part) for part in together(boxes)]
        self.frames = [self._clear_of_stop(part) for part in parts]
        for frame in self.frames:
            self._frame(frame, kind)
        if kind == "item":
            self._arrow(self.frames[0])
        if kind != "item" or named:
            self._chip(tr("Back") if kind == "back" else words, others() if others is not None else [])

    def _outside_stop(self, box: Box) -> Box:
        """The largest part of it that STOP does not lie on; STOP itself where that is what is marked."""
        for stop in self._stops():
            if not _meet(box, stop) or (
                box[2] - box[0] <= stop[2] - stop[0] and box[3] - box[1] <= stop[3] - stop[1]
            ):
                continue
            left, low, right, top = box
            parts = (
                (left, low, min(right, stop[0]), top),
                (max(left, stop[2]), low, right, top),
                (left, max(low, stop[3]), right, top),
                (left, low, right, min(top, stop[1])),
            )
            box = max(parts, key=_area)
        return box

    def _clear_of_stop(self, box: Box) -> Box:
        """The frame lies outside its box, and gives way where that would be on STOP."""
        out = dp(THICK + CASING)
        left, low, right, top = box[0] - out / 2, box[1] - out / 2, box[2] + out / 2, box[3] + out / 2
        for stop in self._stops():
            if (
                left - out / 2 < stop[2]
                and right + out / 2 > stop[0]
                and low - out / 2 < stop[3]
                and top + out / 2 > stop[1]
            ):
                if box[2] <= stop[0] + 1:
                    right = min(right, stop[0] - out / 2)
                elif box[0] >= stop[2] - 1:
                    left = max(left, stop[2] + out / 2)
                elif box[1] >= stop[3] - 1:
                    low = max(low, stop[3] + out / 2)
                elif box[3] <= stop[1] + 1:
                    top = min(top, stop[1] - out / 2)
        edge = out / 2
        root = self._app.root
        if box[0] < edge:
            right = min(right, box[2] - edge)  # at the glass's left edge names begin close behind
        return max(left, edge), max(low, edge), min(right, root.width - edge), min(top, root.height - edge)

    def _frame(self, box: Box, kind: str) -> None:
        left, low, right, top = box
        lines: list[dict[str, Any]]
        if kind == "group":
            lines = [{"points": points} for points in _corners(box, dp(CORNER))]
        elif kind == "back":
            lines = [{"rectangle": (left, low, right - left, top - low), "dash_offset": 0}]
        else:
            lines = [{"rounded_rectangle": (left, low, right - left, top - low, theme.corner)}]
        for role, wide in (
            ("surface", THICK + 2 * CASING),
            ("text", THICK + CASING),
            ("warn", THICK - CASING),
        ):
            self._group.add(Color(*theme.roles[role]))
            for line in lines:
                self._group.add(Line(width=dp(wide) / 2, cap="square", joint="miter", **_plain(line)))

    def _arrow(self, box: Box) -> None:
        """Points at the thing from the side that has room for it: what is marked is told by its shape too."""
        size = dp(ARROW)
        x, y = (box[0] - dp(THICK) / 2, (box[1] + box[3]) / 2)
        way = 1.0
        if x < size:
            x, way = box[0] + dp(THICK) / 2 + size, 1.0
        for role, grown in (("text", dp(CASING) * 1.6), ("warn", 0.0)):
            self._group.add(Color(*theme.roles[role]))
            back, half = x - way * (size + grown), size / 2 + grown
            points = [x + way * grown, y, 0, 0, back, y + half, 0, 0, back, y - half, 0, 0]
            self._group.add(Mesh(vertices=points, indices=[0, 1, 2], mode="triangles"))

    def _chip(self, words: str, others: Sequence[Box]) -> None:
        """What a press would do, at the side of a frame where it covers least of what else is there."""
        short = words if len(words) <= 48 else f"{words[:47].rstrip()}…"
        texture = text_texture(short, sp(15), theme.font, bold=True)
        wide, high = texture.width + dp(20), texture.height + dp(10)
        x, y = self._room_for(wide, high, others)
        self._group.add(Color(*theme.roles["text"]))
        self._group.add(RoundedRectangle(pos=(x, y), size=(wide, high), radius=[dp(6)]))
        self._group.add(Color(*theme.roles["surface"]))
        self._group.add(Rectangle(pos=(x + dp(10), y + dp(5)), size=texture.size, texture=texture))

    def _room_for(self, wide: float, high: float, others: Sequence[Box]) -> tuple[float, float]:
        """Lower left corner of a chip of that size [px]."""
        root, out = self._app.root, dp(THICK)
        places = []
        for left, low, right, top in self.frames[:NEAR]:
            rows = (top + out, low - out - high, top - high - out, low + out)
            columns = (left, right - wide, (left + right - wide) / 2)
            places += [(x, y) for y in rows for x in columns]
            places += [
                (x, y)
                for x in (right + out, left - out - wide)
                for y in (top - high, low, (low + top - high) / 2)
            ]
        inside = [
            (min(max(x, 0.0), max(root.width - wide, 0.0)), min(max(y, 0.0), max(root.height - high, 0.0)))
            for x, y in places
        ]
        stops = self._stops()

        def covers(place: tuple[float, float]) -> float:
            chip = (*place, place[0] + wide, place[1] + high)
            on_stop = sum(_shared(chip, stop) for stop in stops) * STOP_COUNTS
            on_own = sum(_shared(chip, frame) for frame in self.frames) * OWN_COUNTS
            return round(on_stop + on_own + sum(_shared(chip, other) for other in others), 1)

        return min(inside, key=covers)


def _plain(line: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in line.items() if name != "dash_offset"}


def _around(boxes: Sequence[Box], room: Box) -> Box:
    """What holds all of them, within the glass."""
    left, low = min(box[0] for box in boxes), min(box[1] for box in boxes)
    right, top = max(box[2] for box in boxes), max(box[3] for box in boxes)
    return max(left, room[0]), max(low, room[1]), min(right, room[2]), min(top, room[3])


def _corners(box: Box, length: float) -> list[list[float]]:
    left, low, right, top = box
    across, up = min(length, (right - left) / 3), min(length, (top - low) / 3)
    return [
        [left, low + up, left, low, left + across, low],
        [right - across, low, right, low, right, low + up],
        [right, top - up, right, top, right - across, top],
        [left + across, top, left, top, left, top - up],
    ]


def together(boxes: Sequence[Box]) -> list[Box]:
    """Boxes that fill what holds them almost as one; each by itself that lies apart from the others."""
    parts = list(dict.fromkeys(boxes))
    filled = {part: _area(part) for part in parts}
    at = 0
    while at < len(parts):
        for other in range(at + 1, len(parts)):
            one, two = parts[at], parts[other]
            both = _around((one, two), (-math.inf, -math.inf, math.inf, math.inf))
            whole = filled[one] + filled[two] - _shared(one, two)
            if whole >= FULL * _area(both):
                parts[at] = both
                filled[both] = min(whole, _area(both))
                del parts[other]
                at = -1
                break
        at += 1
    return parts


def _area(box: Box) -> float:
    return max(box[2] - box[0], 0.0) * max(box[3] - box[1], 0.0)


def _shared(one: Box, other: Box) -> float:
    wide = min(one[2], other[2]) - max(one[0], other[0])
    high = min(one[3], other[3]) - max(one[1], other[1])
    return max(wide, 0.0) * max(high, 0.0)


def _meet(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
