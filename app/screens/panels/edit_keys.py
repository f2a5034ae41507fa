"""Keys of the editor: the selected panel is moved, resized and removed, changes are undone and done again."""

from __future__ import annotations

from typing import Protocol

from app.layout.panel_grid import Place

__all__ = ["KeyedEditor", "press"]

Z, Y, DELETE, BACKSPACE, TAB = 122, 121, 127, 8, 9
ARROWS = {276: (-1, 0), 275: (1, 0), 273: (0, -1), 274: (0, 1)}
"""Codes of the arrow keys, to columns and rows."""


class KeyedEditor(Protocol):
    """The editor, as far as keys need it."""

    @property
    def selected(self) -> int | None:
        """Index of the panel that is selected; None for none."""

    @property
    def places(self) -> list[Place]:
        """Where every panel of the view lies."""

    def select(self, index: int | None) -> None:
        """Select a panel."""

    def place(self, index: int, place: Place) -> None:
        """Put a panel there."""

    def act_on(self, index: int, what: str) -> None:
        """Do something about a panel."""

    def undo(self) -> None:
        """Take back the last change."""

    def redo(self) -> None:
        """Make it again."""


def press(editor: KeyedEditor, key: int, modifiers: list[str]) -> bool:
    """Do what a key means; whether it means anything.

    Tab goes to the next panel, arrows move it, with Shift they resize it, Delete removes it; Ctrl+Z and Ctrl+Y undo and redo.
    """
    if "ctrl" in modifiers or "meta" in modifiers:
        again = key == Y or (key == Z and "shift" in modifiers)
        if again or key == Z:
            (editor.redo if again else editor.undo)()
        return again or key == Z
    selected, places = editor.selected, editor.places
    if key == TAB and places:
        step = -1 if "shift" in modifiers else 1
        editor.select(((selected if selected is not None else -step) + step) % len(places))
        return True
    if selected is None:
        return False
    if key in (DELETE, BACKSPACE):
        editor.act_on(selected, "remove")
    elif key in ARROWS:
        editor.place(selected, _nudged(places[selected], *ARROWS[key], resize="shift" in modifiers))
    else:
        return False
    return True


def _nudged(place: Place, columns: int, rows: int, *, resize: bool) -> Place:
    if resize:
        return place._replace(width=place.width + columns, height=place.height + rows)
    return place._replace(left=place.left + columns, top=place.top + rows)
