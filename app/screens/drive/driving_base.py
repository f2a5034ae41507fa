"""The base of every drive screen, however it is arranged: picture, instruments, controls and action buttons of a layout, small
sensors, and the robot's own checks."""

from __future__ import annotations

from typing import Any

from kivy.metrics import dp
from kivy.properties import ObjectProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.layout.layout import Action, Layout
from app.layout.rects import Rect
from app.link.camera_decoder import Picture
from app.link.channels import CAPABILITIES
from app.link.feeds import Post
from app.screens.drive.drawer import DrawerGround, DrawerHandle
from app.screens.drive.drive_blocked import DriveBlocked
from app.screens.drive.drive_controls import DriveControls
from app.screens.drive.instruments import Instruments
from app.screens.drive.small_sensors import SmallSensors
from app.screens.parts.picture_boxes import PictureBoxes
from app.screens.parts.placing import AWAY_X, off, put
from app.screens.parts.robot_screen import RobotScreen
from app.screens.shell.check_card import CheckCard
from app.screens.shell.screen_host import ScreenHost
from app.session.dashboard import Dashboard
from app.session.layout_actions import LayoutActions
from app.session.session import Session
from widgets import Video
from widgets.controls.sticks.stick import Stick

__all__ = ["Driving"]

CHIP = 96, 24
"""Least room for how late the picture is, at its upper edge, and its height [dp]."""


