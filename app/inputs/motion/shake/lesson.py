"""The lesson: three movements of three seconds each, measured, and what they say about the one who shook."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from statistics import median

from app.inputs.motion.shake.gravity import GravityFilter, Motion
from app.inputs.motion.shake.spread import Spread, Turning
from app.inputs.motion.shake.tuning import (
    AXES,
    LEAST_GAP,
    LEAST_PEAK,
    MOST_GAP,
    MOST_PEAK,
    USUAL,
    WORDS,
    Axis,
    PersonalAxis,
)
from widgets.core.language import tr, within

__all__ = ["MOVING_TIME", "READY_TIME", "Lesson", "Measured", "measure"]

READY_TIME = 1.2
"""Before each movement the phone is held still for so long [s]."""
MOVING_TIME = 3.0
"""Each is done for so long [s]."""
MAX_TRIES = 3
"""A movement that cannot be used so often is left as it is for anybody."""
MIN_HALF_CYCLES = 3
"""Half cycles that a movement needs."""
MIN_STRAIGHTNESS = 0.62
"""Less straight than this, 1/3 to 1, it was no movement to and fro."""
MAX_ROUNDNESS = 0.55
"""Nor was it if it went more round than this, 0 to 1."""
MAX_COSINE = math.cos(math.radians(35.0))
"""Two movements that are closer than that cannot be told from each other."""
LEAK_TIME = 0.25
"""As in the recogniser [s]."""


@dataclass(frozen=True, slots=True)
class Measured:
    """What one movement came to."""

    own: PersonalAxis | None
    """None where it cannot be used."""
    sentence: str
    """Why not; empty where it can."""


class Lesson:
    """Feed it samples; `axis` says what is to be done now and `doing` whether that has begun."""

    def __init__(self, ask: tuple[Axis, ...] = AXES) -> None:
        self._asked = list(ask)
        self._ground = GravityFilter(USUAL.settling)
        self._since = self._last = math.nan
        self._moved: list[tuple[float, Motion]] = []
        self._tries = 0
        self.own: dict[Axis, PersonalAxis] = {}
        """What is measured so far; a movement that could not be is not in it."""
        self.sentence = ""
        """Why the movement before has to be done again; empty where it need not."""

    @property
    def axis(self) -> Axis | None:
        """The movement that is to be done; None once the lesson is over."""
        return self._asked[0] if self._asked else None

    @property
    def over(self) -> bool:
        """All are measured, or were tried often enough."""
        return not self._asked

    @property
    def doing(self) -> bool:
        """The hand is to move now; before that it is to be still."""
        return not self.over and self.elapsed >= READY_TIME

    @property
    def elapsed(self) -> float:
        """Since this movement was asked for [s]; 0 before the first sample."""
        return self._last - self._since if self._last >= self._since else 0.0

    @property
    def progress(self) -> float:
        """Of all three, 0 to 1."""
        asked = len(self._asked)
        done = min(1.0, self.elapsed / (READY_TIME + MOVING_TIME)) if asked else 0.0
        return 1.0 - (asked - done) / len(AXES)

    def feed(self, t: float, axes: Motion) -> None:
        """One sample of the accelerometer, measured at `t` [s], with gravity [m/s²]."""
        if self.over:
            return
        dt = t - self._last
        self._last = t
        if not 0.0 < dt < 0.5:
            self._since, self._moved = t, []
            return
        motion = self._ground.motion(dt, *axes)
        if self.doing:
            self._moved.append((t, motion))
        if self.elapsed >= READY_TIME + MOVING_TIME:
            self._measured(self._asked[0])

    def _measured(self, axis: Axis) -> None:
        found = measure(axis, self._moved, self.own)
        self._since, self._moved, self.sentence = self._last, [], found.sentence
        self._tries += 1
        if found.own is not None:
            self.own[axis] = found.own
        elif self._tries < MAX_TRIES:
            return
        self._asked.pop(0)
        self._tries, self.sentence = 0, ""


def measure(axis: Axis, moved: list[tuple[float, Motion]], others: dict[Axis, PersonalAxis]) -> Measured:
    """What samples of one movement, with their times [s], say; `others` are those that it must differ from."""
    name = tr(WORDS[axis])
    spread = _spread(moved)
    along = [spread.way[0] * x + spread.way[1] * y + spread.way[2] * z for _, (x, y, z) in moved]
    peaks, times = _halves([t for t, _ in moved], along)
    if len(peaks) < MIN_HALF_CYCLES or median(peaks) < LEAST_PEAK:
        return Measured(None, tr("{name} was too gentle: shake harder, to and fro.").format(name=name))
    gap = median(b - a for a, b in pairwise(times))
    if gap > MOST_GAP:
        return Measured(
            None,
            tr("{name} was too slow: once to and fro takes at most {most_gap:.1f} s.").format(
                name=name, most_gap=2 * MOST_GAP
            ),
        )
    if spread.straight < MIN_STRAIGHTNESS or spread.round > MAX_ROUNDNESS:
        return Measured(None, tr("{name} went round and round: go to and fro on a line.").format(name=name))
    for other, own in others.items():
        if abs(sum(a * b for a, b in zip(spread.way, own.way, strict=True))) > MAX_COSINE:
            return Measured(
                None,
                tr("{name} looked like {words}: do it once more, along another line.").format(
                    name=name, words=within(tr(WORDS[other]))
                ),
            )
    return Measured(PersonalAxis(spread.way, min(median(peaks), MOST_PEAK), max(gap, LEAST_GAP)), "")


def _spread(moved: list[tuple[float, Motion]]) -> Spread:
    """Of the velocity, leaky as in the recogniser."""
    vx = vy = vz = power = 0.0
    sums, turned = [0.0] * 6, [0.0] * 3
    for (before, _), (t, (x, y, z)) in pairwise(moved):
        dt = t - before
        keep = max(0.0, 1.0 - dt / LEAK_TIME)
        vx, vy, vz = vx * keep + x * dt, vy * keep + y * dt, vz * keep + z * dt
        for i, product in enumerate((vx * vx, vy * vy, vz * vz, vx * vy, vx * vz, vy * vz)):
            sums[i] += product * dt
        for i, product in enumerate((vy * z - vz * y, vz * x - vx * z, vx * y - vy * x)):
            turned[i] += product * dt
        power += (x * x + y * y + z * z) * dt
    seconds = moved[-1][0] - moved[0][0] if moved else 0.0
    return Spread(sums, seconds, Turning((turned[0], turned[1], turned[2]), power, LEAK_TIME))


def _halves(times: list[float], values: list[float]) -> tuple[list[float], list[float]]:
    """Peaks of the half cycles [m/s²] and when each began [s]; what counts is a third of the loud ones."""
    loud = sorted(abs(value) for value in values)
    if not loud:
        return [], []
    threshold = max(0.35 * loud[int(0.9 * (len(loud) - 1))], 0.8)
    side, peaks, began = 0, list[float](), list[float]()
    for t, value in zip(times, values, strict=True):
        if (value > threshold and side <= 0) or (value < -threshold and side >= 0):
            side = 1 if value > 0 else -1
            peaks.append(abs(value))
            began.append(t)
        elif side and value * side > peaks[-1]:
            peaks[-1] = value * side
    return peaks, began
