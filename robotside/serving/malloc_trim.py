"""Memory that a start leaves behind."""

from __future__ import annotations

import ctypes

__all__ = ["trim"]


def trim() -> None:
    """Give back what was freed, to the system: painting the world leaves 20 MB. Only glibc keeps it, and only it can."""
    try:
        give_back = ctypes.CDLL(None).malloc_trim
    except (AttributeError, OSError, TypeError):  # another C library; on Windows there is no CDLL(None)
        return
    give_back(0)
