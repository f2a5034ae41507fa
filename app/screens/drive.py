"""The drive screen: video fills the glass, instruments float on it, the stick is under one thumb and STOP under the other."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.metrics import Metrics
from kivy.properties import ObjectProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

import widgets
from app import arrange
from app.arrange import Rect
from app.camera import Picture
from app.dashboard import Dashboard
from app.feeds import Post
from app.layout import Instrument, Layout, LayoutError
from app.link import OFFER
from app.offer import POSE
from app.screens.check_card import CheckCard
from app.screens.in_vain import InVain
from app.screens.placing import AWAY, put
from app.screens.senses import Senses
from app.screens.sight import Sight
from app.screens.speed_card import SpeedCard, allowed
from app.session import Session
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.vision_msgs import Detection2DArray
from bridge.topics import topic
from widgets import Joystick, Readout, Video
from widgets.kit import Card, QuietButton, Text

__all__ = ["DriveScreen"]

LONGEST_NAME = 14
"""Letters of a topic's name on an instrument."""
NARROW = 110
"""On a narrower button the icon is above the word [dp]."""
FIRST = 0.6
"""Share of the robot's greatest speed that the slider begins with."""


class DriveScreen(FloatLayout):
    """Drive one robot by hand."""

    app = ObjectProperty()
    session: Session = ObjectProperty()

    def __init__(self, layout: Layout, **kwargs: Any) -> None:
        """`layout` says which instruments sit where; LayoutError when one cannot show its topic."""
        super().__init__(**kwargs)
        self._arranged: dict[str, Rect] = {}
        self._cover: Rect | None = None
        self._strip = Rect(0, 0, 0, 0)
        self.dashboard = Dashboard(self.session.feeds)
        self.video = Video(fit="cover", corner=0)
        self.stick = Joystick()
        self.speed = SpeedCard()
        self.actions = GridLayout(cols=1, spacing="10dp")
        self.senses = Senses(self.session.feeds)
        self.senses.bind(open=self._uncover, opacity=self._uncover)
        self.in_vain = InVain(self.session, self.app)
        self.sight = Sight(self.session, self.video, self.dashboard)
        self.places: dict[str, list[Widget]] = {}
        self._titled: list[tuple[Any, Instrument]] = []
        self._places_told: list[tuple[Readout, Instrument]] = []
        self._place("video", self.video)
        self._build_instruments(layout)
        self._build_controls()
        self.add_widget(self.sight)
        self.add_widget(self.senses)
        self.low = BoxLayout(orientation="vertical", spacing="8dp", size_hint=(None, None))
        """For cards that hold on until they are dealt with, each with a height of its own; they grow upwards."""
        self.low.bind(minimum_height=self.low.setter("height"), height=self._uncover)
        self.add_widget(self.low)
        self.checks = CheckCard(self.session, self.dashboard, brief=True, pos_hint={"center_x": 0.5})
        self.low.add_widget(self.checks)
        self.dashboard.bind(self.video, "/detections", fresh=False, empty=Detection2DArray())
        self._limited = False
        self._tall = False

    def _build_instruments(self, layout: Layout) -> None:
        readouts = [one for one in layout.instruments if one.slot == "readouts"]
        for one in layout.instruments:
            if one.slot == "senses":
                self.senses.add(self._instrument(one), one.topics)
            elif one.slot != "readouts":
                self._place(one.slot, self._instrument(one))
        card = Card(floating=True, padding=("12dp", "8dp"))
        self.readouts = GridLayout(cols=2, spacing=("10dp", "4dp"))
        for one in readouts:
            self.readouts.add_widget(self._instrument(one))
        card.add_widget(self.readouts)
        self._place("readouts", card)

    def _instrument(self, one: Instrument) -> Widget:
        kind = getattr(widgets, one.widget)
        if kind is Readout:
            widget = Readout(
                name=one.title,
                unit=one.unit,
                path=one.field,
                scale=one.factor,
                decimals=one.digits,
                fitted=False,
                font_size="21sp",
            )
            widget.size_hint_x = 1
            if one.topic == POSE:
                self._places_told.append((widget, one))
        else:
            wanted = topic(one.topic).type
            if wanted not in kind.accepts:
                allowed = ", ".join(accepted.MSGTYPE for accepted in kind.accepts) or "nothing"
                raise LayoutError(
                    f"{one.widget} shows {allowed}, not {one.topic}, which is {wanted.MSGTYPE}."
                )
            offered = {"card": True, "title": one.title}
            widget = kind(**{name: value for name, value in offered.items() if hasattr(kind, name) and value})
            if one.title and hasattr(kind, "title"):
                self._titled.append((widget, one))
        if one.slot != "senses":  # which look after themselves
            self.dashboard.bind(widget, one.topic)
        return widget

    def _place(self, slot: str, widget: Widget) -> None:
        self.places.setdefault(slot, []).append(widget)
        self.add_widget(widget)

    def _build_controls(self) -> None:
        self.stick.bind(on_command=self._drive, on_in_vain=lambda _: self.in_vain.tell())
        self.speed.bind(maximum_speed=self._limit)
        self._place("stick", self.stick)
        self._place("slider", self.speed)
        self._place("actions", self.actions)
        buttons: tuple[tuple[str, str, str, Callable[..., object]], ...] = (
            ("snapshot", "photo_camera", "Snapshot", lambda *_: self.app.records.snapshot()),
            ("pause", "pause", "Pause", lambda *_: self._pause()),
            ("home", "home", "Go home", lambda *_: self.session.command("home")),
        )
        for name, icon, text, act in buttons:
            button = QuietButton(icon=icon, text=text, size_hint_y=1)
            button.bind(on_release=act)
            self.ids[name] = button
            self.actions.add_widget(button)
        self.no_tasks = Card(floating=True, padding=("6dp", "2dp"))
        note = Text(text="It offers no tasks.", role="muted", font_size="14sp", halign="center")
        note.size_hint_y, note.valign = 1, "middle"
        note.bind(size=note.setter("text_size"))
        self.no_tasks.add_widget(note)
        self._buttons = tuple(reversed(self.actions.children))
        self.ids.update(
            {"stick": self.stick, "speed": self.speed, "fader": self.speed.ids.fader, "video": self.video}
        )

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        places = self._arranged = arrange.drive(body, form, dp)
        for slot, found in self.places.items():
            for widget in found:
                put(widget, places[slot])
        tall = self._tall = form == "tall"
        self._show_actions()
        roomy = form == "wide" or places["readouts"].width >= 330 * dp
        self.readouts.cols = 1 if form == "short" else 4 if roomy and tall else 2
        self._trim(roomy)
        self.notice, low = places["notice"], places["notice_low"]
        self.low.pos, self.low.width, self.low.height = (low.x, low.y), low.width, self.low.minimum_height
        self.checks.wide, self.checks.room = min(low.width, 340 * dp), places["top"].y - 8 * dp - low.y
        self._strip = Rect(0, 0, 0, 0)
        self._uncover()
        self.sight.place(places["badge"], to_right=form != "wide")
        chip = places["badge" if form == "wide" else "top"].y
        aside = max(0.0, body.right - self.notice.right - 8 * dp)
        self.video.insets = [self.notice.x - 8 * dp - body.x, 0, aside, body.top - chip]
        return places["stop"]

    def clear(self, cover: Rect | None) -> None:
        """Take away what would be seen only in part behind what is said over the screen."""
        self._cover = cover
        self._uncover()

    def _uncover(self, *_: object) -> None:
        """What lies under the unfolded sensors, or under what is said, is not seen, not even at its corners."""
        if not self._arranged:
            return
        lids = [self._cover] if self._cover is not None else []
        if self.senses.covers:
            lids.append(self._arranged["senses_open"])
        for slot in ("top_left", "top_right", "readouts", "top"):
            place = self._arranged[slot]
            hidden = any(lid.overlaps(place) for lid in lids)
            for widget in self.places.get(slot, ()):
                widget.opacity = 0 if hidden else 1
                # what has a shader of its own knows nothing of opacity
                put(widget, Rect(AWAY, place.y, place.width, place.height) if hidden else place)
        low, cover = self.low, self._cover
        under = cover is not None and cover.overlaps(Rect(*low.pos, *low.size))
        low.opacity, low.disabled = float(not under), under
        self.sight.covered = cover is not None and cover.overlaps(self._arranged["badge"])
        strip = self._arranged["senses"]
        if cover is not None and cover.overlaps(strip) and self.senses.folded:
            strip = Rect(AWAY, strip.y, strip.width, strip.height)
        if strip != self._strip:
            self._strip = strip
            self.senses.place(strip, self._arranged["senses_open"])

    def _trim(self, roomy: bool) -> None:
        """A phone has room for two figures."""
        shown = list(reversed(self.readouts.children)) if not hasattr(self, "_figures") else self._figures
        self._figures = shown
        wanted = shown if roomy else shown[:2]
        if list(reversed(self.readouts.children)) != wanted:
            self.readouts.clear_widgets()
            for widget in wanted:
                self.readouts.add_widget(widget)

    def hear(self, channel: str, post: Post) -> None:
        """A message came."""
        self.dashboard.deliver(channel, post.value)
        if channel in ("/robot/info", "/limits"):
            self._take_limits()
        elif channel == OFFER:
            self._name_sources()

    def enter(self) -> None:
        """Come onto the glass."""
        self._take_limits()
        self._name_sources()
        self.dashboard.enter()
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""
        self.rest()
        self.dashboard.leave()

    def rest(self) -> None:
        """The stick springs back."""
        self.stick.rest()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.dashboard.tick()
        self.senses.tick()
        self.sight.tick()
        self.in_vain.tick()
        self.checks.tick()
        session = self.session
        self.stick.state = "live" if session.may_drive else "disabled"
        mine = session.may_ask
        held = session.stop_latched
        self.ids.home.disabled = held or not mine or not session.offers("/task/go_home")
        status = session.feeds.latest("/task/status")
        paused = status is not None and status.state == "PAUSED"
        pause = self.ids.pause
        pause.text, pause.icon = ("Resume", "play_arrow") if paused else ("Pause", "pause")
        pause.meaning = pause.text
        pause.disabled = not (mine and session.running) or (held and paused)
        self.ids.snapshot.disabled = self.app.records.frame is None
        self._show_actions()

    def _show_actions(self) -> None:
        """Instead of two buttons that can never be pressed stands why."""
        tasks = any(map(self.session.offers, ("/task/start", "/task/pause", "/task/go_home")))
        wanted = self._buttons if tasks else (self._buttons[0], self.no_tasks)
        if tuple(reversed(self.actions.children)) != wanted:
            self.actions.clear_widgets()
            for widget in wanted:
                self.actions.add_widget(widget)
        self.actions.cols = len(wanted) if self._tall else 1
        narrow = self._tall and self.actions.width < NARROW * Metrics.density * len(wanted)
        for button in self._buttons:
            button.flow = "vertical" if narrow else "horizontal"
            button.padding = (4 * Metrics.density, 0) if narrow else (10 * Metrics.density, 0)

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A decoded camera frame; `rate` [Hz] and `latency` [s] are said on it, NaN for unknown."""
        self.video.show_frame(picture.width, picture.height, picture.rgba, picture.taken)
        self.video.rate, self.video.latency = rate, latency

    def _name_sources(self) -> None:
        """An instrument that shows a topic of another name than the usual one says which."""
        offer = self.session.offer
        for widget, one in self._titled:
            source = offer.source(one.topic) if offer is not None else None
            widget.title = f"{one.title} · {_brief(source)}" if source and source != one.topic else one.title
        for readout, one in self._places_told:
            by_wheels = offer is not None and offer.pose_by_odometry
            readout.name = one.title.replace("Map", "Odom") if by_wheels else one.title

    # what the fingers do

    def _drive(self, _: object, twist: Twist) -> None:
        self.session.link.drive(twist)

    def _pause(self) -> None:
        status = self.session.feeds.latest("/task/status")
        paused = status is not None and status.state == "PAUSED"
        self.session.command("resume" if paused else "pause")

    def _take_limits(self) -> None:
        """The slider's range is the robot's; where it stood is kept."""
        limits = self.session.feeds.latest("/limits")
        self.speed.speed_limit = limits.max_speed if limits is not None else math.nan
        self.speed.turn_limit = limits.max_yaw_rate if limits is not None else math.nan
        fader, (fastest, _) = self.speed.ids.fader, allowed(self.session.info, limits)
        if self._limited and fader.maximum == fastest:
            self._limit()
            return
        fader.minimum, fader.maximum, fader.step = fastest / 10, fastest, 0.0
        wanted = self.speed.maximum_speed if self._limited else fastest * FIRST
        self._limited = self._limited or bool(self.session.info.max_speed)
        fader.value = min(max(wanted, fader.minimum), fastest)
        self.speed.maximum_speed = fader.value
        self._limit()

    def _limit(self, *_: object) -> None:
        """Slow on the slider is slow in turning as well, but never below half."""
        fastest, turn = allowed(self.session.info, self.session.feeds.latest("/limits"))
        share = self.speed.maximum_speed / fastest
        self.stick.max_speed = self.speed.maximum_speed
        self.stick.max_yaw_rate = turn * (0.5 + 0.5 * min(1.0, share))


def _brief(name: str) -> str:
    """The end of a topic's name, as much as an instrument has room for."""
    return name if len(name) <= LONGEST_NAME else f"…{name[1 - LONGEST_NAME :]}"
