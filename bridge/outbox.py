"""What waits to be sent to one client, so that a slow one costs memory for one message a topic and no more."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

from msgspec import Raw

from bridge.codec import to_cbor, to_json
from bridge.msgs import Msg
from bridge.protocol import Publish, ServerSession, Subscribed, encode

__all__ = ["Frame", "Outbox", "Outgoing"]


class Frame(NamedTuple):
    """One WebSocket message, ready to be sent."""

    data: bytes
    text: bool
    """It is UTF-8 text; else it is binary."""


class Outgoing:
    """One published message; encoded when first needed and once per codec, however many clients want it."""

    __slots__ = ("_frames", "msg", "topic")

    def __init__(self, topic: str, msg: Msg) -> None:
        self.topic = topic
        self.msg = msg
        self._frames: dict[tuple[str, bool], Frame] = {}

    def frame(self, wanted: Subscribed) -> Frame:
        """The message in the form that a client wants; ProtocolError when it cannot be encoded."""
        key = (wanted.name, wanted.compression == "cbor")
        frame = self._frames.get(key)
        if frame is None:
            frame = self._frames[key] = self._encode(*key)
        return frame

    def _encode(self, name: str, binary: bool) -> Frame:
        if binary:
            return Frame(to_cbor({"op": "publish", "topic": name, "msg": self.msg}), text=False)
        return Frame(encode(Publish(topic=name, msg=Raw(to_json(self.msg)))), text=True)


class Outbox:
    """A queue for what must arrive in order, and one slot a topic for streams, where the newest wins."""

    def __init__(self, session: ServerSession, limit: int = 256) -> None:
        self._session = session
        self._limit = limit
        self._queue: deque[Frame] = deque()
        self._slots: dict[str, Outgoing] = {}
        self._sent: dict[str, float] = {}

    def put(self, frame: Frame) -> bool:
        """Queue a frame that must not be lost; False when `limit` of them wait already."""
        if len(self._queue) >= self._limit:
            return False
        self._queue.append(frame)
        return True

    def put_latest(self, message: Outgoing) -> None:
        """Offer a stream's message; one of the same topic that still waits is forgotten."""
        self._slots[message.topic] = message

    def take(self, now: float) -> Frame | None:
        """The next frame to send at `now` [s]; None when nothing is due. ProtocolError when it cannot be encoded."""
        if self._queue:
            return self._queue.popleft()
        for topic in list(self._slots):
            wanted = self._session.subscriptions.get(topic)
            if wanted is None:
                del self._slots[topic]
            elif self._due(topic, wanted) <= now:
                self._sent[topic] = now
                return self._slots.pop(topic).frame(wanted)
        return None

    def delay(self, now: float) -> float | None:
        """Seconds until the first throttled message is due; None when none waits."""
        wanted = self._session.subscriptions
        waits = [self._due(topic, wanted[topic]) - now for topic in self._slots if topic in wanted]
        return max(0.0, min(waits)) if waits else None

    def _due(self, topic: str, wanted: Subscribed) -> float:
        return self._sent.get(topic, float("-inf")) + wanted.period
