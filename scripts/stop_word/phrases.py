"""What the voices say: sentences with STOP, and many without it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

__all__ = ["Phrase", "phrases", "prose"]

ALONE = ("stop", "Stop!", "stop.", "STOP?")
AMID = (
    "please stop now", "robot stop", "I said stop", "stop the robot", "stop it", "okay stop there", "no, stop", "hey, stop moving",
    "can you stop please", "just stop", "you should stop right here", "and stop", "now stop, it is enough", "wait, stop it there",
    "go on and stop at the door", "oh no stop", "stop right now", "would you stop", "left, left, stop", "faster, stop",
)  # fmt: skip
OTHERS = (
    "halt",
    "Halt!",
    "freeze",
    "Freeze!",
    "abort",
    "Abort!",
    "halt the robot",
    "just freeze",
    "abort it now",
)
"""STOP too, by other words, which other parts of the app hear."""
NEIGHBOURS = Path(__file__).with_name("neighbours.txt")
"""Words that sound like it in part, and what is said to a robot."""
TIMES_ALONE = 3
"""Each way to say it alone is said so often, at other speeds."""
LENGTHS = range(4, 27)
"""Words of a sentence."""
LIKE_STOP = re.compile(r"\b(non)?(stop|halt|freez|froz|abort)\w*", re.IGNORECASE)


class Phrase(NamedTuple):
    """Something to say."""

    kind: str
    """`alone`: STOP; `amid`: STOP among words; `near`: what sounds like it; `prose`: anything else."""
    text: str


def phrases(sentences: list[str]) -> Iterator[Phrase]:
    """All that one voice says, with these `sentences` of its own."""
    for text in sentences:
        yield Phrase("prose", text)
    for text in (*OTHERS, *NEIGHBOURS.read_text(encoding="utf-8").splitlines()):
        yield Phrase("near", text)
    for text in ALONE * TIMES_ALONE:
        yield Phrase("alone", text)
    for text in AMID:
        yield Phrase("amid", text)


def prose(book: Path) -> list[str]:
    """The sentences of a text file that have words alone, and none like STOP."""
    text = re.sub(r"\s+", " ", book.read_text(encoding="utf-8", errors="ignore"))
    found = re.split(r"(?<=[.!?])\s+", text)
    return [
        one
        for one in found
        if len(one.split()) in LENGTHS
        and re.fullmatch(r"[A-Za-z ,.'!?;:-]+", one)
        and not LIKE_STOP.search(one)
    ]
