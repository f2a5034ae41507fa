"""Stamps of commands as clients write them beside a message: a time in seconds as text."""

from __future__ import annotations

import math

from bridge.core.errors import ProtocolError

__all__ = ["read_stamp"]


def read_stamp(text: str | None, what: str) -> float:
    """When a command was meant [s, operators' clock], NaN where that was not said; ProtocolError for what is no time.

    `what` holds it, as in `header Stamp`.
    """
    if text is None:
        return math.nan
    try:
        stamp = float(text)
    except ValueError:
        stamp = math.nan
    if not math.isfinite(stamp):
        raise ProtocolError(f"The {what} is a time in seconds, not {text[:60]!r}.")
    return stamp
