"""Pairing as a terminal shows it: the QR code, the link and the code to type."""

from __future__ import annotations

from bridge.trust.pairing import code_in_groups
from robotside.trust.qr import as_text

__all__ = ["shown"]


def shown(robot: str, link: str, code: str, left: float) -> str:
    """The lines that show how to pair with `robot`; pairing is open for `left` [s] yet."""
    minutes = max(1, round(left / 60.0))
    return (
        f"{as_text(link)}\n"
        f"To pair with {robot}, scan this with the app, or choose {robot} there and type {code_in_groups(code)}.\n"
        f"{link}\n"
        f"It is for one use, in the next {minutes} minutes."
    )
