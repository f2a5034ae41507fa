"""Tells a deliberate shake, and along which direction, from everything else that moves a phone; a stream of samples goes in.

    recogniser = Recogniser()
    shake = recogniser.feed(t, (x, y, z))      # of the accelerometer, gravity included; None, or what was understood

Half cycles along each direction, and between them, are counted; the velocity of the burst says which direction it was, since an arc and
the lean of a swinging hand are in the acceleration more than in it. Left-right, which is STOP, is told inside the gesture; the
others when the burst is over, so that the first steps of a run are no command. Nothing is trained and nothing is learned.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from app.inputs.motion.shake.gravity import GravityFilter, Motion
from app.inputs.motion.shake.half_cycles import HalfCycles
from app.inputs.motion.shake.shake_axes import lines
from app.inputs.motion.shake.spread import Spread, Turning
from app.inputs.motion.shake.tuning import AXES, USUAL, Axis, Tuning

__all__ = ["MIN_RATE", "Recogniser", "Shake"]

MIN_RATE = 25.0
"""Samples in a second that are needed [Hz]."""
BLOCK_TIME = 0.08
"""The movement is judged so often [s]."""
WARM_UP_TIME = 2.0
"""Nothing is understood before the background is known for so long [s]."""
HISTORY_TIME = 10.0
"""For so long blocks are kept [s]."""
BACKGROUND_TIME = 6.0
"""The background is what was in this time [s]."""
RECENT_TIME = 0.4
"""And not in this: the burst may have begun [s]."""
MAX_GAP = 0.5
"""After so long without a sample everything begins anew [s]."""
MAX_PEAK = 12.0
"""The loudest block of a burst counts for no more where its end is looked for [m/s²]."""
FAINT_PEAK = 0.8
"""A burst has ended below this in any case [m/s²]."""
LEAD_TIME = 0.16
"""A burst began so long before it was seen to [s]."""
SURE_AT = 2.0
"""Half cycles and evidence of so many times what is needed are as sure as can be."""
WEIGHTLESS, FALLING = 1.5, 0.2
"""What weighs no more [m/s²] for so long [s] falls: it is caught or it bounces, and neither is a command."""
STEP_PEAK = 8.0
"""From here on what goes up and down may be somebody who begins to run [m/s², mean of the peaks]."""
ASLANT, ASLANT_SPEED = 2.0, 0.45
"""Left-right is aslant below so many times up-down, squared, and is then none below that speed [m/s]: who sets off swings so."""
TURNED, TURNED_TIME, TURNED_DOUBTS = math.radians(35.0), 5.5, 2
"""Gravity that turned by so much [rad] within so long [s] wants so many half cycles more."""
ALL_ALONG = 0.78
"""A shake is to and fro for so much of its burst; what became so only later wants one more."""
SURE_OUTRUN = 2.3
SURE_SPEED = 0.4
"""And so does what is not so many times as fast as the background, and what is slower than that [m/s]."""
STRONG_PEAK = 12.0
"""Mean peak of a strong shake [m/s²]: nobody carries a phone about like that."""


@dataclass(frozen=True, slots=True)
class Shake:
    """What was understood."""

    axis: Axis
    began: float
    """When the burst began [s, clock of the samples]."""
    told: float
    """When it was known [s]."""
    ended: bool
    """The burst is over; False for left-right, told while the hand still moves."""
    confidence: float
    """0 to 1: how far beyond what is needed it was, and how straight."""
    peak: float
    """Mean of the half cycles' peaks [m/s²]."""
    count: int
    """Half cycles."""


Products = tuple[float, float, float, float, float, float]
"""xx, yy, zz, xy, xz, yz."""


class _Block(NamedTuple):
    at: float
    loud: float
    """Root of the mean square [m/s²]."""
    sums: Products
    """Of the velocity [m²/s²·s]."""
    seconds: float
    turn: Motion
    """Of the velocity towards the acceleration, their cross product [m²/s³·s]."""
    gravity: Motion
    """As it was followed, axes of the device, of length 1."""


@dataclass(slots=True)
class _Background:
    """What was before the burst."""

    level: float
    loud: float
    """Acceleration: median of the blocks, and the loud ones [m/s²]."""
    speed: float
    """Median over all directions [m/s]."""
    mean: tuple[float, ...]
    """Products of the velocity a second [m²/s²]."""


