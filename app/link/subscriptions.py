"""Which of the robot's topics the link listens to, the one that somebody looks at field by field, and those that are watched.

Everything here lives in the network thread.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Mapping
from dataclasses import dataclass
from typing import Any

from app.link.capabilities import CAMERA, POSE, Capabilities
from bridge.client.client import BridgeClient
from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.core.topics import TOPICS, Topic
from bridge.msgs import TYPES, Msg, ros1_name
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import CompressedImage
from widgets.core.language import tr

__all__ = ["MAX_WATCHED", "Peek", "Seen", "Sources", "Watches"]

UNUSED = ("/tf", "/diagnostics", "/bumper")
"""Topics that no screen shows."""
MIN_INTERVAL = 50
"""No stream is asked for more often than this [ms]: the eye sees no more."""
SLOW_INTERVALS = {"/line_sensor": 100, "/joint_states": 100}
"""Streams that are shown as figures, with the time between two that can be read [ms]."""
CBOR_TYPES = (
    "sensor_msgs/LaserScan",
    "nav_msgs/OccupancyGrid",
    "sensor_msgs/CompressedImage",
    "sensor_msgs/Image",
    "sensor_msgs/PointCloud2",
)
"""Types whose numbers travel as CBOR; the real servers lose others in it."""
INFINITE_TYPES = ("sensor_msgs/Range",)
"""Types with an infinity that means something, which JSON cannot say: as CBOR, from a robot of ours."""

MAX_WATCHED = 64
"""Topics that are listened to at once, beside those that every screen shows."""

Deliver = Callable[[str, Msg, float], object]
"""Takes our name of a topic, the message, and when it came [s], our clock."""


class Sources:
    """The subscriptions of everything that the screens show, under our names whatever the robot's are."""

    def __init__(self, client: BridgeClient, deliver: Deliver, event: Callable[[Any, float], object]) -> None:
        """`event` takes what is told once each."""
        self._client, self._deliver, self._event = client, deliver, event
        self._ends: dict[str, tuple[str, Callable[[], None]]] = {}
        self._offer: Capabilities | None = None
        self._on_demand: set[str] = set()
        """Topics that the robot makes only while somebody looks, of those that are looked at now."""

    def want(self, topic: str, wanted: bool) -> None:
        """Listen to an on-demand topic of the table, where the robot has it, or no longer."""
        (self._on_demand.add if wanted else self._on_demand.discard)(topic)
        self.follow(self._offer)

    def follow(self, offer: Capabilities | None) -> None:
        """Listen to what the robot offers; None, while that is not known, to the usual names."""
        self._offer = offer
        for entry in TOPICS:
            if entry.to != "handheld" or entry.name in UNUSED:
                continue
            wanted = self._wanted(entry)
            name, end = self._ends.get(entry.name, (None, None))
            if wanted == name:
                continue
            if end is not None:
                del self._ends[entry.name]
                end()
            if wanted is not None:
                self._ends[entry.name] = (wanted, self._subscribe(entry, wanted))

    def _wanted(self, entry: Topic) -> str | None:
        """The robot's name of a topic that is listened to; None for one that is not."""
        offer = self._offer
        if not entry.on_demand:
            return entry.name if offer is None else offer.source(entry.name)
        looked_at = entry.name in self._on_demand and offer is not None and entry.name in offer.topics
        return entry.name if looked_at else None

    def _subscribe(self, entry: Topic, name: str) -> Callable[[], None]:
        if entry.once:
            return self._client.subscribe(name, entry.type, self._on_event, queue_length=100)
        fast = entry.rate * MIN_INTERVAL > 1000
        return self._client.subscribe(
            name,
            entry.type,
            lambda message, received: self._hear(entry.name, message, received),
            throttle_rate=SLOW_INTERVALS.get(entry.name, MIN_INTERVAL if fast else 0),
            compression="cbor"
            if entry.type.MSGTYPE in (INFINITE_TYPES if self._ours else ()) + CBOR_TYPES
            else "none",
        )

    def _on_event(self, event: Any, received: float) -> None:
        self._event(event, received)
        if event.code == Code.PAYLOAD_SWITCHED:
            asyncio.get_running_loop().call_soon(self._renew)

    def _renew(self) -> None:
        """Ask again for what was refused while its payload was off; events go on, so that none is missed."""
        for entry in TOPICS:
            if not entry.once and entry.name in self._ends:
                self._ends.pop(entry.name)[1]()
        self.follow(self._offer)

    @property
    def _ours(self) -> bool:
        return self._offer is None or self._offer.ours

    def _hear(self, name: str, message: Msg, received: float) -> None:
        self._deliver(name, message, received)
        if isinstance(message, Odometry) and self._offer is not None and self._offer.pose_by_odometry:
            self._deliver(POSE, PoseWithCovarianceStamped(message.header, message.pose), received)

    def camera(self, show: Callable[[CompressedImage, float], object]) -> Callable[[], None] | None:
        """Listen to the pictures of a camera without a socket of its own; None when the robot has no such topic."""
        name = CAMERA if self._offer is None else self._offer.source(CAMERA)
        if name is None:
            return None
        return self._client.subscribe(
            name, CompressedImage, show, compression="none" if self._ours else "cbor"
        )


