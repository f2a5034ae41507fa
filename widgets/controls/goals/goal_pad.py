"""Goal of a robot: buttons move it by a quarter of a metre and turn it by 15°, and Go sends it.

pad = GoalPad()
robot.on("/pose", pad.show)
pad.bind(on_command=lambda _, goal: robot.publish("/goal_pose", goal))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.metrics import dp, sp
from kivy.properties import OptionProperty
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
)
from widgets.controls.finger_grip import Grip
from widgets.controls.goals.goal_choice import BUTTONS, STEP, TURN, UNDER_WAY, GoalChoice
from widgets.controls.goals.goal_picture import Box, draw, ground
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word, tint
from widgets.core.finger_stay import FingerStay
from widgets.core.geometry import DASH
from widgets.core.icons import icon
from widgets.core.language import brief_figure, figure, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge

__all__ = ["STEP", "TURN", "GoalPad", "samples"]

REPEAT_AFTER, REPEAT_EVERY = 0.45, 0.12
"""A held button goes on moving the goal [s]."""
MIN_CELL = 53
"""Least side of a button for which a picture or a table may take room from the buttons [dp]."""
MIN_WORDS_HEIGHT = 46
"""Lower buttons have their icon only [sp]."""
ROOMY = 66
"""A wider corner has room for units and for the sign of the robot [dp]."""
GAP = 3
"""Between the buttons [dp]."""

AXES = {"north": "y+", "south": "y−", "east": "x+", "west": "x−"}
AXIS_NAMES = ("x", "y", "yaw")


class GoalPad(GoalChoice, Grip, Gauge):
    """Dispatches `on_command(pose)`, a PoseStamped in `map`, when Go is pressed, and only then."""

    drawn_from: ClassVar = ("actual", "wanted", "followed", "outcome", "way", "pressed")

    pressed = OptionProperty("", options=["", *BUTTONS])
    """The button under the finger; empty without one."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": "Goal", **kwargs})
        self.veil_radius = theme.radius
        self._repeat = Clock.create_trigger(lambda _: self.press(self.pressed), REPEAT_EVERY, interval=True)
        self._held = FingerStay(self._repeat, REPEAT_AFTER)

    def spring(self) -> None:
        """Count no further; the goal stays."""
        self.pressed = ""
        self._held.end()
        self._repeat.cancel()

    def holds(self, x: float, y: float) -> bool:
        """On a button."""
        return bool(self._button_at(x, y))

    def follow(self, touch: Any) -> None:
        """Count at once where the finger comes down, and on while it stays; Go waits until it is lifted."""
        name = self._button_at(*touch.pos)
        if self.pressed and name != self.pressed:
            self.rest()
        elif name and not self.pressed:
            self.pressed = name
            if name not in ("go", "here"):
                self.press(name)
                self._held.begin()

    def on_touch_up(self, touch: Any) -> bool:
        """Go, where the finger is still on it."""
        name = self.pressed if touch.grab_current is self else ""
        done = bool(super().on_touch_up(touch))
        if name in ("go", "here"):
            self.press(name)
        return done

    def _button_at(self, x: float, y: float) -> str:
        for name in BUTTONS:
            left, low, width, height = self.button(name)
            if left <= x <= left + width and low <= y <= low + height:
                return name
        return ""

    def button(self, name: str) -> Box:
        """Where a button is."""
        column, row, *_ = BUTTONS[name]
        return self._cell(column, row)

    def _cell(self, column: int, row: int) -> Box:
        left, low, width, height = self.layout[0]
        gap = dp(GAP)
        wide, high = (width - 2 * gap) / 3, (height - 2 * gap) / 3
        return left + column * (wide + gap), low + (2 - row) * (high + gap), wide, high

    @property
    def layout(self) -> tuple[Box, Box | None, Box | None]:
        """Of the pad, of the picture and of the figures; None for what has no room: the figures are in corners then."""
        # a whole target each where there is room; nine of them would fill half a phone, so on a small card less
        edge, least, wanted = dp(5), 3 * dp(MIN_CELL) + 2 * dp(GAP), 3 * theme.target + 2 * dp(GAP)
        left, low = self.x + edge, self.y + edge
        width, height = self.width - 2 * edge, self.height - 2 * edge
        gap, table = dp(10), sp(62)
        if width >= least + gap + dp(116) and height < 2 * least + table:
            wide = min(max(wanted, width * 0.54), max(height * 1.1, wanted), width - gap - dp(116))
            rest = left + dp(5), low + dp(4), width - wide - gap, height - dp(8)
            figures = rest[0], rest[1], rest[2], table
            picture = rest[0], rest[1] + table + dp(6), rest[2], rest[3] - table - dp(6)
            return (left + width - wide, low, wide, height), picture, figures
        pad = min(max(wanted, min(width * 0.75, height * 0.45)), height - table - dp(10))
        if pad < least:
            return (left, low, width, height), None, None
        figures = left + dp(6), low + height - table - dp(4), width - dp(12), table
        free = height - pad - table - dp(10)
        if free < dp(90):
            return (left, low, width, height - table - dp(8)), None, figures
        picture = left + dp(6), low + pad + dp(6), width - dp(12), free - dp(8)
        return (left, low, width, pad), picture, figures

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The buttons, the picture, the figures."""
        _, picture, figures = self.layout
        for name in BUTTONS:
            if name != "here" or figures is not None:
                yield from self._draw_button(shapes, name)
        if picture is not None:
            sent = self.outcome in UNDER_WAY
            yield from draw(
                shapes,
                picture,
                self.actual,
                self.wanted,
                self.way,
                self.step,
                sent=sent,
                followed=self.followed,
            )
        if figures is None:
            yield from self._in_corners(shapes)
        else:
            yield from self._table(figures)
            left, low, width, height = self._cell(2, 2)
            for row, step in ((-1, f"{brief_figure(self.step)} m"), (1, f"{math.degrees(TURN):.0f}°")):
                yield Word(step, left + width / 2, low + height / 2 - row * sp(9), sp(12), theme.muted)

    def _draw_button(self, shapes: Shapes, name: str) -> Iterator[Word]:
        left, low, width, height = box = self.button(name)
        x, y, can = left + width / 2, low + height / 2, self.can(name)
        main = name == "go" and can and self.outcome not in UNDER_WAY
        if name == "go" and self.outcome in ("refused", "failed"):
            fill, ink = theme.danger, theme.ink_danger
        else:
            fill, ink = (theme.accent, theme.ink_accent) if main else (theme.raised, theme.text)
        if name == "go" and self.outcome in UNDER_WAY:
            ink = theme.plan
        elif not can:
            ink = theme.faint
        ground(shapes, box, fill, fill if main else theme.line)
        if self.pressed == name:
            ground(shapes, box, tint(ink, 0.18), ink)
        words, sign = self.says if name == "go" else (AXES.get(name, ""), BUTTONS[name][2])
        if height < sp(MIN_WORDS_HEIGHT):
            words = ""
        shift = sp(9) if words else 0
        yield Word(icon(sign), x, y + shift, sp(24), ink, font=theme.icons)
        if words:
            size = fitting_size([words], sp(14), width - dp(6), bold=name == "go")
            yield Word(words, x, y - sp(14), size, ink, bold=name == "go")

    def _figures(self, place: list[float]) -> tuple[str, str, str]:
        if not place:
            return DASH, DASH, DASH
        x, y = (figure(value, 2 if abs(value) < 99.995 else 1) for value in place[:2])
        return x, y, f"{figure(math.degrees(place[2]), 0)}°"

    def _in_corners(self, shapes: Shapes) -> Iterator[Word]:
        """Where the robot is in the lower left corner, which is a button too, where it is to go in the lower right one."""
        here, there = self._cell(0, 2), self._cell(2, 2)
        fill = tint(theme.accent, 0.25) if self.pressed == "here" else theme.raised
        ground(shapes, here, fill, theme.line)
        left, low, width, height = here
        if height < sp(MIN_WORDS_HEIGHT):
            sign = icon("my_location")
            yield Word(sign, left + width / 2, low + height / 2, sp(24), theme.text, font=theme.icons)
            return
        aside = dp(6) if width > dp(ROOMY) else 0
        if aside:
            y = low + height - sp(9)
            yield Word(icon("my_location"), left + dp(11), y, sp(12), theme.text, font=theme.icons)
        yield from self._corner(here, tr("Robot").upper(), self._figures(self.actual), theme.accent, aside)
        if self.wanted:
            told, figures = tr("New" if self.followed else "Goal", "goal").upper(), self._figures(self.wanted)
        else:  # until there is a goal it says what a press does
            step = brief_figure(self.step)
            told, figures = tr("Step").upper(), (step, step, f"{math.degrees(TURN):.0f}°")
        yield from self._corner(there, told, figures, theme.plan, 0)

    def _corner(
        self, box: Box, told: str, figures: tuple[str, str, str], colour: Sequence[float], aside: float
    ) -> Iterator[Word]:
        """A name, `aside` of the middle [px], and three figures under it, with their unit where there is room."""
        left, low, width, height = box
        y, step, roomy = low + height - sp(9), (height - sp(20)) / 3, width > dp(ROOMY)
        unit = " m" if roomy and figures[0] != DASH else ""
        shown = [text if text.endswith("°") else text + unit for text in figures]
        size = fitting_size(shown, sp(15 if height >= dp(68) else 12), width - dp(20), bold=True)
        yield Word(told, left + width / 2 + aside, y, sp(10), colour, bold=True)
        for row, (axis, text) in enumerate(zip(AXIS_NAMES, shown, strict=True), 1):
            at = y - row * step + sp(1)
            if axis != "yaw" or roomy:  # the degree says it too
                yield Word(axis, left + dp(5), at, sp(11), theme.muted, anchor=(0, 0.5))
            yield Word(text, left + width - dp(4), at, size, theme.text, bold=True, anchor=(1, 0.5))

    def _table(self, box: Box) -> Iterator[Word]:
        """Two columns under their names: where it is, where it is to go."""
        left, low, width, height = box
        right, rows = left + width, height / 4
        middle = left + sp(22) + (width - sp(22)) / 2
        new = tr("New goal") if width > sp(170) else tr("New", "goal")
        for x, name, place, colour in (
            (middle, tr("Robot"), self.actual, theme.accent),
            (right, new if self.followed else tr("Goal", "goal"), self.wanted, theme.plan),
        ):
            yield Word(name.upper(), x, low + rows * 3.5, sp(11), colour, bold=True, anchor=(1, 0.5))
            units = (" m", " m", "") if width > dp(116) else ("", "", "")
            told = zip(self._figures(place), units, strict=True)
            shown = [text + (unit if place else "") for text, unit in told]
            size = fitting_size(shown, sp(14), (width - sp(22)) / 2 - dp(6), bold=True)
            for row, text in enumerate(shown):
                yield Word(text, x, low + rows * (2.5 - row), size, theme.text, bold=True, anchor=(1, 0.5))
        for row, axis in enumerate(AXIS_NAMES):
            yield Word(axis, left, low + rows * (2.5 - row), sp(12), theme.muted, anchor=(0, 0.5))


def _pose(x: float, y: float, degrees: float) -> PoseWithCovarianceStamped:
    pose = Pose(Point(x, y), Quaternion.from_yaw(math.radians(degrees)))
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(pose))


def _made(
    *presses: str,
    size: tuple[float, float] = (176, 176),
    outcome: str = "",
    at: PoseWithCovarianceStamped | None = None,
    followed: tuple[float, ...] = (),
    **more: Any,
) -> Callable[[], Widget]:
    """A pad on which these buttons were pressed, before the robot went to `at`."""

    def build() -> GoalPad:
        pad = GoalPad(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
        if presses:
            pad.show(_pose(1.27, -0.49, 62.0))
        for name in presses:
            pad.press(name)
        if at is not None:
            pad.show(at)
        pad.answer(outcome)
        pad.followed = list(followed)
        return pad

    return build


def samples() -> dict[str, Callable[[], Widget]]:
    """Each state of the goal, in the sizes that screens give it."""
    steps = ("east",) * 5 + ("north",) * 4 + ("turn right",) * 3
    large, wide = (326, 228), (242, 242)
    return {
        "never": _made(state="never"),
        "live": _made(*steps),
        "held": _made(*steps, pressed="east"),
        "far away": _made("east", at=_pose(-123.4, 87.66, 180.0)),
        "sent": _made(*steps, outcome="sent"),
        "going": _made(*steps, outcome="accepted"),
        "waiting": _made(*steps, outcome="waiting"),
        "paused": _made(*steps, outcome="paused"),
        "canceled": _made(*steps, outcome="canceled"),
        "failed": _made(*steps, outcome="failed"),
        "refused": _made(*steps, outcome="refused"),
        "no reply": _made(*steps, outcome="no_reply"),
        "there": _made(*steps, outcome="accepted", at=_pose(2.45, 0.52, 16.0)),
        "square": _made(*steps, size=wide),
        "large": _made(*steps, size=large),
        "large never": _made(size=large, state="never"),
        "large going": _made(*steps, size=large, outcome="accepted"),
        "other goal": _made(*steps, size=large, followed=(-1.0, 1.5, 0.5)),
        "other goal, huge": _made(*steps, size=(420, 470), followed=(-1.0, 1.5, 0.5)),
        "huge": _made(*steps, size=(420, 470), outcome="accepted"),
        "broad": _made(*steps, size=(420, 190)),
        "stale": _made(*steps, size=large, state="stale", age=3.0),
        "alarm": _made(*steps, size=large, state="alarm"),
        "disabled": _made(*steps, state="disabled"),
    }
