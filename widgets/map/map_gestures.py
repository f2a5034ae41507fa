"""Gestures on a map: pan, pinch, wheel, tap, and drag what can be dragged.

A mixin for `MapOverlay`. It follows its own fingers only: one that came down elsewhere is not its business.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from kivy.input import MotionEvent
from kivy.metrics import dp
from kivy.properties import ListProperty, NumericProperty, ObjectProperty, OptionProperty
from kivy.uix.widget import Widget

from widgets.core.finger_stay import FingerStay
from widgets.core.geometry import View, nearest
from widgets.core.theme import theme
from widgets.map.map_marks import handle_reach

__all__ = ["Grip", "MapGestures"]

MAX_SLIP = 8
"""How far a finger may slip and still tap [dp]."""
HOLD_DURATION = 0.6
"""A finger that stays so long [s] asks for a new place."""
WHEEL_STEP = 1.2
"""Zoom of one step of the wheel."""


@dataclass(slots=True)
class Grip:
    """What a finger holds, and where it has brought it."""

    what: str
    """`waypoint`, `home`, `robot`, `turn` or `measured`."""
    index: int
    """Of the waypoint or the measured place; -1 for the others."""
    x: float
    """[m]"""
    y: float
    """[m]"""
    slip: complex
    """From the finger to what it holds, when it took it [px]."""
    moved: bool = False


class MapGestures(Widget):
    """Fingers on a map, as changes of the view and as events in world coordinates [m]."""

    view: ObjectProperty[View] = ObjectProperty(View())
    """How the world lies on the screen, a `View`."""
    mode = OptionProperty("view", options=("view", "points", "home", "place", "place_robot", "measure"))
    """What a tap or a drag means: look only; add, select and move waypoints; set home; make and open named places;
    say where the robot is; measure."""
    waypoints: ListProperty[tuple[float, float]] = ListProperty()
    """Places to pass in order, (x, y) in `map` [m]."""
    selected: NumericProperty[int] = NumericProperty(-1)
    """Index of the selected waypoint; -1 for none."""
    home: ListProperty[float] = ListProperty()
    """The place to return to, (x, y) in `map` [m]; empty when it is not set."""
    places: ListProperty[tuple[float, float, str, str]] = ListProperty()
    """Places that have names: x, y in `map` [m], name, kind."""
    placed: ListProperty[float] = ListProperty()
    """Where the operator is putting the robot: x, y [m], yaw [rad]; empty unless `mode` is `place_robot`."""
    grip: ObjectProperty[Grip | None] = ObjectProperty(None, allownone=True)
    """What a finger holds just now, a `Grip`, or None."""

    __events__ = (
        "on_add",
        "on_move",
        "on_select",
        "on_set_home",
        "on_place_robot",
        "on_new_place",
        "on_open_place",
    )

    may_turn = True
    """Two fingers may turn the map."""

    def __init__(self, **kwargs: Any) -> None:
        self._fingers: dict[int, complex] = {}
        self._start = 0j
        self._tapping = False
        self._stay = FingerStay(self._hold, HOLD_DURATION)
        super().__init__(**kwargs)

    def on_add(self, x: float, y: float) -> None:
        """A tap asks for a new waypoint at (x, y); the owner puts it into `waypoints`."""

    def on_move(self, index: int, x: float, y: float) -> None:
        """A finger has dragged waypoint `index` to (x, y) and let go; `waypoints` has it already."""

    def on_select(self, index: int) -> None:
        """A tap has selected waypoint `index`; -1 when it selected none."""

    def on_set_home(self, x: float, y: float) -> None:
        """Home was put to (x, y); `home` has it already."""

    def on_place_robot(self, x: float, y: float, yaw: float) -> None:
        """The operator says that the robot is at (x, y), turned to `yaw` [rad]."""

    def on_new_place(self, x: float, y: float) -> None:
        """A finger that stayed, or a tap in the mode for it, asks for a new place at (x, y)."""

    def on_open_place(self, index: int) -> None:
        """A tap in the mode for it asks for the place at `index` of `places`."""

    def set_view(self, view: View) -> None:
        """Change the view as the operator wishes."""
        raise NotImplementedError

    def let_go(self) -> None:
        """Forget all fingers; what they held goes back to where it was."""
        self._fingers.clear()
        self._stay.end()
        self._tapping, self.grip = False, None

    def on_touch_down(self, touch: MotionEvent) -> bool:
        """Take a finger that comes down on the map."""
        if self.disabled or not self.collide_point(*touch.pos):
            return False
        if super().on_touch_down(touch):
            return True
        if touch.is_mouse_scrolling:
            step = WHEEL_STEP if touch.button == "scrolldown" else 1 / WHEEL_STEP
            self.set_view(self.view.zoomed(step, *touch.pos))
            return True
        touch.grab(self)
        self._fingers[touch.uid] = complex(*touch.pos)
        self._tapping = len(self._fingers) == 1
        if self._tapping:
            self._start = complex(*touch.pos)
            self.grip = self._grip_at(*touch.pos)
        self._stay.end()
        if self._tapping and self.grip is None and self.mode in ("view", "points", "place"):
            self._stay.begin()
        return True

    def _hold(self) -> None:
        """A finger has stayed where it came down."""
        if self._tapping and len(self._fingers) == 1:
            self._tapping = False
            self.dispatch("on_new_place", *self.view.to_world(self._start.real, self._start.imag))

    def on_touch_move(self, touch: MotionEvent) -> bool:
        """Follow the map's own fingers."""
        if touch.grab_current is not self or touch.uid not in self._fingers:
            return bool(super().on_touch_move(touch))
        before = dict(self._fingers)
        self._fingers[touch.uid] = complex(*touch.pos)
        if len(before) > 1:
            self._pinch(before)
        elif not self._tapping or abs(self._fingers[touch.uid] - self._start) > dp(MAX_SLIP):
            self._drag(before[touch.uid], self._fingers[touch.uid])
        else:
            self._fingers[touch.uid] = before[touch.uid]
        return True

    def on_touch_up(self, touch: MotionEvent) -> bool:
        """Let go of what the finger held, or take it as a tap."""
        if touch.grab_current is not self or touch.uid not in self._fingers:
            return bool(super().on_touch_up(touch))
        touch.ungrab(self)
        self._stay.end()
        del self._fingers[touch.uid]
        grip = self.grip
        if grip is not None and not self._fingers:
            self.grip = None
            if grip.moved:
                self._drop(grip)
        if self._tapping:
            self._tapping = False
            self._tap(touch, grip)
        return True

    def _pinch(self, before: dict[int, complex]) -> None:
        if self.grip is not None:
            return
        first, second = list(before)[:2]
        was, now = (before[first], before[second]), (self._fingers[first], self._fingers[second])
        self.set_view(self.view.pinched(was, now, may_turn=self.may_turn))

    def _drag(self, before: complex, after: complex) -> None:
        self._tapping = False
        self._stay.end()
        if self.grip is None:
            self.set_view(self.view.moved(after.real - before.real, after.imag - before.imag))
            return
        held = after + self.grip.slip
        x, y = self.view.to_world(held.real, held.imag)
        self.grip.x, self.grip.y, self.grip.moved = x, y, True
        self._carry(self.grip)
        self.property("grip").dispatch(self)

    def _carry(self, grip: Grip) -> None:
        """Let the robot that is being placed follow the finger at once."""
        if not self.placed:
            return
        x, y, yaw = self.placed
        if grip.what == "robot":
            self.placed = [grip.x, grip.y, yaw]
        elif grip.what == "turn":
            self.placed = [x, y, math.atan2(grip.y - y, grip.x - x)]

    def _grip_at(self, px: float, py: float) -> Grip | None:
        reach = theme.target / 2
        for what, places in self._things():
            index = nearest([self.view.to_screen(*place[:2]) for place in places], px, py, reach)
            if index >= 0:
                x, y = places[index][:2]
                at = complex(*self.view.to_screen(x, y))
                return Grip(
                    what, index if what in ("waypoint", "measured") else -1, x, y, at - complex(px, py)
                )
        return None

    def _things(self) -> list[tuple[str, list[Any]]]:
        """What can be held in this mode, first what lies on top."""
        if self.mode == "points":
            return [("waypoint", list(self.waypoints))]
        if self.mode == "home" and self.home:
            return [("home", [self.home])]
        if self.mode == "place_robot" and self.placed:
            return [("turn", [self.handle_place()]), ("robot", [self.placed])]
        return []

    def handle_reach(self) -> float:
        """From the robot being placed to its handle [px]; the handle stays on the map."""
        x, y, yaw = self.placed
        return handle_reach(self.view, (x, y, yaw), (*self.pos, *self.size))

    def handle_place(self) -> tuple[float, float]:
        """Where the handle is that turns the robot being placed [m]."""
        x, y, yaw = self.placed
        reach = self.handle_reach() / self.view.scale
        return x + reach * math.cos(yaw), y + reach * math.sin(yaw)

    def _drop(self, grip: Grip) -> None:
        if grip.what == "waypoint" and grip.index < len(self.waypoints):
            self.waypoints[grip.index] = (grip.x, grip.y)
            self.dispatch("on_move", grip.index, grip.x, grip.y)
        elif grip.what == "home":
            self._put_home(grip.x, grip.y)
        elif grip.what in ("robot", "turn") and self.placed:
            self.dispatch("on_place_robot", *self.placed)

    def _tap(self, touch: MotionEvent, grip: Grip | None) -> None:
        x, y = self.view.to_world(*touch.pos)
        if self.mode == "home":
            self._put_home(x, y)
        elif grip is not None and grip.what == "waypoint":
            self._select(grip.index)
        elif self.mode == "points":
            self.dispatch("on_add", x, y)
        elif self.mode == "place":
            self._tap_place(touch)
        elif self.mode == "view":
            self._tap_to_look(touch)

    def _tap_place(self, touch: MotionEvent) -> None:
        seen = [self.view.to_screen(*place[:2]) for place in self.places]
        index = nearest(seen, *touch.pos, theme.target / 2)
        if index < 0:
            self.dispatch("on_new_place", *self.view.to_world(*touch.pos))
        else:
            self.dispatch("on_open_place", index)

    def _tap_to_look(self, touch: MotionEvent) -> None:
        seen = [self.view.to_screen(*place[:2]) for place in self.waypoints]
        index = nearest(seen, *touch.pos, theme.target / 2)
        if index < 0 and touch.is_double_tap:
            self.set_view(self.view.zoomed(2.0, *touch.pos))
        elif index != self.selected:
            self._select(index)

    def _select(self, index: int) -> None:
        self.selected = index
        self.dispatch("on_select", index)

    def _put_home(self, x: float, y: float) -> None:
        self.home = [x, y]
        self.dispatch("on_set_home", x, y)
