"""The card of an intruder: its picture, class, distance and bearing, a button that shows it on the map, and one that sees to it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.properties import ObjectProperty, StringProperty

from app.core.robot_sentences import sentence
from app.link.camera_decoder import Picture
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.core.codes import Code
from bridge.core.units import heading_from_yaw
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Event, Intruder, IntruderArray
from bridge.msgs.vision_msgs import Detection2D, Detection2DArray
from widgets.core.detected import kind_word
from widgets.core.language import tr
from widgets.core.sensor_geometry import away_text, side_text
from widgets.parts.kit import Card

__all__ = ["IntruderCard", "cut_out"]

NEWS_DURATION = 60.0
"""An intruder that was first seen longer ago [s] is none that a card comes up for."""
MAX_PICTURE_AGE = 1.0
"""The picture and what was detected in it are at most so far apart [s]."""
SAME_DISTANCE = 1.5
"""A detection within this distance of an intruder's place is of it [m]."""
MARGIN = 0.6
"""Round what was detected, as a part of its larger side."""

Builder.load_string("""
<IntruderCard>:
    size_hint_y: None
    height: self.minimum_height
    outline: 'danger'
    padding: dp(10)
    spacing: dp(8)
    BoxLayout:
        size_hint_y: None
        height: max(words.height, picture.height, dp(40))
        spacing: dp(10)
        Image:
            id: picture
            texture: root.texture
            size_hint: None, None
            height: 0 if not root.texture else dp(88) if self.image_ratio < .8 else dp(72)
            width: min(dp(96), self.height * self.image_ratio)
            opacity: 1 if root.texture else 0
            fit_mode: 'contain'
            pos_hint: {'center_y': .5}
        Column:
            id: words
            pos_hint: {'center_y': .5}
            BoxLayout:
                size_hint_y: None
                height: title.height
                spacing: dp(6)
                Icon:
                    name: 'warning'
                    role: 'danger'
                    font_size: sp(20)
                    pos_hint: {'center_y': .5}
                Text:
                    id: title
                    text: root.title
                    bold: True
                    role: 'danger'
            Text:
                text: root.detail
                font_size: sp(14.5)
    BoxLayout:
        size_hint_y: None
        height: theme.target
        spacing: dp(8)
        QuietButton:
            id: show
            text: root.words_show
            icon: 'map'
            on_release: root.dispatch('on_show')
        QuietButton:
            id: seen
            text: root.words_seen
            icon: 'check'
            on_release: root.see_to()
""")


