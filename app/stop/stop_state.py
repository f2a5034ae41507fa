"""The state of STOP: decided here for the robot that is connected, for every robot of STOP ALL, and for one without a STOP.

`judge` decides, by what is known and the time alone. `StopState` notes what is heard of a robot that has a STOP.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from app.link.commands import STOP_DOUBT, Outcome
from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.core.language import tr

__all__ = [
    "REST_TIMEOUT",
    "ANSWER_TIMEOUT",
    "UNCONFIRMED",
    "StopFacts",
    "StopState",
    "Verdict",
    "judge",
    "silence",
]

ANSWER_TIMEOUT = STOP_DOUBT
"""A STOP that the robot did not take after this is unanswered; it goes on being sent [s]."""
REST_TIMEOUT = 2.0
"""A robot whose STOP is latched rests within this, or it is not obeyed [s]."""

UNCONFIRMED = ("sent", "no_answer", "moves")
"""Phases of a STOP that was pressed and is not confirmed."""


@dataclass(frozen=True, slots=True)
class StopFacts:
    """What is known of the STOP of one robot; instants are of our clock [s], NaN for what did not happen."""

    asked_at: float = math.nan
    """Pressed here, and not let go since."""
    taken_at: float = math.nan
    """The robot answered that it took it."""
    refusal: str = ""
    """Why it did not, in its own words."""
    latched: bool | None = None
    """It says that STOP is pressed, by whomever; None while it says nothing."""
    at_rest: bool = False
    """It says that it rests."""
    by: str = ""
    """Who pressed it, as the robot says."""
    moves_since: float = math.nan
    """Since when it says that STOP is pressed and not that it rests."""
    released: bool = False
    """It was done as it was asked for here, and is pressed no longer."""
    reached: bool = True
    """The link stands."""
    reached_at: float = math.nan
    """Since when."""
    lost_at: float = math.nan
    """The link was lost while it was stopped, and it has said nothing since."""
    why: str = ""
    """Why the link does not stand, as a sentence."""
    hopeless: bool = False
    """It is tried no longer."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of it."""

    phase: str
    """`ready`, nobody pressed it; `sent`; `stopped`, it says that it is pressed and that it rests; `moves`, pressed and it
    does not come to rest; `no_answer`; `lost`, stopped when the link was lost; `released`, by somebody, after it was done."""
    sentence: str = ""
    """The same for the operator; empty where the phase says it all."""


def judge(known: StopFacts, now: float) -> Verdict:
    """What the operator may be told at the instant `now` [s]; it claims no more than what is known."""
    if not known.reached:
        return _unreached(known, now)
    if known.latched:
        return _latched(known, now)
    if known.latched is None and math.isnan(known.asked_at) and not math.isnan(known.lost_at):
        return Verdict("lost", _last_heard(known, now))
    if known.released:
        return Verdict("released", tr("STOP was released."))
    if math.isnan(known.asked_at):
        return Verdict("ready")
    if known.refusal:
        return Verdict("no_answer", known.refusal)
    since = known.asked_at if math.isnan(known.reached_at) else max(known.asked_at, known.reached_at)
    if now - since < ANSWER_TIMEOUT:
        return Verdict("sent")
    if not math.isnan(known.taken_at):
        return Verdict("no_answer", tr("STOP received; the robot has not reported that it rests."))
    return Verdict("no_answer", tr("It does not answer; STOP is sent again and again."))


def _latched(known: StopFacts, now: float) -> Verdict:
    if known.at_rest:
        return Verdict("stopped", tr("Pressed by {by}.").format(by=known.by) if known.by else "")
    if known.refusal:
        return Verdict("no_answer", known.refusal)
    if now - known.moves_since < REST_TIMEOUT:
        return Verdict("sent", tr("STOP is pressed; it comes to rest."))
    return Verdict("moves", tr("STOP is pressed, and it does not come to rest."))


def _unreached(known: StopFacts, now: float) -> Verdict:
    pressed_since = not math.isnan(known.lost_at) and known.asked_at > known.lost_at
    if not math.isnan(known.lost_at) and not pressed_since:
        return Verdict("lost", _last_heard(known, now))
    if math.isnan(known.asked_at):
        return Verdict("ready")
    if not known.hopeless and now - known.asked_at < ANSWER_TIMEOUT:
        return Verdict("sent")
    return Verdict("no_answer", _last_heard(known, now) if pressed_since else known.why)


def _last_heard(known: StopFacts, now: float) -> str:
    return (
        tr("STOPPED when it was last heard, {silence} ago. {why}")
        .format(silence=silence(now - known.lost_at), why=known.why)
        .strip()
    )


def silence(seconds: float) -> str:
    """So long [s] in the words of the glass, as in `12 s` or `3 min`."""
    if seconds < 60:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 3600 else f"{seconds / 3600:.0f} h"


