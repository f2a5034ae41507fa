"""The robot's topics as the operator reads them: names, types, rates, what the app uses them for, and one of them live."""

from __future__ import annotations

import math
from dataclasses import dataclass

from app.link.capabilities import CAMERA, Capabilities
from app.link.channels import CAPABILITIES, LINK, SEEN
from app.link.feeds import MAX_STALE_DELAY, Feed, Post
from app.link.subscriptions import Seen
from app.session.session import Session
from bridge.core.topics import TOPICS, Topic
from bridge.msgs import Msg
from widgets.core.language import mark, tr, trn

__all__ = ["Line", "TopicListing"]

ASK_EVERY = 3.0
"""Between two questions for the list while it is looked at [s]."""
USES = {
    "/scan": mark("laser", "topic"),
    "/imu/data": mark("horizon", "topic"),
    "/odom": mark("speed", "topic"),
    "/pose": mark("place", "topic"),
    "/map": mark("map", "topic"),
    "/plan": mark("plan", "topic"),
    "/fix": mark("satellites", "topic"),
    "/battery_state": mark("battery", "topic"),
    "/detections": mark("boxes in the video"),
    CAMERA: mark("camera", "topic"),
}
"""What a screen shows a topic as, by our name of it."""


@dataclass(frozen=True, slots=True)
class Line:
    """One topic of the list."""

    name: str
    type: str
    """ROS 1 name."""
    use: str = ""
    """What the app does with it; empty for nothing."""
    rate: float = math.nan
    """Messages a second that come here [Hz]; NaN where it is not listened to or not known yet."""
    age: float = math.nan
    """Of the newest [s]; NaN where none came."""
    state: str = ""
    """`never`, `live` or `stale`; empty where it is not listened to."""


