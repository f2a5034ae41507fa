"""What waits to be sent to one client, so that a slow one costs memory for a few messages a topic and no more."""

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
"""Frames that may wait in order in one lane; a client for whom more wait does not read."""
MAX_REPLIES = 4096
"""Frames that may wait in the lane of replies: all that one may have asked for is answered in one step when who answers is gone."""
MAX_BYTES = 8_388_608
"""Bytes that may wait in order in one lane."""
MAX_QUEUE_LENGTH = {2: 100, 3: 100, 4: 4}
"""How many messages of one topic may wait at most, whatever its `queue_length`, by lane."""
MAX_WAITING_BYTES = 25_165_824
"""Bytes of messages of topics that may wait, one that is larger alone; else the oldest are forgotten, samples first."""
MAX_UNCOUNTED_BYTES = 8_388_608
"""After so many bytes that came to wait all that waits is counted anew; so much more than `MAX_WAITING_BYTES` may it be before."""
MESSAGE_COST = 512
"""What a message takes beside what it holds [byte]."""
MAX_SAMPLES = 8
"""After so many samples one message of the bulk lane goes out before the next."""


class Lane(IntEnum):
    """What goes first when not everything can go."""

    CONTROL = 0
    """Answers about STOP and control."""
    REPLY = 1
    """Other answers, calls and goals to carry out, remarks."""
    EVENT = 2
    """What happens once or is latched: must arrive, and in order."""
    TELEMETRY = 3
    """Samples; the newest counts."""
    BULK = 4
    """Maps and pictures; the newest counts, and they are large."""


_WHOLE = (Lane.CONTROL, Lane.REPLY, Lane.EVENT)
_USUAL = (Lane.EVENT, Lane.TELEMETRY, Lane.BULK)
_BULK_FIRST = (Lane.EVENT, Lane.BULK, Lane.TELEMETRY)


class Stream:
    """One client's delivery of one topic."""

    __slots__ = ("due", "form", "gone", "heavy", "lane", "ordered", "period", "topic", "waiting")

    def __init__(self, topic: str, lane: Lane, wanted: Subscribed, keep: int = 1) -> None:
        """`keep` is how many messages may wait when the client does not say; 0 all, in the lane's own order."""
        self.topic = topic
        self.lane = lane
        self.due = -math.inf
        """When the next message may go out [s], the loop's clock."""
        self.gone = False
        """Nothing more is to be sent."""
        self.waiting: deque[OutgoingMessage] = deque()
        self.want(wanted, keep)

    def want(self, wanted: Subscribed, keep: int = 1) -> None:
        """What the client wants from now on."""
        self.form = Form.of(wanted)
        self.period = wanted.period
        """Shortest time between two messages [s]."""
        self.ordered = keep == 0 and wanted.period == 0 and wanted.queue == 0
        """Every message goes out, in order with those of other topics."""
        reduction = wanted.reduction
        self.heavy = reduction is not None and self.lane is Lane.BULK
        """Making less of a message takes long."""
        length = min(wanted.queue or max(1, keep), MAX_QUEUE_LENGTH[self.lane])
        self.waiting = deque(self.waiting, maxlen=length)


class PriorityLanes:
    """Queues for what must arrive in order, and for each topic a few places, where the newest wins."""

    def __init__(self) -> None:
        self._frames: tuple[deque[bytes], ...] = tuple(deque() for _ in Lane)
        self._bytes = [0] * len(Lane)
        self._streams: tuple[dict[Stream, None], ...] = tuple({} for _ in Lane)
        self._uncounted = 0
        self._passed = 0
        self.held = False
        """The next message is due and too large for what room there was when last asked."""
        self.holding = Lane.CONTROL
        """The lane of the message that is held, or was last."""

    def push(self, lane: Lane, frame: bytes) -> bool:
        """Queue a frame that must not be lost; False when too many wait in this lane already."""
        frames = self._frames[lane]
        most = MAX_REPLIES if lane is Lane.REPLY else MAX_FRAMES
        if len(frames) >= most or (frames and self._bytes[lane] + len(frame) > MAX_BYTES):
            return False
        frames.append(frame)
        self._bytes[lane] += len(frame)
        return True

    def offer(self, stream: Stream, message: OutgoingMessage) -> None:
        """Have a message wait; when its topic or all of them have no place left, the oldest is forgotten."""
        stream.waiting.append(message)
        self._streams[stream.lane][stream] = None
        self._uncounted += _cost(message)
        if self._uncounted > MAX_UNCOUNTED_BYTES:
            self._lighten(message)

    def remove(self, stream: Stream) -> None:
        """Nothing of this topic is wanted any more."""
        stream.gone = True
        stream.waiting.clear()
        self._streams[stream.lane].pop(stream, None)

    def clear(self) -> None:
        """Nothing is wanted any more."""
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
        """Whether frames wait in this lane, behind which others must stand."""
        return bool(self._frames[lane])

    def pop(self, now: float, fits: Callable[[int], bool] = lambda _: True) -> bytes | None:
        """The next frame to send at `now` [s]; None when nothing is due, or the next is `held`.

        `fits` tells whether there is room for so many bytes. ProtocolError when the next cannot be encoded.
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
        """Seconds until something is due; None when nothing waits."""
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
        """Count what waits, and forget the oldest of it, but never `newest`, until the rest is within bounds."""
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
