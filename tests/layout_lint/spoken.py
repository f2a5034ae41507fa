"""What is written on the glass and came from no catalogue, by a language in which each sentence can be told.

The pseudo-language writes every vowel of a sentence with an accent. So a plain vowel is of a word that was not translated: a
name, a unit, what a robot says in its own words, or a mistake.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

__all__ = ["Written", "foreign", "points"]

TAG = re.compile(r"\[/?(?:b|i|u|s|font|size|color|ref|anchor|sub|sup)(?:=[^\]]*)?\]")
WORD = re.compile(r"[A-Za-z_/.@'À-ž]*[AaCcEeIiNnOoSsUuYy][A-Za-z_/.@'À-ž]*")
"""A word with a letter that the pseudo-language would have dressed."""
PLAIN = re.compile(r"[AaCcEeIiNnOoSsUuYy]")
POINT = re.compile(r"(?<![\d.])\d+\.\d+(?![\d.])")
"""A figure with a decimal point, which the pseudo-language writes with a comma; no address and no version has one point."""
DATA = re.compile(r"\{[^}]*\}|(?:\w+://|/)\S+|\w+_msgs/\w+")
"""A place in an address, an address, a path, a topic, and a type of message."""
THIN = "\u200a"
"""Between the letters of a spaced heading."""


class Written:
    """Every text that was drawn while it listens, each with the scene that it was first drawn in."""

    def __init__(self) -> None:
        self.texts: dict[str, str] = {}
        self.scene = ""

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Take down what any label or canvas draws."""
        from kivy.core.text import LabelBase

        drawn = LabelBase.refresh

        def refresh(label: LabelBase) -> None:
            self.texts.setdefault(str(label.text), self.scene)
            drawn(label)

        LabelBase.refresh = refresh
        try:
            yield
        finally:
            LabelBase.refresh = drawn


def foreign(text: str, known: Iterable[str] = ()) -> list[str]:
    """Words of `text` that came from no catalogue, but for what it has of `known`, names and sentences that are data."""
    text = DATA.sub(" ", TAG.sub("", text).replace(THIN, ""))
    for one in sorted(known, key=len, reverse=True):
        text = re.sub(rf"(?<!\w){re.escape(one)}(?!\w)", " ", text, flags=re.IGNORECASE)
    return [word for word in WORD.findall(text) if PLAIN.search(word)]


def points(text: str) -> list[str]:
    """Figures of `text` that are not written as the language does."""
    return POINT.findall(TAG.sub("", text))
