"""The panels screen: the views of the robot's profile, live, and their editor."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from kivy.core.window import Window
from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, ObjectProperty, StringProperty

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.layout.arrange_panels import panels as places_on_screen
from app.layout.layout import Layout
from app.layout.rects import Body, Rect
from app.layout.sensible_view import sensible_view
from app.layout.views import View
from app.link.camera_decoder import Picture
from app.link.channels import CAPABILITIES
from app.link.feeds import Post
from app.profiles.profile_choice import ProfileChoice
from app.screens.panels.board import Board
from app.screens.panels.edit_dialogs import tell_faults
from app.screens.panels.editing import Editing
from app.screens.panels.side_pane import SidePane
from app.screens.panels.view_show import ViewShow
from app.screens.panels.view_tabs import ActRow, ViewTabs
from app.screens.parts.placing import put
from app.screens.parts.robot_screen import RobotScreen
from app.screens.shell.screen_host import ScreenHost
from app.session.session import Session
from widgets import Video
from widgets.controls.sticks.stick import Stick
from widgets.core.language import tr

__all__ = ["PanelsScreen"]

Builder.load_string("""
#:import tr widgets.core.language.tr
<PanelsScreen>:
    canvas.before:
        Color:
            rgba: theme.bg
        Rectangle:
            pos: self.pos
            size: self.size
    Text:
        id: empty
        text: root.empty
        role: 'muted'
        halign: 'center'
        size_hint: None, None
        opacity: 1 if root.empty else 0
