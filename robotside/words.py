"""What others send, made fit to be shown and kept."""

from __future__ import annotations

__all__ = ["number", "plain"]


def number(value: float) -> str:
    """`value` with one decimal, or shortened from a million on, as in `1e+308`."""
    return f"{value:.1f}" if abs(value) < 1e6 else f"{value:.4g}"


def plain(text: str, most: int) -> str:
    """`text` on one line, without control and direction characters, cut to `most` characters."""
    line = " ".join(text[: 4 * most].split())
    return "".join(filter(str.isprintable, line))[:most].rstrip()
