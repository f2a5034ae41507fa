"""The topics screen: everything that the robot tells, and any part of it live, field by field."""

from __future__ import annotations

import math
from typing import Any

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import BooleanProperty, ObjectProperty, StringProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.recycleview.views import RecycleDataViewBehavior

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.layout import arrange
from app.layout.arrange import Rect
from app.link.camera_decoder import Picture
from app.link.feeds import Post
from app.screens.parts.placing import above, put
from app.screens.parts.robot_screen import RobotScreen
from app.session.session import Session
from app.session.topic_list import Line, TopicListing
from widgets import FieldView
from widgets.core.base import age_text
from widgets.parts.cards import Card

__all__ = ["TopicRow", "TopicsScreen"]

LEGIBLE = 860
"""Wider, a name and its value are too far apart for the eye [dp]."""
LIST_EVERY = 4
"""The list is brought up to date in every so many ticks."""
ICONS = {
    "sensor_msgs/Imu": "explore",
    "sensor_msgs/LaserScan": "radar",
    "sensor_msgs/PointCloud2": "radar",
    "sensor_msgs/Range": "sensors",
    "sensor_msgs/CompressedImage": "videocam",
    "sensor_msgs/Image": "videocam",
    "sensor_msgs/BatteryState": "bolt",
    "sensor_msgs/NavSatFix": "satellite_alt",
    "nav_msgs/Odometry": "route",
    "nav_msgs/Path": "polyline",
    "nav_msgs/OccupancyGrid": "map",
    "geometry_msgs/Twist": "sports_esports",
    "diagnostic_msgs/DiagnosticArray": "build",
    "std_msgs/String": "text_fields",
}
"""Icon of a type; any other is a pair of braces."""

Builder.load_string("""
#:import wrapped widgets.parts.labels.wrapped
<Beside@Label>:
    font_name: theme.font
    font_size: sp(13.5)
    disabled_color: self.color
    size_hint: None, 1
    width: self.texture_size[0] if self.text else 0

<TopicRow>:
    padding: dp(14), 0, dp(14), 0
    spacing: dp(12)
    canvas.before:
        Rounded:
            rgba: theme.accent if root.chosen else theme.line
            pos: self.x, self.y + dp(4)
            size: self.width, self.height - dp(8)
            radius: [theme.corner]
        Rounded:
            rgba: theme.raised
            pos: self.x + root.edge, self.y + dp(4) + root.edge
            size: self.width - 2 * root.edge, self.height - dp(8) - 2 * root.edge
            radius: [theme.corner - root.edge]
        Rounded:
            rgba: theme.accent if root.chosen else (0, 0, 0, 0)  # a mark, and not a hue alone
            pos: self.x + dp(4), self.y + dp(14)
            size: dp(4), self.height - dp(28)
            radius: [dp(2)]
        Rounded:
            rgba: theme.text[:3] + [.14 if root.state == 'down' else 0]
            pos: self.x, self.y + dp(4)
            size: self.width, self.height - dp(8)
            radius: [theme.corner]
    Icon:
        name: root.icon
        role: 'accent' if root.listened else 'muted'
        pos_hint: {'center_y': .5}
    BoxLayout:
        orientation: 'vertical'
        size_hint_y: None
        height: dp(44)
        pos_hint: {'center_y': .5}
        BoxLayout:
            spacing: dp(8) if root.use else 0
            Text:
                text: root.name
                bold: True
                font_size: sp(16)
                size_hint_y: 1
                text_size: self.size
                shorten: True
                shorten_from: 'left'
            Beside:
                text: root.use
                color: theme.accent
        BoxLayout:
            spacing: dp(8) if root.pace else 0
            Text:
                text: root.type
                role: 'muted'
                font_size: sp(13.5)
                size_hint_y: 1
                text_size: self.size
                shorten: True
                shorten_from: 'left'
            Beside:
                text: root.pace
                color: theme.muted

<TopicList>:
    orientation: 'vertical'
    spacing: dp(8)
    BoxLayout:
        size_hint_y: None
        height: search.height
        TextField:
            id: search
            hint_text: 'Search names and types'
            on_text: root.dispatch('on_search', self.text)
        IconButton:
            id: clear
            icon: 'close'
            role: 'muted'
            bare: True
            width: search.height if search.text else 0
            opacity: 1 if search.text else 0
            disabled: not search.text
            on_release: search.text = ''
    FloatLayout:
        id: frame
        RecycleView:
            id: view
            viewclass: 'TopicRow'
            pos_hint: {'x': 0, 'y': 0}
            size_hint_x: None
            width: frame.width + dp(8)  # the bar beside the cards
            bar_width: dp(3)
            bar_color: theme.muted
            bar_inactive_color: theme.line
            scroll_type: ['bars', 'content']
            RecycleBoxLayout:
                orientation: 'vertical'
                size_hint_y: None
                height: self.minimum_height
                padding: 0, 0, dp(8), 0
                default_size: None, max(theme.target, dp(60)) + dp(8)
                default_size_hint: 1, None
        Text:
            text: root.sentence
            role: 'muted'
            font_size: sp(15)
            pos_hint: {'x': 0, 'top': 1}
            padding: dp(6), dp(10)

<TopicDetail>:
    padding: dp(12), dp(10), dp(6), dp(10)
    spacing: dp(8)
    BoxLayout:
        size_hint_y: None
        height: max(theme.target, titles.height + dp(6)) if root.name else 0
        opacity: 1 if root.name else 0
        spacing: dp(8)
        padding: 0, 0, dp(6), 0
        IconButton:
            id: close
            icon: 'arrow_back' if root.alone else 'close'
            role: 'muted'
            bare: True
            pos_hint: {'center_y': .5}
            disabled: not root.name
            on_release: root.dispatch('on_close')
        Column:
            id: titles
            spacing: dp(2)
            pos_hint: {'center_y': .5}
            Text:  # whole, on as many lines as it takes: here alone a long name can be read
                id: title
                text: wrapped(root.name, self.width, self.font_size)
                bold: True
                font_size: sp(18)
            Text:
                text: wrapped(root.type, self.width, self.font_size)
                role: 'muted'
                font_size: sp(14)
        Chip:
            id: pace
            icon: root.pace_icon
            role: root.pace_role
            text: root.pace
            usual: '00.0 Hz'
            pos_hint: {'center_y': .5}
            opacity: 1 if root.pace else 0
    BoxLayout:
        size_hint_y: None
        height: note.height if root.notice else 0
        opacity: 1 if root.notice else 0
        spacing: dp(8)
        padding: dp(8), 0, dp(8), 0
        Icon:
            name: 'warning' if root.wrong else 'info'
            role: 'warn' if root.wrong else 'muted'
            font_size: sp(20)
            pos_hint: {'center_y': .5}
        Text:
            id: note
            text: root.notice
            role: 'text' if root.wrong else 'muted'
            font_size: sp(15)
            pos_hint: {'center_y': .5}
    FloatLayout:
        id: ground
        Icon:
            name: 'data_object'
            role: 'muted'
            font_size: sp(34)
            center: ground.center_x, ground.center_y + dp(24)
            opacity: 0 if root.name or root.idle else 1
        Text:
            text: 'Choose a topic to see its fields.'
            role: 'muted'
            halign: 'center'
            pos_hint: {'center_x': .5}
            center_y: ground.center_y - dp(18)
            opacity: 0 if root.name or root.idle else 1

<TopicsScreen>:
    Text:
        id: strip
        text: root.summary
        role: 'muted'
        font_size: sp(14)
        valign: 'middle'
        text_size: self.size
        size_hint: None, None
""")