class StopState:
    """Notes what is heard of the STOP of a robot that has one, over whatever link."""

    def __init__(self, now: Callable[[], float], own_id: str) -> None:
        """`now` is our clock [s]; by `own_id` the robot publishes this handheld."""
        self._now, self._id = now, own_id
        self._status: ControlStatus | None = None
        self._early: ControlStatus | None = None
        """Heard over a new connection before that is known to stand."""
        self._cut_at = math.nan
        """When it was told last that the link does not stand; NaN before it was."""
        self._asked_at = self._taken_at = self._moves_since = self._reached_at = self._lost_at = math.nan
        self._refusal = self._why = ""
        self._reached = True
        self._hopeless = self._done = self._released = False
        self._command_id = self._void_id = ""
        """Of the STOP that is asked for, and of the last one that was let go."""

    @property
    def verdict(self) -> Verdict:
        """What became of it."""
        return judge(self._known, self._now())

    @property
    def rests(self) -> bool:
        """It says that STOP is pressed and that it rests."""
        return self._status is not None and self._status.stopped and self._status.at_rest

    @property
    def taken(self) -> bool:
        """It answered that it took STOP."""
        return not math.isnan(self._taken_at)

    @property
    def unanswered(self) -> bool:
        """It was pressed here and not let go, and the robot has not answered that it took it."""
        return not math.isnan(self._asked_at) and not self.taken

    @property
    def owed(self) -> bool:
        """It was pressed here and not let go, and the robot has not confirmed that it rests."""
        return not math.isnan(self._asked_at) and self.verdict.phase in UNCONFIRMED

    @property
    def lost_for(self) -> float:
        """So long ago the link to a robot was lost that was stopped [s]; NaN where it was not, or it was heard since."""
        return self._now() - self._lost_at

    def press(self) -> None:
        """STOP was pressed here; again while it is being sent changes nothing, after a release it begins anew."""
        under_way = not (math.isnan(self._asked_at) or self._done or self._released)
        if not under_way:
            self._clear()
            self._asked_at = self._now()

    def forget(self) -> None:
        """It is asked for no longer, and what is on its way of that says nothing; what the robot says of it stands."""
        self._void_id = self._command_id
        self._clear()

    def _clear(self) -> None:
        self._asked_at = self._taken_at = math.nan
        self._refusal = ""
        self._done = self._released = False

    def on_outcome(self, outcome: Outcome) -> bool:
        """What came of asking for it; False, and nothing is noted, where that was let go meanwhile."""
        if outcome.command_id and outcome.command_id == self._void_id:
            return False
        self._command_id = outcome.command_id
        if outcome.phase == "sent" or math.isnan(self._asked_at):
            self.press()
        if outcome.phase == "accepted":
            self._taken_at, self._refusal = self._now(), ""
            self._done = self._done or (self._status is not None and self._status.stopped)
        elif outcome.phase in ("refused", "no_reply"):
            self._refusal = "" if outcome.silent else outcome.reason
        return True

    def on_status(self, status: ControlStatus, received: float) -> None:
        """What the robot says of it, `received` when it came [s].

        While the link does not stand that is the last word of the old connection if it came before it was lost, and else the
        first of a new one, which counts from when that stands.
        """
        if not self._reached and received > self._cut_at:
            self._early = status
            return
        if not self._reached:
            rests = status.stopped and status.at_rest
            self._lost_at = (
                math.nan if not rests else self._now() if math.isnan(self._lost_at) else self._lost_at
            )
            return
        self._status, self._lost_at = status, math.nan
        if status.stopped and not status.at_rest:
            self._moves_since = self._now() if math.isnan(self._moves_since) else self._moves_since
        else:
            self._moves_since = math.nan
        if not status.stopped:
            self._released = self._done
        elif not math.isnan(self._asked_at):
            self._released = False
            self._done = self._done or status.at_rest or self.taken

    def reach(self, reached: bool, why: str = "", *, at: float = math.nan, hopeless: bool = False) -> None:
        """The link stands, or does not, and `why`, since `at` [s], NaN for now; `hopeless` when it is tried no longer."""
        if self._reached and not reached and self._status is not None:
            self._lost_at = self._now() if self.rests else math.nan
        if self._reached != reached:
            self._status, self._moves_since, self._refusal = None, math.nan, ""
        if reached and not self._reached:
            self._reached_at = self._now()
        self._reached, self._why, self._hopeless = reached, why, hopeless
        early, self._early = self._early, None
        if not reached:
            self._cut_at = self._now() if math.isnan(at) else at
        elif early is not None:
            self.on_status(early, self._now())

    @property
    def _other(self) -> str:
        """Who else pressed it."""
        if self._status is None or (self._id and self._status.stopped_by_id == self._id):
            return ""
        return self._status.stopped_by

    @property
    def _known(self) -> StopFacts:
        status = self._status
        return StopFacts(
            asked_at=self._asked_at,
            taken_at=self._taken_at,
            refusal=self._refusal,
            latched=None if status is None else status.stopped,
            at_rest=self.rests,
            by=self._other,
            moves_since=self._moves_since,
            released=self._released,
            reached=self._reached,
            reached_at=self._reached_at,
            lost_at=self._lost_at,
            why=self._why,
            hopeless=self._hopeless,
        )
