"""The one drive command that is wanted now, a twist or a manoeuvre: newest wins, and silence of anybody means rest.

Nothing here knows a socket: the link asks `DriveSlot.due` what to send.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable

import msgspec

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.std_msgs import Header, Time
from widgets.core.language import tr

__all__ = ["Drive", "DriveSlot", "stamped_at"]

Drive = Twist | Manoeuvre
"""What a robot is driven by: a manoeuvre of the kind `steer`, `tilt` or `twist` where a twist does not say it."""

SEND_PERIOD = 0.05
"""Between two drive commands while the stick is held [s]."""
HEARTBEAT_TIMEOUT = 0.15
"""A user interface silent for longer steers nothing [s]."""
REARM_DELAY = 1.0
"""After a longer silence of the user interface the stick must be pushed anew [s]."""
LATCHED_PERIOD = 0.1
"""Between two commands to rest while the slot is latched [s]."""
REST_REPEATS = 3
"""How often the command to rest is said after the stick is let go."""
KINDS = ("twist", "steer", "tilt")
"""Of manoeuvres that are streams; whatever lasts is a task."""

_ZERO = Twist()
_INSTANT = 0.001
"""Later than the last moment of a heartbeat it is over, whatever the clock rounds [s]."""


def _is_finite(order: Drive) -> bool:
    """Every number is one; speed and throttle of a manoeuvre may be NaN, which leaves them open."""
    twist = order if isinstance(order, Twist) else order.twist
    values = [value for part in (twist.linear, twist.angular) for value in (part.x, part.y, part.z)]
    if isinstance(order, Manoeuvre):
        values += [order.steering, order.roll, order.pitch]
        if math.isinf(order.speed) or math.isinf(order.throttle):
            return False
    return all(map(math.isfinite, values))


def _alike(one: Drive, other: Drive) -> bool:
    """Command the same; NaN is like NaN."""
    return one == other or (type(one) is type(other) and repr(one) == repr(other))


def stamped_at(order: Manoeuvre, now: float) -> Manoeuvre:
    """A manoeuvre as it goes to the robot; `now` is its clock [s], NaN while that is not known."""
    stamp = Time.at(now) if math.isfinite(now) else Time()
    return msgspec.structs.replace(order, header=Header(stamp, "map"))


class DriveSlot:
    """The one wanted command. Rest is a twist of nothing but zeros, whatever was wanted before."""

    def __init__(self, now: Callable[[], float]) -> None:
        """`now` is our monotonic clock [s]."""
        self._now = now
        self._lock = threading.Lock()
        self._wanted: Drive = _ZERO
        self._beat = -math.inf
        self._last_sent: Drive = _ZERO
        self._sent_at = -math.inf
        self._zeros = 0
        self._latched = False
        self._voided = 0
        self._held = False
        """A push was dropped, and the hand that pushed has not come to rest since."""
        self._drove = False
        """Something else than rest was sent, over this link or one before."""
        self._unheard = False
        """The robot may not have heard that the last push was let go."""

    @property
    def voided(self) -> int:
        """How often a wish to move was dropped though nobody let go: what pushed is to spring back, and is pushed anew."""
        return self._voided

    def _void(self) -> None:
        if self._wanted != _ZERO:
            self._wanted, self._voided, self._held = _ZERO, self._voided + 1, True

    @property
    def latched(self) -> bool:
        """Nothing but rest is sent, again and again."""
        return self._latched

    def latch(self, on: bool) -> None:
        """Send rest at once and ten times a second whatever anybody wants, or end that; from any thread.

        It is how a robot without a STOP of its own is stopped. Afterwards the stick must be pushed anew.
        """
        with self._lock:
            self._latched = on
            self._void()
            if on:
                self._sent_at = -math.inf

    def want(self, order: Drive) -> None:
        """Set the command to drive by, from any thread; one that is not finite means rest.

        ValueError for a manoeuvre that is no drive command.
        """
        self._check(order)
        with self._lock:
            self._wanted = order if _is_finite(order) else _ZERO
            if order == _ZERO:
                self._held = False

    def amend(self, order: Drive) -> None:
        """Drive so instead of what is wanted, from any thread; rest stays rest until the stick is pushed anew.

        ValueError as with `want`.
        """
        self._check(order)
        with self._lock:
            if self._wanted != _ZERO and self._now() - self._beat <= REARM_DELAY:
                self._wanted = order if _is_finite(order) else _ZERO

    @staticmethod
    def _check(order: Drive) -> None:
        if isinstance(order, Manoeuvre) and order.kind not in KINDS:
            raise ValueError(
                tr("A robot is driven by {kinds}, not by the manoeuvre {kind!r}.").format(
                    kinds=", ".join(KINDS), kind=order.kind
                )
            )

    def beat(self) -> None:
        """Say that the user interface is alive, from any thread."""
        with self._lock:
            self._beat = self._now()

    def drop(self) -> None:
        """Forget everything unsent, as when the link is lost: nothing old may leave later.

        A push over the next link says rest first, if the hand has let go meanwhile: the robot may have heard of none.
        """
        with self._lock:
            self._void()
            self._last_sent, self._zeros = _ZERO, 0
            self._unheard = self._unheard or self._drove

    def rest(self) -> None:
        """Say rest a few times, whatever was said before; the stick must be pushed anew."""
        with self._lock:
            self._void()
            self._last_sent, self._zeros = _ZERO, REST_REPEATS

    @property
    def driving(self) -> bool:
        """The robot was last told to move."""
        return self._last_sent != _ZERO

    def patience(self, longest: float) -> float:
        """How long `due` need not be asked unless something changes [s]: until the heartbeat is too old, at most `longest`."""
        with self._lock:
            if self._last_sent == _ZERO:
                return longest
            left = self._beat + HEARTBEAT_TIMEOUT + _INSTANT - self._now()
            return min(longest, left) if left > 0 else longest

    def due(self, *, allowed: bool = True) -> Drive | None:
        """What has to be sent now, at once on a change and each `SEND_PERIOD` while held; None when nothing.

        Not `allowed` means rest, and that the stick must be pushed anew; the robot may not hear that rest, and the new push
        says it again before anything else.
        """
        with self._lock:
            if not allowed or self._latched:
                self._void()
            if not allowed:
                self._unheard = self._unheard or self._drove
            now = self._now()
            order = self._led(self._effective(now))
            changed = not _alike(order, self._last_sent)
            if changed and order == _ZERO:
                self._zeros = REST_REPEATS
            waited = now - self._sent_at >= (LATCHED_PERIOD if self._latched else SEND_PERIOD) - 1e-9
            silent = order == _ZERO and self._zeros == 0 and not self._latched
            if not changed and (not waited or silent):
                return None
            self._zeros = max(0, self._zeros - 1) if order == _ZERO else 0
            self._last_sent, self._sent_at = order, now
            self._drove = self._drove or order != _ZERO
            return order

    def _led(self, order: Drive) -> Drive:
        """What of `order` goes out: rest before a push of a hand that let go unheard. A hand that never let go says none."""
        if order == _ZERO or not self._unheard or self._held:
            return order
        self._unheard = False
        self._last_sent, self._zeros = order, 0  # the rest is a change, and leaves at once
        return _ZERO

    def _effective(self, now: float) -> Drive:
        silence = now - self._beat
        if silence > REARM_DELAY:
            self._void()
        return self._wanted if silence <= HEARTBEAT_TIMEOUT else _ZERO
