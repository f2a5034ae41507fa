"""What others call things, made fit to be shown and kept."""

from __future__ import annotations

__all__ = ["plain"]


def plain(text: str, most: int) -> str:
    """`text` on one line, without control and direction characters, cut to `most` characters."""
    line = " ".join(text[: 4 * most].split())
    return "".join(filter(str.isprintable, line))[:most].rstrip()
