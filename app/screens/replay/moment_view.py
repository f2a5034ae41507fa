"""What a recording showed at a moment: picture, map with the trail, plots, events. By the same feeds and widgets as live."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable
from typing import Any

import numpy as np
from kivy.uix.floatlayout import FloatLayout

from app.layout.arrange import Rect
from app.link.camera_decoder import PICTURE, Picture
from app.link.feeds import Post
from app.replay.player import PICTURES, Player
from app.replay.recording_index import Index
from app.screens.parts.placing import put
from app.screens.parts.plot_stack import PlotStack
from app.screens.replay.places import panes
from app.session.dashboard import Dashboard
from bridge.msgs.vision_msgs import Detection2DArray
from widgets import EventLog, GridMap, Video
from widgets.core.language import tr
from widgets.core.quantities import SI_KINDS, to_shown, unit_of
from widgets.fields.number_fields import NumberField, number_fields

__all__ = ["USUAL_FIELDS", "MomentView"]

USUAL_FIELDS = (
    ("/odom", "twist.twist.linear.x", "m/s"),
    ("/odom", "twist.twist.angular.z", "rad/s"),
)
"""What is drawn of a recording until somebody chooses: topic, path, unit."""
PICTURE_LIVES = 1.0
"""A picture older than this at the moment that is shown is stale [s]."""
SPAN = 30.0
"""Time that plots show at first [s]."""
AHEAD = 0.3
"""Part of a plot that lies after the moment."""
NOWHERE = np.zeros((0, 2))
MAX_EVENTS = 200
"""So many lie in the list."""
MAP_TOPICS = ("/plan", "/intruders", "/limits", "/map", "/localisation/candidates")


class MomentView(FloatLayout):
    """Dispatches `on_seek(at)` when a finger chose a moment on a plot."""

    __events__ = ("on_seek",)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.video, self.map = Video(fit="contain"), GridMap()
        self.plots, self.events = PlotStack(pausable=False), EventLog(state="live")
        self.plots.bind(on_pick=lambda _, at: self._pick(at))
        self.parts = {"video": self.video, "map": self.map, "plots": self.plots, "events": self.events}
        self.player: Player | None = None
        self.dashboard: Dashboard | None = None
        self.fields: list[tuple[str, str, str]] = list(USUAL_FIELDS)
        """What is drawn: topic, path, unit."""
        self._shown, self._picture_at = 0, math.nan
        self._moment = math.nan

    def on_seek(self, at: float) -> None:
        """A finger asks for a moment [s since 1970]."""

    # the recording

    def open(self, player: Player) -> None:
        """Show the moments of a recording that is open."""
        index = player.index
        if index is None:
            raise ValueError(tr("The recording is not open yet."))
        self.player = player
        self._shown, self._picture_at, self._moment = 0, math.nan, math.nan
        self.dashboard = Dashboard(player.feeds)
        self.dashboard.bind(self.map, "/pose")
        for topic in MAP_TOPICS:
            self.dashboard.bind(self.map, topic, fresh=False)
        self.dashboard.bind(self.video, "/detections", fresh=False, empty=Detection2DArray())
        player.listeners.append(self._hear)
        self.events.clear()
        self._open_plots(index)
        self.dashboard.enter()
        player.tell_again()

    def _open_plots(self, index: Index) -> None:
        self.plots.clear()
        self.plots.epoch = index.start
        self.fields = [one for one in self.fields if one[0] in index.topics]
        for field in self.fields:
            self._draw_field(*field)

    @property
    def pictures(self) -> bool:
        """The recording has pictures."""
        return (
            self.player is not None and self.player.index is not None and PICTURES in self.player.index.topics
        )

    def choices(self) -> Iterable[tuple[str, NumberField]]:
        """Every number of the recording that can be drawn: topic and field."""
        player = self.player
        if player is None or player.index is None:
            return
        for topic in sorted(player.index.topics.values(), key=lambda one: one.name):
            if topic.type is None or topic.name == PICTURES:
                continue
            newest = player.feeds.latest(topic.name) if topic.name in player.feeds else None
            for field in number_fields(newest if newest is not None else topic.type()):
                yield topic.name, field

    @property
    def drawn(self) -> frozenset[tuple[str, str]]:
        """Topic and path of what is drawn."""
        return frozenset((topic, path) for topic, path, _ in self.fields)

    def turn(self, topic: str, path: str, unit: str) -> bool:
        """Draw a field, or no longer, in the units of the glass where it has one of `unit`; False where there is no room for it."""
        if (topic, path) in self.drawn:
            self.fields = [one for one in self.fields if one[:2] != (topic, path)]
            self.plots.remove(topic, path)
            return True
        if not self._draw_field(topic, path, unit):
            return False
        self.fields.append((topic, path, unit))
        return True

    def _draw_field(self, topic: str, path: str, unit: str) -> bool:
        player = self.player
        if player is None or player.index is None:
            return False
        kind = SI_KINDS.get(unit, "")
        made = self.plots.add(topic, path, unit_of(kind) if kind else unit)
        if made is None:
            return False
        plot, trace = made
        start = player.index.start

        def take(found: Any) -> None:
            if trace in plot.traces:
                values: Any = to_shown(found[1], kind) if kind else found[1]
                plot.load(trace, found[0] - start, values)
                self._follow()

        plot.span = min(SPAN, max(player.index.duration, 1.0))
        player.series(topic, path, take)
        return True

    # the moment

    def _hear(self, channel: str, post: Post) -> None:
        if channel == PICTURE:
            picture: Picture = post.value
            self.video.show_frame(picture.width, picture.height, picture.rgba, picture.taken)
            self._picture_at = post.received
        elif self.dashboard is not None:
            self.dashboard.deliver(channel, post.value)

    def tick(self) -> None:
        """Bring up to date what the moment changes."""
        if self.player is None or self.player.index is None or self.dashboard is None:
            return
        self.dashboard.tick()
        if self.player.position != self._moment:
            self._moment = self.player.position
            self._retrace(self.player.index)
            self._show_events(self.player.index)
            self._follow()
        self._judge_picture()

    def _retrace(self, index: Index) -> None:
        count = int(bisect_right(index.trail[:, 0], self._moment))
        self.map.retrace(index.trail[:count, 1:])

    def _show_events(self, index: Index) -> None:
        times = [time for time, _ in index.events]
        count = bisect_right(times, self._moment)
        if count < self._shown:
            self.events.clear()
            self._shown = 0
        self.events.show_all(event for _, event in index.events[max(self._shown, count - MAX_EVENTS) : count])
        self._shown = count
        if count:
            time, event = index.events[count - 1]
            self.events.now = event.stamp.seconds + self._moment - time

    def _judge_picture(self) -> None:
        age = self._moment - self._picture_at
        self.video.state = "never" if math.isnan(age) else "live" if abs(age) < PICTURE_LIVES else "stale"
        if self.video.state == "stale":
            self.video.age = abs(age)

    def _follow(self) -> None:
        """Plots have the moment in sight, where their cursor stands."""
        player = self.player
        if player is None or player.index is None or not self.plots.plots:
            return
        at, span = player.position - player.index.start, self.plots.plots[0].span
        until = min(max(at + AHEAD * span, span), max(player.index.duration, span))
        self.plots.show(cursor=at, until=until)

    def _pick(self, at: float) -> None:
        if self.player is not None and self.player.index is not None:
            if math.isfinite(at):
                self.dispatch("on_seek", self.player.index.start + at)
            else:
                self._follow()

    def close(self) -> None:
        """Show nothing of a recording any more."""
        if self.player is not None and self._hear in self.player.listeners:
            self.player.listeners.remove(self._hear)
        self.player = self.dashboard = None
        self.map.retrace(NOWHERE)
        self.map.robot = [math.nan] * 3

    # places

    def arrange(self, main: Rect, form: str, dp: float, chosen: str) -> None:
        """Put what has a place there; on a phone that is the `chosen` part."""
        places = panes(main, form, dp, pictures=self.pictures, chosen=chosen)
        for name, part in self.parts.items():
            if name in places:
                put(part, places[name])
            if (name in places) != (part.parent is self):
                (self.add_widget if name in places else self.remove_widget)(part)
        self.map.let_go()
