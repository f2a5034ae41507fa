"""One protocol or payload in the list: what it is called, how it is, and a switch that shows what the robot said."""

from __future__ import annotations

import re
from typing import Any

from kivy.metrics import dp, sp

from app.session.robot_setup import State
from widgets.core.base import text_texture
from widgets.core.theme import theme
from widgets.parts.kit import ListRow, Toggle
from widgets.parts.rows import TwoLines

__all__ = ["SetupRow", "broken"]

MIN_ROOM = 140
"""What is narrower is not laid out yet [dp]."""
DETAIL_SIZE = 13
"""Of the second line's type [sp]."""


class SetupRow(ListRow):
    """Dispatches `on_turn(on)` when its switch is pressed, which alone switches nothing; what is fixed has none."""

    __events__ = ("on_turn",)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(whole=True, **kwargs)
        self.switch = Toggle(pos_hint={"center_y": 0.5})
        self.switch.bind(on_change=lambda _, on: self.dispatch("on_turn", on))

    def show(self, state: State, *, on: bool, fixed: bool, may: bool) -> None:
        """Say how it is: `on` as the robot says, `may` be switched from here."""
        if fixed == (self.switch.parent is self):
            (self.remove_widget if fixed else self.add_widget)(self.switch)
        if self.switch.active != on:
            self.switch.active = on
        self.switch.disabled = not may
        said, self.role = state
        line = next((child for child in self.children if isinstance(child, TwoLines)), None)
        self.detail = said if line is None else broken(said, line.width, sp(DETAIL_SIZE))

    def on_turn(self, on: bool) -> None:
        """The switch was pressed."""


def broken(text: str, room: float, size: float) -> str:
    """`text` with an address that is wider than `room` [px] at type of `size` [px] broken before a slash, and not in a word."""
    return " ".join(_lines(word, room, size) for word in text.split(" "))


def _lines(word: str, room: float, size: float) -> str:
    if "/" not in word or room < dp(MIN_ROOM) or text_texture(word, size, theme.font).width <= room:
        return word
    lines = [""]
    for piece in re.split(r"(?<=[^/:])(?=/)", word):
        if lines[-1] and text_texture(lines[-1] + piece, size, theme.font).width > room:
            lines.append("")
        lines[-1] += piece
    return "\n".join(lines)
