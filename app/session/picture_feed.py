"""The camera's pictures on their way to the glass: which stream is watched, how often one comes, how long it is believed."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from app.link.camera_decoder import Picture
    from app.session.session import Session

__all__ = ["PictureFeed"]

PICTURE_LIVES = 1.0
"""A camera that shows nothing new for longer is stale [s]."""


class ShownPicture(Protocol):
    """The widget that shows a camera, as far as its age is concerned."""

    @property
    def age(self) -> float:
        """Age of the picture [s]."""

    @age.setter
    def age(self, value: float) -> None: ...

    @property
    def state(self) -> str:
        """`never`, `live` or `stale`."""

    @state.setter
    def state(self, value: str) -> None: ...

    @property
    def refusal(self) -> str:
        """Why there is no newer picture, as a sentence; empty where nobody knows."""

    @refusal.setter
    def refusal(self, value: str) -> None: ...


class PictureScreen(Protocol):
    """A screen, as far as pictures need it."""

    @property
    def picture(self) -> ShownPicture | None:
        """The widget that shows the camera; None where there is none."""

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A camera frame came; `rate` [Hz] and `latency` [s] are NaN while they are not known."""


class PictureFrame(Protocol):
    """The frame round the robot's screens, as far as pictures need it."""

    @property
    def shown(self) -> PictureScreen | None:
        """The screen on the glass; None before there is one."""


class PictureFeed:
    """What the app knows of one robot's camera. Everything here happens in the UI thread."""

    def __init__(self, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._now = now
        self._recent: list[float] = []
        """When the pictures of the last second came [s]."""
        self._newest = math.nan
        self._refusal = ""
        """Why the picture after the newest was not decoded."""
        self._watched: str | None = None
        self._taken = math.nan
        """Stamp of the newest picture [s], robot clock."""

    def show(
        self, picture: Picture, received: float, shell: PictureFrame | None, session: Session | None
    ) -> None:
        """Put a decoded picture on the screen that is on the glass; without a `shell` there is none.

        One with the stamp of the last is that picture once more: it is no fresher than it was.
        """
        if not picture.stamp or picture.stamp != self._taken:
            self._newest = received
        self._taken, self._refusal = picture.stamp, ""
        screen = shell.shown if shell is not None else None
        if screen is None:
            return
        self._recent = [at for at in self._recent if received - at < 1.0] + [received]
        rate = float(len(self._recent)) if len(self._recent) > 1 else math.nan
        latency = session.link.robot_time() - picture.stamp if session and picture.stamp else math.nan
        screen.show_picture(picture, rate, latency if latency > 0 else math.nan)

    def refuse(self, sentence: str) -> None:
        """A picture came that is not decoded; the last good one stays, and grows old."""
        self._refusal = sentence

    def judge(self, shell: PictureFrame) -> None:
        """A picture is believed for a second; after that it says how old it is."""
        screen = shell.shown
        video = screen.picture if screen is not None else None
        if video is None:
            return
        age = self._now() - self._newest
        video.state = "never" if math.isnan(age) else "live" if age < PICTURE_LIVES else "stale"
        video.refusal = self._refusal if video.state != "live" else ""
        if video.state == "stale" and not abs(age - video.age) < 0.5:
            video.age = age

    def watch(self, session: Session) -> None:
        """Ask for the picture that the robot offers, once it has said what there is."""
        if not session.connected:
            return
        wanted = session.cameras.wanted(self._watched)
        if wanted != self._watched:
            self._watched = wanted
            session.link.watch(wanted)

    def ask_again(self) -> None:
        """The link is a new one: nothing is watched over it yet."""
        self._watched = None

    def forget(self) -> None:
        """The robot is left: there is no picture and nothing is watched."""
        self._watched, self._newest, self._refusal = None, math.nan, ""
        self._taken = math.nan
