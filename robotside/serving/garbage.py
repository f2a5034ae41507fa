"""What a start made, and Python's collector."""

from __future__ import annotations

import gc

__all__ = ["set_aside"]


def set_aside() -> None:
    """Have the collector look no more at what there is by now, which stays for good.

    It looks through all that it knows every few minutes: 110,000 things take it 40 ms, in which the loop hears no STOP.
    """
    gc.collect()
    gc.freeze()
