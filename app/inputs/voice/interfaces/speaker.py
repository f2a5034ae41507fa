"""The seam between the app and whatever speaks: a sentence goes in, its begin and its end come out.

speaker.start(tell)           # tell("began", words), tell("ended", words), tell("failed", sentence): in any thread
speaker.say("Go home?", 1.0)  # instead of what is being said
speaker.stop()
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

__all__ = ["Speaker", "Tell"]

Tell: TypeAlias = Callable[[str, str], object]
"""`began` or `ended` with the words that were said, or `failed` with a sentence; in any thread."""


class Speaker(Protocol):
    """One way to speak. Called in one thread; its `Tell` is called in any."""

    def missing(self) -> str:
        """Why it cannot speak here, in one sentence; empty when nothing is known against it."""
        ...

    def start(self, tell: Tell) -> None:
        """Get ready; OSError when that cannot be."""
        ...

    def say(self, words: str, rate: float) -> None:
        """Say it, `rate` times as fast as usual, instead of what is being said."""
        ...

    def hush(self) -> None:
        """Say nothing more."""
        ...

    def stop(self) -> None:
        """Let go of everything; more than once does nothing."""
        ...
