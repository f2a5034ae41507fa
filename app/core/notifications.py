"""One sentence on the glass, wherever it is: over the screens of a robot, or above the cards where there is none."""

from __future__ import annotations

from typing import Protocol

__all__ = ["notify"]


class Frame(Protocol):
    """The frame round the robot's screens, as far as notifications need it."""

    def say(self, text: str, level: str = ..., about: str = ...) -> None:
        """Show one sentence over the screen, in place of the last one `about` the same."""


class Page(Protocol):
    """The connect page, as far as notifications need it."""

    def say(self, text: str, level: str = ...) -> None:
        """Show one sentence above the cards."""


class Host(Protocol):
    """The app, as far as notifications need it."""

    @property
    def connect(self) -> Page:
        """The connect page."""

    @property
    def shell(self) -> Frame | None:
        """The frame round the robot's screens; None where there is no robot."""


def notify(app: Host, sentence: str, level: str = "warn", about: str = "") -> None:
    """Show it; with a robot in place of what was said `about` the same before."""
    if app.shell is not None:
        app.shell.say(sentence, level, about=about)
    else:
        app.connect.say(sentence, level)
