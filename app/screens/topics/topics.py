"""The topics screen: everything that the robot tells, and any part of it live, field by field."""

from __future__ import annotations

import math
from typing import Any

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import ObjectProperty, StringProperty

from app.layout import arrange
from app.layout.arrange import Rect
from app.link.camera_decoder import Picture
from app.link.feeds import Post
from app.screens.parts.placing import above, put
from app.screens.parts.robot_screen import RobotScreen
from app.screens.shell.screen_host import ScreenHost
from app.screens.topics.graph_pane import GraphPane
from app.screens.topics.live_picture import LivePicture
from app.screens.topics.live_plots import LivePlots
from app.screens.topics.panel_adding import AddDialog
from app.screens.topics.ros_graph import GraphWatch
from app.screens.topics.topic_figures import Flows, entries
from app.screens.topics.topic_parts import TopicDetail
from app.screens.topics.topic_table import GRAPH, TopicList, row_of
from app.session.session import Session
from app.session.topic_list import TopicListing
from bridge.msgs.sensor_msgs import CompressedImage
from widgets import FieldView
from widgets.core.base import age_text
from widgets.core.language import figure, tr

__all__ = ["TopicsScreen"]

LEGIBLE = 860
"""Wider, a name and its value are too far apart for the eye [dp]."""
PART = 0.42
"""Of the open topic's height for its picture, and for what is drawn."""
LIST_EVERY = 4
"""The list is brought up to date in every so many ticks."""
Builder.load_string("""
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


class TopicsScreen(RobotScreen):
    """Look at anything that the robot tells."""

    app: ObjectProperty[ScreenHost] = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()
    summary = StringProperty("")

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.topics = TopicListing(self.session)
        self.flows, self.graph = Flows(self.session), GraphWatch(self.session)
        self.list, self.detail = TopicList(), TopicDetail()
        self.graph_pane = GraphPane(self.graph)
        self.view = FieldView(
            aged=False, veil_radius=1, size_hint_max_x=LEGIBLE * Metrics.density, picks=True
        )
        self.detail.ids.ground.add_widget(self.view)
        self.view.pos_hint = {"x": 0, "y": 0}
        self.view.bind(on_pick=lambda _, path, unit: self.plot(path, unit))
        self.plots, self.picture_view = LivePlots(self.session), LivePicture()
        self.list.bind(on_search=self._search, on_order=self._reorder, form=self._show_form)
        self.list.bind(wide=lambda *_: self._show_list(), stacked=lambda *_: self._show_list())
        self.list.bind(share=lambda *_: self._show_list())
        self.graph_pane.bind(on_open=lambda _, topic: self.open(topic))
        self.detail.bind(on_close=lambda _: self.close(), on_add=lambda _: self.add_to_panel())
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
        """On a phone the open topic takes the list's place; elsewhere the list has all room until a topic is open."""
        tall, opened = self._form == "tall", bool(self.topics.opened)
        self.detail.alone = tall
        shown = {self.list: not (tall and opened), self.detail: opened}
        for widget, wanted in shown.items():
            if wanted and widget.parent is None:
                self.add_widget(widget)
            elif not wanted and widget.parent is not None:
                self.remove_widget(widget)
        self._lay_detail()
        listed, detail = self._places["list"], self._places["detail"]
        strip = self._places["strip"]
        if not opened and self._form == "short":  # to the lower edge: its height is what it lacks
            listed = Rect(listed.x, listed.y, strip.right - listed.x, listed.height)
            left = strip.right + 12 * Metrics.density
            strip = Rect(left, detail.y, detail.right - left, detail.height)
        elif not opened and not tall:
            listed = Rect(listed.x, detail.y, detail.right - listed.x, detail.height)
        for widget, place in ((self.list, listed), (self.detail, detail)):
            put(widget, above(place, self._cover, Metrics.density))
        put(self.ids.strip, strip)

    def _lay_detail(self) -> None:
        """Above the fields a picture, where the topic is one; below them what is drawn."""
        stack, video = self.plots.stack, self.picture_view.video
        room = self._places["detail"].height if self._places else 0.0
        shown = ((stack, bool(stack.plots), 0), (video, LivePicture.takes(self.topics.kind), None))
        for widget, wanted, index in shown:
            widget.size_hint_y, widget.height = None, PART * room
            if wanted and widget.parent is None:
                at = len(self.detail.children) - 3 if index is None else index
                self.detail.add_widget(widget, index=max(at, 0))
            elif not wanted and widget.parent is not None:
                self.detail.remove_widget(widget)

    def plot(self, path: str, unit: str) -> None:
        """Draw a number of the open topic over time, or no longer."""
        if not self.topics.opened:
            return
        if not self.plots.turn(self.topics.opened, self.topics.type, path, unit):
            self.topics.problem = tr("There is no room for one more plot: take one away.")
        self.view.picked = self.plots.drawn(self.topics.opened)
        self._lay()

    def on_post(self, channel: str, post: Post) -> None:
        """A message came."""
        self.plots.on_post(channel, post)
        if self.graph.on_post(channel, post):
            self.graph_pane.show()
            self._show_state()
        if self.topics.on_post(channel, post):
            self._show_message()

    def enter(self) -> None:
        """Come onto the glass."""
        self.graph.look(True)
        self.tick()

    def leave(self) -> None:
        """Leave the glass: nothing is listened to for it any more."""
        self.graph.look(False)
        self.graph_pane.view.let_go()
        self.plots.close()
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
        self.flows.tick()
        self.graph.tick()
        self.plots.tick()
        self.picture_view.tick(self.topics.state, self.topics.age)
        self.view.now = self.session.link.robot_time()
        self._show_state()
        if self._ticks % LIST_EVERY == 0:
            self._show_list()
        self._ticks += 1

    def show_picture(self, picture: Picture, rate: float, latency: float) -> None:
        """Pictures are shown elsewhere."""

    # what is shown

    def _show_list(self) -> None:
        order, descending = self.list.sorting
        found = entries(
            self.topics.lines(), self.flows.of, self.graph.graph, order, descending=bool(descending)
        )
        opened = self.topics.opened
        rows = [
            row_of(one, self.list) | {"chosen": one.line.name == opened, "choose": self.open} for one in found
        ]
        if rows != self._rows:
            self._rows = rows
            self.list.table.data = rows
        graph = self.list.form == GRAPH
        self.list.sentence = "" if graph else self.topics.sentence
        self.graph_pane.say()
        hint = tr("Tap a number to plot it.") if opened else ""
        if not opened and not graph:
            hint = tr("Rate, age and bandwidth only of what is listened to.")
        self.summary = " · ".join(part for part in (self.topics.summary, hint) if part)

    def _reorder(self, *_: object) -> None:
        self._show_list()
        self.list.table.scroll_y = 1

    def _show_form(self, *_: object) -> None:
        """Table or graph."""
        pane, graph = self.graph_pane, self.list.form == GRAPH
        if graph and pane.parent is None:
            self.list.ids.frame.add_widget(pane)
            pane.show()
            pane.look_at(self.topics.opened)
        elif not graph and pane.parent is not None:
            pane.view.let_go()
            self.list.ids.frame.remove_widget(pane)
        self._show_list()

    def _show_message(self) -> None:
        self.view.now = self.session.link.robot_time()
        self.view.type = self.topics.kind
        message = self.topics.message
        if message is not None:
            self.view.show(message)
        if isinstance(message, CompressedImage):
            self.picture_view.show(message, self.session.now())
        self._lay_detail()
        self._show_state()

    def _show_state(self) -> None:
        topics, detail, view = self.topics, self.detail, self.view
        detail.name, detail.type = topics.opened, topics.type
        detail.nodes = self.graph.told(topics.opened) if topics.opened else ""
        detail.notice, detail.wrong = topics.notice, bool(topics.problem)
        state, age = topics.state, topics.age
        if state == "stale" and not abs(age - view.age) < 0.5:
            view.age = age
        view.state = state
        view.opacity = 1 if topics.kind is not None else 0
        stale, once = state == "stale", topics.once
        rate = f"{figure(topics.rate, 1)} Hz" if math.isfinite(topics.rate) else ""
        detail.pace = age_text(age) if stale else rate or ("live" if state == "live" else "")
        detail.pace_icon, detail.pace_role = ("schedule", "warn") if stale else ("sensors", "ok")
        if math.isfinite(once):
            words = "once" if detail.alone else f"once, {age_text(once)[:-3]}ago"
            detail.pace, detail.pace_icon, detail.pace_role = words, "info", "muted"

    # what the fingers do

    def _search(self, _: object, text: str) -> None:
        self.topics.search = self.graph_pane.view.search = text
        self._show_list()
        self.list.table.scroll_y = 1

    def open(self, name: str) -> None:
        """Show a topic of the list live; nothing when the robot has just taken it away."""
        if self.topics.offer is None or name not in self.topics.offer.topics:
            return
        self.list.ids.search.focus = False
        self._forget()
        self.topics.open(name)
        self.view.picked = self.plots.drawn(name)
        self._show_state()
        self._show_list()
        self._lay()

    def add_to_panel(self) -> None:
        """Ask on which view the open topic shall be, and as what."""
        shell = self.app.shell
        if self.topics.opened and shell is not None and shell.parent is not None:
            shell.parent.add_widget(AddDialog(self.app, self.topics.opened, self.topics.type))

    def close(self) -> None:
        """Back to the list."""
        self.topics.close()
        self._forget()
        self._show_state()
        self._show_list()
        if self._places:
            self._lay()

    def _forget(self) -> None:
        """Tree and picture belong to one topic."""
        self.picture_view.close()
        self.view.message, self.view.type, self.view.age = None, None, math.nan
        self.view.folds = {}
        self.view.ids.scroll.scroll_y = 1