class IntruderCard(Card):
    """Comes up for each new intruder, the newest first; dispatches `on_show` to have it in the middle of the map."""

    __events__ = ("on_show",)

    intruder: ObjectProperty[Intruder | None] = ObjectProperty(None, allownone=True)
    """The one that is shown; None while none waits to be seen to."""
    title = StringProperty("")
    detail = StringProperty("")
    texture: ObjectProperty[Texture | None] = ObjectProperty(None, allownone=True)
    """Its picture; None where there was none of it when it was found."""
    words_show = StringProperty("")
    words_seen = StringProperty("")

    def __init__(self, session: Session, dashboard: Dashboard, **kwargs: Any) -> None:
        self._session = session
        self._known: set[int] = set()
        self._waiting: list[Intruder] = []
        self._picture: Picture | None = None
        self._pictures: dict[int, Texture | None] = {}
        self._robots: set[int] = set()
        """Those whose picture is the robot's own."""
        super().__init__(**kwargs)
        self.words_show, self.words_seen = tr("Show"), tr("Seen")
        dashboard.bind(self, "/intruders", self._take, fresh=False)

    @property
    def place(self) -> tuple[float, float] | None:
        """Where the one is that is shown, in `map` [m]; None for none."""
        one = self.intruder
        return (one.position.x, one.position.y) if one is not None else None

    def keep(self, picture: Picture) -> None:
        """The newest picture of the camera, of which one is cut out when something is found in it."""
        self._picture = picture

    def _take(self, msg: IntruderArray) -> None:
        """Wait for what was not there before and was found just now; what the robot knows no more needs no card."""
        now = self._session.link.robot_time()
        known = {one.id for one in msg.intruders}
        fresh = [one for one in msg.intruders if one.id not in self._known]
        news = [one for one in fresh if not now - one.first_seen.seconds > NEWS_DURATION]
        self._known = known
        self._robots &= known
        for one in news:
            self._pictures[one.id] = self._cut(one)
        self._waiting = [one for one in self._waiting if one.id in known] + news
        self._turn()

    def _turn(self) -> None:
        shown = self._waiting[-1] if self._waiting else None
        self._pictures = {one.id: self._pictures.get(one.id) for one in self._waiting}
        self.texture = self._pictures.get(shown.id) if shown is not None else None
        self.intruder = shown
        self._look_up()
        self.tick()

    def _look_up(self) -> None:
        """Take the picture that the robot keeps, where it has come: it is of the moment when the robot saw it."""
        one, pictures = self.intruder, self._session.pictures
        if one is None or one.id in self._robots:
            return
        event = pictures.found(one.id)
        texture = pictures.of(event) if event is not None else None
        if texture is not None:
            self._robots.add(one.id)
            self.texture = self._pictures[one.id] = texture

    def tick(self) -> None:
        """Bring up to date how far it is and where, for the robot moves, and its picture, which may come later."""
        one = self.intruder
        if one is None:
            return
        self._look_up()
        more = len(self._waiting) - 1
        title = tr("Intruder {id} · {kind}").format(id=one.id, kind=kind_word(one.class_id))
        self.title = tr("{title}, {count} more").format(title=title, count=more) if more else title
        circled = self._session.pictures.circled(one.id)
        sides = [sentence(circled.code, circled.parameters, circled.text)] if circled is not None else []
        self.detail = "\n".join([self._where(one), *sides])

    def _where(self, one: Intruder) -> str:
        pose: PoseWithCovarianceStamped | None = self._session.feeds.latest("/pose")
        if pose is None or self._session.feeds.state("/pose") != "live":
            return tr("How far it is from the robot is not known.")
        here, yaw = pose.pose.pose.position, pose.pose.pose.orientation.yaw
        east, north = one.position.x - here.x, one.position.y - here.y
        way = math.atan2(north, east)
        bearing = tr("bearing {degrees}°").format(degrees=f"{heading_from_yaw(way):03.0f}")
        return " · ".join((away_text(math.hypot(east, north)), bearing, side_text(way - yaw)))

    def see_to(self) -> None:
        """The operator has seen the one that is shown: the robot's log gets to know it, and the next one comes up."""
        one = self.intruder
        if one is None:
            return
        self._session.logbook.acknowledge(
            [event for event in self._session.logbook.open if _is_of(event, one)]
        )
        self._waiting = [other for other in self._waiting if other.id != one.id]
        self._turn()

    def on_show(self) -> None:
        """A finger wants it in the middle of the map."""

    def on_touch_down(self, touch: Any) -> bool:
        """The map behind the card gets no finger that comes down on it."""
        return bool(super().on_touch_down(touch)) or bool(self.collide_point(*touch.pos))

    # its picture

    def _cut(self, one: Intruder) -> Texture | None:
        found: Detection2DArray | None = self._session.feeds.latest("/detections")
        picture = self._picture
        if found is None or picture is None or not self._session.cameras.shows_first:
            return None
        if abs(found.header.stamp.seconds - picture.stamp) > MAX_PICTURE_AGE:
            return None
        seen = [each for each in found.detections if self._is_there(each, one)]
        pixels = cut_out(picture, seen[0]) if seen else None
        return None if pixels is None else _texture(pixels)

    def _is_there(self, detection: Detection2D, one: Intruder) -> bool:
        """What was detected stands where the intruder is."""
        pose: PoseWithCovarianceStamped | None = self._session.feeds.latest("/pose")
        if pose is None or not detection.results:
            return False
        here, yaw = pose.pose.pose.position, pose.pose.pose.orientation.yaw
        seen = detection.results[0].pose.pose.position
        x = here.x + seen.x * math.cos(yaw) - seen.y * math.sin(yaw)
        y = here.y + seen.x * math.sin(yaw) + seen.y * math.cos(yaw)
        return math.dist((x, y), (one.position.x, one.position.y)) <= SAME_DISTANCE


def cut_out(picture: Picture, detection: Detection2D) -> np.ndarray[Any, np.dtype[np.uint8]] | None:
    """What was detected with a margin round it, rows from the top, RGBA; None where it is not in the picture."""
    wide, high = picture.width, picture.height
    scale = wide / picture.taken[0] if picture.taken[0] else 1.0
    box, centre = detection.bbox, detection.bbox.center.position
    if not all(map(math.isfinite, (centre.x, centre.y, box.size_x, box.size_y))):
        return None
    half_x, half_y = box.size_x / 2, box.size_y / 2
    around = MARGIN * max(box.size_x, box.size_y)
    left, right = (int(min(max((centre.x + side * (half_x + around)) * scale, 0), wide)) for side in (-1, 1))
    top, low = (int(min(max((centre.y + side * (half_y + around)) * scale, 0), high)) for side in (-1, 1))
    if right - left < 2 or low - top < 2 or len(picture.rgba) != wide * high * 4:
        return None
    whole = np.frombuffer(picture.rgba, np.uint8).reshape(high, wide, 4)
    return np.ascontiguousarray(whole[top:low, left:right])


def _texture(pixels: np.ndarray[Any, np.dtype[np.uint8]]) -> Texture:
    high, wide = pixels.shape[:2]
    texture = Texture.create(size=(wide, high), colorfmt="rgba")
    texture.blit_buffer(pixels.tobytes(), colorfmt="rgba", bufferfmt="ubyte")
    texture.flip_vertical()
    return texture


def _is_of(event: Event, one: Intruder) -> bool:
    parameters = {pair.key: pair.value for pair in event.parameters}
    return event.code == Code.INTRUDER_FOUND and parameters.get("id") == str(one.id)
