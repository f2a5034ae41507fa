"""Topics of the panels on the glass: each is listened to once, however many panels show it, and only what is in sight is drawn."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from app.link.channels import CAPABILITIES, LINK, watched
from app.link.feeds import Feed, Post
from app.link.subscriptions import UNUSED
from app.session.dashboard import AGE_STEP
from app.session.session import Session
from bridge.core.topics import TOPICS, Topic
from bridge.msgs import Msg
from widgets.core.language import tr

__all__ = ["PanelFeeds"]

WHO = "panels"
_ENTRIES = {entry.name: entry for entry in TOPICS if entry.to == "handheld"}


@dataclass
class _Binding:
    widget: Any
    show: Callable[[Any], object]
    fresh: bool
    seen: Callable[[], bool]


@dataclass
class _Source:
    """One topic."""

    topic: str
    bindings: list[_Binding] = field(default_factory=list)
    feed: Feed | None = None
    """Its own, where the app does not listen to the topic anyway."""
    ours: str = ""
    """Our name of it, where it does."""
    problem: str = ""
    """Why nothing comes, in one sentence."""


class PanelFeeds:
    """The bindings of one view's widgets. Everything here happens in the UI thread."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._sources: dict[str, _Source] = {}
        """By topic, as the layout names it."""
        self._channels: dict[str, _Source] = {}
        self._link: object = None

    def bind(
        self,
        widget: Any,
        topic: str,
        seen: Callable[[], bool],
        show: Callable[[Any], object] | None = None,
        *,
        fresh: bool = True,
    ) -> None:
        """Show `topic` on `widget` while it is `seen`; with `fresh` its age and state follow the topic."""
        source = self._sources.setdefault(topic, _Source(topic))
        source.bindings.append(_Binding(widget, show or widget.show, fresh, seen))

    def problem(self, topic: str) -> str:
        """Why nothing comes of a topic, in one sentence; empty where that is not known."""
        source = self._sources.get(topic)
        return source.problem if source is not None else ""

    def latest(self, topic: str) -> Msg | None:
        """The newest message of a topic that a panel shows; None before the first."""
        source = self._sources.get(topic)
        if source is None:
            return None
        message: Msg | None = self._session.feeds.latest(source.ours) if source.ours else None
        return source.feed.message if source.feed is not None else message

    def open(self) -> None:
        """Listen to what the robot offers of the topics."""
        self._route()
        for source in self._sources.values():
            for binding in source.bindings:
                self._show(source, binding)
        self.tick()

    def close(self) -> None:
        """Listen to nothing any longer, and let go of the widgets."""
        self._session.link.watches.look(WHO, {})
        self._sources.clear()
        self._channels.clear()

    def _route(self) -> None:
        """Find the channel of each topic; those that no screen shows are watched."""
        session, self._link = self._session, self._session.link
        offer = session.robot.capabilities
        wanted: dict[str, str] = {}
        self._channels.clear()
        for source in self._sources.values():
            source.ours = self._ours(source.topic)
            if source.ours:
                source.feed = None
                self._channels[source.ours] = source
                continue
            kind = offer.topics.get(source.topic) if offer is not None else None
            if kind is None:
                source.problem = (
                    "" if offer is None else tr("This robot has no topic {topic}.").format(topic=source.topic)
                )
                continue
            self._channels[watched(source.topic)] = source
            wanted[source.topic] = kind
        session.link.watches.look(WHO, wanted)

    def _ours(self, topic: str) -> str:
        """Our name of a topic that the app listens to anyway; empty for any other."""
        offer = self._session.robot.capabilities
        if offer is None:
            entry = _ENTRIES.get(topic)
            usual = entry is not None and not entry.on_demand and topic not in UNUSED
            return topic if usual else ""
        for name, entry in _ENTRIES.items():
            if not entry.on_demand and not entry.once and name not in UNUSED and offer.source(name) == topic:
                return name
        return ""

    def on_post(self, channel: str, post: Post) -> None:
        """Something came: draw it where it is in sight."""
        if channel in (CAPABILITIES, LINK):
            if channel == CAPABILITIES or self._link is not self._session.link:
                self._route()
            return
        source = self._channels.get(channel)
        if source is None:
            return
        if not source.ours and not self._take(source, post):
            return
        for binding in source.bindings:
            if binding.seen():
                self._show(source, binding)

    def _take(self, source: _Source, post: Post) -> bool:
        """Take in what was seen of a watched topic; whether it was a message."""
        seen = post.value
        source.problem = seen.problem
        if seen.kind is not None and (source.feed is None or source.feed.topic.type is not seen.kind):
            source.feed = Feed(Topic(source.topic, seen.kind, 0.0, "handheld", ""), learns=True)
            for binding in source.bindings:
                if hasattr(binding.widget, "folds"):
                    binding.widget.type = seen.kind
        if seen.message is None or source.feed is None:
            return False
        source.feed.put(seen.message, post.received, post.count)
        return True

    def _show(self, source: _Source, binding: _Binding) -> None:
        message = self.latest(source.topic)
        if message is None:
            return
        accepts = getattr(binding.widget, "accepts", ())
        if accepts and not isinstance(message, accepts) and binding.show == binding.widget.show:
            source.problem = tr("{name} does not show {msgtype}.").format(
                name=type(binding.widget).__name__, msgtype=message.MSGTYPE
            )
            return
        binding.show(message)

    def refresh(self) -> None:
        """Show the newest of everything that is in sight: something came into it."""
        for source in self._sources.values():
            for binding in source.bindings:
                if binding.seen():
                    self._show(source, binding)
        self.tick()

    def tick(self) -> None:
        """Bring age and state of what is in sight up to date."""
        now, feeds = self._session.now(), self._session.feeds
        for source in self._sources.values():
            if not any(binding.fresh and binding.seen() for binding in source.bindings):
                continue
            state, age = "never", math.nan
            if source.ours:
                state, age = feeds.state(source.ours), feeds.age(source.ours)
            elif source.feed is not None:
                state, age = source.feed.state(now, feeds.lost_at), source.feed.age(now, feeds.lost_at)
            for binding in source.bindings:
                if binding.fresh and binding.seen():
                    _refresh(binding.widget, state, age)


def _refresh(widget: Any, state: str, age: float) -> None:
    if state == "stale" and not abs(age - widget.age) < AGE_STEP:
        widget.age = age
    if widget.state != "alarm" or state != "live":
        widget.state = state
