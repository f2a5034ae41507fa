"""A guide to read: text of any length, in pieces that every screen can draw."""

from __future__ import annotations

from collections.abc import Iterator

from widgets.parts.kit import Column, Remark

__all__ = ["LINES", "GuideText", "pieces"]

LINES = 16
"""Of one piece: a longer one may be higher than the largest picture that a phone can draw."""
MAX_LETTERS = 40_000
"""Letters that are shown."""


class GuideText(Column):
    """Shows `show(text)`."""

    def __init__(self) -> None:
        super().__init__(spacing="2dp")
        self._text = ""

    def show(self, text: str) -> None:
        """Show this text, empty for none; the same again changes nothing."""
        if text == self._text:
            return
        self._text = text
        self.clear_widgets()
        for piece in pieces(text[:MAX_LETTERS]):
            self.add_widget(Remark(text=piece, role="text"))


def pieces(text: str) -> Iterator[str]:
    """`text` in parts of whole lines."""
    lines = text.splitlines()
    for start in range(0, len(lines), LINES):
        yield "\n".join(lines[start : start + LINES])
