"""Parts of the app that are imported when they are needed, some of which a build can leave out."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.util import find_spec
from typing import Any

__all__ = ["bring", "is_included"]


def is_included(module: str) -> bool:
    """`module`, by its dotted name or as for `bring`, is part of this build; one that is broken counts, and says so when it is imported."""
    module = module.partition(":")[0]
    if module in sys.modules:
        return True
    try:
        return find_spec(module) is not None
    except ModuleNotFoundError:  # the package that it is in is left out
        return False


def bring(where: str) -> Any:
    """What stands in a module under a name, as in `app.study.report:Report`; the module is imported now, and raises what it raises."""
    module, _, name = where.partition(":")
    return getattr(import_module(module), name)
