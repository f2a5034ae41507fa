"""Commanded motion in figures: speed ahead, up and round, and what is held.

motion = CommandedMotion()
robot.on("/manoeuvre", motion.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar, NamedTuple

from kivy.metrics import dp, sp
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from widgets.core.canvas_ink import Word
from widgets.core.geometry import DASH
from widgets.core.language import DASH as LONG_DASH
from widgets.core.language import figure, mark, tr
from widgets.core.quantities import said
from widgets.core.shapes import Shapes
from widgets.core.task_words import heading_of
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["CommandedMotion", "Figure", "samples"]

KINDS = {
    "twist": mark("Speeds"),
    "steer": mark("Steered"),
    "course": mark("On course"),
    "tilt": mark("Tilted"),
    "hover": mark("Holding"),
    "take_off": mark("Taking off"),
    "land": mark("Landing"),
    "surface": mark("Surfacing"),
    "rest": mark("At rest"),
}
"""Kind of manoeuvre to what people say of it."""
NARROW, MIN_ROW_HEIGHT, GAP = 68, 40, 12
"""Least width of a column, height of a row, and room between columns [dp, sp, dp]."""
MIN_SPEED = 1e-3
"""A speed below this is none [m/s, rad/s]."""


class Figure(NamedTuple):
    """One figure of the order."""

    name: str
    text: str
    unit: str = ""
    role: str = "text"
    """Of its colour; what is to be held is `plan`."""


class CommandedMotion(Gauge):
    """Name, value and unit of each part of the order, and its kind in a word."""

    accepts: ClassVar = (Manoeuvre,)
    grid_size: ClassVar = (3, 3)
    drawn_from: ClassVar = ("kind", "figures")

    kind = StringProperty("")
    """Of the order, as the message says it; empty before the first."""
    figures: ListProperty[Figure] = ListProperty()
    """A `Figure` for each part that the order has."""
    target = NumericProperty(math.nan)
    """Depth or height that is held independently of the order [m]; NaN for none."""
    under_water = BooleanProperty(False)
    """A height is shown as a depth."""

    def __init__(self, **kwargs: Any) -> None:
        self._order: Manoeuvre | None = None
        self._aside: set[str] = set()
        super().__init__(**{"title": tr("Commanded"), **kwargs})
        for name in ("target", "under_water"):
            self.fbind(name, self._read)
        self._read()

    def show(self, msg: Manoeuvre) -> None:
        """Take over the order; NaN in it is a dash, or left out where it says that nothing is wanted of that."""
        self._order = msg
        self.kind = msg.kind
        self._read()

    @property
    def word(self) -> str:
        """The kind in a word; as the message says it where it is not known."""
        return tr(KINDS.get(self.kind, self.kind.replace("_", " ").capitalize()))

    def _read(self, *_: object) -> None:
        order = self._order
        if order is None:
            told = [_speed(tr("Surge"), math.nan), _speed(tr("Heave"), math.nan), _rate(tr("Yaw"), math.nan)]
        else:
            told = [*getattr(self, f"_of_{order.kind}" if order.kind in KINDS else "_of_nothing")(order)]
        height = math.nan if order is None else order.height
        held = height if order is not None and order.kind in ("course", "hover", "take_off") else math.nan
        told += self._height(held)
        if told != self.figures:
            self.figures = told

    def _height(self, held: float) -> list[Figure]:
        if math.isnan(held):
            held = -self.target if self.under_water else self.target
        if math.isnan(held):
            return []
        if self.under_water:
            return [Figure(tr("Target depth"), *said(-held, "height", 1), "plan")]
        return [Figure(tr("Target height"), *said(held, "height", 1), "plan")]

    def _of_twist(self, order: Manoeuvre) -> Iterator[Figure]:
        """Ahead, up and round always; aside, roll and pitch from when they were first asked for."""
        linear, angular = order.twist.linear, order.twist.angular
        more = {"Sway": linear.y, "Roll": angular.x, "Pitch": angular.y}
        self._aside |= {name for name, value in more.items() if abs(value) > MIN_SPEED}
        yield _speed(tr("Surge"), linear.x)
        if "Sway" in self._aside:
            yield _speed("Sway", linear.y)
        yield _speed(tr("Heave"), linear.z)
        for name in ("Roll", "Pitch"):
            if name in self._aside:
                yield _rate(name, more[name])
        yield _rate(tr("Yaw"), angular.z)

    def _of_rest(self, _: Manoeuvre) -> Iterator[Figure]:
        yield from self._of_twist(Manoeuvre())

    def _of_steer(self, order: Manoeuvre) -> Iterator[Figure]:
        yield from _push(order)
        yield _angle(tr("Steer"), order.steering)

    def _of_course(self, order: Manoeuvre) -> Iterator[Figure]:
        yield from _push(order)
        yield _heading(order.yaw)

    def _of_tilt(self, order: Manoeuvre) -> Iterator[Figure]:
        if math.isfinite(order.speed) or math.isfinite(order.throttle):
            yield from _push(order)
        yield _angle("Pitch", order.pitch)
        yield _angle("Roll", order.roll)
        yield _speed(tr("Heave"), order.twist.linear.z)
        yield _rate(tr("Yaw"), order.twist.angular.z)

    def _of_hover(self, order: Manoeuvre) -> Iterator[Figure]:
        yield _heading(order.yaw)

    def _of_nothing(self, _: Manoeuvre) -> Iterator[Figure]:
        yield from ()

    _of_take_off = _of_land = _of_surface = _of_nothing

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The kind in the header, the figures in columns."""
        bottom = self.y + self.edge
        top = self.top - self.edge
        if not self.low:
            yield from self.header((self.word,) if self.kind else (), "accent")
            top -= sp(12) + dp(4)
        if not self.figures:
            size = min(sp(26), (self.width - 2 * self.edge) / 7)
            yield Word(self.word or DASH, self.center_x, (bottom + top) / 2, size, theme.text, bold=True)
            return
        columns, rows, size = self._grid(top - bottom)
        across, high = (self.width - 2 * self.edge) / columns, (top - bottom) / rows
        shown, cells = list(self.figures), columns * rows
        if len(shown) > cells:
            shown[cells - 1 :] = shown[-1:]
        for number, told in enumerate(shown):
            row, column = divmod(number, columns)
            left = self.x + self.edge + column * across
            yield from self._cell(told, (left, top - (row + 0.5) * high), size, across - dp(GAP))

    def _grid(self, high: float) -> tuple[int, int, float]:
        """Columns, rows and size of the type [px]: those with which it is largest; what has no room is left out, but for the last."""
        room, count = self.width - 2 * self.edge, len(self.figures)
        most = max(1, min(count, int(room // dp(NARROW))))
        fits = max(1, int(high // sp(MIN_ROW_HEIGHT)))
        tried = [(columns, min(math.ceil(count / columns), fits)) for columns in range(1, most + 1)]
        whole = [grid for grid in tried if grid[0] * grid[1] >= count] or [(most, fits)]
        sized = [
            (self._size(room / columns - dp(GAP), high / rows), -columns, rows) for columns, rows in whole
        ]
        size, columns, rows = max(sized)
        return -columns, rows, size

    def _size(self, room: float, high: float) -> float:
        """Of the values' type in so much room, the same for all [px]."""
        size = min(sp(30), (high - sp(13)) / 1.4)
        widest = max(wide(told.text, size, bold=True) + _unit_wide(told, size) for told in self.figures)
        return max(min(size, size * room / widest), float(dp(11)))

    def _cell(self, told: Figure, place: tuple[float, float], size: float, room: float) -> Iterator[Word]:
        left, y = place
        rise = max(size * 0.5, sp(9.5))
        names = (told.name, told.name.split()[-1])
        name = first_fitting([text.upper() for text in names], sp(11.5), room)
        yield Word(name, left, y + rise + sp(1), sp(11.5), theme.muted, anchor=(0, 0.5))
        role = "muted" if told.text == LONG_DASH else told.role
        yield Word(told.text, left, y - rise * 0.5, size, theme.roles[role], bold=True, anchor=(0, 0.5))
        if told.unit and told.text != LONG_DASH:
            behind = left + wide(told.text, size, bold=True) + size * 0.18
            yield Word(
                told.unit,
                behind,
                y - rise * 0.5 - size * 0.12,
                _unit_size(size),
                theme.muted,
                anchor=(0, 0.5),
            )


def _unit_size(size: float) -> float:
    return max(size * 0.5, min(float(sp(11)), size * 0.75))


def _unit_wide(told: Figure, size: float) -> float:
    return wide(told.unit, _unit_size(size)) + size * 0.18 if told.unit else 0.0


def _speed(name: str, value: float) -> Figure:
    return Figure(name, *said(value, "speed", 2))


def _rate(name: str, value: float) -> Figure:
    return Figure(name, figure(math.degrees(value), 0, signed=True), "°/s")


def _angle(name: str, value: float) -> Figure:
    told = figure(math.degrees(value), 0, signed=True)
    return Figure(name, told + ("" if told == LONG_DASH else "°"))


def _heading(yaw: float) -> Figure:
    return Figure(tr("Heading"), heading_of(yaw) if math.isfinite(yaw) else tr("as now"), role="plan")


def _push(order: Manoeuvre) -> Iterator[Figure]:
    """How it goes ahead: by a speed or by a throttle."""
    if math.isfinite(order.throttle) and not math.isfinite(order.speed):
        yield Figure(tr("Throttle"), figure(order.throttle * 100, 0), "%")
    else:
        yield _speed(tr("Surge"), order.speed)


def samples() -> dict[str, Callable[[], Widget]]:
    """Each kind of order, small and large, and the states."""
    swim = Manoeuvre(kind="twist", twist=Twist(Vector3(0.45, 0.0, -0.10), Vector3(0.0, 0.0, 0.14)))
    six = Manoeuvre(kind="twist", twist=Twist(Vector3(0.45, 0.1, -0.10), Vector3(0.1, -0.1, 0.14)))
    course = Manoeuvre(kind="course", speed=0.5, yaw=-0.8, height=-4.5)
    tilt = Manoeuvre(kind="tilt", twist=swim.twist, roll=0.09, pitch=-0.2)

    def made(
        msg: Manoeuvre | None = swim, size: tuple[float, float] = (176, 176), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> CommandedMotion:
            motion = CommandedMotion(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if msg is not None:
                motion.show(msg)
            return motion

        return build

    live: dict[str, Any] = {"state": "live", "under_water": True}
    return {
        "never": made(None),
        "live": made(target=4.5, **live),
        "six": made(six, target=4.5, **live),
        "course": made(course, **live),
        "tilt": made(tilt, **live),
        "steer": made(Manoeuvre(kind="steer", throttle=0.6, steering=0.2), state="live"),
        "hover": made(Manoeuvre(kind="hover", height=12.0), state="live"),
        "take off": made(Manoeuvre(kind="take_off", height=1.5), state="live"),
        "surface": made(Manoeuvre(kind="surface"), **live),
        "rest": made(Manoeuvre(kind="rest"), **live),
        "unknown kind": made(Manoeuvre(kind="barrel_roll"), state="live"),
        "large": made(target=4.5, size=(326, 228), **live),
        "large six": made(six, target=4.5, size=(326, 228), **live),
        "wide": made(target=4.5, size=(420, 96), **live),
        "low": made(target=4.5, size=(300, 54), **live),
        "bare": made(target=4.5, size=(240, 150), card=False, **live),
        "stale": made(age=2.0, state="stale"),
        "alarm": made(state="alarm"),
        "disabled": made(state="disabled"),
    }
