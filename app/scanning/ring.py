"""The mark over what the switches would do: a thick frame with a shape of its own for a thing, a group and the way back.

It is drawn above everything else and takes no finger. It never covers STOP.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from typing import Any

from kivy.graphics import Color, InstructionGroup, Line, Mesh, Rectangle, RoundedRectangle
from kivy.metrics import dp, sp

from app.scanning.finding import Box
from widgets.base import text_texture
from widgets.theme import theme

__all__ = ["THICK", "Ring"]

THICK = 8.0
"""Of the frame [dp]."""
CASING = 2.0
"""Round the frame, so that it stands out on any ground [dp]."""
CORNER = 28.0
"""Length of the corners that frame a group [dp]."""
ARROW = 22.0
"""Of the arrow that points at a thing [dp]."""


class Ring:
    """`show` draws it; without boxes it is gone."""

    def __init__(
        self, app: Any, stops: Callable[[], list[Box]], now: Callable[[], float] = time.monotonic
    ) -> None:
        """`app` is asked for its `root` and its size; `stops` says where STOP is [px]."""
        self._app, self._stops, self._now = app, stops, now
        self._group = InstructionGroup()
        self._shown: tuple[Any, ...] = ()
        self.box: Box | None = None
        """What is framed now [px, window]; None for nothing."""
        self.said = ""
        """The words beside it."""

    def show(self, boxes: Sequence[Box], kind: str, words: str = "", until: float = math.nan) -> None:
        """Frame all of `boxes`, of which none means nothing is marked. `until` says when the mark goes on by itself."""
        root = self._app.root
        box = _around(boxes, (0, 0, root.width, root.height)) if boxes else None
        left = "" if math.isnan(until) else f"{max(until - self._now(), 0.0):.1f}"
        shown = (box, kind, words, theme.name, left)
        if shown == self._shown:
            return
        self._shown, self.box = shown, box
        self.said = words if kind != "item" else ""
        self._group.clear()
        if self._group not in root.canvas.after.children:
            root.canvas.after.add(self._group)
        if box is None:
            return
        box = self._clear_of_stop(box)
        self._frame(box, kind)
        if kind == "item":
            self._arrow(box)
        else:
            self._chip(box, "Back" if kind == "back" else words)

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

    def _chip(self, box: Box, words: str) -> None:
        """What a press would do, above or below what is framed."""
        short = words if len(words) <= 48 else f"{words[:47].rstrip()}…"
        texture = text_texture(short, sp(15), theme.font, bold=True)
        wide, high = texture.width + dp(20), texture.height + dp(10)
        root = self._app.root
        x = min(max(box[0], 0), max(root.width - wide, 0))
        above = box[3] + dp(THICK)
        y = above if above + high <= root.height else max(box[1] - dp(THICK) - high, 0)
        if any(_meet((x, y, x + wide, y + high), stop) for stop in self._stops()):
            x, y = box[0] + dp(THICK), box[3] - high - dp(THICK)
        self._group.add(Color(*theme.roles["text"]))
        self._group.add(RoundedRectangle(pos=(x, y), size=(wide, high), radius=[dp(6)]))
        self._group.add(Color(*theme.roles["surface"]))
        self._group.add(Rectangle(pos=(x + dp(10), y + dp(5)), size=texture.size, texture=texture))


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


def _meet(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
