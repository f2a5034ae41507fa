"""The part of the robot's page that shows how to pair, for those alone who manage it."""

from __future__ import annotations

import html

from bridge.trust.pairing import code_in_groups
from robotside.trust.pairing import Pairing
from robotside.trust.qr import as_svg

__all__ = ["pairing_part"]

_OPEN = """<div class="qr">{picture}</div><div><p>Pair a handheld: scan this with the phone's camera, or choose the robot in the app
and type</p><p class="code"><b>{code}</b></p><p class="quiet">It is for one use, and ends at most ten minutes after it was opened.
<a href="{link}">Pair this device</a></p></div>"""


def pairing_part(pairing: Pairing | None) -> str:
    """The part, in HTML; empty while pairing is closed, and for a robot without keys. It has a secret: only for who manages the robot."""
    offer = pairing.offer if pairing is not None else None
    if pairing is None or offer is None:
        return ""
    link = pairing.link(offer)
    return _OPEN.format(code=code_in_groups(offer.code), picture=as_svg(link), link=html.escape(link))
