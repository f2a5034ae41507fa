"""What a detector says of a thing, in a word: its class where it is sure, and no class where it is not."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable

from widgets.core.language import mark, tr

__all__ = ["SURE_SCORE", "kind_word", "things_words"]

SURE_SCORE = 0.6
"""A class with a lower score than this, 0 to 1, is a guess that the glass does not repeat."""

KINDS = {
    "unknown": mark("unknown"),
    "cone": mark("cone"),
    "person": mark("person"),
    "diver": mark("diver"),
    "car": mark("car"),
    "tree": mark("tree"),
    "buoy": mark("buoy"),
    "fruit": mark("fruit"),
    "coral": mark("coral"),
}
"""Classes that detectors of ours give, to their words; others are shown as they come."""


def kind_word(kind: str, score: float = math.nan) -> str:
    """The class that a detector gave, or `unknown` where it gave none or one with a low `score`; NaN where it says no score."""
    sure = bool(kind.strip()) and kind.strip() != "?" and not score < SURE_SCORE
    word = kind.strip() if sure else "unknown"
    return tr(KINDS.get(word, word))


def things_words(kinds: Iterable[str]) -> str:
    """Words of `kind_word` counted, as in `cone, 2 × unknown`; empty for none."""
    counted = Counter(kinds)
    return ", ".join(kind if count == 1 else f"{count} × {kind}" for kind, count in counted.items())
