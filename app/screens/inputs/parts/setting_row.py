"""Rows of a pane that sets something up: a title with its sentence, and at the end a switch or a number."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from widgets.parts.kit import ListRow, Stepper, Toggle

__all__ = ["number_row", "switch_row"]


def switch_row(
    icon: str, title: str, detail: str, change: Callable[[bool], object]
) -> tuple[ListRow, Toggle]:
    """A row whose switch, and which itself, calls `change`."""
    row, toggle = (
        ListRow(icon=icon, title=title, detail=detail, whole=True),
        Toggle(pos_hint={"center_y": 0.5}),
    )

    def press(_: object) -> None:
        toggle.active = not toggle.active
        change(toggle.active)

    toggle.bind(on_change=lambda _, on: change(on))
    row.bind(on_release=press)
    row.add_widget(toggle)
    return row, toggle


def number_row(
    icon: str, title: str, detail: str, change: Callable[[float], object], **ends: Any
) -> tuple[ListRow, Stepper]:
    """A row whose number calls `change`; `ends` are those of a `Stepper`."""
    row, stepper = ListRow(icon=icon, title=title, detail=detail, whole=True), Stepper(**ends)
    stepper.pos_hint = {"center_y": 0.5}
    stepper.bind(on_change=lambda _, value: change(value))
    row.add_widget(stepper)
    return row, stepper