class TopicRow(RecycleDataViewBehavior, ButtonBehavior, BoxLayout):
    """One topic of the list, to be pressed."""

    name = StringProperty("")
    type = StringProperty("")
    icon = StringProperty("data_object")
    use = StringProperty("")
    """What a screen shows it as."""
    pace = StringProperty("")
    """How often it comes, or how old it is."""
    listened = BooleanProperty(False)
    """Messages come from it now."""
    chosen = BooleanProperty(False)
    """It is the one that is open."""
    choose = ObjectProperty(None, allownone=True)
    """Called with the name when a finger pressed it."""

    @property
    def edge(self) -> float:
        """Width of its border [px]."""
        return float(Metrics.density * (1.5 if self.chosen else 1.0))

    def on_release(self) -> None:
        """Open it."""
        if self.choose is not None:
            self.choose(self.name)


class TopicList(BoxLayout):
    """The search and what it leaves."""

    __events__ = ("on_search",)

    sentence = StringProperty("")

    def on_search(self, text: str) -> None:
        """Something else is looked for."""


class TopicDetail(Card):
    """One topic, live."""

    __events__ = ("on_close",)

    name = StringProperty("")
    type = StringProperty("")
    notice = StringProperty("")
    wrong = BooleanProperty(False)
    """The notice is about something that failed."""
    pace = StringProperty("")
    pace_icon = StringProperty("sensors")
    pace_role = StringProperty("muted")
    alone = BooleanProperty(False)
    """The list is not beside it."""
    idle = BooleanProperty(False)
    """There is no topic to choose."""

    def on_close(self) -> None:
        """The finger wants back to the list."""


