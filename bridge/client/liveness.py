"""What a link's other end is, and whether it still lives, judged by what comes; without I/O.

Our own servers tell their time at once, and without it no link to them counts. Others may have no rosapi: they refuse to
tell the time, or do not answer at all. There an answer to any question of ours, a message that was subscribed, or in the
end that pings are answered and nothing strange came, makes a robot of a WebSocket.
"""

from __future__ import annotations

import math

from bridge.core.address import LinkLost

__all__ = ["SILENCE_TIMEOUT", "Liveness"]

SILENCE_TIMEOUT = 3.0
"""A link on which nothing came for this long is lost [s]."""
ALERT_TIMEOUT = 1.0
"""As `SILENCE_TIMEOUT`, after the network changed or the machine slept [s]."""
LATE_AFTER = 1.0
"""When nothing came for this long, what is sent now may arrive late [s]; a link that lives brings something twice a second."""
GRACE_TIME = 1.0
"""A server that answers other questions may still tell its time, for this long from the beginning [s]."""
_TIME_QUESTION_INTERVAL = 4
"""A foreign server that tells its time is asked for it with each so many pings."""
_RARE_TIME_QUESTION_INTERVAL = 20
"""As `_TIME_QUESTION_INTERVAL`, when it does not."""


class Liveness:
    """One connection's life, from its opening on. Times are [s] on one clock that only goes forward."""

    def __init__(self, place: str, ours: bool, now: float) -> None:
        """`place` is the address as people say it; `ours` whether the other end calls itself a Pilothouse server."""
        self.ours = ours
        self.robot = False
        """The other end has shown to be a robot's server."""
        self.tells_time: bool | None = None
        """It tells its clock; None until it answered."""
        self._place = place
        self._opened = self._heard = now
        self._alert = math.inf
        self._answers = False
        self._strange = False
        self._pong = False
        self._beats = -1

    def should_ask_time(self) -> bool:
        """Count one ping; whether it is to ask for the time."""
        self._beats += 1
        if self.ours:
            return True
        if self.tells_time is None:
            return self._beats < _TIME_QUESTION_INTERVAL or self._beats % _RARE_TIME_QUESTION_INTERVAL == 0
        return (
            self._beats % (_TIME_QUESTION_INTERVAL if self.tells_time else _RARE_TIME_QUESTION_INTERVAL) == 0
        )

    def on_message(self, now: float) -> None:
        """Something came."""
        self._heard = now
        self._alert = math.inf

    def on_pong(self, now: float) -> None:
        """A WebSocket ping was answered."""
        self.on_message(now)
        self._pong = True

    @property
    def answers_pings(self) -> bool:
        """It answers pings of WebSocket."""
        return self._pong

    def on_answer(self) -> None:
        """A question of ours was answered, or something came that we subscribed."""
        self._answers = True

    def on_time(self, known: bool) -> None:
        """The question for the time was answered; `known` tells whether with a time."""
        self.tells_time = known
        self.robot = True

    def on_strange(self) -> None:
        """Something came that no robot's server sends: what is no operation, or a question that nobody may ask."""
        self._strange = True

    def alert(self, now: float) -> None:
        """The network changed or the machine slept: the link has to show soon that it lives."""
        self._alert = min(self._alert, now)

    def is_late(self, now: float) -> bool:
        """What is sent now may wait on its way."""
        return now - self._heard > LATE_AFTER

    def check(self, now: float) -> None:
        """LinkLost when it is silent, or has not shown in time to be a robot's server."""
        if now - self._heard >= SILENCE_TIMEOUT:
            raise LinkLost(f"Nothing came from {self._place} for {SILENCE_TIMEOUT:g} s.")
        if now - self._alert >= ALERT_TIMEOUT:
            raise LinkLost(f"Nothing came from {self._place} after the network changed.")
        self.robot = self.robot or self._shown(now - self._opened)
        if not self.robot and now - self._opened >= SILENCE_TIMEOUT:
            raise LinkLost(
                f"{self._place} is a WebSocket but no robot: it did not answer within {SILENCE_TIMEOUT:g} s."
            )

    def _shown(self, age: float) -> bool:
        if self.ours or self._strange:
            return False
        return (self._answers and age >= GRACE_TIME) or (self._pong and age >= SILENCE_TIMEOUT)
