"""Picture quality for one camera watcher: level and rate, judged by the time that acknowledgements take.

The acknowledgement of a picture takes the round trip (`base`), the time of its bytes on the link, and the time that
it waits behind others. Only the last two can be changed here, so `base` is subtracted: it is the least latency of
late, and it is trusted only once pictures of the coarsest level went through, whose bytes hardly count. The excess
decides the pause before the next picture (the link is kept about four fifths busy, so that nothing queues) and the
level: coarser when most recent pictures took too long, or one far too long; finer after a while in which finer ones
would mostly have fitted, and later after each failure. A single late one means little: the watcher was busy, and a
coarser picture would have waited just as long.

Pure: every call gets the time [s] of one and the same clock.
"""

from __future__ import annotations

import math
from collections import deque
from statistics import median
from typing import NamedTuple

__all__ = ["COARSEST", "LEVELS", "PictureQuality"]

LEVELS = 4
"""Number of levels. Level 0 is the picture as it was taken; each next one has a fraction of its size."""
COARSEST = LEVELS - 1

SLOW_LATENCY = 0.12
"""Pictures that take longer than this beyond the round trip are too large for the link [s]."""
VERY_SLOW_LATENCY = 0.3
"""One picture that takes longer than this beyond the round trip is proof enough [s]."""
RECENT_COUNT = 5
"""Pictures of a level by which it is judged, by their median."""
FAST_LATENCY = 0.07
"""A finer level is tried when its pictures would take less than this beyond the round trip [s]."""
MAX_PAUSE = 0.5
"""Longest time between two pictures, on the slowest link [s]."""
MAX_LOAD = 0.8
"""Fraction of the link's time that pictures may take."""
GOOD_TIME = (2.0, 60.0)
"""Time without a slow picture before a finer level is tried: at first, and at most after failures [s]."""
MAX_UNACKNOWLEDGED = (2, 8)
"""Most unacknowledged pictures: on a short link, and on the longest."""
FRAME_PERIOD = 1 / 15
"""Typical time between two pictures of a camera [s], for the number of pictures on a long link."""


class _Sent(NamedTuple):
    seq: int
    level: int
    at: float
    same: bool = False
    """A header alone: the same picture as before, whose bytes are at the watcher already."""


class PictureQuality:
    """The quality for one watcher; starts with the best pictures."""

    def __init__(self, coarsest: int = COARSEST) -> None:
        """`coarsest` is the highest level that can be made; 0 where there is only the original."""
        self._coarsest = coarsest
        self.level = 0
        """Level of the next picture, 0 to the coarsest."""
        self.pause = 0.0
        """Least time between two pictures now [s]."""
        self.base = 0.0
        """Round-trip time [s]; 0 until it is known."""
        self._under_way: deque[_Sent] = deque()
        self._sizes = [math.nan] * LEVELS
        self._last = -math.inf
        self._bases: deque[float] = deque(maxlen=64)
        self._excesses: deque[float] = deque(maxlen=RECENT_COUNT)
        self._good_since = math.inf
        self._good_time = GOOD_TIME[0]
        self._climbed = -math.inf

    def delay(self, now: float) -> float | None:
        """Time to wait before the next picture [s]; 0 for none, None until one is acknowledged."""
        if len(self._under_way) >= self._max_unacknowledged(now):
            return None
        return max(0.0, self._last + self.pause - now)

    def on_sent(self, seq: int, size: int, level: int, now: float) -> None:
        """Note that picture number `seq` of `size` bytes was sent at `level`."""
        self._under_way.append(_Sent(seq, level, now))
        self._sizes[level] = size
        self._last = now

    def on_same_sent(self, seq: int, level: int, now: float) -> None:
        """Note that picture number `seq` went out as a header alone, as the same as one sent at `level`."""
        self._under_way.append(_Sent(seq, level, now, same=True))
        self._last = now

    def on_ack(self, seq: int, now: float) -> bool:
        """Note the acknowledgement of picture `seq` and all before it; False, and no change, when it is not under way."""
        if all(sent.seq != seq for sent in self._under_way):
            return False
        while True:
            sent = self._under_way.popleft()
            if sent.seq == seq:
                break
        self._judge(sent, now - sent.at, now)
        return True

    def _max_unacknowledged(self, now: float) -> int:
        fewest, most = MAX_UNACKNOWLEDGED
        if self._under_way and now - self._under_way[0].at > self.base + SLOW_LATENCY:
            return fewest
        return max(fewest, min(most, 1 + math.ceil(self.base / FRAME_PERIOD)))

    def _judge(self, sent: _Sent, latency: float, now: float) -> None:
        if sent.same or sent.level == COARSEST:
            self._bases.append(latency)
            self.base = min(self._bases)
        else:
            self.base = min(self.base, latency)
        excess = latency - self.base
        wanted = min(MAX_PAUSE, excess / MAX_LOAD)
        self.pause = wanted if wanted > self.pause else (self.pause + wanted) / 2
        if sent.level != self.level:
            return  # says nothing about the level that is sent now
        if sent.same:
            self._finer(now)  # nothing moves, so a finer picture that comes late holds up no other
            return
        self._excesses.append(excess)
        usual = median([*self._excesses, *[0.0] * (RECENT_COUNT - len(self._excesses))])
        if usual > SLOW_LATENCY or excess > VERY_SLOW_LATENCY:
            self._coarser(now)
        elif self._finer_would_take(usual) < FAST_LATENCY:
            self._finer(now)
        else:
            self._good_since = math.inf

    def _finer_would_take(self, excess: float) -> float:
        """Latency of the finer level beyond the round trip [s], by the sizes seen so far, or three times the bytes."""
        ratio = self._sizes[self.level - 1] / self._sizes[self.level] if self.level else 1.0
        return excess * (ratio if ratio >= 1.0 else 3.0)

    def _coarser(self, now: float) -> None:
        self._good_since = math.inf
        if self.level == self._coarsest:
            return
        self._excesses.clear()
        if now - self._climbed < 2.0 * self._good_time:
            self._good_time = min(GOOD_TIME[1], 2.0 * self._good_time)
        else:
            self._good_time = GOOD_TIME[0]
        self.level += 1

    def _finer(self, now: float) -> None:
        self._good_since = min(self._good_since, now)
        if self.level and now - self._good_since >= self._good_time:
            self.level -= 1
            self._excesses.clear()
            self._climbed, self._good_since = now, math.inf
