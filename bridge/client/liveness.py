"""Liveness of a link, and whether its other end is a robot, judged by what is received; without I/O.

Our own servers report their time at once, and a link to them counts only with it. Foreign servers may have no rosapi:
they refuse to report the time, or do not answer. There an answer to any question, a message of a subscription, or in
the end pongs without anything strange, prove that the WebSocket belongs to a robot.
"""

from __future__ import annotations

import math

from bridge.core.address import LinkLost

__all__ = ["SILENCE_TIMEOUT", "Liveness"]

SILENCE_TIMEOUT = 3.0
"""A link on which nothing was received for this long is lost [s]."""
ALERT_TIMEOUT = 1.0
"""As `SILENCE_TIMEOUT`, after the network changed or the machine slept [s]."""
LATE_AFTER = 1.0
"""When nothing was received for this long, a message that is sent now may arrive late [s]; a live link brings
something twice a second."""
GRACE_TIME = 1.0
"""A foreign server may report its time this long after the connection, although it answers other questions [s]."""
_TIME_QUESTION_INTERVAL = 4
"""Pings between two questions for the time to a foreign server that reports it."""
_RARE_TIME_QUESTION_INTERVAL = 20
"""As `_TIME_QUESTION_INTERVAL`, for a server that does not."""


class Liveness:
    """The life of one connection. Times are [s] on one clock that only goes forward."""

    def __init__(self, place: str, ours: bool, now: float) -> None:
        """`place` is the address as people say it; `ours` whether the other end identifies itself as a Pilothouse
        server."""
        self.ours = ours
        self.robot = False
        """Whether the other end has proved to be a robot's server."""
        self.tells_time: bool | None = None
        """Whether it reports its clock; None until it answered."""
        self._place = place
        self._opened = self._heard = now
        self._alert = math.inf
        self._answers = False
        self._strange = False
        self._pong = False
        self._beats = -1

    def should_ask_time(self) -> bool:
        """Count one ping; whether it should ask for the time."""
        self._beats += 1
        if self.ours:
            return True
        if self.tells_time is None:
            return self._beats < _TIME_QUESTION_INTERVAL or self._beats % _RARE_TIME_QUESTION_INTERVAL == 0
        return (
            self._beats % (_TIME_QUESTION_INTERVAL if self.tells_time else _RARE_TIME_QUESTION_INTERVAL) == 0
        )

    def on_message(self, now: float) -> None:
        """Note that something was received."""
        self._heard = now
        self._alert = math.inf

    def on_pong(self, now: float) -> None:
        """Note that a WebSocket ping was answered."""
        self.on_message(now)
        self._pong = True

    @property
    def answers_pings(self) -> bool:
        """Whether the other end answers WebSocket pings."""
        return self._pong

    def on_answer(self) -> None:
        """Note an answer to a question of ours, or a message of a subscription."""
        self._answers = True

    def on_time(self, known: bool) -> None:
        """Note an answer to the question for the time; `known` is False when it has no time."""
        self.tells_time = known
        self.robot = True

    def on_strange(self) -> None:
        """Note something that no robot's server sends: not an operation, or a request to a client that serves none."""
        self._strange = True

    def alert(self, now: float) -> None:
        """Note that the network changed or the machine slept: the link must show soon that it lives."""
        self._alert = min(self._alert, now)

    def is_late(self, now: float) -> bool:
        """Whether a message that is sent now may wait on its way."""
        return now - self._heard > LATE_AFTER

    def check(self, now: float) -> None:
        """Raise LinkLost when the link is silent, or its other end did not prove in time to be a robot's server."""
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
