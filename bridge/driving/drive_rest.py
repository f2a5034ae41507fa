"""Zero speed after the last drive command to a server of another maker, which does not let commands expire."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

import msgspec

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.msgs.std_msgs import Time

__all__ = ["CHECK_PERIOD", "MAX_LAST_TRIES", "SILENCE_TIMEOUT", "DriveRest"]

SILENCE_TIMEOUT = 0.25
"""A drive command counts for so long [s], as on a robot side of ours; then zero is sent."""
CHECK_PERIOD = 0.05
"""Time between two checks while a robot is driven, and between two tries of what could not be sent [s]."""
MAX_LAST_TRIES = 5
"""At the end zero is tried so often: for 0.2 s."""


class DriveRest:
    """Remembers what drives a robot, and brings that to rest when nothing follows."""

    def __init__(self, publish: Callable[[str, Msg], bool], now: Callable[[], float]) -> None:
        """`publish(topic, msg)` sends zero at once and returns whether it did; `now` is a clock [s] that only goes forward."""
        self._publish = publish
        self._now = now
        self._last: dict[str, tuple[Twist | TwistStamped, float]] = {}
        self._driven = asyncio.Event()

    def note(self, topic: str, msg: Msg) -> None:
        """Note a drive command that was sent; zero ends what was before it, and other messages are no commands."""
        if not isinstance(msg, (Twist, TwistStamped)):
            return
        if msg == _zero(msg, 0.0):
            self._last.pop(topic, None)
        else:
            self._last[topic] = msg, self._now()
            self._driven.set()

    async def end(self) -> bool:
        """Send zero on each topic that was driven last with another speed; False when one could not be sent for 0.2 s."""
        for tries_left in reversed(range(MAX_LAST_TRIES)):
            for topic in list(self._last):
                self._rest(topic)
            if not self._last or not tries_left:
                break
            await asyncio.sleep(CHECK_PERIOD)
        return not self._last

    def check(self) -> None:
        """Send zero where nothing was sent for `SILENCE_TIMEOUT`; what could not be sent is tried again at the next check."""
        for topic, (_, sent) in list(self._last.items()):
            if self._now() - sent >= SILENCE_TIMEOUT:
                self._rest(topic)

    def forget(self) -> None:
        """The connection is gone, and nothing can be sent on it."""
        self._last.clear()

    async def run(self) -> None:
        """Check for as long as something is driven; never returns."""
        while True:
            await self._driven.wait()
            while self._last:
                await asyncio.sleep(CHECK_PERIOD)
                self.check()
            self._driven.clear()

    def _rest(self, topic: str) -> None:
        msg, sent = self._last[topic]
        if self._publish(topic, _zero(msg, self._now() - sent)):
            del self._last[topic]


def _zero(msg: Twist | TwistStamped, passed: float) -> Twist | TwistStamped:
    """Zero speed in the form of `msg`, stamped `passed` [s] later."""
    if isinstance(msg, Twist):
        return Twist()
    stamp = Time.at(msg.header.stamp.seconds + passed) if passed else msg.header.stamp
    return TwistStamped(msgspec.structs.replace(msg.header, stamp=stamp))
