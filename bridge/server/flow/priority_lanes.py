"""Priority lanes of one client's waiting messages, so that a slow one costs memory for a few messages per topic and
no more."""

from __future__ import annotations

import heapq
import math
from collections import deque
from collections.abc import Callable
from enum import IntEnum

from bridge.protocol import Subscribed
from bridge.server.flow.outgoing_messages import Form, OutgoingMessage

__all__ = ["MAX_BYTES", "MAX_FRAMES", "Lane", "PriorityLanes", "Stream"]

MAX_FRAMES = 256
"""Most frames that may wait in one ordered lane; a client with more does not read."""
MAX_REPLIES = 4096
"""Most frames in the lane of replies: a client may have asked so much of another one that it is all answered in one
step when that leaves."""
MAX_BYTES = 8_388_608
"""Most bytes that may wait in one ordered lane."""
MAX_QUEUE_LENGTH = {2: 100, 3: 100, 4: 4}
"""Most messages of one topic that may wait, by lane, whatever its `queue_length`."""
MAX_WAITING_BYTES = 25_165_824
"""Most bytes of topics' messages that may wait, except for one that is larger alone; then the oldest are dropped,
samples first."""
MAX_UNCOUNTED_BYTES = 8_388_608
"""The waiting bytes are counted anew after so many more came; they may exceed `MAX_WAITING_BYTES` by as many until
then."""
MESSAGE_COST = 512
"""Memory of a message beside its content [byte]."""
MAX_SAMPLES = 8
"""After so many samples one message of the bulk lane is sent before the next."""


class Lane(IntEnum):
    """The order of sending when not everything can be sent."""

    CONTROL = 0
    """Responses about STOP and control."""
    REPLY = 1
    """Other responses, calls and goals to carry out, remarks."""
    EVENT = 2
    """Messages that happen once or are latched: all must arrive, in order."""
    TELEMETRY = 3
    """Samples; only the newest counts."""
    BULK = 4
    """Maps and pictures; only the newest counts, and they are large."""


_WHOLE = (Lane.CONTROL, Lane.REPLY, Lane.EVENT)
_USUAL = (Lane.EVENT, Lane.TELEMETRY, Lane.BULK)
_BULK_FIRST = (Lane.EVENT, Lane.BULK, Lane.TELEMETRY)


class Stream:
    """The delivery of one topic to one client."""

    __slots__ = ("due", "form", "gone", "heavy", "lane", "ordered", "period", "topic", "waiting")

    def __init__(self, topic: str, lane: Lane, wanted: Subscribed, keep: int = 1) -> None:
        """`keep` is how many messages may wait when the client gives neither a number nor a period; 0 for all, in the order
        of the lane. With a period alone the newest counts."""
        self.topic = topic
        self.lane = lane
        self.due = -math.inf
        """Earliest time of the next message [s], the loop's clock."""
        self.gone = False
        """Whether the subscription has ended."""
        self.waiting: deque[OutgoingMessage] = deque()
        self.want(wanted, keep)

    def want(self, wanted: Subscribed, keep: int = 1) -> None:
        """Change the form in which the client wants the topic."""
        self.form = Form.of(wanted)
        self.period = wanted.period
        """Shortest time between two messages [s]."""
        self.ordered = keep == 0 and wanted.period == 0 and wanted.queue == 0
        """Whether every message is sent, in order with those of other topics."""
        reduction = wanted.reduction
        self.heavy = reduction is not None and self.lane is Lane.BULK
        """Whether its messages take long to reduce."""
        usual = 1 if wanted.period else max(1, keep)  # a backlog sent at a slow rate is all old
        length = min(wanted.queue or usual, MAX_QUEUE_LENGTH[self.lane])
        self.waiting = deque(self.waiting, maxlen=length)


