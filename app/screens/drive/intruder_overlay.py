"""Intruders on the drive screen: a badge, and their place in the picture."""

from __future__ import annotations

import math

from kivy.metrics import dp
from kivy.properties import BooleanProperty
from kivy.uix.image import Image

from app.layout.arrange import Rect
from app.link.capabilities import POSE
from app.link.feeds import Feeds
from app.screens.parts.picture_boxes import FOUND
from app.screens.parts.placing import put
from app.session.dashboard import AGE_STEP, Dashboard
from app.session.session import Session
from widgets import IntruderBadge, Video
from widgets.core.detected import kind_word
from widgets.core.sensor_geometry import away_text

__all__ = ["IntruderOverlay"]


class IntruderOverlay(IntruderBadge):
    """The badge of one screen, which marks the last intruder in `video`; without a robot that looks it is not seen."""

    told = BooleanProperty(False)
    """The robot has said what it found, be it nothing."""
    covered = BooleanProperty(False)
    """Something lies over its place."""

    def __init__(self, session: Session, video: Video, dashboard: Dashboard) -> None:
        """Shows what comes by `dashboard`."""
        super().__init__(state="live", opacity=0)
        self._session, self._video = session, video
        self._place = Rect(0, 0, 1, 1)
        self.picture = Image(size_hint=(None, None), size=(0, 0), fit_mode="contain", opacity=0)
        """The last intruder, beside the bar, where the robot keeps a picture of it and there is room."""
        self.add_widget(self.picture)
        dashboard.bind(self, FOUND, fresh=False)
        dashboard.bind(self, POSE, self.show_pose, fresh=False)

    def place(self, rect: Rect, *, to_right: bool) -> None:
        """Take its place on the glass."""
        self.to_right = to_right
        put(self, rect)

    def tick(self) -> None:
        """Bring up to date whether it is seen, and the mark in the picture."""
        feeds: Feeds = self._session.feeds
        self.told = feeds.latest(FOUND) is not None
        self._show()
        self._show_picture()
        seen = [kind_word(label, score) for label, score, *_ in self._video.boxes]
        if seen != self.seen:
            self.seen = seen
        self._grow_old(feeds)
        placed = self.told and self.count > 0 and feeds.state(POSE) == "live" and math.isfinite(self.angle)
        placed = placed and self._session.cameras.shows_first
        marks = [(f"{self.number} · {away_text(self.away)}", self.angle)] if placed else []
        if marks != self._video.marks:
            self._video.marks = marks

    def _show_picture(self) -> None:
        pictures = self._session.pictures
        event = pictures.found(self.number) if self.told and self.count > 0 and self.fresh else None
        texture = pictures.of(event) if event is not None else None
        high = self.height
        broad = min(high, high * texture.width / texture.height) if texture is not None else 0.0
        left = self.bar_left - broad - dp(4)
        shown = texture is not None and left >= self.x
        self.picture.texture = texture if shown else None
        self.picture.opacity = 1 if shown else 0
        if shown:
            self.picture.size, self.picture.pos = (broad, high), (left, self.y)

    def _show(self, *_: object) -> None:
        self.opacity = 1 if self.told and not self.covered else 0

    on_covered = _show

    def _grow_old(self, feeds: Feeds) -> None:
        """What was found is said once; where it is from here is as old as the robot's own place."""
        told = [name for name in (FOUND, POSE) if feeds.latest(name) is not None]
        ages = [feeds.age(name) for name in told if feeds.state(name) == "stale"]
        old = max(ages, default=math.nan)
        if ages and not abs(old - self.age) < AGE_STEP:
            self.age = old
        self.state = "stale" if ages else "live"