""")


class PanelsScreen(RobotScreen):
    """Put any topic of the robot on the glass, and drive from there."""

    app: ObjectProperty[ScreenHost] = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()
    profiles: ObjectProperty[ProfileChoice] = ObjectProperty()
    view = NumericProperty(0)
    """Index of the view on the glass."""
    editing = BooleanProperty(False)
    empty = StringProperty("")
    """Why there is no panel, in one sentence; empty where there are some."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.layout: Layout = self.profiles.of(self.session.robot.info)
        self.board, self.tabs, self.acts, self.pane = Board(), ViewTabs(), ActRow(), SidePane()
        self.shows = ViewShow(self.board, self.session, self.app, self._act_on)
        self.editor = Editing(self)
        self._form, self._body, self._dp = "wide", Body(0, 0, 1, 1), 1.0
        self._places: dict[str, Rect] = {}
        self._cover: Rect | None = None
        self._seen: object = None
        """What the robot offered when the view was chosen that is shown where the profile has none."""
        self._sensible: tuple[View, ...] = ()
        for widget in (self.board, self.tabs, self.acts):
            self.add_widget(widget)
        self.tabs.bind(on_choose=lambda _, index: self.choose(index), on_add=lambda _: self.editor.add_view())
        self.acts.bind(on_act=lambda _, what: self.editor.act(what))
        self.pane.bind(on_close=lambda _: self.editor.close_pane())
        self.board.bind(
            on_select=lambda _, card: self.editor.select(None if card is None else int(card.shown)),
            on_place=lambda _, card, place: self.editor.place(int(card.shown), place),
        )
        self.ids.update({"board": self.board, "tabs": self.tabs, "acts": self.acts, "pane": self.pane})

    # the views

    @property
    def views(self) -> tuple[View, ...]:
        """Those of the profile or, where it has none, one made of the robot's topics; while edited those under change."""
        if self.editing:
            return self.editor.views
        if self.layout.views:
            return self.layout.views
        offer = self.session.robot.capabilities
        if offer is not self._seen:
            self._seen = offer
            self._sensible = (sensible_view(offer),) if offer is not None and offer.topics else ()
        return self._sensible

    def choose(self, index: int) -> None:
        """Put another view on the glass; every control of the one before lets go."""
        self.shows.rest()
        self.view = index
        self.editor.select(None)
        self.show()

    def show(self) -> None:
        """Bring the glass up to date with the views."""
        views = self.views
        self.view = min(self.view, max(len(views) - 1, 0))
        self.tabs.show([tr(view.title) for view in views], int(self.view), editing=self.editing)
        self.acts.show(self.editor.acts(self._form), self._form)
        view = views[int(self.view)] if views else View("")
        self.shows.show(view, self._form, editing=self.editing)
        self.empty = "" if any(self.editing or not one.hidden for one in view.panels) else self._nothing()
        self.editor.show_pane(self._form)

    def _nothing(self) -> str:
        if self.session.robot.capabilities is None:
            return tr("Asking the robot for its topics …")
        return tr("There is no panel yet. Press Edit and add some from this robot.")

    def reload(self) -> None:
        """Take the robot's profile as it is now, unless it is being edited."""
        if self.editing:
            return
        layout = self.profiles.of(self.session.robot.info)
        if layout != self.layout:
            self.shows.rest()
            self.layout = layout
        if self._places:
            self.show()

    def edit(self, on: bool) -> None:
        """Begin or end to edit; nothing drives from here in between."""
        self.shows.rest()
        self.editing = on
        self._lay()

    def take(self, views: tuple[View, ...]) -> None:
        """Keep these views as the robot's profile; OSError where they cannot be written."""
        self.layout = self.profiles.save(self.session.robot.info, replace(self.layout, views=views))

    # what the shell calls

    def arrange(self, body: Body, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._body, self._form, self._dp = body, form, dp
        self._lay()
        self.notice = self._places["notice"]
        return self._places["stop"]

    def clear(self, cover: Rect | None) -> None:
        """What is said lies over the board's lower edge for a while."""
        self._cover = cover

    def _lay(self) -> None:
        if self._body.width <= 1:
            return
        self._places = places_on_screen(self._body, self._form, self._dp, editing=self.editing)
        self.make_room()
        for widget, name in (
            (self.tabs, "tabs"),
            (self.acts, "acts"),
            (self.pane, "side"),
        ):
            put(widget, self._places[name])
        self.ids.empty.width = min(self.board.width - 24 * self._dp, 460 * self._dp)
        self.ids.empty.center = self.board.center
        self.pane.sheet = self._form == "tall"
        self.show()

    def make_room(self) -> None:
        """A phone's board ends above the sheet that lies over it, or beside it."""
        place = self._places["board"]
        self.board.whole = place.height
        if self._form == "tall" and self.pane.parent is not None:
            low = self._places["side"].top + 8 * self._dp
            place = Rect(place.x, low, place.width, place.top - low)
        elif self._form == "short" and self.pane.parent is not None:
            pane, gap = self._places["side"], 8 * self._dp
            left = place.x if pane.x > place.x else pane.right + gap
            right = pane.x - gap if pane.x > place.x else place.right
            place = Rect(left, place.y, right - left, place.height)
        put(self.board, place)
        if self.board.selected is not None:
            self.board.reveal(self.board.selected)

    def settle(self) -> None:
        """Have the frame put STOP where it goes now."""
        if self.app.shell is not None:
            self.app.shell.settle()

    def on_post(self, channel: str, post: Post) -> None:
        """A message came."""
        self.shows.on_post(channel, post)
        if channel in ("/robot/info", CAPABILITIES) and self.shows.active:
            self.reload()
            self.editor.on_offer()

    def enter(self) -> None:
        """Come onto the glass."""
        Window.bind(on_key_down=self._on_key)
        self.shows.active = True
        self.reload()
        self.show()
        self.shows.enter()
        tell_faults(self)
        self.tick()

    def leave(self) -> None:
        """Leave the glass; what was edited is kept under change."""
        Window.unbind(on_key_down=self._on_key)
        self.shows.leave()

    def end(self) -> None:
        """Let go for good."""
        self.board.close()

    def rest(self) -> None:
        """Every control lets go."""
        self.shows.rest()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.shows.tick()

    def back(self) -> bool:
        """Back from the pane to the board, then from editing to the views, whose changes are kept."""
        return self.editor.back()

    def keep(self) -> object:
        """The view that is looked at, and what is under change."""
        return int(self.view), self.editor.kept if self.editing else None

    def take_up(self, kept: Any) -> None:
        """Go on there."""
        self.view, changed = kept
        if changed is not None:
            self.editor.begin(changed)

    @property
    def picture(self) -> Video | None:
        """The first picture of the camera in sight; None without one."""
        return next(iter(self.shows.videos), None)

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """A camera frame came."""
        self.shows.show_picture(picture, rate, latency)

    # what the inputs look at

    @property
    def sticks(self) -> list[tuple[Stick, str]]:
        """What drives and is in sight; nothing while the view is edited."""
        return self.shows.sticks

    @property
    def grips(self) -> list[Any]:
        """What a finger may hold besides."""
        return self.shows.grips

    def _act_on(self, index: int, what: str) -> None:
        if what == "select":
            self.editor.select(index)
        else:
            self.editor.act_on(index, what)

    def _on_key(self, _window: object, key: int, _code: int, _text: object, modifiers: list[str]) -> bool:
        return self.editor.on_key(key, modifiers)
