"""The part of the robot's page that shows how to pair, for those alone who manage it."""

from __future__ import annotations

import html

from bridge.trust.pairing import code_in_groups
from robotside.trust.pairing import Pairing
from robotside.trust.qr import as_svg

__all__ = ["pairing_part"]

_OPEN = """<h2>Pair a handheld</h2><p>Scan this with the app, or choose the robot there and type
<b>{code}</b>. It is for one use, and ends at most ten minutes after it was opened.</p>{picture}
<p><a href="{link}">Pair this device</a></p>"""

_CLOSED = """<h2>Pair a handheld</h2><p>Pairing is closed. A paired handheld that manages the robot opens it, or
<code>python -m robotside pair</code> on the robot's computer.</p>"""


def pairing_part(pairing: Pairing | None) -> str:
    """The part, in HTML; empty for a robot without keys. It has a secret: only for who manages the robot."""
    if pairing is None:
        return ""
    offer = pairing.offer
    if offer is None:
        return _CLOSED
    link = pairing.link(offer)
    return _OPEN.format(code=code_in_groups(offer.code), picture=as_svg(link), link=html.escape(link))
