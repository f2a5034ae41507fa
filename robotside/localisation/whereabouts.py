"""The judge of the robot's place: whether what it believes has been checked against all other places on the map.

A place is proven when a search of the whole map has found none that explains what the laser sees nearly as well.
Until then, and whenever another one explains it better, the robot is not sure: the places that fit are followed in parallel until one
dominates, or an operator says which of them it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from bridge.core.units import wrap
from robotside.core.pose2 import ORIGIN, Points, Pose2
from robotside.core.worker import Job, Work, Worker
from robotside.localisation.explanation import Explanation, Look, explained
from robotside.localisation.field import Field
from robotside.localisation.hypotheses import Hypotheses, Hypothesis, Prior, shares
from robotside.localisation.place_search import Found, differ, matched, search
from robotside.localisation.scan_matching import Localiser

__all__ = ["Whereabouts", "anywhere", "said_to_be"]

SURE_SHARE = 0.95
"""A place is believed from this share on."""

DOUBT_SHARE = 0.8
"""A place that was proven is doubted below this share."""

CONTINUITY = 4.0
"""What every other place has against it while the proven one has been followed without a break (logarithm)."""

MIN_FIT, MAX_THROUGH = 0.55, 0.25
"""What a place must explain to be believed: part of the beams' ends that lie on surfaces, and part of beams that went through walls."""

MIN_TAKEN_FIT, MAX_TAKEN_THROUGH = 0.85, 0.05
"""What another place than the believed one must explain to be taken without asking: people and cars that are gone may speak for a wrong one."""

SAME_FIT = 0.02
"""A place is not left by itself while it has no fewer of the ends on surfaces than the other one, give or take this part."""

CHECK_DISTANCE = 4.0
"""A proven place is checked against all others each time the robot has gone so far [m]."""

RETRY_DISTANCE, RETRY_PERIOD = 1.0, 3.0
"""An unproven one is checked again after so far [m], or so long while nothing fits [s]."""

FOLLOW_PERIOD = 0.3
"""Between two looks of the places that are followed [s]."""

MAX_UNEXPLAINED = 3
"""Looks in a row that a proven place may fail to explain before it is doubted."""

WORSE = 3.0
"""A proven place that explains a look so much worse than before is checked at once (logarithm)."""

CONFIRM_DISTANCE = 0.4
"""A place that it did not believe must fit over this distance [m] before it is taken, unless it is beyond doubt."""

ANSWERED = math.log(20.0)
"""What the best of the other places has against it after an operator's answer, until a look tells them apart (logarithm)."""

BEYOND_DOUBT = 0.99
"""Share from which a place is taken though the robot stands."""


ELSEWHERE, FARTHER, TURNED_ROUND = 2.0, 0.15, 3.5
"""What places have against them that are not where an operator says, more for each metre off, and for another direction (logarithms): a wrong
door is taken in one of ten cases, a wrong direction in one of thirty."""


def anywhere(_: Pose2) -> float:
    """All places are as likely."""
    return 0.0


def said_to_be(pose: Pose2, reach: float, *, otherwise: float = 0.0) -> Prior:
    """Somebody says that it is at `pose`, to `reach` [m]; who errs takes a place nearby for it, seldom one far off, or turned round.

    `otherwise` is what every other place has against it besides (logarithm).
    """

    def prior(other: Pose2) -> float:
        off = pose.distance(other.x, other.y)
        against = ELSEWHERE + FARTHER * min(off, 20.0) + otherwise if off > reach else 0.0
        return -against - (TURNED_ROUND + otherwise if abs(wrap(other.yaw - pose.yaw)) > 0.8 else 0.0)

    return prior


