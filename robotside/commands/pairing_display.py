"""Pairing as a terminal shows it: the QR code, the link and the code to type."""

from __future__ import annotations

from robotside.trust.qr import as_text

__all__ = ["code_in_groups", "shown"]


def code_in_groups(code: str) -> str:
    """A code as people read it aloud: `123 456`, of a guest `42 123 456`."""
    return f"{code[:-6]} {code[-6:-3]} {code[-3:]}".strip()


def shown(robot: str, link: str, code: str, left: float) -> str:
    """The lines that show how to pair with `robot`; pairing is open for `left` [s] yet."""
    minutes = max(1, round(left / 60.0))
    return (
        f"{as_text(link)}\n"
        f"To pair with {robot}, scan this with the app, or choose {robot} there and type {code_in_groups(code)}.\n"
        f"{link}\n"
        f"It is for one use, in the next {minutes} minutes."
    )
