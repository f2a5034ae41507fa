"""The map on a drive screen: small beside the picture, or as large with the picture small in its place; a tap swaps the two.

Whatever is large, the controls lie above both, and nothing of them changes.
"""

from __future__ import annotations

from typing import Any

from kivy.metrics import dp
from kivy.uix.widget import Widget

from app.core.hand import hand
from app.layout.rects import Rect, all_mirrored, between, mirrored
from app.maps.ground_keeper import GroundKeeper
from app.maps.maps import Maps
from app.screens.parts.inset_frame import InsetFrame
from app.screens.parts.placing import off, put
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import RobotInfo
from widgets import GridMap, Video
from widgets.core.geometry import View
from widgets.core.language import tr
from widgets.map.map_robot import corners
from widgets.parts.kit import IconButton

__all__ = ["InsetMap", "add_inset", "checks_beside", "inset_place"]

SCALE = 8.0
"""Of the small map [dp/m]: what is some steps away is seen."""
TICKS = 2
"""The small map shows every pose of so many ticks: what is small need not be drawn twenty times a second."""
LOOKS = 5
"""In one of so many ticks it is looked whether another map lies beneath it now."""
MIN_SIDE = 66.0
"""A smaller map shows nothing that can be read [dp]."""
WIDTH, ASPECT = 250.0, 1.4
"""Greatest width of the small one [dp], and that by its height."""
PHONE_WIDTH = 112.0
"""Of the small one on an upright phone [dp]."""
PHONE_HEIGHT, BESIDE_TWO = 100.0, 67.0
"""Of the small one on a phone's side, and there beside two sticks [dp]: the picture is the screen."""


class InsetMap:
    """Map and picture of one drive screen."""

    def __init__(self, session: Session, dashboard: Dashboard, video: Video, maps: Maps) -> None:
        self._session, self._video = session, video
        self.map = GridMap(foot=float("nan"))
        self.keeper = GroundKeeper(self.map, maps, session.feeds.latest)
        """Keeps tiles or a picture beneath it."""
        self.frame = InsetFrame()
        self.centre = IconButton(icon="my_location")
        """Brings a large map back to the robot."""
        self.centre.bind(on_release=lambda *_: self.map.centre_on_robot())
        self.large = False
        """The map is where the picture was."""
        self._places: dict[str, Rect] = {}
        self._inset: Rect | None = None
        self._info: RobotInfo | None = None
        self._ticks = 0
        self.map.set_view(View(complex(dp(SCALE))))
        self.map.follow = self.map.heading_up = True
        dashboard.bind(self.map, "/pose", self._show_pose)
        for topic in ("/map", "/plan", "/intruders", "/limits", "/localisation/candidates"):
            dashboard.bind(self.map, topic, fresh=False)

    @property
    def widgets(self) -> tuple[Widget, ...]:
        """What lies lowest on the screen, the topmost first."""
        small, large = (self._video, self.map) if self.large else (self.map, self._video)
        return self.centre, self.frame, small, large

    def lay(self, screen: Widget) -> None:
        """Put everything below all else on the screen."""
        for widget in self.widgets:
            if widget.parent is screen:
                screen.remove_widget(widget)
        for widget in self.widgets:
            screen.add_widget(widget, len(screen.children))

    def swap(self, screen: Widget) -> None:
        """Have the map large and the picture small, or the other way round."""
        self.large = not self.large
        self.map.let_go()
        self.lay(screen)
        if not self.large:
            self.map.centre_on_robot()

    def arrange(self, places: dict[str, Rect], form: str, unit: float) -> None:
        """Put both into their places among those of the screen's `form`; `unit` is one dp [px]."""
        self._places, self._inset = places, inset_place(places, form, unit)
        if self._inset is None and self.large:
            self._inset = off(places["video"])
        whole = places["video"]
        small = self._inset or off(whole)
        put(self.map, whole if self.large else small)
        put(self._video, small if self.large else whole)
        put(self.frame, small)
        self.frame.scan_words = tr("Show the picture large") if self.large else tr("Show the map large")
        self.map.foot = 0.0 if self.large else float("nan")
        self.map.insets = _free(places, form) if self.large else [0, 0, 0, 0]
        if self.large:
            self._video.insets = [0, 0, 0, 0]

    def uncover(self, lids: list[Rect]) -> None:
        """What is small is away where one of `lids` lies over it."""
        if not self._places:
            return  # what lies over it is arranged first
        place = self._inset
        if place is None:
            place = off(self._places["video"])
        elif any(lid.overlaps(place) for lid in lids):
            place = off(place)
        put(self._video if self.large else self.map, place)
        put(self.frame, place)
        if self.large:
            self._video.show_chip = False
        self._place_centre()

    def tick(self) -> None:
        """Bring up to date what time changes, and what the operator drew."""
        self._ticks += 1
        pose = self._session.feeds.latest("/pose")
        if not self.large and pose is not None and self._ticks % TICKS == 0:
            self.map.show(pose)
        if self._ticks % LOOKS == 0:
            self.keeper.look()
        info, draft = self._session.robot.info, self._session.mission.draft
        if info is not self._info:
            self._info = info
            self.map.robot_radius, self.map.camera_fov = info.radius or self.map.robot_radius, info.camera_fov
            self.map.footprint = corners(info)
        self.map.waypoints, self.map.home = list(draft.points), list(draft.home or ())
        self.map.motion_name, self.map.heights = draft.motion, list(draft.levels)
        self._place_centre()

    def rest(self) -> None:
        """Fingers on the map let go."""
        self.map.let_go()

    def end(self) -> None:
        """Let go of the map and of what lies beneath it."""
        self.keeper.close()
        self.map.close()

    def _show_pose(self, msg: PoseWithCovarianceStamped) -> None:
        if self.large:
            self.map.show(msg)

    def _place_centre(self) -> None:
        """Beside what is small, while a finger has moved the map away from the robot."""
        wanted = self.large and not self.map.follow and self._inset is not None
        side, frame = self.centre.height, self.frame
        x = frame.right + dp(8) if hand.left else frame.x - side - dp(8)
        place = Rect(x, frame.y, side, side)
        put(self.centre, place if wanted and frame.x > 0 else off(place))


