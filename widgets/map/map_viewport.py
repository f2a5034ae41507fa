"""View of a map: its free box, zooming, fitting, and following the robot."""

from __future__ import annotations

import math
from typing import Any

from kivy.metrics import dp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    ListProperty,
)

from widgets.core.geometry import Points, View
from widgets.map.map_measure import MeasuringMap

__all__ = ["MapViewport"]

ZOOM_STEP = 1.5
"""Of one press of a zoom button."""
MIN_SCALE, MAX_SCALE = 0.5, 400.0
"""Limits of the scale [dp/m]."""
SMALL = 220.0
"""Least side from which on marks have the size that fingers take hold of [dp]."""
MAX_FITTED_SCALE = 60.0
"""Greatest scale that `fit` chooses [dp/m]."""


class MapViewport(MeasuringMap):
    """A map whose view fits all that is worth seeing until an operator moves it, or follows the robot."""

    robot: ListProperty[float] = ListProperty([math.nan] * 3)
    """Where it believes to be: x, y [m], yaw [rad]; NaN before the first pose."""
    follow = BooleanProperty(False)
    """Keep the robot in the middle; a finger that moves the map ends that."""
    insets: ListProperty[float] = ListProperty([0, 0, 0, 0])
    """How much is covered by what lies over the map [px]: left, bottom, right, top."""

    def _free_box(self) -> tuple[float, float, float, float]:
        left, bottom, right, top = self.insets
        wide, high = max(self.width - left - right, dp(40)), max(self.height - bottom - top, dp(40))
        return self.x + left, self.y + bottom, wide, high

    free_box = AliasProperty(_free_box, bind=["pos", "size", "insets"], cache=True)
    """The part of the map that nothing covers: x, y, width, height [px]."""

    def _mark_radius(self) -> float:
        least = min(self.width, self.height)
        return dp(21) if least > dp(440) else dp(16) if least > dp(SMALL) else dp(9)

    mark_radius = AliasProperty(_mark_radius, bind=["size"], cache=True)
    """Of a waypoint's disc [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self._touched = self._looks = False
        self._middle = (0.0, 0.0)
        super().__init__(**kwargs)
        self.bind(pos=self._lay_out, size=self._lay_out, insets=self._lay_out)
        self._lay_out()

    @property
    def located(self) -> bool:
        """The robot's pose is known."""
        return all(map(math.isfinite, self.robot))

    def set_view(self, view: View) -> None:
        """Change the view as the operator wishes; that ends `follow` and automatic fitting."""
        self._touched, self.follow = True, False
        self.view = self.limited(view)

    def limited(self, view: View) -> View:
        """The view with its scale within what this map can show."""
        return view.within(dp(MIN_SCALE), dp(MAX_SCALE), *self._free_middle())

    def zoom_in(self) -> None:
        """Enlarge about the middle of what is free."""
        self._zoom(ZOOM_STEP)

    def zoom_out(self) -> None:
        """Make smaller about the middle of what is free."""
        self._zoom(1 / ZOOM_STEP)

    def _zoom(self, factor: float) -> None:
        self._touched = True
        self.view = self.limited(self.view.zoomed(factor, *self._free_middle()))

    def centre_on_robot(self) -> None:
        """Bring the robot into the middle of what is free and keep it there; nothing while it is not located."""
        if self.located:
            self._touched = self.follow = True
            self._centre(*self.robot[:2])

    def centre_on(self, x: float, y: float) -> None:
        """Bring (x, y) in `map` [m] into the middle of what is free; that ends `follow`."""
        self._touched, self.follow = True, False
        self._centre(x, y)

    def reveal(self, x: float, y: float) -> None:
        """Bring (x, y) in `map` [m] into what is free, where it is not in sight; that ends `follow`."""
        left, low, wide, high = self.free_box
        edge = min(2.2 * self.mark_radius, wide / 4, high / 4)
        px, py = self.view.to_screen(x, y)
        if not (left + edge <= px <= left + wide - edge and low + edge <= py <= low + high - edge):
            self.centre_on(x, y)

    def fit(self) -> None:
        """Show everything, as large as it fits into what is free."""
        self._fit(self.extent(), math.inf)

    def look_at(self, points: Points, below: float) -> None:
        """Show `points`, shape (n, 2) [m], in what is free below the height `below` [px], until `look_away`."""
        self._looks = True
        self._fit(points, below)

    def look_away(self) -> None:
        """Show what was seen before `look_at`, where no operator had chosen it: everything."""
        if self._looks:
            self._looks = False
            self._fit_until_touched()

    def _fit(self, points: Points, below: float) -> None:
        if len(points):
            self.follow = False
            x, y, wide, high = self.free_box
            high = max(min(high, below - y), dp(40))
            edge = min(2.2 * self.mark_radius, wide / 4, high / 4)
            box = (x + edge, y + edge, wide - 2 * edge, high - 2 * edge)
            turn = self.view.turn if self.may_turn else 0.0
            self.view = self.limited(View.fitting(points, box=box, turn=turn, most=dp(MAX_FITTED_SCALE)))

    def extent(self) -> Points:
        """Everything worth seeing, shape (n, 2) [m]."""
        raise NotImplementedError(f"{type(self).__name__} does not say how far it extends")

    def _centre(self, x: float, y: float) -> None:
        px, py = self._free_middle()
        was_x, was_y = self.view.to_screen(x, y)
        self.view = self.view.moved(px - was_x, py - was_y)

    def _free_middle(self) -> tuple[float, float]:
        x, y, wide, high = self.free_box
        return x + wide / 2, y + high / 2

    def _lay_out(self, *_: object) -> None:
        was, self._middle = self._middle, self._free_middle()
        self.view = self.view.moved(self._middle[0] - was[0], self._middle[1] - was[1])
        self._fit_until_touched()

    def _fit_until_touched(self) -> None:
        if not (self._touched or self._looks) and self.width > dp(100):
            self.fit()

    def on_places(self, *_: object) -> None:
        """Bring them into sight until the operator moves the map."""
        self._fit_until_touched()

    def on_mode(self, *_: object) -> None:
        """Let go of what was held; bring up the robot to be placed, at its pose or in the middle."""
        self.let_go()
        if self.mode != "measure":
            self.measured = []
        if self.mode != "place_robot":
            self.placed = []
        elif self.located:
            self.placed = list(self.robot)
        else:
            self.placed = [*self.view.to_world(*self._free_middle()), 0.0]