@dataclass(frozen=True, slots=True)
class _Best:
    count: int
    evidence: float
    mean: float
    since: float
    """When the first of them began [s]."""


class _Burst:
    """A movement above the background, since `began`."""

    def __init__(self, began: float, loud: float) -> None:
        self.began, self.peak = began, loud
        self.calm = math.nan
        self.told = False
        self.best: dict[int, _Best] = {}
        """Of each direction whose half cycles suffice: the most so far."""
        self.soft = True
        """No step or bound is in it."""


class Recogniser:
    """Everything happens in `feed`: a few microseconds, and some tens each 0.08 s."""

    def __init__(self, tuning: Tuning = USUAL, any_shake: bool = False) -> None:
        """With `any_shake` a strong one along any direction is told at once, as left-right is."""
        self._tuning, self.any_shake = tuning, any_shake
        self._begun = self._last = math.nan
        self._anew()

    def _anew(self) -> None:
        tuning = self._tuning
        self._ground = GravityFilter(tuning.settling)
        self._lines = lines(tuning)
        self._halves = [HalfCycles(line.threshold, line.gap, tuning.cap) for line in self._lines]
        self._blocks: deque[_Block] = deque(maxlen=int(HISTORY_TIME / BLOCK_TIME))
        self._velocity = [0.0, 0.0, 0.0]
        self._sums = [0.0] * 10
        self._count = 0
        self._block_since = math.nan
        self._background: _Background | None = None
        self._burst: _Burst | None = None
        self._light_since = self._fell = -math.inf

    @property
    def busy(self) -> bool:
        """Something stands out from the background just now."""
        return self._burst is not None

    def feed(self, t: float, axes: Motion) -> Shake | None:
        """One sample, measured at `t` [s], with gravity [m/s², axes of the device]; what cannot be is passed over."""
        dt = t - self._last
        if -MAX_GAP < dt <= 0.0 or not math.isfinite(axes[0] + axes[1] + axes[2] + t):
            return None
        self._last = t
        if not 0.0 < dt < MAX_GAP:
            self._anew()
            self._begun = self._block_since = t
            self._ground.motion(1e-6, *axes)
            return None
        if axes[0] * axes[0] + axes[1] * axes[1] + axes[2] * axes[2] > WEIGHTLESS * WEIGHTLESS:
            self._light_since = t
        elif t - self._light_since > FALLING:
            self._fell = t
        motion = self._ground.motion(dt, *axes)
        self._add(dt, *motion)
        x, y, z = motion
        for line, halves in zip(self._lines, self._halves, strict=True):
            a, b, c = line.way
            halves.feed(t, a * x + b * y + c * z)
        return self._judge(t) if t - self._block_since >= BLOCK_TIME else None

    def _add(self, dt: float, x: float, y: float, z: float) -> None:
        """To the block that is under way."""
        keep = max(0.0, 1.0 - dt / self._tuning.leak)
        velocity, sums = self._velocity, self._sums
        vx = velocity[0] = velocity[0] * keep + x * dt
        vy = velocity[1] = velocity[1] * keep + y * dt
        vz = velocity[2] = velocity[2] * keep + z * dt
        sums[0] += vx * vx
        sums[1] += vy * vy
        sums[2] += vz * vz
        sums[3] += vx * vy
        sums[4] += vx * vz
        sums[5] += vy * vz
        sums[6] += x * x + y * y + z * z
        sums[7] += vy * z - vz * y
        sums[8] += vz * x - vx * z
        sums[9] += vx * y - vy * x
        self._count += 1

    def _judge(self, t: float) -> Shake | None:
        count, sums, seconds = self._count, self._sums, t - self._block_since
        share = seconds / count
        xx, yy, zz, xy, xz, yz = (value * share for value in sums[:6])
        loud = math.sqrt(sums[6] / count)
        self._blocks.append(
            _Block(
                t,
                loud,
                (xx, yy, zz, xy, xz, yz),
                seconds,
                (sums[7] * share, sums[8] * share, sums[9] * share),
                self._ground.upward,
            )
        )
        self._sums, self._count, self._block_since = [0.0] * 10, 0, t
        self._look_back(t)
        if self._background is None or t - self._begun < WARM_UP_TIME:
            return None
        return self._decide(t, loud, self._background)

    def _look_back(self, t: float) -> None:
        """The background as it was before the burst; one that lasts becomes the background itself: a jogger's."""
        burst = self._burst
        if burst is not None and t - burst.began <= 4.0:
            return
        until = t - (RECENT_TIME if burst is None else 1.5)
        blocks = [block for block in self._blocks if t - BACKGROUND_TIME <= block.at <= until]
        if len(blocks) <= 10:
            self._background = None
            return
        tuning = self._tuning
        louds = sorted(block.loud for block in blocks)
        speeds = sorted(sum(block.sums[:3]) / block.seconds for block in blocks)
        seconds = sum(block.seconds for block in blocks)
        mean = tuple(sum(column) / seconds for column in zip(*(block.sums for block in blocks), strict=True))
        middle = len(blocks) // 2
        level = louds[middle]
        self._background = _Background(
            level, louds[int(len(louds) * tuning.loud)], math.sqrt(speeds[middle]), mean
        )
        for line, halves in zip(self._lines, self._halves, strict=True):
            halves.threshold = max(line.threshold, tuning.raised * level)

    # what it comes to

    def _decide(self, t: float, loud: float, background: _Background) -> Shake | None:
        tuning, burst = self._tuning, self._burst
        if burst is None:
            if loud <= max(tuning.begins, tuning.begins_above * background.level):
                return None
            burst = self._burst = _Burst(t, loud)
            for halves in self._halves:
                halves.begin(t)
        burst.peak = max(burst.peak, loud)
        self._note(burst, background)
        shake = None
        if not burst.told and t - burst.began <= tuning.stop_within:
            shake = self._inside(t, burst, background)
        return shake or self._after(t, burst, background)

    def _note(self, burst: _Burst, background: _Background) -> None:
        burst.soft = self._halves[1].mean < STEP_PEAK
        for line, halves in zip(self._lines, self._halves, strict=True):
            for i in line.counts_for:
                way = self._tuning.ways[i]
                if halves.count < way.halves or halves.evidence < way.evidence:
                    continue
                if halves.period < way.hasty and halves.mean < way.hard:
                    continue
                if halves.mean >= max(way.above * background.level, way.beyond * background.loud):
                    best = burst.best.get(i)
                    if best is None or halves.evidence > best.evidence:
                        mean = max(halves.mean, best.mean if best else 0.0)
                        burst.best[i] = _Best(halves.count, halves.evidence, mean, halves.since)

    def _inside(self, t: float, burst: _Burst, background: _Background) -> Shake | None:
        """STOP does not wait for the end."""
        tuning = self._tuning
        if 0 in burst.best and self._halves[0].count:
            spread = self._spread(max(burst.began - LEAD_TIME, self._halves[0].since - 0.25), t, background)
            scores = self._scores(spread, burst)
            fits = _fits(tuning, 0, spread, scores, background)
            clear = scores[0] >= tuning.ahead * max(scores[1:])
            if fits and clear and self._enough(t, self._halves[0], burst, spread, background):
                return self._told(0, t, burst, spread, scores)
        if self.any_shake:
            strong = [i for i, best in burst.best.items() if best.mean >= STRONG_PEAK]
            if strong:
                spread = self._spread(burst.began - LEAD_TIME, t, background)
                scores = self._scores(spread, burst)
                return self._told(max(strong, key=scores.__getitem__), t, burst, spread, scores)
        return None

    def _after(self, t: float, burst: _Burst, background: _Background) -> Shake | None:
        tuning = self._tuning
        limit = max(tuning.ends * min(burst.peak, MAX_PEAK), tuning.ends_above * background.level, FAINT_PEAK)
        if t - burst.began < tuning.quiet:
            return None
        lately = [block.loud for block in self._blocks if block.at > t - tuning.quiet]
        mean = math.sqrt(sum(loud * loud for loud in lately) / len(lately))
        if max(lately) >= limit and mean >= tuning.as_before * background.level:
            return None
        burst.calm = t - tuning.quiet
        self._burst = None
        for halves in self._halves:
            halves.forget()
        if burst.told or burst.calm - burst.began > tuning.longest:
            return None
        spread = self._spread(burst.began - LEAD_TIME, burst.calm, background)
        scores = self._scores(spread, burst)
        i = max(range(3), key=scores.__getitem__)
        if i not in burst.best or not _fits(tuning, i, spread, scores, background):
            return None
        if i == 0 and not self._enough(burst.calm, burst.best[0], burst, spread, background):
            return None
        if i and (background.level > tuning.rough or self._fell > burst.began - LEAD_TIME):
            return None
        return self._told(i, t, burst, spread, scores, ended=True)

    def _spread(self, since: float, until: float, background: _Background) -> Spread:
        """Of the velocity between two instants, less the background's."""
        blocks = [block for block in self._blocks if since <= block.at <= until]
        seconds = sum(block.seconds for block in blocks)
        taken = seconds * self._tuning.without
        left = [
            sum(block.sums[i] for block in blocks) - taken * mean for i, mean in enumerate(background.mean)
        ]
        left[:3] = (max(value, 1e-4) for value in left[:3])
        power = sum(block.loud * block.loud * block.seconds for block in blocks)
        x, y, z = (sum(block.turn[i] for block in blocks) for i in range(3))
        turning = Turning((x, y, z), power - taken * background.level * background.level, self._tuning.leak)
        return Spread(left, seconds, turning)

    def _scores(self, spread: Spread, burst: _Burst) -> list[float]:
        """How much of it each direction has; of up-down less where that makes it left-right."""
        tuning = self._tuning
        scores = [(way.weight * spread.along(way.way)) ** 2 for way in tuning.ways]
        upward = scores[1] * (tuning.softly if burst.soft else 1.0)
        if scores[0] > max(upward, scores[2]):
            scores[1] = upward
        elif burst.soft:
            scores[1] *= tuning.gently
        return scores

    def _enough(
        self, t: float, run: HalfCycles | _Best, burst: _Burst, spread: Spread, background: _Background
    ) -> bool:
        """Left-right has as many half cycles as there are doubts, of which each wants one more."""
        tuning = self._tuning
        way, upward = tuning.ways[0], tuning.ways[1]
        speed, rise = spread.along(way.way), spread.along(upward.way)
        aslant = speed * speed < ASLANT * rise * rise
        if aslant and speed < ASLANT_SPEED:
            return False
        doubts = sum(
            (
                TURNED_DOUBTS * (_turned(self._blocks, self._ground.upward, t) > TURNED),
                t - run.since + 0.25 < ALL_ALONG * (t - burst.began + LEAD_TIME),
                aslant,
                speed < SURE_OUTRUN * background.speed,
                speed < SURE_SPEED,
            )
        )
        return run.count >= way.halves + doubts and run.evidence >= way.evidence * (1.0 + doubts / way.halves)

    def _told(
        self, i: int, t: float, burst: _Burst, spread: Spread, scores: list[float], ended: bool = False
    ) -> Shake:
        burst.told = True
        way, best = self._tuning.ways[i], burst.best[i]
        much = min(1.0, best.evidence / way.evidence / SURE_AT)
        confidence = math.sqrt(much * min(1.0, spread.straight) * scores[i] / (sum(scores) or 1.0))
        return Shake(AXES[i], burst.began - LEAD_TIME, t, ended, confidence, best.mean, best.count)


def _fits(tuning: Tuning, i: int, spread: Spread, scores: list[float], background: _Background) -> bool:
    """It is straight enough, fast enough, and enough of it lies along that direction."""
    way = tuning.ways[i]
    if spread.straight < way.straight or scores[i] < way.share * sum(scores):
        return False
    if spread.round > min(tuning.round, tuning.round_of_pace * spread.pace):
        return False
    return spread.along(way.way) >= max(way.speed, way.outrun * background.speed)


def _turned(blocks: Iterable[_Block], now: Motion, t: float) -> float:
    """How far gravity is from where it was at any time of late [rad]: a pocket, or a hand that fetches the phone."""
    before = (block.gravity for block in blocks if t - block.at <= TURNED_TIME)
    least = min((sum(a * b for a, b in zip(now, up, strict=True)) for up in before), default=1.0)
    return math.acos(max(-1.0, min(1.0, least)))
