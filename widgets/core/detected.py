"""What a detector says of a thing, in a word: its class where it is sure, and no class where it is not."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable

from widgets.core.language import tr

__all__ = ["SURE_SCORE", "kind_word", "things_words"]

SURE_SCORE = 0.6
"""A class with a lower score than this, 0 to 1, is a guess that the glass does not repeat."""


def kind_word(kind: str, score: float = math.nan) -> str:
    """The class that a detector gave, or `unknown` where it gave none or one with a low `score`; NaN where it says no score."""
    sure = bool(kind.strip()) and kind.strip() != "?" and not score < SURE_SCORE
    return kind.strip() if sure and kind.strip() != "unknown" else tr("unknown")


def things_words(kinds: Iterable[str]) -> str:
    """Words of `kind_word` counted, as in `cone, 2 × unknown`; empty for none."""
    counted = Counter(kinds)
    return ", ".join(kind if count == 1 else f"{count} × {kind}" for kind, count in counted.items())
