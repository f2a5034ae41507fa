"""Intruders found: their number, and the distance, direction and age of the last one.

badge = IntruderBadge()
robot.on("/intruders", badge.show)
robot.on("/pose", badge.show_pose)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, ListProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.pilothouse_msgs import Intruder, IntruderArray
from bridge.msgs.std_msgs import Header, Time
from widgets.core.base import age_text
from widgets.core.canvas_ink import Drawing, Ink, Word, Words
from widgets.core.detected import things_words
from widgets.core.icons import icon
from widgets.core.language import tr, trn
from widgets.core.sensor_geometry import ago_text, away_text, side_text
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.map_marks import arrow
from widgets.parts.sensor_card import first_fitting, wide

__all__ = ["IntruderBadge", "direction_of", "samples"]

FRESH_DURATION = 30.0
"""An intruder found within this is news [s]."""
AHEAD = math.pi / 2
"""Where straight ahead is on the screen [rad]."""


class IntruderBadge(Drawing):
    """As wide as its words, in the middle of its place, or at its right end with `to_right`."""

    accepts: ClassVar = (IntruderArray,)
    veiled: ClassVar = False
    drawn_from: ClassVar = ("count", "seen", "away", "angle", "ago", "age", "to_right")

    count = NumericProperty(-1)
    """Intruders known; -1 before the robot reports them."""
    seen: ListProperty[str] = ListProperty()
    """What is marked in the picture now, a word of `kind_word` for each thing; the robot may not count it as long as it does not watch."""
    away = NumericProperty(math.nan)
    """To the last one [m]; NaN while the robot does not know where it is."""
    angle = NumericProperty(math.nan)
    """Where the last one is in `base_link` [rad], positive left; NaN as for `away`."""
    ago = NumericProperty(math.nan)
    """Since the last one was found [s], by the robot's clock; NaN when not known."""
    to_right = BooleanProperty(False)
    bar_left = NumericProperty(math.nan)
    """Left edge of what is drawn [px]; NaN before anything is."""

    def _fresh(self) -> bool:
        return (
            self.state != "stale" and self.count > 0 and (math.isnan(self.ago) or self.ago < FRESH_DURATION)
        )

    fresh = AliasProperty(_fresh, bind=["state", "count", "ago"], cache=True)
    """The last one was found just now, as far as is known now."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        self._last: Intruder | None = None
        self._pose: PoseWithCovarianceStamped | None = None
        super().__init__(**kwargs)
        self.canvas.add(self._ink)
        self.canvas.add(self._words.canvas)

    @property
    def texts(self) -> list[str]:
        """What is written."""
        return self._words.texts

    @property
    def number(self) -> int:
        """The last intruder's number; 0 when there is none."""
        return self._last.id if self._last else 0

    def show(self, msg: IntruderArray) -> None:
        """Take over which intruders are known; the one that was found last is shown."""
        self._last = max(msg.intruders, key=lambda one: one.first_seen.seconds, default=None)
        self.count = len(msg.intruders)
        self._measure()

    def show_pose(self, msg: PoseWithCovarianceStamped) -> None:
        """Take over where the robot is, and by its stamp what time its clock says."""
        self._pose = msg
        self._measure()

    def _measure(self) -> None:
        """Distance, direction and age, as fine as they are read: a glass that flickers in its last figure says less."""
        if self._last is None or self._pose is None:
            self.away = self.angle = self.ago = math.nan
            return
        pose, there = self._pose.pose.pose, self._last.position
        away = math.hypot(there.x - pose.position.x, there.y - pose.position.y)
        self.away = round(away, 1) if math.isfinite(away) else math.nan  # robots tell places that are none
        self.angle = direction_of(pose, self._last)
        self.ago = max(0.0, round(self._pose.header.stamp.seconds - self._last.first_seen.seconds))

    def counted(self) -> str:
        """The first line."""
        if self.count < 0:
            return tr("Intruders: not reported")
        if self.count == 0 and self.seen and self.state != "stale":
            return tr("Seen, not yet an intruder: {things}").format(things=things_words(self.seen))
        return (
            tr("No intruders")
            if self.count == 0
            else trn("{count} intruder", "{count} intruders", int(self.count))
        )

    def details(self) -> tuple[str, ...]:
        """The second line, longest first."""
        if self.count <= 0:
            return ()
        away = away_text(self.away) if math.isfinite(self.away) else ""
        side, ago = side_text(self.angle), ago_text(self.ago)
        if self.state == "stale":
            ago = age_text(self.age)
        parts = [part for part in (away, side, ago) if part]
        brief = [part for part in (away, ago.removesuffix(" ago").removesuffix(" old")) if part]
        whole = " · ".join(parts)
        if not parts:
            return (tr("distance unknown"), tr("not known"))
        return tuple(
            text for text in (tr("last: {what}").format(what=whole), whole, " · ".join(brief), away) if text
        )

    def draw(self) -> None:
        """Bring ground, arrow and words up to date."""
        shapes = Shapes()
        self._words.write(list(self._found(shapes) if self.count > 0 else self._quiet(shapes)))
        self._ink.fill(shapes)

    def _quiet(self, shapes: Shapes) -> Iterator[Word]:
        old = age_text(self.age) if self.state == "stale" else ""
        text, size = " · ".join(part for part in (self.counted(), old) if part), sp(12.5)
        why = (
            f"{text} · {tr('it counts when seen three times in one place')}" if self.seen and not old else ""
        )
        if why and self.count == 0:
            text = first_fitting((why, text, things_words(self.seen)), size, self.width - dp(38))
        if not text:
            return  # a box without words tells nothing
        width = wide(text, size) + dp(38)
        left, y = self._ground(shapes, width, dp(30), "glass"), self.top - dp(15)
        yield Word(icon("visibility"), left + dp(16), y, sp(15), theme.muted, font=theme.icons)
        yield Word(text, left + dp(28), y, size, theme.muted, anchor=(0, 0.5))

    def _found(self, shapes: Shapes) -> Iterator[Word]:
        room = self.width - dp(54)
        first, small = sp(15), sp(12.5)
        second = first_fitting(self.details(), small, room)
        width = max(wide(self.counted(), first, bold=True), wide(second, small)) + dp(54)
        left = self._ground(shapes, min(width, self.width), self.height, "danger" if self.fresh else "glass")
        ink = theme.ink_danger if self.fresh else theme.muted if self.state == "stale" else theme.text
        if math.isfinite(self.angle):
            shapes.polygon(arrow(left + dp(22), self.center_y, self.angle + AHEAD, dp(24)), ink)
        else:
            yield Word(icon("warning"), left + dp(22), self.center_y, sp(22), ink, font=theme.icons)
        rise = sp(9) if second else 0.0
        yield Word(
            self.counted(), left + dp(42), self.center_y + rise, first, ink, bold=True, anchor=(0, 0.5)
        )
        yield Word(second, left + dp(42), self.center_y - sp(9), small, ink, anchor=(0, 0.5))

    def _ground(self, shapes: Shapes, width: float, height: float, role: str) -> float:
        """Fill a rounded bar of that size; gives its left edge [px]."""
        left = self.right - width if self.to_right else self.center_x - width / 2
        self.bar_left = left
        round_ = min(float(dp(11)), height / 2)
        y = self.top - height / 2
        fill = theme.danger if role == "danger" else theme.glass
        found = theme.warn if self.count > 0 and self.state != "stale" else theme.line
        rim = theme.danger if role == "danger" else found
        for inset, colour in ((0.0, rim), (float(dp(1.5)), fill if role == "danger" else theme.surface)):
            self._bar(shapes, (left + inset, y, left + width - inset), height - 2 * inset, round_, colour)
        return left

    def _bar(
        self,
        shapes: Shapes,
        place: tuple[float, float, float],
        height: float,
        corner: float,
        colour: tuple[float, ...] | list[float],
    ) -> None:
        left, y, right = place
        for inset, high in ((corner, height), (0.0, height - 2 * corner)):
            if high > 0:
                shapes.segments(np.array([[left + inset, y]]), np.array([[right - inset, y]]), high, colour)
        rise = height / 2 - corner
        corners = [(x, y + up) for x in (left + corner, right - corner) for up in (-rise, rise)]
        shapes.discs(np.array(corners), corner, colour)


