"""The places where the robot may be, followed in parallel while it moves, each with its share of what is believed."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from bridge.core.units import wrap
from robotside.core.pose2 import Points, Pose2
from robotside.localisation.explanation import Explanation, Look, explained
from robotside.localisation.place_search import Found, differ
from robotside.localisation.scan_matching import Localiser

__all__ = ["MAX_FOLLOWED", "Hypotheses", "Hypothesis", "Prior"]

Prior = Callable[[Pose2], float]
"""Logarithm of how likely a place is by all but the laser; 0 for the likeliest."""

MAX_FOLLOWED = 8
"""Places that are followed at once."""

LOOK_APART, TURN_APART = 0.5, 0.5
"""Looks so far apart [m], or turned by that [rad], tell different things; of nearer ones only a part is new."""

LEAST_SHARE = 0.005
"""A place that is believed less is dropped."""

LATE = 3.0
"""What a place that is found late has against it, beside those that were followed until then (logarithm)."""


@dataclass(slots=True)
class Hypothesis:
    """A place where the robot may be."""

    number: int
    localiser: Localiser
    weight: float
    """Logarithm of its likelihood, beside the others'."""
    explanation: Explanation

    @property
    def pose(self) -> Pose2:
        """In `map`, now."""
        return self.localiser.pose or Pose2(math.nan, math.nan, math.nan)


class Hypotheses:
    """A bounded set of places; none while there is no doubt."""

    def __init__(self) -> None:
        self.all: list[Hypothesis] = []
        """The likeliest first."""
        self._numbers = 0
        self._looked: Pose2 | None = None

    def clear(self) -> None:
        """There is no doubt any more."""
        self.all, self._looked = [], None

    @property
    def shares(self) -> list[float]:
        """Of each, 0 to 1, together 1."""
        return shares([each.weight for each in self.all])

    def take_in(self, localiser: Localiser, found: Found, weight: float) -> None:
        """Follow a place that was found, unless it is followed already; `localiser` is at that place now."""
        if localiser.pose is None or any(not differ(each.pose, localiser.pose) for each in self.all):
            return
        self._numbers += 1
        self.all.append(Hypothesis(self._numbers, localiser, weight, found.explanation))
        self._sort()

    def late_weight(self, explanation: Explanation, prior: float) -> float:
        """Of a place that is found now: as good as the best one, by how much better or worse it explains the last look."""
        if not self.all:
            return explanation.evidence + prior
        best = self.all[0]
        return best.weight + explanation.evidence - best.explanation.evidence + min(0.0, prior) - LATE

    def predict(self, odom: Pose2) -> None:
        """Move on by the wheels; `odom` is the pose in the odometry's frame."""
        for each in self.all:
            each.localiser.predict(odom)

    def look(self, points: Points, look: Look, odom: Pose2) -> None:
        """Lay a sweep on the map at each of the places, and see which of them explain it."""
        fresh = self._fresh(odom)
        for each in self.all:
            each.localiser.correct(points)
            each.explanation = explained(each.localiser.field, each.pose, look)
        if not self.all or not fresh:
            return
        best = max(each.explanation.evidence for each in self.all)
        for each in self.all:
            each.weight += fresh * max(-20.0, each.explanation.evidence - best)
        self._looked = odom
        self._sort()

    def _fresh(self, odom: Pose2) -> float:
        """How much of what is seen from here has not been counted yet, 0 to 1; nothing while the robot has hardly moved."""
        if self._looked is None:
            self._looked = odom
        moved = self._looked.distance(odom.x, odom.y) / LOOK_APART
        turned = abs(wrap(odom.yaw - self._looked.yaw)) / TURN_APART
        new = min(1.0, math.hypot(moved, turned))
        return new if new > 0.2 else 0.0

    def _sort(self) -> None:
        """Order them, keep of two that have come together the likelier, and drop what is hardly believed."""
        self.all.sort(key=lambda each: -each.weight)
        kept: list[Hypothesis] = []
        for each, share in zip(self.all, self.shares, strict=True):
            if share >= LEAST_SHARE and all(differ(each.pose, other.pose) for other in kept):
                kept.append(each)
        self.all = kept[:MAX_FOLLOWED]


def shares(weights: Sequence[float]) -> list[float]:
    """Of logarithms of likelihoods: what each has of all, 0 to 1."""
    if not weights:
        return []
    best = max(weights)
    parts = [math.exp(weight - best) for weight in weights]
    total = sum(parts)
    return [part / total for part in parts]
