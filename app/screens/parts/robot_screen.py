"""A screen of a connected robot, as the frame round it knows it."""

from __future__ import annotations

from typing import Any

from kivy.uix.floatlayout import FloatLayout

from app.layout.arrange import Body, Rect
from app.link.camera_decoder import Picture
from app.link.feeds import Post
from widgets import Video

__all__ = ["RobotScreen"]


class RobotScreen(FloatLayout):
    """What a screen does not need it leaves as it is here."""

    notice = Rect(0, 0, 1, 1)
    """Where the frame may show sentences over the screen [px]."""

    @property
    def picture(self) -> Video | None:
        """The camera's picture; None where the screen shows none."""
        return None

    def arrange(self, body: Body, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes. `form` is the window's shape, `dp` one dp [px]."""
        raise NotImplementedError

    def clear(self, cover: Rect | None) -> None:
        """Make room for what is said over the screen; None where nothing is."""

    def on_post(self, channel: str, post: Post) -> None:
        """Something came from the robot or its link."""

    def enter(self) -> None:
        """Come onto the glass."""

    def leave(self) -> None:
        """Leave the glass."""

    def end(self) -> None:
        """Let go of what it holds, for good; it has left the glass."""

    def rest(self) -> None:
        """Fingers let go of what they hold."""

    def tick(self) -> None:
        """Bring up to date what time changes; ten times a second while it is on the glass."""

    def keep(self) -> object:
        """What an operator opened or typed here, for the screen that is made in the place of this one; None for nothing."""
        return None

    def take_up(self, kept: Any) -> None:
        """Go on where the screen that gave `kept` ended; never called with None."""

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A camera frame came; `rate` [Hz] and `latency` [s] are NaN while they are not known."""

    def back(self) -> bool:
        """Back within the screen; False where it has nowhere to go back to."""
        return False
