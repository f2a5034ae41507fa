"""One protocol or payload in the list: what it is called, how it is, and a switch that shows what the robot said."""

from __future__ import annotations

from typing import Any

from app.session.robot_setup import State
from widgets.parts.kit import ListRow, Toggle

__all__ = ["SetupRow"]


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
        self.detail, self.role = state

    def on_turn(self, on: bool) -> None:
        """The switch was pressed."""
