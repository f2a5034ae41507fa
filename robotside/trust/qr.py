"""Links as QR codes: for a terminal, a web page, a printer and a handheld."""

from __future__ import annotations

import io
from pathlib import Path

import segno

__all__ = ["as_rows", "as_svg", "as_text", "write_png"]

_MODULE_PIXELS = 12
"""Of a picture for a printer."""


def as_text(link: str) -> str:
    """A QR code of block characters, for a terminal of either background."""
    out = io.StringIO()
    _code(link).terminal(out, compact=True)
    return out.getvalue()


def as_svg(link: str) -> str:
    """A QR code as an SVG element, black on white, as large as the page makes it."""
    shown: str = _code(link).svg_inline(light="white", omitsize=True)
    return shown


def as_rows(link: str) -> list[str]:
    """Rows of a QR code from the top, each of 0 (light) and 1 (dark), without the quiet zone."""
    return ["".join("1" if dark else "0" for dark in row) for row in _code(link).matrix]


def write_png(link: str, path: Path) -> None:
    """Write a QR code as a picture to `path`. Raises OSError."""
    with path.open("wb") as file:
        _code(link).save(file, kind="png", scale=_MODULE_PIXELS)


def _code(link: str) -> segno.QRCode:
    return segno.make_qr(link, error="m")