def direction_of(pose: Pose, one: Intruder) -> float:
    """Where it is in `base_link` [rad], positive left, as fine as degrees are read; NaN where one of the two is nowhere."""
    east, north = one.position.x - pose.position.x, one.position.y - pose.position.y
    yaw = pose.orientation.yaw
    if not (math.isfinite(east) and math.isfinite(north) and math.isfinite(yaw)):
        return math.nan
    ahead = math.remainder(math.atan2(north, east) - yaw, math.tau)
    return math.radians(round(math.degrees(ahead)))


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the badge by name."""

    def made(
        *places: tuple[float, float],
        known: bool = True,
        now: float = 112.0,
        size: tuple[float, float] = (320, 46),
        **more: Any,
    ) -> Callable[[], Widget]:
        def build() -> IntruderBadge:
            badge = IntruderBadge(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if more["state"] != "never":
                found = [
                    Intruder(n, "cone", Point(x, y), Time.at(99.0 + n)) for n, (x, y) in enumerate(places, 1)
                ]
                badge.show(IntruderArray(intruders=found))
            if known:
                here = PoseWithCovariance(Pose(Point(0.0, 0.0), Quaternion.from_yaw(0.0)))
                badge.show_pose(PoseWithCovarianceStamped(Header(Time.at(now)), here))
            return badge

        return build

    two = (1.0, 8.0), (3.4, 2.4)
    return {
        "never": made(state="never"),
        "none": made(state="live"),
        "none counted": made(state="live", seen=["cone"]),
        "one": made((3.4, 2.4), state="live"),
        "two": made(*two, state="live"),
        "behind": made((-6.0, 0.2), state="live"),
        "long ago": made(*two, state="live", now=400.0),
        "lost": made(*two, state="live", known=False),
        "phone": made(*two, state="live", size=(200, 46)),
        "narrow": made(*two, state="live", size=(148, 46)),
        "stale": made(*two, state="stale", age=8.2),
        "stale phone": made(*two, state="stale", age=8.2, size=(200, 46)),
        "stale none": made(state="stale", age=8.2),
    }
