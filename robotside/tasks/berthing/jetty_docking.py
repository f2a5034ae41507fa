"""Docking of a boat at its jetty: to its line by position, along it by the tag on the jetty's post, and slowly against it until it charges."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Place
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal, LegState, Navigator
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing import dock_outcomes
from robotside.tasks.berthing.cage_sight import FRESH, Look
from robotside.tasks.berthing.dock_contact import DockContact
from robotside.tasks.berthing.jetty_line import JettyLine

__all__ = ["GATE", "MAX_ASKEW", "MAX_TRIES", "NEAR", "JettyDocking"]

MAX_TRIES = 4
"""Approaches before it gives up."""

NEAR = 4.0
"""Where it charges so near to the place of a jetty it lies there: satellites err so far [m]."""

FAST, SLOW, CREEP = 0.5, 0.3, 0.06
"""Over ground: far away; where it cannot see the tag yet; and at the berth [m/s]."""

SLOWING = 0.12
"""Speed for each metre that is left, beside `CREEP` [1/s]."""

STEERAGE, STEERED = 0.2, 0.25
"""Up to where its bow is so near it makes at least the first through the water, to steer [m/s, m]."""

LOOK_FROM, LOOK_GAP = 6.0, 2.0
"""By the map: nearer than the first it goes slowly to see the tag, and no nearer than the second without it [m]."""

GATE, REACH_ASIDE, FUNNEL = 0.9, 0.35, 4.0
"""With its bow so near it has to be on the line; farther away, up to the third, it may be so much more aside for each metre [m, 1, m]."""

MAX_OFF, MAX_ASKEW = 0.13, 0.30
"""There its bow is no farther off the line, and the boat no more askew [m, rad]."""

BERTH = 0.7
"""With its bow so near it is between the fingers, and what it touches is the berth [m]."""

TOUCH = 0.30
"""Touching so near it has come to the jetty [m]."""

MAX_BEYOND = 0.25
"""By what it saw it goes no farther than this beyond the jetty [m]."""

STALL_TIME = 10.0
"""So long in the berth without getting to the jetty, something holds it [s]."""

LOST_TIMEOUT = 6.0
"""Without a sight of the tag for so long it goes back to see it anew [s]."""

APPROACH_TIMEOUT, RETREAT_TIMEOUT = 120.0, 60.0
"""One approach, and one way back, take no longer [s]."""

ASTERN = 0.7
"""Through the water, on the way back [m/s]."""

CLEAR, AWAY = 5.5, 6.5
"""It goes back until its bow is so far from the jetty, the second to lie there when it gives up [m]."""

MAX_TURNED, NEAR_LINE, FARTHEST = 1.2, 0.6, 12.0
"""Turned from the line, beside it (at the gate, and so much more before it) and before the jetty by no more than this it comes up from where it is [rad, m, m]."""

ROUND = 3.0
"""Farther away it has room to come round ahead; nearer it goes astern first [m]."""

MAX_OUTS = 4
"""It sets out anew no more often than this because it is too far beside the line; from then on that is a try."""

SEEN_FROM = 4.0
"""Nearer than this it sees the tag [m]."""

SETTLED_TIME = 4.0
"""It has charged for so long when it is done [s]: a wave may part the contacts again."""

MAX_GAP = 0.5
"""Left alone for longer, it may be elsewhere: it begins anew [s]."""


class _Stage(Enum):
    """What it does just now."""

    SAIL = "sails to where the line begins"
    APPROACH = "comes up along the line"
    CONTACT = "leans on the jetty until it charges"
    RETREAT = "goes back to come up anew, or to give up"


class JettyDocking(Behaviour):
    """Succeeds when the battery takes charge; fails after some approaches, at rest clear of the jetty, and says what was seen."""

    def __init__(
        self,
        jetty: Place,
        course: Course,
        navigator: Navigator,
        situation: Situation,
        look: Look,
        front: float,
        begin: Callable[[Pose2], Goal],
    ) -> None:
        """`course` has the one point where the line begins by the map; `look` finds tags ahead, `front` is from the boat's middle to its bow [m].

        `begin` gives the place to begin from for one where the boat would lie docked, the best of `dock_start.starts`.
        """
        super().__init__("dock at the jetty")
        self._jetty, self._course, self._navigator, self._situation = jetty, course, navigator, situation
        self._begin = begin
        self._line = JettyLine(jetty, navigator, situation, look, front)
        self._sight, self._contacts = self._line.sight, DockContact(jetty.name, situation)
        self._stage, self._since, self._ticked = _Stage.SAIL, 0.0, -math.inf
        self._tries = self._outs = 0
        self._why: Notice | None = None
        self._settled = self._berthed = math.inf
        self._steps: dict[_Stage, Callable[[], Status]] = {
            _Stage.SAIL: self._sail,
            _Stage.APPROACH: self._approach,
            _Stage.CONTACT: self._contact,
            _Stage.RETREAT: self._retreat,
        }

    def initialise(self) -> None:
        """Set out."""
        self._tries, self._outs, self._ticked = 0, 0, self._situation.now
        self._line.begin()
        self._set_out()

    def update(self) -> Status:
        """Go on."""
        now = self._situation
        alone, self._ticked = now.now - self._ticked > MAX_GAP, now.now
        near = now.pose.distance(self._jetty.x, self._jetty.y) < NEAR
        if now.charging and self._stage is not _Stage.CONTACT and (near or self._stage is not _Stage.SAIL):
            self._touch()
        elif alone and self._stage is not _Stage.SAIL:
            self._begin_anew()
        return self._steps[self._stage]()

    def terminate(self, new_status: Status) -> None:
        """Lie still."""
        self._navigator.rest()

    def _enter(self, stage: _Stage) -> None:
        self._stage, self._since = stage, self._situation.worked
        self._settled = self._berthed = math.inf

    @property
    def _spent(self) -> float:
        """In this stage [s]."""
        return self._situation.worked - self._since

    def _begin_anew(self) -> None:
        """It was left alone: out of the berth first, where it may be in it."""
        near = self._line.where()[1] < CLEAR
        self._line.begin()
        self._enter(_Stage.RETREAT) if near else self._set_out()

    def _set_out(self) -> None:
        """From where it is, if the line can be reached from there."""
        robot, gap = self._line.where()
        far = abs(robot.y) > NEAR_LINE + REACH_ASIDE * max(0.0, gap - GATE)
        if abs(robot.yaw) < MAX_TURNED and CLEAR - 0.5 < gap < FARTHEST and not far:
            self._enter(_Stage.APPROACH)
            return
        self._navigator.head_for(self._begin(self._line.docked()))
        self._enter(_Stage.SAIL)

    def _sail(self) -> Status:
        now, name = self._situation, self._jetty.name
        leg = self._navigator.update(now.pose, now.points, now.now)
        now.report("driving", self._navigator.waits_for or f"Heading for {name}.", place=name, still=60.0)
        if leg is LegState.BLOCKED:
            return Status.FAILURE
        if leg is LegState.ARRIVED:
            self._navigator.finish()
            self._enter(_Stage.APPROACH)
        return Status.RUNNING

    def _approach(self) -> Status:
        self._line.look()
        name, (_, gap) = self._jetty.name, self._line.where()
        if self._met(gap):
            self._touch()
            return Status.RUNNING
        if gap > ROUND and self._beside(gap) and self._outs < MAX_OUTS:
            self._outs += 1  # there is room yet to come round
            self._set_out()
            return Status.RUNNING
        if why := self._astray(gap):
            return self._again(why)
        if self._sight.known:
            self._tell(f"Coming up to {name}, by its tag.", touches=gap < BERTH)
            fastest = FAST
        else:
            self._tell(f"Looking for {name}.")
            fastest = FAST if gap > LOOK_FROM else SLOW
        if gap > STEERED:
            self._line.go(min(fastest, CREEP + SLOWING * gap), STEERAGE)
        else:
            self._line.creep(CREEP)
        return Status.RUNNING

    def _met(self, gap: float) -> bool:
        """It has come to the jetty, by what it sees of it."""
        if not self._sight.known:
            return False
        return gap < -MAX_BEYOND or self._contacts.meet or (self._situation.touched and gap < TOUCH)

    def _beside(self, gap: float) -> bool:
        """It is so far beside the line that it would not come onto it any more."""
        aside = abs(self._line.aside())
        return self._sight.known and GATE < gap < FUNNEL and aside > MAX_OFF + REACH_ASIDE * (gap - GATE)

    def _astray(self, gap: float) -> Notice | None:
        """Why this approach leads nowhere; None while it may lead to the berth."""
        name, robot = self._jetty.name, self._line.where()[0]
        worked = self._situation.worked
        if not self._sight.known:
            if gap > LOOK_GAP and self._spent < APPROACH_TIMEOUT:
                return None
            return dock_outcomes.unseen(name, by_laser=False)
        aside = abs(self._line.aside())
        if gap > BERTH:
            at_gate = gap < GATE and (aside > MAX_OFF or abs(robot.yaw) > MAX_ASKEW)
            if at_gate or self._beside(gap):
                return dock_outcomes.missed(name, aside)
            unseen = min(self._sight.age, self._spent) if gap > GATE else self._sight.age
            if gap < SEEN_FROM and unseen > (LOST_TIMEOUT if gap > GATE else FRESH):
                return dock_outcomes.unseen(name, by_laser=False)
        self._berthed = min(self._berthed, worked) if gap < BERTH else math.inf
        if worked - self._berthed > STALL_TIME:
            said = f"{name} cannot be reached: something stands before it."
            return Notice(Code.DOCK_BLOCKED, said, place=name)
        return dock_outcomes.not_in_time(name, APPROACH_TIMEOUT) if self._spent > APPROACH_TIMEOUT else None

    def _touch(self) -> None:
        self._contacts.begin()
        self._enter(_Stage.CONTACT)

    def _contact(self) -> Status:
        now, name = self._situation, self._jetty.name
        self._tell(f"Waiting for the charge at {name}.", touches=True)
        self._line.lean()
        if now.charging:
            self._settled = min(self._settled, now.worked)
            if now.worked - self._settled < SETTLED_TIME:
                return Status.RUNNING
            self._course.reached()
            return Status.SUCCESS
        self._settled = math.inf
        why = self._contacts.outcome("by its tag")
        if why is None:
            return Status.RUNNING
        if why.code == Code.DOCK_MISSED:
            return self._again(why)
        self._navigator.reason = why
        return Status.FAILURE

    def _again(self, why: Notice) -> Status:
        """Go back and try once more; after the last time too, to lie clear of the jetty."""
        self._tries, self._why = self._tries + 1, why
        if why.code == Code.DOCK_UNSEEN:
            self._line.begin()
        self._enter(_Stage.RETREAT)
        return Status.RUNNING

    def _retreat(self) -> Status:
        """Astern along the line, then anew from there or from where it begins."""
        self._line.look()
        name, (_, gap) = self._jetty.name, self._line.where()
        over = self._tries >= MAX_TRIES
        if gap < (AWAY if over else CLEAR) and self._spent < RETREAT_TIMEOUT:
            self._tell(f"Going back to try {name} again.", touches=gap < BERTH)
            self._line.back(ASTERN)
            return Status.RUNNING
        if over and self._why is not None:
            said = f"{str(self._why)[:-1]}; after {MAX_TRIES} tries the robot lies before it."
            self._navigator.reason = self._why.reworded(said)
            return Status.FAILURE
        self._set_out()
        return Status.RUNNING

    def _tell(self, text: str, *, touches: bool = False) -> None:
        self._situation.report("docking", text, place=self._jetty.name, still=30.0, touches=touches)
