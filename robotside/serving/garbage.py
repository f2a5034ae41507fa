"""What a start made, and Python's collector."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["loading", "set_aside"]

_under_way: list[bool] = []
"""For each load under way whether the collector worked when it began."""
_has_set_aside = [False]
"""Whether this program sets aside what it is made of; counting what is aside takes 20 ms."""


def set_aside() -> None:
    """Have the collector look no more at what there is by now, which stays for good.

    It looks through all that it knows every few minutes: 110,000 things take it 40 ms, in which the loop hears no STOP.
    """
    gc.collect()
    gc.freeze()
    _has_set_aside[0] = True


@contextmanager
def loading() -> Iterator[None]:
    """While libraries are loaded in another thread the collector rests; what came of them it looks no more at, as of `set_aside`.

    It would look through all that is loaded several times meanwhile and every few minutes afterwards, and holds up the loop in
    whatever thread it works: 30 to 60 ms with the libraries of all gateways. For the thread of the loop alone.
    """
    _under_way.append(gc.isenabled())
    gc.disable()
    try:
        yield
    finally:
        works = _under_way.pop(0)  # that of the first says how it was before all of them
        if _under_way:
            _under_way[0] = works
        else:
            if _has_set_aside[0]:
                gc.freeze()
            if works:
                gc.enable()
