"""The question to the operator: at which of these places is the robot?"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import PlaceCandidate, PlaceCandidates
from bridge.msgs.std_msgs import Header, Time
from robotside.core.bus import Publish
from robotside.core.pose2 import Pose2
from robotside.localisation.hypotheses import Hypotheses, Hypothesis

__all__ = ["QUESTION_NUMBERS", "Candidates"]

QUESTION_NUMBERS = 26
"""Numbers that belong to a question: it counts its candidates from the first of them, which screens call A."""

MIN_SHARE = 0.02
"""A place that is believed less is not asked about."""

PERIOD = 0.5
"""Between two messages about the same candidates [s]."""

MOVED, TURNED, SHARED = 0.2, 0.1, 0.05
"""Changes of a candidate that are told: of its place [m], its direction [rad] and its share."""


class Candidates:
    """Publishes the places that are asked about, when they change."""

    def __init__(self, publish: Publish) -> None:
        self._publish = publish
        self._told = -math.inf
        self._numbers: dict[int, int] = {}
        """Of the question: what each hypothesis that was ever asked about in it is called."""
        self._last = 0
        self.all: tuple[PlaceCandidate, ...] = ()
        """The likeliest first; empty while nothing is asked."""

    def update(self, hypotheses: Hypotheses, stamp: float) -> None:
        """Ask about `hypotheses`, at `stamp` [s, robot clock]; nothing is asked about fewer than two."""
        believed = [
            (each, share)
            for each, share in zip(hypotheses.all, hypotheses.shares, strict=True)
            if share >= MIN_SHARE
        ]
        made = tuple(self._candidate(each, share) for each, share in believed) if len(believed) > 1 else ()
        if not made:
            self._numbers.clear()
        known = [each.id for each in self.all]
        if [each.id for each in made] == known:
            same = all(map(_alike, self.all, made))
            if same or 0 <= stamp - self._told < PERIOD:
                return
        self.all, self._told = made, stamp
        reason = f"The robot may be at {len(made)} places: say at which it is." if made else ""
        said = PlaceCandidates(Header(Time.at(stamp), "map"), list(made), reason)
        self._publish("/localisation/candidates", said)

    def scatter(self, pose: Pose2) -> NDArray[np.float64]:
        """How far the places that are asked about lie from `pose`: of x, y [m] and yaw [rad] the mean squares, 3 x 3; 0 while nothing is asked."""
        off = np.array([(each.x - pose.x, each.y - pose.y, wrap(each.yaw - pose.yaw)) for each in self.all])
        shares = np.array([each.share for each in self.all])
        return (off.T * shares) @ off / shares.sum() if self.all else np.zeros((3, 3))

    def _candidate(self, hypothesis: Hypothesis, share: float) -> PlaceCandidate:
        pose, spread = hypothesis.pose, hypothesis.localiser.spread
        number = self._number(hypothesis.number)
        return PlaceCandidate(number, pose.x, pose.y, pose.yaw, share, spread)

    def _number(self, hypothesis: int) -> int:
        """Kept while the question is open and never given again: a late answer must not mean another place."""
        if hypothesis not in self._numbers:
            if not self._numbers:
                self._last = -(-self._last // QUESTION_NUMBERS) * QUESTION_NUMBERS
            self._last += 1
            self._numbers[hypothesis] = self._last
        return self._numbers[hypothesis]


def _alike(one: PlaceCandidate, other: PlaceCandidate) -> bool:
    return (
        math.hypot(one.x - other.x, one.y - other.y) < MOVED
        and abs(wrap(one.yaw - other.yaw)) < TURNED
        and abs(one.share - other.share) < SHARED
    )
