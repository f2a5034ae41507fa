"""QR codes say the link, whatever they are drawn with."""

from __future__ import annotations

from pathlib import Path

import pytest
import segno
from PIL import Image

from robotside.trust.qr import as_rows, as_svg, as_text, write_png

LINK = "pilothouse://192.168.1.7:9090?c=" + "ab" * 32 + "&s=secret-of-22-letters-x&n=Patrol-1"


def test_a_terminal_shows_a_square_of_blocks_that_is_another_for_another_link() -> None:
    lines = as_text(LINK).splitlines()
    assert len(lines) > 15
    assert as_text(LINK) != as_text(LINK.replace("ab", "cd"))


def test_a_page_has_it_as_an_element() -> None:
    shown = as_svg(LINK)
    assert shown.startswith("<svg")
    assert "viewBox" in shown, "a page that makes it smaller cuts it off"
    assert "width=" not in shown


def test_a_printer_has_it_as_a_picture(tmp_path: Path) -> None:
    write_png(LINK, tmp_path / "qr.png")
    with Image.open(tmp_path / "qr.png") as picture:
        assert picture.width == picture.height > 400
    with pytest.raises(OSError, match="."):
        write_png(LINK, tmp_path / "none" / "qr.png")


def test_a_handheld_has_it_as_rows_that_are_the_codes_own_modules() -> None:
    rows = as_rows(LINK)
    assert [[int(module) for module in row] for row in rows] == [
        list(row) for row in segno.make_qr(LINK, error="m").matrix
    ]
    finder = ["1111111", "1000001", "1011101", "1011101", "1011101", "1000001", "1111111"]
    assert [row[:7] for row in rows[:7]] == finder
    assert [row[-7:] for row in rows[:7]] == finder
    assert [row[:7] for row in rows[-7:]] == finder
