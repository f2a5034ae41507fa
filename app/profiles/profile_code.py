"""QR code of a profile's link."""

from __future__ import annotations

import segno

from widgets.core.language import tr

__all__ = ["code_of"]


def code_of(link: str) -> list[str]:
    """Rows from the top, each of 0 (light) and 1 (dark), without the quiet zone. ValueError for a link that does not fit."""
    try:
        code = segno.make_qr(link, error="l")
    except segno.DataOverflowError as error:
        raise ValueError(tr("This link does not fit into a QR code.")) from error
    return ["".join("1" if module else "0" for module in row) for row in code.matrix]
