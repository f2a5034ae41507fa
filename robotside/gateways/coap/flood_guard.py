"""Limits on datagrams: how many are heard of each source and of all, and how much is sent to an address that may be forged.

Pure: every call is told the time [s], of a clock that only goes forward.
"""

from __future__ import annotations

from collections import OrderedDict

from bridge.server.reception.reception import neighbourhood
from robotside.trust.trust import is_own_machine

__all__ = ["FloodGuard", "TokenBucket"]

MAX_SOURCES = 256
"""Sources that are told apart; of more, those that were not heard for longest are forgotten."""
SOURCE_RATE, SOURCE_BURST = 150.0, 300.0
"""Datagrams of one source that are heard [Hz], and at once."""
ALL_RATE, ALL_BURST = 200.0, 400.0
"""Datagrams of all sources; each request is remembered for a while, so that one that comes twice is carried out once."""
STOP_RATE, STOP_BURST = 50.0, 100.0
"""Presses of STOP, which nothing else takes room from."""
ANSWER_RATE, ANSWER_BURST = 65_536.0, 262_144.0
"""Bytes that are sent to another machine or its network [byte/s], and at once: its address may be somebody else's."""


class TokenBucket:
    """So many units at once and so many a second afterwards."""

    __slots__ = ("_at", "_burst", "_left", "_rate")

    def __init__(self, rate: float, burst: float, now: float) -> None:
        self._rate, self._burst = rate, burst
        self._left, self._at = burst, now

    def take(self, now: float, units: float = 1.0) -> bool:
        """Take `units` if they are there."""
        self._left = min(self._burst, self._left + (now - self._at) * self._rate)
        self._at = now
        if self._left < units:
            return False
        self._left -= units
        return True


class FloodGuard:
    """Decides which datagrams are heard, and whether an answer is sent."""

    def __init__(self, now: float) -> None:
        self._all = TokenBucket(ALL_RATE, ALL_BURST, now)
        self._stop = TokenBucket(STOP_RATE, STOP_BURST, now)
        self._sources: OrderedDict[str, TokenBucket] = OrderedDict()
        self._answers: OrderedDict[str, TokenBucket] = OrderedDict()

    def hears(self, host: str, port: int, now: float) -> bool:
        """Whether a datagram from there is heard."""
        # on this machine nobody forges a port, and elsewhere anybody has all of them
        source = f"{host}:{port}" if is_own_machine(host) else neighbourhood(host)
        bucket = _bucket(self._sources, source, SOURCE_RATE, SOURCE_BURST, now)
        return bucket.take(now) and self._all.take(now)

    def hears_stop(self, now: float) -> bool:
        """Whether a press of STOP is heard."""
        return self._stop.take(now)

    def sends(self, host: str, size: int, now: float) -> bool:
        """Whether `size` bytes are sent there."""
        if is_own_machine(host):
            return True
        bucket = _bucket(self._answers, neighbourhood(host), ANSWER_RATE, ANSWER_BURST, now)
        return bucket.take(now, size)


def _bucket(
    known: OrderedDict[str, TokenBucket], key: str, rate: float, burst: float, now: float
) -> TokenBucket:
    bucket = known.get(key)
    if bucket is None:
        bucket = known[key] = TokenBucket(rate, burst, now)
        if len(known) > MAX_SOURCES:
            known.popitem(last=False)
    else:
        known.move_to_end(key)
    return bucket
