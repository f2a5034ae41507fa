"""Optional parts of the app: packages that a build can leave out."""

from __future__ import annotations

import sys
from importlib.util import find_spec

__all__ = ["is_included"]


def is_included(module: str) -> bool:
    """`module`, by its dotted name, is part of this build; one that is broken counts, and says so when it is imported."""
    if module in sys.modules:
        return True
    try:
        return find_spec(module) is not None
    except ModuleNotFoundError:  # the package that it is in is left out
        return False
