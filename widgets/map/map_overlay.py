"""Overlay of every map: all that is drawn above its ground; `GridMap` and `GeoMap` add the ground.

map.waypoints = [(2.0, 1.0), (8.0, 1.0)]
map.bind(on_add=lambda _, x, y: map.waypoints.append((x, y)))
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, ClassVar

import numpy as np
from kivy.graphics import InstructionGroup, Rectangle, StencilPop, StencilPush, StencilUnUse, StencilUse
from kivy.metrics import dp, sp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
    OptionProperty,
    StringProperty,
)

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import Path
from bridge.msgs.pilothouse_msgs import Intruder, IntruderArray, Limits, PlaceCandidates
from bridge.msgs.sensor_msgs import LaserScan
from widgets.core.base import VEIL
from widgets.core.canvas_ink import Drawing, Ink, Word, Words, folded, ground, tint
from widgets.core.detected import kind_word
from widgets.core.geometry import Points, View, nice_floor, scan_points, spread
from widgets.core.language import tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map import fence_marks
from widgets.map import map_marks as marks
from widgets.map.fence import Fence
from widgets.map.map_candidates import MapCandidates
from widgets.map.map_heights import height_marks
from widgets.map.map_measure import measure_marks
from widgets.map.map_viewport import SMALL

__all__ = ["MapOverlay"]

NOTHING = np.zeros((0, 2))


class MapOverlay(MapCandidates, Drawing):
    """The robot and its task on a map. Everything is in the `map` frame: x east, y north [m]."""

    accepts: ClassVar[tuple[type[Msg], ...]] = (
        PoseWithCovarianceStamped,
        Path,
        IntruderArray,
        LaserScan,
        Limits,
        PlaceCandidates,
    )
    shown_beside: ClassVar[tuple[type[Msg], ...]] = (IntruderArray, LaserScan, Limits, PlaceCandidates)
    grid_size: ClassVar[tuple[int, int]] = (6, 6)
    drawn_from: ClassVar[tuple[str, ...]] = (
        "view", "waypoints", "selected", "home", "placed", "grip", "mode", "robot", "robot_radius", "camera_fov",
        "plan", "places", "intruders", "visited", "coming", "motion_name", "laser", "show_laser", "insets", "fence", "foot", "refused",
        "footprint", "measured", "unplaced", "candidates", "doubt", "height_words", "heights",
    )  # fmt: skip

    plan: ObjectProperty[Points] = ObjectProperty(NOTHING, force_dispatch=True)
    """The way it means to take, shape (n, 2) [m]."""
    intruders: ListProperty[tuple[float, float, str]] = ListProperty()
    """What does not belong here: (x, y, label), [m]."""
    laser: ObjectProperty[Points] = ObjectProperty(NOTHING, force_dispatch=True)
    """What the laser hit, shape (n, 2) [m], placed by the pose known when the sweep came."""
    show_laser = BooleanProperty(False)
    """Draw what the laser hits."""
    fence: ObjectProperty[Fence] = ObjectProperty(Fence())
    """Where it may be, a `Fence`; waypoints, home and places that it would refuse are marked."""
    refused: ListProperty[tuple[float, float, str]] = ListProperty()
    """Waypoints and home that it would refuse for another reason too, or why it would: x, y [m], a few words; none of them empty."""
    foot = NumericProperty(0)
    """How far above the lower edge of what is free the scale and the legend begin [px]; NaN draws neither."""
    visited: NumericProperty[int] = NumericProperty(0)
    """How many of the first waypoints are done; they are drawn filled."""
    coming: NumericProperty[int] = NumericProperty(-1)
    """Index of the waypoint it is heading for; -1 for none."""
    motion_name = OptionProperty("loop", options=("loop", "random", "intermittent"))
    """How the waypoints follow each other: round and round, in any order, or round with a stay at each."""
    veils: ClassVar = {"disabled": VEIL["disabled"]}
    """A stale pose fades the robot and not the map."""

    def _badge_pos(self) -> tuple[float, float]:
        x, y, wide, high = self.free_box
        left, right = self.badge_span if any(self.badge_span) else (x, x + wide)
        return (left + right - self.badge_size[0]) / 2, y + high - self.badge_size[1] - dp(8)

    badge_pos = AliasProperty(_badge_pos, bind=["badge_size", "free_box", "badge_span"], cache=True)
    """The age stands at the top of what is free."""

    unplaced = StringProperty("")
    """What is said while no pose has come: other news of the robot's place than a pose may have come already; empty for the usual words."""
    badge_span: ListProperty[float] = ListProperty([0, 0])
    """From where to where along that top nothing lies, x [px]; zeros for all of it."""

    def __init__(self, **kwargs: Any) -> None:
        self.over_ground = InstructionGroup()
        """Drawn above the ground and below the marks; for a subclass to fill."""
        self._fence_ink = Ink()
        self._fence_look: tuple[object, ...] = ()
        self._layers = [(Ink(), Words()) for _ in range(2)]
        self._clip = [Rectangle(), Rectangle()]
        super().__init__(**kwargs)
        for part in (StencilPush(), self._clip[0], StencilUse()):
            self.canvas.before.add(part)
        self.canvas.add(self.over_ground)
        self.canvas.add(self._fence_ink)
        for ink, words in self._layers:
            self.canvas.add(ink)
            self.canvas.add(words.canvas)
        for last in (StencilUnUse(), self._clip[1], StencilPop()):
            self.canvas.after.add(last)

    # what comes in

    def show(self, msg: Msg) -> None:
        """Take over a pose, a plan, intruders, a laser sweep or limits."""
        if isinstance(msg, PoseWithCovarianceStamped):
            self._show_pose(msg)
        elif isinstance(msg, Path):
            self.plan = spread((p.pose.position.x, p.pose.position.y) for p in msg.poses)
        elif isinstance(msg, IntruderArray):
            self.intruders = [(i.position.x, i.position.y, _intruder_words(i)) for i in msg.intruders]
        elif isinstance(msg, LaserScan):
            self._show_scan(msg)
        elif isinstance(msg, Limits):
            self.fence = Fence.of(msg)
            self._fit_until_touched()
        else:
            super().show(msg)

    def _show_scan(self, msg: LaserScan) -> None:
        if not (self.show_laser and self.located):
            return
        _, _, points = scan_points(msg.ranges, msg.angle_min, msg.angle_increment)
        x, y, yaw = self.robot
        self.laser = View.centred(0, 0, at=(x, y), scale=1.0, turn=yaw).many_to_screen(spread(points))

    def extent(self) -> Points:
        """Everything worth seeing, shape (n, 2) [m]."""
        places = [*self.waypoints, self.home, self.robot[:2], *self.intruders, *self.places]
        places += [(each.x, each.y) for each in self.candidates]
        corners = [corner for area in self.fence.keep_in for corner in area]
        return spread(tuple(place[:2]) for place in (*places, *corners) if len(place))

    def _lay_out(self, *_: object) -> None:
        for rectangle in self._clip:
            rectangle.pos, rectangle.size = self.pos, self.size
        super()._lay_out()

    # how it is drawn

    def draw(self) -> None:
        """Bring ground, marks and robot up to date."""
        self.draw_ground()
        self._draw_fence()
        for (ink, words), fill in zip(self._layers, (self._fill_task, self._fill_robot), strict=True):
            shapes = Shapes()
            words.write(list(fill(shapes)))
            ink.fill(shapes)

    def close(self) -> None:
        """Let go of what the ground is read from."""

    def draw_ground(self) -> None:
        """Bring what lies below the marks up to date."""

    def _draw_fence(self) -> None:
        """Anew only when it or the view of it has changed: a pose, which comes 20 times a second, is no reason."""
        look = (self.fence, self.view, *self.pos, *self.size, theme.name)
        if look != self._fence_look:
            self._fence_look = look
            shapes = Shapes()
            if self.fence:
                fence_marks.fence_lines(shapes, self.view, self.fence, (*self.pos, *self.size))
            self._fence_ink.fill(shapes)

    def _fill_task(self, shapes: Shapes) -> Iterator[Word]:
        view, places, home = self.view, self._places(), self._home_place()
        marks.trail_line(shapes, view, self._trail.points)
        marks.plan_line(shapes, view, self.plan)
        if self.motion_name != "random":
            marks.route_line(shapes, view, places, closed=True)
        if self.show_laser:
            marks.laser_dots(shapes, view, self.laser)
        yield from marks.place_marks(shapes, view, self.places, self.mark_radius * 0.66)
        if home:
            yield marks.home_mark(shapes, view, home, self.mark_radius * 0.9)
        yield from marks.waypoint_marks(
            shapes, view, places, self.mark_radius,
            visited=self.visited, coming=self.coming, selected=self.selected,
            refused={place for place in places if self._would_refuse(*place)},
        )  # fmt: skip
        if min(self.size) >= dp(SMALL):
            yield from height_marks(shapes, view, places, self.heights, self.mark_radius)
        yield from self._refused(shapes, places, home)

    def _refused(
        self, shapes: Shapes, waypoints: list[tuple[float, float]], home: Sequence[float]
    ) -> Iterator[Word]:
        """Where the robot would not go, and why: of a dock it is the place before it that counts, which is not known here."""
        sizes = [(place, self.mark_radius) for place in waypoints]
        sizes += [((home[0], home[1]), self.mark_radius * 0.9)] if home else []
        sizes += [(place[:2], self.mark_radius * 0.8) for place in self.places if place[3] != "dock"]
        bad = {place: size for place, size in reversed(sizes) if self._would_refuse(*place)}  # once each
        taken = [self.view.to_screen(*place) for place, _ in sizes]
        for place, size in bad.items():
            yield fence_marks.refused_mark(shapes, self.view, *place, size)
        why = {(x, y): words for x, y, words in self.refused}
        said = [(*place, why[place], size) for place, size in bad.items() if place in why]
        yield from marks.reasons(shapes, self.view, said, box=self.free_box, taken=taken)

    def _would_refuse(self, x: float, y: float) -> bool:
        if any((x, y) == one[:2] for one in self.refused):
            return True
        return bool(self.fence) and self.fence.forbids(x, y, self.robot_radius)

    def _fill_robot(self, shapes: Shapes) -> Iterator[Word]:
        yield from self._alarms(shapes)
        if self.located:
            x, y, yaw = self.robot
            stale, alarm = self.state == "stale", self.state == "alarm"
            self._robot_shapes(shapes, (x, y, yaw), faded=stale, alarm=alarm)
            yield from self._robot_words(shapes, (x, y, yaw), faded=stale)
        else:
            x, y = self._free_middle()
            words = self.unplaced or tr("Its place on this map is not known yet")
            size = sp(16) if min(self.size) > dp(SMALL) else dp(11)
            for word in folded(Word(words, x, y, size, theme.text), self.free_box[2] - dp(12)):
                ground(shapes, word, tint(theme.bg, 0.85))
                yield word
        yield from self._candidate_marks(shapes)
        if self.placed:
            x, y, yaw = self.placed
            pose = (x, y, yaw)
            word, _ = marks.place_handle(shapes, self.view, pose, self.mark_radius, self.handle_reach())
            marks.ghost_mark(shapes, self.view, pose, self._robot_disc())
            yield word
        yield from self._tools(shapes)
        if math.isnan(self.foot) or min(self.size) < dp(SMALL):
            return
        x, y, wide, _ = self.free_box
        left, low, longest = x + dp(16), y + dp(14) + self.foot, min(dp(140), wide / 3)
        yield from marks.scale_bar(shapes, self.view, left, low, longest)
        beside = max(nice_floor(longest / self.view.scale) * self.view.scale, dp(44)) + dp(16)
        room = wide - dp(16) - beside
        if room >= fence_marks.legend_width(self.fence):
            yield from fence_marks.legend(shapes, self.fence, left + beside, low - dp(4), room)
        else:
            yield from fence_marks.legend(shapes, self.fence, left, low + dp(30), 0.0)

    def _tools(self, shapes: Shapes) -> Iterator[Word]:
        """What is measured, and where north is while it is not up."""
        yield from measure_marks(shapes, self.view, self.measured_now())
        if abs(self.view.turn) > marks.UPRIGHT and min(self.size) > dp(SMALL):
            x, y, wide, high = self.free_box
            yield marks.north_mark(shapes, x + wide - dp(30), y + high - dp(30), self.view.turn)

    def _alarms(self, shapes: Shapes) -> Iterator[Word]:
        """The intruders, above the waypoints and below the robot."""
        marked = [*self._places(), *([self._home_place()] if self._home_place() else [])]
        marked += [self.robot[:2]] if self.located else []
        taken = [self.view.to_screen(*place[:2]) for place in marked]
        yield from marks.intruder_marks(
            shapes, self.view, self.intruders, self.mark_radius, box=self.free_box, taken=taken,
            faded=self.state == "stale",
        )  # fmt: skip

    def _places(self) -> list[tuple[float, float]]:
        """The waypoints, with the one in a finger's grip where the finger is."""
        places, grip = list(self.waypoints), self.grip
        if grip is not None and grip.what == "waypoint" and grip.index < len(places):
            places[grip.index] = (grip.x, grip.y)
        return places

    def _home_place(self) -> list[float]:
        grip = self.grip
        return [grip.x, grip.y] if grip is not None and grip.what == "home" else self.home


def _intruder_words(intruder: Intruder) -> str:
    return tr("Intruder {id} · {kind}").format(id=intruder.id, kind=kind_word(intruder.class_id))