class PriorityLanes:
    """Queues for frames that must arrive in order, and a few places per topic, where the newest message wins."""

    def __init__(self) -> None:
        self._frames: tuple[deque[bytes], ...] = tuple(deque() for _ in Lane)
        self._bytes = [0] * len(Lane)
        self._streams: tuple[dict[Stream, None], ...] = tuple({} for _ in Lane)
        self._uncounted = 0
        self._passed = 0
        self.held = False
        """Whether the next message is due and was too large for the room at the last call."""
        self.holding = Lane.CONTROL
        """Lane of the message that is held, or was last."""

    def push(self, lane: Lane, frame: bytes) -> bool:
        """Queue a frame that must not be lost; False when this lane is full."""
        frames = self._frames[lane]
        most = MAX_REPLIES if lane is Lane.REPLY else MAX_FRAMES
        if len(frames) >= most or (frames and self._bytes[lane] + len(frame) > MAX_BYTES):
            return False
        frames.append(frame)
        self._bytes[lane] += len(frame)
        return True

    def offer(self, stream: Stream, message: OutgoingMessage) -> None:
        """Queue a message of a topic; when there is no place left, the oldest is dropped."""
        stream.waiting.append(message)
        self._streams[stream.lane][stream] = None
        self._uncounted += _cost(message)
        if self._uncounted > MAX_UNCOUNTED_BYTES:
            self._lighten(message)

    def remove(self, stream: Stream) -> None:
        """Drop all messages of a topic that is no longer wanted."""
        stream.gone = True
        stream.waiting.clear()
        self._streams[stream.lane].pop(stream, None)

    def clear(self) -> None:
        """Drop everything."""
        self.held = False
        self._bytes = [0] * len(Lane)
        for frames in self._frames:
            frames.clear()
        for streams in self._streams:
            for stream in streams:
                stream.gone = True
                stream.waiting.clear()
            streams.clear()

    def is_blocked(self, lane: Lane) -> bool:
        """Whether frames wait in this lane, so that others must queue behind them."""
        return bool(self._frames[lane])

    def pop(self, now: float, fits: Callable[[int], bool] = lambda _: True) -> bytes | None:
        """The next frame to send at `now` [s]; None when nothing is due, or the next is `held`.

        `fits` returns whether there is room for so many bytes. ProtocolError when the next cannot be encoded.
        """
        self.held = False
        for lane in _WHOLE:
            frames = self._frames[lane]
            if frames:
                if not fits(len(frames[0])):
                    self.held, self.holding = True, lane
                    return None
                self._bytes[lane] -= len(frames[0])
                return frames.popleft()
        order = _USUAL if self._passed < MAX_SAMPLES else _BULK_FIRST
        for lane in order:
            for stream in self._streams[lane]:
                if stream.due <= now:
                    return self._next(stream, now, fits)
        return None

    def delay(self, now: float) -> float | None:
        """Time until something is due [s]; None when nothing waits."""
        if any(self._frames):
            return 0.0
        dues = [stream.due for streams in self._streams for stream in streams]
        return max(0.0, min(dues) - now) if dues else None

    def _next(self, stream: Stream, now: float, fits: Callable[[int], bool]) -> bytes | None:
        try:
            frame = stream.waiting[0].frame(stream.form)
            self.held, self.holding = not fits(len(frame)), stream.lane
        finally:
            if not self.held:
                self._sent(stream, now)
        return None if self.held else frame

    def _lighten(self, newest: OutgoingMessage) -> None:
        """Count the waiting bytes, and drop the oldest messages, but never `newest`, until they are within bounds."""
        self._uncounted = 0
        held = sum(
            _cost(message) for streams in self._streams for each in streams for message in each.waiting
        )
        for lane in (Lane.TELEMETRY, Lane.BULK, Lane.EVENT):
            if held <= MAX_WAITING_BYTES:
                return
            streams = self._streams[lane]
            oldest = [(each.waiting[0].number, place, each) for place, each in enumerate(streams)]
            heapq.heapify(oldest)
            while held > MAX_WAITING_BYTES and oldest:
                _, place, stream = oldest[0]
                if stream.waiting[0] is newest:
                    heapq.heappop(oldest)
                    continue
                held -= _cost(stream.waiting.popleft())
                if stream.waiting:
                    heapq.heapreplace(oldest, (stream.waiting[0].number, place, stream))
                else:
                    heapq.heappop(oldest)
                    del streams[stream]

    def _sent(self, stream: Stream, now: float) -> None:
        stream.waiting.popleft()
        streams = self._streams[stream.lane]
        del streams[stream]
        if stream.waiting:
            streams[stream] = None
        stream.due = now + stream.period
        passed = stream.lane is Lane.TELEMETRY and bool(self._streams[Lane.BULK])
        self._passed = self._passed + 1 if passed else 0


def _cost(message: OutgoingMessage) -> int:
    return message.size + MESSAGE_COST
