"""A QR code stays in the middle of its widget, whichever side of that changes last."""

from __future__ import annotations

from kivy.graphics import Rectangle

from tests.headless import Stage
from widgets.parts.qr_code import QUIET_ZONE, QrCode

ROWS = ["101", "010", "101"]
ACROSS = len(ROWS) + 2 * QUIET_ZONE


def field(code: QrCode) -> tuple[float, ...]:
    """x, y, width and height of the white ground."""
    ground = next(each for each in code._code.children if isinstance(each, Rectangle))
    return (*ground.pos, *ground.size)


def test_it_is_in_the_middle_whatever_changes_last(stage: Stage) -> None:
    code = stage.show(QrCode(rows=ROWS, size_hint=(None, None)), None)
    for name, value in (("size", (110, 110)), ("width", 330), ("height", 220), ("x", 40), ("y", 7)):
        setattr(code, name, value)
        side = min(code.size) // ACROSS * ACROSS
        middle = code.x + code.width / 2, code.y + code.height / 2
        assert field(code) == (round(middle[0] - side / 2), round(middle[1] - side / 2), side, side), name


def test_what_is_no_code_is_not_drawn(stage: Stage) -> None:
    code = stage.show(QrCode(rows=ROWS, size=(110, 110)))
    assert code._code.children
    for rows in ([], ["10", "1"], ["12", "01"], ["1" * 200] * 200):
        code.rows = rows
        assert not [each for each in code._code.children if isinstance(each, Rectangle)], rows