class TopicListing:
    """The list, the search, and the one topic that is open. Everything here happens in the UI thread."""

    def __init__(self, session: Session) -> None:
        self._session, self._now = session, session.now
        self.search = ""
        """What names or types must hold to be in the list, in any case; several words must all be there."""
        self.opened = ""
        """The topic that is looked at; empty for none."""
        self.problem = ""
        """Why its messages cannot be shown, in one sentence; empty while they can."""
        self.kind: type[Msg] | None = None
        """Class of its messages; None until it is known."""
        self._feed: Feed | None = None
        self._asked_at = -math.inf

    # the list

    @property
    def offer(self) -> Capabilities | None:
        """What the robot offers; None until it said so."""
        return self._session.robot.capabilities

    def tick(self) -> None:
        """Ask for the list again now and then, while somebody looks at it."""
        if self._session.connected and self._now() - self._asked_at >= ASK_EVERY:
            self._asked_at = self._now()
            self._session.link.ask_offer()

    def lines(self) -> list[Line]:
        """What the search leaves, by name."""
        if self.offer is None:
            return []
        uses = self._uses(self.offer)
        words = self.search.lower().split()
        return [
            self._line(name, kind, uses)
            for name, kind in sorted(self.offer.topics.items())
            if all(word in name.lower() or word in kind.lower() for word in words)
        ]

    def _uses(self, offer: Capabilities) -> dict[str, tuple[str, str]]:
        """By the robot's name: our name, and what the app does with it."""
        found: dict[str, tuple[str, str]] = {}
        for entry in TOPICS:
            source = offer.source(entry.name) if entry.to == "handheld" else None
            if source is not None:
                found[source] = (entry.name, tr(USES.get(entry.name, "")))
        if offer.drive is not None:
            found[offer.drive] = ("", tr("drives it"))
        return found

    def _line(self, name: str, kind: str, uses: dict[str, tuple[str, str]]) -> Line:
        if name == self.opened and self._feed is not None:
            use = uses.get(name, ("", ""))[1]
            return Line(name, kind, use, self._feed.rate, self.age, self.state)
        ours, use = uses.get(name, ("", ""))
        feeds = self._session.feeds
        if ours not in feeds or feeds[ours].message is None:
            return Line(name, kind, use)
        return Line(name, kind, use, feeds[ours].rate, feeds.age(ours), feeds.state(ours))

    @property
    def sentence(self) -> str:
        """Why there is nothing in the list; empty when there is something, or how much there is."""
        offer = self.offer
        if offer is None:
            return (
                tr("Asking the robot for its topics …")
                if self._session.connected
                else tr("There is no connection.")
            )
        if not offer.rosapi:
            return tr("This robot lists no topics: it runs no rosapi.")
        if not offer.topics:
            return tr("This robot has no topics.")
        if not self.lines():
            return tr("No topic has “{search}” in its name or type.").format(search=self.search.strip())
        return ""

    @property
    def summary(self) -> str:
        """How much the robot offers, as in `14 topics, 31 services`."""
        if self.offer is None or not self.offer.rosapi:
            return ""
        topics = trn("{count} topic", "{count} topics", len(self.offer.topics))
        return f"{topics}, {trn('{count} service', '{count} services', len(self.offer.services))}"

    # the open one

    def open(self, name: str) -> None:
        """Look at a topic of the list; the one before is listened to no longer. KeyError for one that is not there."""
        if self.offer is None:
            raise KeyError(name)
        kind = self.offer.topics[name]
        self.opened, self.problem, self.kind = name, "", None
        self._feed = None
        self._session.link.inspect(name, kind)

    def close(self) -> None:
        """Look away: it is listened to no longer."""
        if self.opened:
            self._session.link.end_inspection()
        self.opened, self.problem, self.kind, self._feed = "", "", None, None

    @property
    def type(self) -> str:
        """ROS 1 name of the open topic's type; empty when none is open."""
        return self.offer.topics.get(self.opened, "") if self.offer is not None else ""

    @property
    def message(self) -> Msg | None:
        """The newest of the open topic; None before the first."""
        return self._feed.message if self._feed is not None else None

    def on_post(self, channel: str, post: Post) -> bool:
        """Take in what came; True when it belongs to the open topic."""
        if channel == LINK and self._feed is not None:
            self._feed.subscribed_anew()
        if channel == LINK and self.opened and self._session.connected and self.problem:
            self.open(self.opened)
            return True
        if channel == CAPABILITIES and self.opened and not self.type:
            self.problem = tr("The robot no longer offers {opened}.").format(opened=self.opened)
        if channel != SEEN or post.value.topic != self.opened:
            return False
        self._take(post.value, post)
        return True

    def _take(self, seen: Seen, post: Post) -> None:
        if seen.problem:
            self.problem = seen.problem
        if seen.kind is not None:
            self.kind = seen.kind
            known = next((one for one in TOPICS if one.name == self.opened and self._ours), None)
            rate = known.rate if known is not None else 0.0
            self._feed = Feed(Topic(self.opened, seen.kind, rate, "handheld", ""), learns=known is None)
        elif seen.message is not None and self._feed is not None:
            self.problem = ""
            self._feed.put(seen.message, post.received, post.count)

    @property
    def _ours(self) -> bool:
        return self.offer is not None and self.offer.ours

    @property
    def rate(self) -> float:
        """How many messages of the open topic come here in a second [Hz]; NaN while that is not known."""
        return self._feed.rate if self._feed is not None and self.state == "live" else math.nan

    @property
    def age(self) -> float:
        """Of the newest message of the open topic [s]; NaN before the first."""
        return (
            self._feed.age(self._now(), self._session.feeds.lost_at) if self._feed is not None else math.nan
        )

    @property
    def state(self) -> str:
        """Of the open topic: `never`, `live` or `stale`.

        One whose rate nobody knows is live for 3 s, or longer where its messages come seldom; said once, it stays so.
        """
        return (
            self._feed.state(self._now(), self._session.feeds.lost_at) if self._feed is not None else "never"
        )

    @property
    def once(self) -> float:
        """How long ago the open topic said the only thing that it has said here [s]; NaN for a stream and a lost link."""
        feed = self._feed
        if feed is None or feed.repeats or self.state != "live" or not feed.learns:
            return math.nan
        since = self._now() - feed.received
        return since if since > MAX_STALE_DELAY else math.nan

    @property
    def notice(self) -> str:
        """What there is to say instead of fields; empty while there are some."""
        if self.problem:
            return self.problem
        if not self.opened:
            return ""
        if self.kind is None:
            return tr("Learning {type} …").format(type=self.type)
        if self.message is None:
            return tr("Nothing has come yet on {opened}.").format(opened=self.opened)
        return ""