class Driving(RobotScreen):
    """A screen of its kind says how the picture is framed (`corner`), what lies where (`fill`, `arrange`) and what must be
    away under what is said (`uncover`); the shell calls the rest."""

    corner = 0
    """Rounding of the picture [dp]."""
    app: ObjectProperty[ScreenHost] = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()

    def __init__(self, layout: Layout, **kwargs: Any) -> None:
        """`layout` says what sits where."""
        super().__init__(**kwargs)
        session, app = self.session, self.app
        self.arranged: dict[str, Rect] = {}
        """Places by name since the last arranging; empty before."""
        self._over = False
        self.cover: Rect | None = None
        """Where something is said over the screen; None where nothing is."""
        self.notice = Rect(0, 0, 1, 1)
        """Where the shell says something."""
        self.places: dict[str, list[Widget]] = {}
        """What is on the glass, by place."""
        self.dashboard = Dashboard(session.feeds)
        self.video = Video(fit="cover", corner=self.corner)
        self.in_vain = DriveBlocked(session, app)
        confirmed = (Action(one.action) for one in layout.controls if one.action)
        self.does = LayoutActions((*layout.actions, *confirmed), session, app)
        self.instruments = Instruments(layout, self.dashboard, session.feeds)
        self.hands = DriveControls(layout, session, self.dashboard, self.does, self.in_vain)
        self.senses = SmallSensors(session.feeds)
        for make, topics in self.instruments.senses:
            self.senses.add(make, topics)
        self.senses.bind(open=self._cover_up, opacity=self._cover_up)
        self.sheet, self.handle = DrawerGround(), DrawerHandle()
        self.fill(layout)
        self._add_front()
        self._boxes = PictureBoxes(session, self.dashboard, self.video)

    def _add_front(self) -> None:
        """What lies over everything else: what pulls the drawer of a phone on its side, and cards."""
        self.handle.bind(on_pull=lambda _, out: self.pull(out=out))
        self.add_widget(self.handle)
        self.low = BoxLayout(orientation="vertical", spacing="8dp", size_hint=(None, None))
        """For cards that hold on until they are dealt with, each with a height of its own; they grow upwards."""
        self.low.bind(minimum_height=self.low.setter("height"), height=self._cover_up)
        self.add_widget(self.low)
        self.checks = CheckCard(self.session, self.dashboard, brief=True, pos_hint={"center_x": 0.5})
        self.low.add_widget(self.checks)

    # what a screen of its kind says

    def fill(self, layout: Layout) -> None:
        """Put everything on the glass: the picture below, what is touched above what is only seen."""
        raise NotImplementedError

    def uncover(self) -> None:
        """Take off the glass what would be seen only in part, and put the rest back."""
        raise NotImplementedError

    def meet(self) -> None:
        """The robot said what it is, or what it offers."""

    def back(self) -> bool:
        """Push the drawer back; False where it is not out."""
        out = bool(self.handle.pulled)
        self.pull(out=False)
        return out

    def settle(self) -> None:
        """Have the frame put everything into its place anew: other controls are on the glass."""
        shell = self.app.shell
        if shell is not None:
            shell.settle()

    def pull(self, *, out: bool) -> None:
        """Pull the drawer of a phone on its side out, or push it back: what is in it lets go."""
        if out != self.handle.pulled:
            self.handle.pulled = out
            self.settle()

    def place_drawer(self, form: str) -> None:
        """Put ground and handle into their places, which other forms have none of; over the picture sticks are bare."""
        away = Rect(AWAY_X, 0, 1, 1)
        put(self.sheet, self.arranged.get("drawer", away))
        put(self.handle, self.arranged.get("handle", away))
        short = form == "short"
        if not short:
            self.handle.pulled = False
        for found in self.places.values():
            for widget in found:
                if isinstance(widget, Stick):
                    widget.bare = short
        self.checks.tight = short

    def _yield_to(self, cover: Rect | None) -> None:
        """What is said comes before what is in the drawer."""
        if (
            cover is not None
            and self.handle.pulled
            and cover.overlaps(Rect(*self.sheet.pos, *self.sheet.size))
        ):
            self.pull(out=False)

    # what the inputs look at

    @property
    def stick(self) -> Any:
        """The first control that drives; None without one."""
        return next((stick for stick, _ in self.sticks), None)

    @property
    def sticks(self) -> list[tuple[Stick, str]]:
        """What drives and is on the glass, each with the stick of a gamepad that pushes it too."""
        return self.hands.sticks

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold besides."""
        return self.hands.grips

    # what the shell calls

    @property
    def picture(self) -> Video:
        """The camera's picture."""
        return self.video

    def clear(self, cover: Rect | None) -> None:
        """Take away what would be seen only in part behind what is said over the screen."""
        self.cover = cover
        self._yield_to(cover)
        self._cover_up()

    def on_post(self, channel: str, post: Post) -> None:
        """A message came."""
        self.dashboard.deliver(channel, post.value)
        self.hands.on_post(channel, post)
        if channel == CAPABILITIES:
            self.instruments.name_sources(self.session.robot.capabilities)
        if channel in ("/robot/info", CAPABILITIES):
            self.meet()

    def enter(self) -> None:
        """Come onto the glass."""
        self.hands.take_limits()
        self.meet()
        self.instruments.name_sources(self.session.robot.capabilities)
        self.dashboard.enter()
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""
        self.rest()
        self.pull(out=False)
        self.dashboard.leave()

    def rest(self) -> None:
        """Every control lets go."""
        self.hands.rest()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.dashboard.tick()
        self.senses.tick()
        self.in_vain.tick()
        self.checks.tick()
        self._boxes.tick()
        if self.session.checks.over != self._over:
            self._over = self.session.checks.over
            self._cover_up()
        self.hands.tick()

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A decoded camera frame; `rate` [Hz] and `latency` [s] are said on it, NaN for unknown."""
        self.video.show_frame(picture.width, picture.height, picture.rgba, picture.taken)
        self.video.rate, self.video.latency = rate, latency

    # what the screens of every kind do alike

    def place(self, slot: str, widget: Widget) -> None:
        """Put a widget on the glass, in that place from the next arranging on."""
        self.places.setdefault(slot, []).append(widget)
        self.add_widget(widget)

    def place_checks(self, low: Rect, top: float, unit: float) -> None:
        """The checks stand on the lower edge of `low` and end below `top` [px]; `unit` is one dp there."""
        self.low.pos, self.low.width, self.low.height = (low.x, low.y), low.width, self.low.minimum_height
        self.checks.wide, self.checks.room = min(low.width, 340 * unit), top - 8 * unit - low.y

    def hide_checks(self) -> bool:
        """Take the checks away once they are over, or where something is said over them, or sensors unfolded; whether they are away."""
        lids = [self.cover, self.arranged["senses_open"] if self.senses.covers else None, self._drawn]
        low = Rect(*self.low.pos, *self.low.size)
        under = self.session.checks.over or any(lid.overlaps(low) for lid in lids if lid is not None)
        self.low.opacity, self.low.disabled = float(not under), under
        return under

    @property
    def _drawn(self) -> Rect | None:
        """Where the drawer is; None while it is not out."""
        return self.arranged["drawer"] if self.handle.pulled else None

    @property
    def checks_place(self) -> list[Rect]:
        """Where the checks are; nothing while they are away."""
        wide, low = self.checks.shown_width, self.low
        if low.disabled or not wide:
            return []
        hint = self.checks.pos_hint
        x = low.right - wide if "right" in hint else low.x if "x" in hint else low.center_x - wide / 2
        return [Rect(x, low.y, wide, low.height)]

    def hide_chip(self, lids: list[Rect]) -> None:
        """The picture's own words end before the first of `lids` beside them, and are away where that leaves too little."""
        left = self.video.x + self.video.insets[0] + self.video.chip_inset + dp(8)
        top = self.video.top - self.video.insets[3] - dp(8)
        row = Rect(left, top - dp(CHIP[1]), max(self.video.right - left, 1.0), dp(CHIP[1]))
        ends = min((max(lid.x - dp(8), left) for lid in lids if lid.overlaps(row)), default=self.video.right)
        self.video.chip_room = ends - left
        self.video.show_chip = bool(self.video.chip_room >= dp(CHIP[0])) and self._drawn is None

    def _cover_up(self, *_: object) -> None:
        if self.arranged:
            self.uncover()
            self._uncover_handle()

    def _uncover_handle(self) -> None:
        """What is said is dealt with first: no part of the handle is seen or touched beside it."""
        place = self.arranged.get("handle")
        if place is not None:
            put(self.handle, off(place) if self.cover is not None and self.cover.overlaps(place) else place)
