"""Numbers of any topics over time beside the topic that is open: only what is drawn is listened to."""

from __future__ import annotations

import math

from app.link.channels import LINK, watched
from app.link.feeds import MAX_STALE_DELAY, Post
from app.link.link import Link
from app.screens.parts.plot_stack import PlotStack
from app.session.session import Session

__all__ = ["LivePlots"]

WHO = "plots"
"""As which the link knows who looks."""


class LivePlots:
    """Everything here happens in the UI thread."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self.stack = PlotStack()
        self._topics: dict[str, str] = {}
        """What is listened to, and its type."""
        self._channels: dict[str, str] = {}
        self._heard: dict[str, float] = {}
        """When each topic's newest came [s], our clock."""
        self._link: Link | None = None

    def turn(self, topic: str, kind: str, path: str, unit: str) -> bool:
        """Draw a field of a topic of that type, or no longer; False where there is no room for it."""
        if self.stack.find(topic, path) is not None:
            self.stack.remove(topic, path)
        elif self.stack.add(topic, path, unit) is None:
            return False
        else:
            self._topics[topic] = kind
        drawn = {trace.topic for trace in self.stack.traces}
        self._listen({topic: kind for topic, kind in self._topics.items() if topic in drawn})
        return True

    def _listen(self, topics: dict[str, str]) -> None:
        self._topics = topics
        self._channels = {watched(topic): topic for topic in topics}
        self._link = self._session.link
        self._link.watches.look(WHO, dict(topics))

    def drawn(self, topic: str) -> list[str]:
        """Paths of a topic that are drawn."""
        return [trace.path for trace in self.stack.traces if trace.topic == topic]

    def on_post(self, channel: str, post: Post) -> None:
        """Take in what came."""
        if channel == LINK and self._topics and self._link is not self._session.link:
            self._listen(self._topics)
        topic = self._channels.get(channel)
        if topic is None or post.value.message is None:
            return
        self._heard[topic] = post.received
        for trace in self.stack.traces:
            if trace.topic == topic:
                try:
                    trace.show(post.value.message, post.received)
                except (AttributeError, TypeError, ValueError):
                    trace.add(post.received, math.nan)  # of another type since it was chosen

    def tick(self) -> None:
        """A plot of which nothing comes any more says how long that has been so."""
        now = self._session.now()
        for plot in self.stack.plots:
            newest = max((self._heard.get(trace.topic, math.nan) for trace in plot.traces), default=math.nan)
            age = now - newest
            silent = not self._session.connected or age > MAX_STALE_DELAY
            plot.state = "never" if math.isnan(age) else "stale" if silent else "live"
            if plot.state == "stale":
                plot.age = age

    def close(self) -> None:
        """Draw nothing, and listen to nothing."""
        self.stack.clear()
        self._heard.clear()
        if self._topics:
            self._listen({})
