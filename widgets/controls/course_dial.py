"""Course dial of a boat: commanded against actual heading, north up.

A finger drags its mark, or rests on the rim until there is one, and lets go to set it; a touch in passing sets nothing.

dial = CourseDial()
robot.on("/compass", dial.show), robot.on("/manoeuvre", dial.show)
dial.bind(on_course=lambda _, yaw: print(yaw))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import BooleanProperty, NumericProperty, OptionProperty
from kivy.uix.widget import Widget

from bridge.core.units import heading_from_yaw, yaw_from_heading
from bridge.msgs.pilothouse_msgs import Compass, Manoeuvre
from widgets.controls.course_picture import KNOB, draw_arc, draw_boat, draw_knob
from widgets.controls.finger_grip import Grip
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word
from widgets.core.finger_stay import FingerStay
from widgets.core.geometry import DASH, dial_point, dial_text, heading_text, shortest_turn
from widgets.core.language import mark, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge

__all__ = ["CourseDial", "samples"]

HOLD_DURATION = 0.6
"""A finger that rests on the rim for so long sets a course [s]; on the mark of one it does at once."""
MAX_SLIP = 14
"""One that moves farther before that was only passing [dp]."""
STEP = 5.0
"""A finger sets courses in steps of this [deg]."""
INNER = 0.42
"""Nearer to the middle than this part of the radius a finger sets nothing: there it can let go without a new course."""
KNOB_SPAN = 13.0
"""What is written nearer to a knob would be covered by it [deg]."""
WIDE = 1.25
"""A card this many times broader than high has its figures beside the dial, where they have room."""
BESIDE = 64
"""The least that is left of the card beside the dial for them to have room [dp]."""
ON_COURSE = 2.5
"""A heading that is no farther off is on course [deg]."""
INVITES = mark("hold to set")
OUTCOMES = {
    "": "",
    "sent": mark("sent"),
    "accepted": mark("taken"),
    "refused": mark("refused"),
    "no_reply": mark("no reply"),
}


class CourseDial(Grip, Gauge):
    """Dispatches `on_course(yaw)` [rad] when a finger that dragged the course along the rim is lifted there."""

    __events__ = ("on_course",)
    accepts: ClassVar = (Compass, Manoeuvre)
    drawn_from: ClassVar = ("heading", "wanted", "asked", "aim", "resting", "dragged", "outcome")

    heading = NumericProperty(math.nan)
    """Of the bow [deg], 0 north, clockwise; NaN when not known."""
    wanted = NumericProperty(math.nan)
    """That the robot follows [deg]; NaN while it follows none."""
    asked = NumericProperty(math.nan)
    """That was asked for and that the robot does not follow yet [deg]; NaN without one."""
    aim = NumericProperty(math.nan)
    """Under the finger [deg]; NaN without one, and where letting go sets nothing."""
    resting = BooleanProperty(False)
    """A finger is on the rim, and nothing follows it yet."""
    dragged = BooleanProperty(False)
    """A course follows the finger."""
    outcome = OptionProperty("", options=list(OUTCOMES))
    """What became of the course that was asked for; empty when there is nothing to say."""

    def __init__(self, **kwargs: Any) -> None:
        self._came: tuple[float, float] | None = None
        self._followed = False
        self._catch = FingerStay(self._caught, HOLD_DURATION)
        super().__init__(**{"title": tr("Course"), **kwargs})
        self.veil_radius = theme.radius

    def show(self, msg: Compass | Manoeuvre) -> None:
        """Show where the bow points, or which course the robot follows."""
        if isinstance(msg, Compass):
            self.heading = round(msg.heading, 1)
            return
        follows = msg.kind == "course" and math.isfinite(msg.yaw)
        self.wanted = round(heading_from_yaw(msg.yaw), 1) if follows else math.nan
        if not follows and self.outcome == "accepted" and self._followed:
            self.asked, self.outcome = math.nan, ""
        self._followed = follows
        if abs(shortest_turn(self.wanted, self.asked)) < STEP / 2:
            self.asked, self.outcome = math.nan, ""

    def answer(self, outcome: str) -> None:
        """What became of the course that was asked for: `sent`, `accepted`, `refused` or `no_reply`."""
        followed = outcome == "accepted" and math.isnan(self.asked)  # the robot was faster than its answer
        self.outcome = "" if followed else outcome
        if outcome in ("refused", "no_reply"):
            self.asked = math.nan

    @property
    def off(self) -> float:
        """How far to turn from the heading to the course [deg], positive to the right; NaN when one is not known."""
        return shortest_turn(self.heading, self.wanted)

    @property
    def off_words(self) -> str:
        """The same in words, as in `7° right`, `on course`; empty when one is not known."""
        if math.isnan(self.off):
            return ""
        if abs(self.off) <= ON_COURSE:
            return tr("on course")
        return f"{abs(self.off):.0f}° {tr('right') if self.off > 0 else tr('left')}"

    @property
    def course(self) -> tuple[float, str]:
        """The course that is shown in figures [deg] and what it is: `let go to set`, `sent`, `hold to set`, or nothing."""
        if self.resting:
            return self.wanted, tr("keep holding")
        if self.dragged:
            return (
                (self.aim, tr("let go to set")) if math.isfinite(self.aim) else (self.wanted, tr("no change"))
            )
        if math.isfinite(self.asked):
            return self.asked, tr(OUTCOMES[self.outcome]) or tr("asked")
        free = math.isnan(self.wanted) and math.isfinite(self.heading) and not self.disabled
        return self.wanted, tr(OUTCOMES[self.outcome]) or (tr(INVITES) if free else "")

    @property
    def place(self) -> tuple[float, float, float]:
        """Middle and radius of the dial [px]."""
        edge = dp(8) if self.card else dp(2)
        radius = max(min(self.width, self.height) / 2 - edge, dp(10))
        x = self.x + edge + radius if self.beside else self.center_x
        return x, self.center_y, radius

    @property
    def beside(self) -> bool:
        """The figures stand beside the dial."""
        return bool(self.width > max(WIDE * self.height, self.height + dp(BESIDE)))

    def holds(self, x: float, y: float) -> bool:
        """On the dial, but not in its middle."""
        middle_x, middle_y, radius = self.place
        return INNER * radius <= math.dist((x, y), (middle_x, middle_y)) <= radius + dp(4)

    def follow(self, touch: Any) -> None:
        """Wait until the finger means it, then point where it is; in the middle, nowhere."""
        if self._came is None:
            self._came = touch.pos
            self.dragged = self._on_mark(*touch.pos)
            self.resting = not self.dragged
            if self.dragged:
                self.aim = self.asked if math.isfinite(self.asked) else self.wanted
            else:
                self._catch.begin()
        elif self.resting:
            if math.dist(touch.pos, self._came) > dp(MAX_SLIP):
                self.rest()
        else:
            self._point(*touch.pos)

    def _on_mark(self, x: float, y: float) -> bool:
        """On the mark of the course that is followed or asked for."""
        middle_x, middle_y, radius = self.place
        marks = [one for one in (self.wanted, self.asked) if math.isfinite(one)]
        knobs, reach = [dial_point(one, radius * KNOB) for one in marks], min(theme.target / 2, radius / 2)
        return any(math.dist((x - middle_x, y - middle_y), knob) <= reach for knob in knobs)

    def _caught(self) -> None:
        """The finger rested long enough."""
        if self.finger is not None and self.resting:
            self.resting, self.dragged = False, True
            self._point(*self.finger.pos)

    def _point(self, to_x: float, to_y: float) -> None:
        x, y, radius = self.place
        if math.dist((to_x, to_y), (x, y)) < INNER * radius:
            self.aim = math.nan
            return
        bearing = heading_from_yaw(math.atan2(to_y - y, to_x - x))
        self.aim = round(bearing / STEP) * STEP % 360.0

    def spring(self) -> None:
        """Leave the course as it was."""
        self._catch.end()
        self._came = None
        self.aim, self.dragged, self.resting = math.nan, False, False

    def on_touch_up(self, touch: Any) -> bool:
        """Ask for the course under the finger, where that is another one."""
        ours = touch.grab_current is self and self.dragged
        aim, now = self.aim if ours else math.nan, self.asked if math.isfinite(self.asked) else self.wanted
        done = bool(super().on_touch_up(touch))
        if math.isfinite(aim) and aim != now:
            self.asked, self.outcome = aim, "sent"
            self.dispatch("on_course", yaw_from_heading(aim))
        return done

    def on_course(self, yaw: float) -> None:
        """A finger asks for the course `yaw` [rad], 0 east, anticlockwise."""

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Dial, courses, heading, figures."""
        yield from self._card(shapes)
        x, y, radius = self.place
        if math.isfinite(self.off) and abs(self.off) > ON_COURSE:
            draw_arc(shapes, self.place, self.heading, self.off)
        if math.isfinite(self.heading):
            corners = [(0.0, 0.77), (-9.0, 0.58), (0.0, 0.62), (9.0, 0.58)]
            points = [dial_point(self.heading + turn, radius * reach) for turn, reach in corners]
            shapes.polygon([(x + a, y + b) for a, b in reversed(points)], theme.accent)
            if self.beside:
                draw_boat(shapes, self.place, self.heading)
        draw_knob(shapes, self.place, self.wanted, filled=True)
        if self.dragged:
            draw_knob(shapes, self.place, self.aim, filled=False, held=True)
        else:
            draw_knob(shapes, self.place, self.asked, filled=False)
        yield from self._column() if self.beside else self._inside()

    def _card(self, shapes: Shapes) -> Iterator[Word]:
        x, y, radius = self.place
        shapes.disc(x, y, radius, theme.raised)
        shapes.ring(x, y, radius - dp(0.75), dp(1.5), theme.line)
        middle = np.array([x, y])
        for long, length, width, ink in ((False, 0.06, 1.2, theme.muted), (True, 0.11, 2.0, theme.text)):
            bearings = [one for one in range(0, 360, 10) if (one % 30 == 0) == long]
            outer = np.array([dial_point(one, radius * 0.97) for one in bearings]) + middle
            inner = np.array([dial_point(one, radius * (0.97 - length)) for one in bearings]) + middle
            shapes.segments(outer, inner, dp(width), ink)
        every = 30 if radius > dp(95) else 90
        knobs = [one for one in (self.wanted, self.asked, self.aim) if math.isfinite(one)]
        for bearing in range(0, 360, every):
            if any(abs(shortest_turn(one, bearing)) < KNOB_SPAN for one in knobs):
                continue
            main = bearing % 90 == 0
            across, up = dial_point(bearing, radius * 0.76)
            size = max(radius * (0.15 if main else 0.11), sp(11))
            ink = theme.text if main else theme.muted
            yield Word(dial_text(bearing), x + across, y + up, size, ink, bold=main)

    def _inside(self) -> Iterator[Word]:
        """Course and heading in the middle of the dial."""
        x, y, radius = self.place
        room = 2 * radius * 0.52
        course, said = self.course
        told = said or self.off_words
        small = min(max(radius * 0.13, sp(10.5)), sp(14))
        size = fitting_size([heading_text(course)], radius * 0.34, room, bold=True)
        shift = radius * 0.05 if math.isfinite(course) else 0.0  # the degree sign hangs over
        yield Word(tr("Course").upper(), x, y + radius * 0.33, small * 0.85, theme.plan, bold=True)
        yield Word(heading_text(course), x + shift, y + radius * 0.1, size, theme.text, bold=True)
        lower = fitting_size([told], small, room)
        yield Word(told, x, y - radius * 0.16, lower, self._said_ink(said))
        bow = heading_text(self.heading)
        yield Word(
            tr("bow {heading}").format(heading=bow), x, y - radius * 0.36, small, theme.accent, bold=True
        )

    def _said_ink(self, said: str) -> Any:
        return theme.danger if self.outcome in ("refused", "no_reply") and said else theme.muted

    def _column(self) -> Iterator[Word]:
        """Beside the dial: course, heading, how far off; in the middle what a finger does."""
        x, y, radius = self.place
        left, top = x + radius + dp(14), self.top - self.edge
        room = self.right - self.edge - left
        course, said = self.course
        free = self.height - 2 * self.edge
        lines = 3 if free >= 3 * sp(38) else 2
        high = free / lines
        large = sp(28 if high > dp(58) else 18)
        told = said or self.off_words
        first = said.upper() if said not in ("", tr(INVITES)) and lines == 2 else tr("Course").upper()
        for row, (name, value, ink) in enumerate(
            ((first, course, theme.plan), (tr("Heading").upper(), self.heading, theme.accent))
        ):
            up = top - row * high
            small = fitting_size([name], sp(11.5), room, bold=True)
            yield Word(name, left, up - sp(6), small, ink, bold=True, anchor=(0, 0.5))
            size = fitting_size([heading_text(value)], large, room, bold=True)
            yield Word(
                heading_text(value),
                left,
                up - sp(17) - large / 2,
                size,
                theme.text,
                bold=True,
                anchor=(0, 0.5),
            )
        if lines == 3:
            size = fitting_size([told], sp(13), room)
            yield Word(told, left, top - 2 * high - sp(8), size, self._said_ink(said), anchor=(0, 0.5))
        if math.isnan(self.heading):
            yield Word(DASH, x, y, radius * 0.3, theme.muted)


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the dial by name."""

    def made(size: tuple[float, float] = (176, 176), **more: Any) -> Callable[[], Widget]:
        return lambda: CourseDial(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)

    large = (326, 228)
    usual: dict[str, Any] = {"heading": 38.0, "wanted": 45.0}
    far: dict[str, Any] = {"heading": 340.0, "wanted": 75.0}
    return {
        "never": made(state="never"),
        "no course": made(heading=214.0),
        "live": made(**usual),
        "far off": made(**far),
        "on course": made(heading=44.0, wanted=45.0),
        "finger rests": made(**usual, resting=True),
        "asked": made(**usual, asked=120.0, outcome="sent"),
        "taken": made(**usual, asked=120.0, outcome="accepted"),
        "dragged": made(**usual, aim=120.0, dragged=True),
        "large dragged": made(large, **usual, aim=265.0, dragged=True),
        "dragged to the middle": made(**usual, dragged=True),
        "refused": made(**usual, outcome="refused"),
        "square": made((242, 242), **far),
        "large": made(large, **far),
        "large asked": made(large, **usual, asked=120.0, outcome="sent"),
        "large never": made(large, state="never"),
        "short": made((212, 148), **far),
        "stale": made(**usual, state="stale", age=3.0),
        "alarm": made(large, **usual, state="alarm"),
        "disabled": made(**usual, state="disabled"),
    }