def inset_place(places: dict[str, Rect], form: str, unit: float) -> Rect | None:
    """Where what is small lies among the places of a drive screen [px]; None where there is no room."""
    if "hands" in places or "lift" in places:  # in three columns it has a place of its own
        return places.get("inset")
    if not hand.left:
        return _right_place(places, form, unit)
    room = places["video"]
    place = _right_place(all_mirrored(places, room), form, unit)
    return None if place is None else mirrored(place, room)


def _right_place(places: dict[str, Rect], form: str, unit: float) -> Rect | None:
    """The same for a right hand."""
    gap = 8 * unit
    if form == "tall":
        badge, video, strip = places["badge"], places["video"], places["senses"]
        room = between(video.x, video.y + gap, badge.right, badge.y - gap)
        if strip.overlaps(room):
            beside = between(strip.right + gap, room.y, room.right, room.top)
            room = between(room.x, strip.top + gap, room.right, room.top)
            room = beside if beside.width >= MIN_SIDE * unit else room
        return _fitting(room, unit, PHONE_WIDTH * unit)
    stop, right = places["stop"], places["video"].right - 10 * unit
    if form == "short":
        low, high = getattr(stop, "head", stop.top) + gap, places["badge"].y - gap
        top = min(high, low + (BESIDE_TWO if "right_stick" in places else PHONE_HEIGHT) * unit)
        return _fitting(between(stop.x, low, right, top), unit, right - stop.x)
    figures = places["readouts"]
    under = [
        places[slot] for slot in ("stop", "actions", "confirm", "right_stick", "stick") if slot in places
    ]
    low = max(getattr(one, "head", one.top) for one in under if one.right > figures.x - WIDTH * unit) + gap
    below = _fitting(
        between(figures.right - WIDTH * unit, low, figures.right, figures.y - 12 * unit), unit, WIDTH * unit
    )
    if below is not None:
        return below
    top = places["top"]
    beside = between(top.right + gap, low, figures.x - gap, top.top)
    return _fitting(beside, unit, WIDTH * unit, up=True)


def checks_beside(places: dict[str, Rect], form: str, unit: float) -> Rect:
    """What is left of `notice_low` beside what is small on an upright phone, so that it can always be tapped [px]."""
    low, small = places["notice_low"], inset_place(places, form, unit)
    if form != "tall" or small is None or not small.overlaps(low):
        return low
    if hand.left:
        return between(small.right + 8 * unit, low.y, low.right, low.top)
    return between(low.x, low.y, small.x - 8 * unit, low.top)


def _fitting(room: Rect, unit: float, width: float, *, up: bool = False) -> Rect | None:
    """As large as it fits into the lower, or upper, right corner of `room`; None where that is too small."""
    wide = min(width, room.width, room.height * ASPECT)
    high = min(room.height, wide / ASPECT * 1.2)
    if min(wide, high) < MIN_SIDE * unit:
        return None
    return Rect(room.right - wide, room.top - high if up else room.y, wide, high)


def _free(places: dict[str, Rect], form: str) -> list[float]:
    """How much of a large map is covered by what floats on it [px]: left, bottom, right, top."""
    whole, free = places["video"], places["notice"]
    if form == "tall" and "inset" not in places:
        strip = places["senses"]
        return [
            0.0,
            strip.top - whole.y if strip.overlaps(whole) else 0.0,
            0.0,
            whole.top - places["badge"].y,
        ]
    return [free.x - whole.x, free.y - whole.y, whole.right - free.right, whole.top - free.top]


def add_inset(screen: Any) -> InsetMap:
    """The inset of a drive screen, on it; a tap swaps and has the screen arranged anew."""
    inset = InsetMap(screen.session, screen.dashboard, screen.video, screen.app.maps)
    inset.lay(screen)

    def swap(*_: object) -> None:
        inset.swap(screen)
        screen.settle()

    inset.frame.bind(on_release=swap)
    return inset