class TopicsScreen(RobotScreen):
    """Look at anything that the robot tells."""

    app: ObjectProperty[object] = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()
    summary = StringProperty("")

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.topics = TopicListing(self.session)
        self.list, self.detail = TopicList(), TopicDetail()
        self.view = FieldView(aged=False, veil_radius=1, size_hint_max_x=LEGIBLE * Metrics.density)
        self.detail.ids.ground.add_widget(self.view)
        self.view.pos_hint = {"x": 0, "y": 0}
        self.list.bind(on_search=self._search)
        self.detail.bind(on_close=lambda _: self.close())
        self.ids.update({"list": self.list, "detail": self.detail, "search": self.list.ids.search})
        self._places: dict[str, Rect] = {}
        self._cover: Rect | None = None
        self._form, self._ticks = "wide", 0
        self._rows: list[dict[str, Any]] = []

    # what the shell calls

    def arrange(self, body: Rect, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._places, self._form = arrange.topics(body, form, dp), form
        self._lay()
        self.notice = self._places["notice"]
        return self._places["stop"]

    def clear(self, cover: Rect | None) -> None:
        """Make room for what is said over the screen."""
        self._cover = cover
        self._lay()

    def _lay(self) -> None:
        """On a phone the open topic takes the list's place."""
        tall = self._form == "tall"
        self.detail.alone = tall
        shown = {
            self.list: not (tall and self.topics.opened),
            self.detail: not tall or bool(self.topics.opened),
        }
        for widget, wanted in shown.items():
            if wanted and widget.parent is None:
                self.add_widget(widget)
            elif not wanted and widget.parent is not None:
                self.remove_widget(widget)
        for widget, place in ((self.list, "list"), (self.detail, "detail")):
            put(widget, above(self._places[place], self._cover, Metrics.density))
        put(self.ids.strip, self._places["strip"])

    def on_post(self, channel: str, post: Post) -> None:
        """A message came."""
        if self.topics.on_post(channel, post):
            self._show_message()

    def enter(self) -> None:
        """Come onto the glass."""
        self.tick()

    def leave(self) -> None:
        """Leave the glass: nothing is listened to for it any more."""
        self.list.ids.search.focus = False
        self.close()

    def rest(self) -> None:
        """Nothing here moves the robot."""

    def back(self) -> bool:
        """Back from a topic that covers the list; False when there is none."""
        covered = self._form == "tall" and bool(self.topics.opened)
        if covered:
            self.close()
        return covered

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.topics.tick()
        self.view.now = self.session.link.robot_time()
        self._show_state()
        if self._ticks % LIST_EVERY == 0:
            self._show_list()
        self._ticks += 1

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """Pictures are shown elsewhere."""

    # what is shown

    def _show_list(self) -> None:
        rows = [self._row(line) for line in self.topics.lines()]
        if rows != self._rows:
            self._rows = rows
            self.list.ids.view.data = rows
        self.list.sentence, self.summary = self.topics.sentence, self.topics.summary
        self.detail.idle = bool(self.topics.sentence)

    def _row(self, line: Line) -> dict[str, Any]:
        live = line.state == "live"
        pace = f"{line.rate:.1f} Hz" if live and math.isfinite(line.rate) and line.rate >= 0.05 else ""
        return {
            "name": line.name,
            "type": line.type,
            "icon": ICONS.get(line.type, "data_object"),
            "use": line.use,
            "pace": age_text(line.age) if line.state == "stale" else pace,
            "listened": live,
            "chosen": line.name == self.topics.opened,
            "choose": self.open,
        }

    def _show_message(self) -> None:
        self.view.now = self.session.link.robot_time()
        self.view.type = self.topics.kind
        if self.topics.message is not None:
            self.view.show(self.topics.message)
        self._show_state()

    def _show_state(self) -> None:
        topics, detail, view = self.topics, self.detail, self.view
        detail.name, detail.type = topics.opened, topics.type
        detail.notice, detail.wrong = topics.notice, bool(topics.problem)
        state, age = topics.state, topics.age
        if state == "stale" and not abs(age - view.age) < 0.5:
            view.age = age
        view.state = state
        view.opacity = 1 if topics.kind is not None else 0
        stale, once = state == "stale", topics.once
        rate = f"{topics.rate:.1f} Hz" if math.isfinite(topics.rate) else ""
        detail.pace = age_text(age) if stale else rate or ("live" if state == "live" else "")
        detail.pace_icon, detail.pace_role = ("schedule", "warn") if stale else ("sensors", "ok")
        if math.isfinite(once):
            words = "once" if detail.alone else f"once, {age_text(once)[:-3]}ago"
            detail.pace, detail.pace_icon, detail.pace_role = words, "info", "muted"

    # what the fingers do

    def _search(self, _: object, text: str) -> None:
        self.topics.search = text
        self._show_list()
        self.list.ids.view.scroll_y = 1

    def open(self, name: str) -> None:
        """Show a topic of the list live; nothing when the robot has just taken it away."""
        if self.topics.offer is None or name not in self.topics.offer.topics:
            return
        self.list.ids.search.focus = False
        self._forget()
        self.topics.open(name)
        self._show_state()
        self._show_list()
        self._lay()

    def close(self) -> None:
        """Back to the list."""
        self.topics.close()
        self._forget()
        self._show_state()
        self._show_list()
        if self._places:
            self._lay()

    def _forget(self) -> None:
        """The tree belongs to one topic."""
        self.view.message, self.view.type, self.view.age = None, None, math.nan
        self.view.folds = {}
        self.view.ids.scroll.scroll_y = 1
