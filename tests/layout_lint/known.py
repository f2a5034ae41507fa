"""What is wrong and may be for now: each fault by its kind and its place in the tree, with its reason, in known.toml."""

from __future__ import annotations

import tomllib
from collections.abc import Collection
from pathlib import Path

__all__ = ["GROUPS", "KNOWN", "verdict"]

_FILE = tomllib.loads(Path(__file__).with_name("known.toml").read_text(encoding="utf-8"))
GROUPS = _FILE["group"]
KNOWN = frozenset(fault for group in GROUPS for fault in group["faults"])


def verdict(found: Collection[str], *, whole: bool) -> list[str]:
    """A sentence for each fault that is not known; where all was walked, for each as well that is mended and still named."""
    new = [f"new: {name}" for name in sorted(set(found) - KNOWN)]
    return new + [f"mended, and still named: {name}" for name in sorted(KNOWN - set(found)) if whole]
