"""One sentence on the glass, wherever it is: over the screens of a robot, or above the cards where there is none."""

from __future__ import annotations

from typing import Any

__all__ = ["tell"]


def tell(app: Any, sentence: str, level: str = "warn", about: str = "") -> None:
    """Show it; with a robot in place of what was said `about` the same before."""
    if app.shell is not None:
        app.shell.say(sentence, level, about=about)
    else:
        app.connect.say(sentence, level)
