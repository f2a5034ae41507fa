"""A stretch of time on the glass, and the fingers that move it: pan, zoom by two fingers or the wheel, a cursor by a tap."""

from __future__ import annotations

import math

from kivy.input import MotionEvent
from kivy.metrics import dp
from kivy.properties import NumericProperty
from kivy.uix.widget import Widget

from widgets.core.theme import theme

__all__ = ["MAX_SPAN", "MIN_SPAN", "TimeView"]

MIN_SPAN, MAX_SPAN = 0.1, 7 * 86_400.0
"""Shortest and longest stretch on the glass [s]."""
MAX_SLIP = 8.0
"""How far a finger may slip and still tap [dp]."""
WHEEL_STEP = 1.2
"""Zoom of one step of the wheel."""


class TimeView(Widget):
    """What lies between two times. While `until` is NaN it follows the newest."""

    span = NumericProperty(30.0)
    """Length of what is seen [s]."""
    until: NumericProperty[float] = NumericProperty(math.nan)
    """Time at the right edge [s]; NaN follows the newest."""
    cursor: NumericProperty[float] = NumericProperty(math.nan)
    """Time whose values are shown [s]; NaN for none."""

    held: NumericProperty[float] = NumericProperty(math.nan)
    """The newest time when it was told to stand still [s]; NaN before."""

    __events__ = ("on_pick",)

    def __init__(self, **kwargs: object) -> None:
        self._fingers: dict[int, tuple[float, float]] = {}
        self._began = (0.0, 0.0)
        self._tapping = self._holds_cursor = False
        super().__init__(**kwargs)

    def on_pick(self, time: float) -> None:
        """A finger chose a time [s], or none (NaN); `cursor` has it already."""

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """Where the time is drawn: left, low, right, top [px]."""
        raise NotImplementedError

    @property
    def known(self) -> tuple[float, float]:
        """The oldest and the newest time that there is anything of [s]; NaN for nothing."""
        raise NotImplementedError

    @property
    def paused(self) -> bool:
        """It stands still while time goes on."""
        return math.isfinite(self.until)

    @property
    def seen(self) -> tuple[float, float]:
        """The times at the left and at the right edge [s]; NaN before there is anything."""
        right = self.until if self.paused else self.known[1]
        return right - self.span, right

    @property
    def pace(self) -> float:
        """Width of a second [px]."""
        left, _, right, _ = self.frame
        return max(right - left, 1.0) / self.span

    def x_of(self, time: float) -> float:
        """Where a time [s] is on the glass [px]."""
        return self.frame[2] - (self.seen[1] - time) * self.pace

    def time_of(self, x: float) -> float:
        """The time [s] at a place [px]."""
        return self.seen[1] - (self.frame[2] - x) / self.pace

    def pause(self) -> None:
        """Stand still; what comes is kept behind."""
        if not self.paused and math.isfinite(self.known[1]):
            self.held = self.until = self.known[1]

    def resume(self) -> None:
        """Follow the newest again."""
        self.until = self.cursor = math.nan

    def zoom(self, factor: float, x: float) -> None:
        """Show `factor` times as much detail, about the time at `x` [px]; about the newest while that is followed."""
        span = min(max(self.span / factor, MIN_SPAN), MAX_SPAN)
        if self.paused:
            kept = self.time_of(x)
            self.until = self._limited(kept + (self.seen[1] - kept) * span / self.span)
        self.span = span

    def _limited(self, right: float) -> float:
        """The right edge, where something is in sight."""
        oldest, newest = self.known
        if not math.isfinite(newest):
            return right
        return min(max(right, min(oldest + self.span * 0.1, newest)), newest)

    def _pan(self, by: float) -> None:
        self.pause()
        if self.paused:
            self.until = self._limited(self.until - by / self.pace)

    # fingers

    def on_touch_down(self, touch: MotionEvent) -> bool:
        """Take a finger that comes down on the plot."""
        if self.disabled or not self.collide_point(*touch.pos):
            return False
        if super().on_touch_down(touch):
            return True
        if touch.is_mouse_scrolling:
            if touch.button in ("scrollup", "scrolldown"):
                self.zoom(WHEEL_STEP if touch.button == "scrolldown" else 1 / WHEEL_STEP, touch.x)
            return True
        touch.grab(self)
        self._fingers[touch.uid] = touch.pos
        self._tapping = len(self._fingers) == 1
        if self._tapping:
            self._began = touch.pos
            near = abs(touch.x - self.x_of(self.cursor)) < theme.target / 2  # NaN is near nothing
            self._holds_cursor = near
        return True

    def on_touch_move(self, touch: MotionEvent) -> bool:
        """Follow the plot's own fingers."""
        if touch.grab_current is not self or touch.uid not in self._fingers:
            return bool(super().on_touch_move(touch))
        if self._tapping and math.dist(touch.pos, self._began) <= dp(MAX_SLIP):
            return True
        before = dict(self._fingers)
        self._fingers[touch.uid] = touch.pos
        self._tapping = False
        if len(before) > 1:
            self._pinch(before)
        elif self._holds_cursor:
            self._pick(touch.x)
        else:
            self._pan(touch.x - before[touch.uid][0])
        return True

    def on_touch_up(self, touch: MotionEvent) -> bool:
        """Let go, or take it as a tap: a cursor there, or none where it stood already."""
        if touch.grab_current is not self or touch.uid not in self._fingers:
            return bool(super().on_touch_up(touch))
        touch.ungrab(self)
        del self._fingers[touch.uid]
        if self._tapping and touch.uid not in self._fingers:
            if self._holds_cursor:
                self.cursor = math.nan
                self.dispatch("on_pick", math.nan)
            else:
                self._pick(touch.x)
        self._tapping = False
        return True

    def _pick(self, x: float) -> None:
        left, _, right, _ = self.frame
        time = float(self.time_of(min(max(x, left), right)))
        if math.isfinite(time):
            self.pause()
            self.cursor = time
            self.dispatch("on_pick", time)

    def _pinch(self, before: dict[int, tuple[float, float]]) -> None:
        """Two fingers: the times that were beneath them stay there; while the newest is followed, that does."""
        first, second = list(before)[:2]
        was = abs(before[first][0] - before[second][0])
        now = abs(self._fingers[first][0] - self._fingers[second][0])
        middle = (before[first][0] + before[second][0]) / 2
        moved = (self._fingers[first][0] + self._fingers[second][0]) / 2 - middle
        least = dp(20)
        self.zoom(max(now, least) / max(was, least), middle)
        if self.paused:
            self._pan(moved)
