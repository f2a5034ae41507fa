"""Ways in which every scene is looked at: language, size of text, sizes of the window, gloves. Nothing of Kivy is imported."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["DAILY", "LARGE", "PHONE", "SIDE", "SIZES", "SMALL", "TABLET", "WHOLE", "Way"]

PHONE, SIDE, SMALL, TABLET, LARGE = (412, 892), (892, 412), (360, 740), (1280, 800), (1920, 1200)
SIZES = (PHONE, SIDE, SMALL, TABLET, LARGE)
"""Of the window [dp]."""
LANGUAGES = ("en", "de", "fr", "es", "zh_CN", "en_XA")


class Way(NamedTuple):
    """How every scene is looked at."""

    language: str
    text: float
    """Size of text, in times of the usual."""
    sizes: tuple[tuple[int, int], ...] = SIZES
    gloves: tuple[bool, ...] = (False, True)

    @property
    def name(self) -> str:
        """For people and files."""
        return f"{self.language} {self.text * 100:.0f} %"


USUAL = (PHONE, SIDE, TABLET)
"""Sizes that each language is looked at in; the others are smaller or larger in the same arrangement, and are walked in English and in the longest words."""
WHOLE = tuple(
    Way(
        tongue,
        text,
        SIZES if tongue in ("en", "en_XA") else USUAL,
        (False, True) if (tongue, text) == ("en", 1.0) else (False,),
    )
    for text in (1.0, 1.3, 2.0)
    for tongue in LANGUAGES
)
"""Each language in each size of text."""
DAILY = Way("en", 1.0, (PHONE, SIDE), (False,))
"""Each day: a phone upright and sideways."""