class Whereabouts:
    """Checks the place that is believed against all others; calls come from the loop's thread, with the robot's clock [s]."""

    def __init__(self, worker: Worker, take: Callable[[Hypothesis], None]) -> None:
        """`worker` searches the map; `take` is called when another place than the believed one has been proven."""
        self._worker, self._take = worker, take
        self.hypotheses = Hypotheses()
        """The places where it may be, while there is doubt."""
        self.proven = False
        """The place that is believed has been checked against all others, and dominates."""
        self.judged = False
        """It has been checked at all since it was last placed."""
        self.explanation: Explanation | None = None
        """How the believed place explains the last look that it was judged by."""
        self.by_word = False
        """An operator chose it, and nothing that was seen since tells it from all other places."""
        self._prior: Prior = anywhere
        self._job: Job[tuple[list[Found], Explanation]] | None = None
        self._taken_at = (ORIGIN, ORIGIN)
        self._last: Pose2 | None = None
        self._placed_at: Pose2 | None = None
        self._driven = self._checked_at = 0.0
        self._checked = self._followed = -math.inf
        self._doubted_at = 0.0
        self._unexplained = 0

    def placed(self, prior: Prior, *, by_word: bool = False) -> None:
        """The robot was placed anew: nothing of what was found counts any more; `by_word` is an answer to its question."""
        self.by_word = by_word
        self._drop()
        self._prior, self._placed_at = prior, None
        self.proven = self.judged = False
        self._checked = -math.inf

    def doubt(self) -> None:
        """Something else says that the place is wrong: it must be proven again, and any place is as likely."""
        if self.proven:
            self.proven = False
            self._prior = anywhere
            self._checked, self._doubted_at = -math.inf, self._driven
            self._drop()

    def on_sweep(
        self, belief: Localiser, points: Points, look: Look, odom: Pose2, now: float, evidence: Prior
    ) -> None:
        """A sweep was taken where the odometry is at `odom`; `evidence` is what satellites and compass say of a place."""
        if belief.pose is None:
            return
        self._travel(odom)
        self._placed_at = self._placed_at or odom  # what was said of its place is of there
        if self._job is not None and self._job.poll():
            found, own = self._job.result()
            self._job = None
            self._judge(belief, found, own, odom, evidence)
        if now >= self._followed + FOLLOW_PERIOD:
            self._followed = now
            if self.hypotheses.all:
                self._follow(belief, points, look, odom)
            elif self.proven:
                self._glance(explained(belief.field, belief.pose, look), now)
        if self._job is None and look.tells and self._due(belief, now):
            self._checked, self._checked_at = now, self._driven
            self._taken_at = (odom, belief.pose)
            self._job = self._worker.submit(_check(belief.field, belief.pose, look))

    def _glance(self, own: Explanation, now: float) -> None:
        """Whether the proven place still explains what is seen."""
        self._unexplained = 0 if _explains(own) else self._unexplained + 1
        if self._unexplained >= MAX_UNEXPLAINED:
            self.doubt()
        elif (
            self.explanation
            and own.evidence < self.explanation.evidence - WORSE
            and now >= self._checked + RETRY_PERIOD
        ):
            self._checked_at = -math.inf

    def _travel(self, odom: Pose2) -> None:
        if self._last is not None:
            step = self._last.distance(odom.x, odom.y)
            self._driven += step if step < 2.0 else 0.0
        self._last = odom

    def _due(self, belief: Localiser, now: float) -> bool:
        driven = self._driven - self._checked_at
        if self.proven:
            return driven >= (RETRY_DISTANCE if self.by_word else CHECK_DISTANCE)
        fits = bool(self.hypotheses.all) and self.hypotheses.all[0].explanation.fit >= MIN_FIT
        waited = now >= self._checked + RETRY_PERIOD
        return not math.isfinite(self._checked) or driven >= RETRY_DISTANCE or (waited and not fits)

    def _judge(
        self, belief: Localiser, found: list[Found], own: Explanation, odom: Pose2, evidence: Prior
    ) -> None:
        """Weigh what the search has found against what is believed."""
        then, was = self._taken_at
        moved = odom.since(then)
        self.judged, self.explanation = True, own
        if self.hypotheses.all:
            for each in found:
                weight = self.hypotheses.late_weight(each.explanation, evidence(each.pose))
                self.hypotheses.take_in(_at(belief.field, each.pose.then(moved), odom), each, weight)
            return
        against = (ANSWERED if self.by_word else CONTINUITY) if self.proven else 0.0
        others = [each for each in found if differ(each.pose, was)]
        back = (self._placed_at or then).since(then)
        seen = [own.evidence + evidence(was)]
        seen += [each.explanation.evidence + evidence(each.pose) for each in others]
        weights = [seen[0] + self._prior(was.then(back))]
        weights += [
            weight + self._prior(each.pose.then(back)) - against
            for each, weight in zip(others, seen[1:], strict=True)
        ]
        if self.by_word:
            self.by_word = shares(seen)[0] < SURE_SHARE
        if self.proven and self.by_word:
            share = shares([weights[0], *sorted(weights[1:])[-1:]])[0]
        else:
            share = shares(weights)[0]
        if _explains(own) and share >= (DOUBT_SHARE if self.proven else SURE_SHARE):
            self._prove()
            return
        if self.proven and not others:
            return  # people may hide every wall: the sweeps that do not fit are counted elsewhere
        self.proven, self._doubted_at = False, self._driven
        if _explains(own) or own.fit > 0.0:
            self.hypotheses.take_in(_copy(belief, odom), Found(belief.pose or was, own), weights[0])
        for each, weight in zip(others, weights[1:], strict=True):
            self.hypotheses.take_in(_at(belief.field, each.pose.then(moved), odom), each, weight)

    def _follow(self, belief: Localiser, points: Points, look: Look, odom: Pose2) -> None:
        """See which of the places still fit, and take the one that dominates."""
        followed = self.hypotheses
        followed.predict(odom)
        followed.look(points, look, odom)
        best, share = followed.all[0], followed.shares[0]
        if not look.tells or not _explains(best.explanation) or share < SURE_SHARE:
            return
        moved = self._driven - self._doubted_at
        if moved < CONFIRM_DISTANCE and share < BEYOND_DOUBT:
            return
        if belief.pose is not None and differ(best.pose, belief.pose):
            if best.explanation.fit < MIN_TAKEN_FIT or best.explanation.through > MAX_TAKEN_THROUGH:
                return
            if belief.fit >= best.localiser.fit - SAME_FIT:
                return  # all that it sees is on the map where it believes to be: rather has something gone there
            self._take(best)
        self.explanation = best.explanation
        self._prove()

    def _prove(self) -> None:
        self.proven, self._prior = True, anywhere
        self._unexplained = 0
        self.hypotheses.clear()

    def _drop(self) -> None:
        if self._job is not None:
            self._job.cancel()
            self._job = None
        self.hypotheses.clear()


def _check(field: Field, pose: Pose2, look: Look) -> Work[tuple[list[Found], Explanation]]:
    """All places that explain the look, and how well `pose` does."""
    found = yield from search(field, look)
    own = explained(field, pose, look)
    yield
    better = matched(field, pose, look)
    return found, own if differ(better.pose, pose) else better.explanation


def _explains(explanation: Explanation) -> bool:
    return explanation.fit >= MIN_FIT and explanation.through <= MAX_THROUGH


def _at(field: Field, pose: Pose2, odom: Pose2) -> Localiser:
    made = Localiser(field)
    made.place(pose, spread=0.15, turn=0.05)
    made.predict(odom)
    return made


def _copy(belief: Localiser, odom: Pose2) -> Localiser:
    made = Localiser(belief.field)
    made.place(belief.pose or odom, spread=0.15, turn=0.05)
    made.predict(odom)
    return made