@dataclass(frozen=True, slots=True)
class Seen:
    """What came of the topic that is looked at."""

    topic: str
    message: Msg | None = None
    """None with a `kind` or a `problem`."""
    kind: type[Msg] | None = None
    """Class of what will come; told once, before the first message."""
    problem: str = ""
    """Why nothing can be shown, in one sentence."""


class Peek:
    """One topic of the robot, listened to for as long as somebody looks at it."""

    def __init__(self, client: BridgeClient, tell: Callable[[Seen, float], object]) -> None:
        """`tell` takes what came and when [s], our clock; NaN for what is no message."""
        self._client, self._tell = client, tell
        self._topic = ""
        self._end: Callable[[], None] | None = None

    async def open(self, topic: str, type_name: str) -> None:
        """Learn the type, where it is not known, and listen; what was listened to before ends."""
        self.close()
        self._topic = topic
        name = ros1_name(type_name)
        try:
            kind = TYPES.get(name) or await self._client.learn(name)
        except BridgeError as error:
            if self._topic == topic:
                sentence = tr(
                    "{name} cannot be shown: this app does not know it, and learning it failed. {error}"
                ).format(name=name, error=error)
                self._tell(Seen(topic, problem=sentence), float("nan"))
            return
        if self._topic != topic or self._end is not None:
            return
        self._tell(Seen(topic, kind=kind), float("nan"))
        self._end = self._client.subscribe(
            topic,
            kind,
            lambda message, received: self._tell(Seen(topic, message), received),
            throttle_rate=MIN_INTERVAL,
            compression="cbor" if name in CBOR_TYPES else "none",
        )

    def close(self) -> None:
        """Listen no longer."""
        self._topic = ""
        if self._end is not None:
            end, self._end = self._end, None
            end()


class Watches:
    """Who looks at what, and one `Peek` for each topic that anybody looks at."""

    def __init__(
        self,
        client: BridgeClient,
        tell: Callable[[Seen, float], object],
        spawn: Callable[[Coroutine[Any, Any, None]], object],
        hop: Callable[..., object],
    ) -> None:
        """`tell` takes what came and when [s], as that of `Peek`; `spawn` runs a coroutine in the network thread, `hop` calls there."""
        self._client, self._tell, self._spawn, self._hop = client, tell, spawn, hop
        self._wanted: dict[str, dict[str, str]] = {}
        """Who looks, to the topics and their types."""
        self._peeks: dict[str, tuple[str, Peek]] = {}
        self._failed: set[str] = set()

    # in any thread

    def look(self, who: str, topics: Mapping[str, str]) -> None:
        """`who` looks at these topics from now on, each with the name of its type, and at no others; nothing, to look away.

        What is seen comes by the channel `watched(topic)`. What anybody else looks at is listened to on; beyond
        `MAX_WATCHED` a topic is told as a problem.
        """
        self._hop(self._want, who, dict(topics))

    # in the network thread

    def _want(self, who: str, topics: dict[str, str]) -> None:
        if topics:
            self._wanted[who] = topics
        else:
            self._wanted.pop(who, None)
        self._follow()

    def renew(self) -> None:
        """Begin anew what failed: the robot may know by now what it did not before."""
        for topic in self._failed & set(self._peeks):
            self._peeks.pop(topic)[1].close()
        self._failed.clear()
        self._follow()

    def _follow(self) -> None:
        wanted: dict[str, str] = {}
        for topics in self._wanted.values():
            wanted.update(topics)
        for topic in [one for one, (kind, _) in self._peeks.items() if wanted.get(one) != kind]:
            self._peeks.pop(topic)[1].close()
            self._failed.discard(topic)
        for topic, kind in wanted.items():
            if topic in self._peeks:
                continue
            if len(self._peeks) >= MAX_WATCHED:
                words = tr("{count} topics are shown already; take one away to see {topic}.")
                sentence = words.format(count=MAX_WATCHED, topic=topic)
                self._tell(Seen(topic, problem=sentence), float("nan"))
                continue
            peek = Peek(self._client, self._take)
            self._peeks[topic] = kind, peek
            self._spawn(peek.open(topic, kind))

    def _take(self, seen: Seen, received: float) -> None:
        if seen.problem:
            self._failed.add(seen.topic)
        self._tell(seen, received)
