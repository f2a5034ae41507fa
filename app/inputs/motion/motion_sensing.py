"""The motion sensors for all methods at once: on only while somebody listens, looked through for what cannot be, and judged.

forget = sensing.listen("acceleration", shake.feed)     # feed(t, (x, y, z)), in the UI thread
if fault := sensing.health("acceleration", least=25.0).sentence: …
"""

from __future__ import annotations

import logging
import math
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from app.device.motion import GRAVITY, KINDS, Axes, Kind, MotionError, MotionSource
from widgets.core.language import tr

__all__ = ["SILENCE_TIMEOUT", "Fault", "Health", "Judge", "MotionSensing"]

log = logging.getLogger(__name__)

Feed = Callable[[float, Axes], object]
"""Told when a sample was measured [s] and its x, y, z [m/s²]."""
Fault = str
"""`absent`, `refused`, `paused`, `waiting`, `silent`, `broken`, `jumps`, `frozen`, `slow`; empty for none."""

MAX_QUEUE = 256
"""Samples that wait for the UI thread: 2.5 s of two kinds. The oldest make room."""
SILENCE_TIMEOUT = 0.3
"""Without a sample for so long it is silent [s]."""
FIRST_SAMPLE_TIMEOUT = 1.5
"""How long the first sample may take [s]: a phone's fusion begins slowly."""
RATE_WINDOW = 1.0
"""What the rate is counted over [s]."""
FROZEN_TIMEOUT = 1.0
"""The same to the last bit for so long is no hand, and no table either [s]."""
FAULT_TIME = 2.0
"""How long a fault is told after it was last seen [s]."""
MAX_SAMPLE_AGE = 1.0
"""What was measured so long ago is no news [s]: a phone that slept hands it out in one go."""
MAX_SAMPLE_LEAD = 0.5
"""Nothing was measured so far in the future [s]; taken, it would make all that follows old."""
MAX_ACCELERATION = 200.0
"""No phone measures more [m/s²]; most end at 78 or 157."""
MAX_LEAP = {"acceleration": 120.0, "gravity": 10.0}
"""From one sample to the next no hand does that [m/s²]; for gravity that is 60°."""
MAX_DEVIATION = {"acceleration": MAX_ACCELERATION, "gravity": 0.25 * GRAVITY}
"""How far its length may be from 1 g [m/s²]."""


@dataclass(frozen=True, slots=True)
class Health:
    """How one kind of samples comes."""

    fault: Fault = ""
    sentence: str = ""
    """For the operator; empty without a fault."""
    rate: float = math.nan
    """Samples in a second [Hz]; NaN before a second is over."""
    age: float = math.inf
    """Since the last sample came that was handed over, or that waits for it [s]; infinite before the first."""


class Judge:
    """Looks through the samples of one kind, in their order, and tells how they come."""

    def __init__(self, kind: Kind, begun: float) -> None:
        """The sensor was started at `begun` [s]."""
        self._kind, self._begun = kind, begun
        self._times: deque[float] = deque(maxlen=512)
        self._last: tuple[float, Axes] | None = None
        self._leapt: Axes | None = None
        self._heard = -math.inf
        self._same_since = math.nan
        self._seen: dict[Fault, float] = {}

    def add(self, t: float, axes: Axes, now: float, came: float) -> bool:
        """Whether that sample, measured at `t`, which came at `came` [s], may be handed on."""
        if not all(math.isfinite(value) for value in (t, *axes)):
            self._seen["broken"] = now
            return False
        if (
            now - t > MAX_SAMPLE_AGE
            or t - now > MAX_SAMPLE_LEAD
            or (self._last is not None and t <= self._last[0])
        ):
            return False
        if self._jumped(axes):
            self._seen["jumps"] = now
            return False
        if self._last is None or axes != self._last[1]:
            self._same_since = t
        self._last, self._heard = (t, axes), came
        self._times.append(t)
        while self._times[0] < t - RATE_WINDOW:
            self._times.popleft()
        return True

    def _jumped(self, axes: Axes) -> bool:
        """It is longer than can be, or too far from the one before and from the one that was left out for that."""
        length = math.hypot(*axes)
        if length > MAX_ACCELERATION or abs(length - GRAVITY) > MAX_DEVIATION[self._kind]:
            return True
        leap = MAX_LEAP[self._kind]
        known = [other for other in (self._last and self._last[1], self._leapt) if other is not None]
        if known and all(math.dist(axes, other) > leap for other in known):
            self._leapt = axes
            return True
        self._leapt = None
        return False

    @property
    def rate(self) -> float:
        """Samples in a second [Hz] by their own times; NaN while it is not known."""
        times = self._times
        if len(times) < 3 or times[-1] - times[0] < RATE_WINDOW / 2:
            return math.nan
        return (len(times) - 1) / (times[-1] - times[0])

    def health(self, now: float, least: float, waits: float = -math.inf) -> Health:
        """How they come at `now`, for one who needs `least` in a second [Hz].

        `waits` is when the newest came that is yet to be taken [s]; -inf without one.
        """
        heard = max(self._heard, waits)
        fault = self._fault(now, least, heard)
        return Health(fault, self._words(fault, least), self.rate, now - heard)

    def _fault(self, now: float, least: float, heard: float) -> Fault:
        recent = [name for name, at in self._seen.items() if now - at < FAULT_TIME]
        if heard == -math.inf and not recent:
            return "waiting" if now - self._begun < FIRST_SAMPLE_TIMEOUT else "silent"
        if recent:
            return "broken" if "broken" in recent else recent[0]
        if now - heard > SILENCE_TIMEOUT:
            return "silent"
        if self._last is not None and self._last[0] - self._same_since > FROZEN_TIMEOUT:
            return "frozen"
        return "slow" if self.rate < least else ""

    def _words(self, fault: Fault, least: float) -> str:
        name = "motion" if self._kind == "acceleration" else "gravity"
        return {
            "": "",
            "waiting": tr("Waiting for the {name} sensor.").format(name=name),
            "silent": tr("The {name} sensor is silent.").format(name=name),
            "broken": tr("The {name} sensor delivers values that are no numbers.").format(name=name),
            "jumps": tr("The {name} sensor jumps about as no hand can.").format(name=name),
            "frozen": tr("The {name} sensor has stood still for a second.").format(name=name),
            "slow": tr(
                "The {name} sensor delivers {rate:.0f} Hz, and at least {least:.0f} Hz are needed."
            ).format(name=name, rate=self.rate, least=least),
        }[fault]


@dataclass(slots=True)
class _Kind:
    judge: Judge
    feeds: list[Feed] = field(default_factory=list)


class MotionSensing:
    """Owns the source. Everything but the source's own call happens in the UI thread; `update` belongs to the heartbeat."""

    def __init__(self, source: MotionSource, now: Callable[[], float] = time.monotonic) -> None:
        self._source, self._now = source, now
        self._kinds = {kind: _Kind(Judge(kind, now())) for kind in KINDS}
        self._queue: deque[tuple[Kind, float, Axes, float]] = deque(maxlen=MAX_QUEUE)
        """Kind, when it was measured, axes, and when it came [s]."""
        self._came: dict[Kind, float] = {}
        """When the newest of each kind came [s]: a glass that is slow to look makes no sensor silent."""
        self._looked = -math.inf
        self._running: frozenset[Kind] = frozenset()
        self._refused: dict[Kind, str] = {}
        """What the system does not hand out, and why."""
        self._paused = self._closed = False

    @property
    def possible(self) -> bool:
        """There is any sensor."""
        return self._source.possible

    @property
    def sentence(self) -> str:
        """Why there is none; empty where there is one."""
        return self._source.sentence

    def has(self, kind: Kind) -> bool:
        """There is a sensor of that kind."""
        return kind in self._source.kinds

    @property
    def running(self) -> frozenset[Kind]:
        """What is on: empty while nobody listens."""
        return self._running

    def use(self, source: MotionSource) -> None:
        """Listen to another source from now on; the one before is stopped."""
        self._stop()
        self._source = source
        self._fit()

    def listen(self, kind: Kind, feed: Feed) -> Callable[[], None]:
        """Tell `feed` every sample of that kind that can be true; what is returned ends it. The first listener starts the sensor."""
        feeds = self._kinds[kind].feeds
        feeds.append(feed)
        self._fit()

        def forget() -> None:
            if feed in feeds:
                feeds.remove(feed)
                self._fit()

        return forget

    def update(self, now: float | None = None) -> None:
        """Hand on what came since the last look."""
        now = self._now() if now is None else now
        self._looked = now
        for _ in range(len(self._queue)):
            kind, t, axes, came = self._queue.popleft()
            one = self._kinds[kind]
            if kind in self._running and one.judge.add(t, axes, now, came):
                for feed in tuple(one.feeds):
                    feed(t, axes)

    def health(self, kind: Kind, least: float = 25.0, now: float | None = None) -> Health:
        """How samples of that kind come, for one who needs `least` in a second [Hz]; without a fault where nobody asked for them."""
        if kind not in self._source.kinds:
            return Health(
                "absent", self._source.sentence or tr("This device has no {kind} sensor.").format(kind=kind)
            )
        if kind in self._refused:
            return Health("refused", self._refused[kind])
        if self._paused:
            return Health("paused", tr("The sensors rest while the app is in the background."))
        if kind not in self._running:
            return Health()
        came = self._came.get(kind, -math.inf)
        waits = came if came > self._looked else -math.inf
        return self._kinds[kind].judge.health(self._now() if now is None else now, least, waits)

    def pause(self) -> None:
        """The app is in the background: every sensor is off."""
        self._paused = True
        self._fit()

    def resume(self) -> None:
        """It is back."""
        self._paused = False
        self._fit()

    def close(self) -> None:
        """For good: nothing is started again."""
        self._closed = True
        self._fit()

    def _fit(self) -> None:
        """Exactly what is listened to is on, but for what the system refuses: that takes nothing else with it."""
        wanted = frozenset(kind for kind, one in self._kinds.items() if one.feeds and self._source.possible)
        wanted = frozenset() if self._paused or self._closed else wanted & self._source.kinds
        refused = {kind: why for kind, why in self._refused.items() if kind in wanted}
        if wanted == self._running | refused.keys():
            self._refused = refused
            return
        fresh = wanted - self._running
        self._stop()
        if not wanted:
            return
        self._running = self._granted(wanted)
        for kind in fresh & self._running:
            self._kinds[kind].judge = Judge(kind, self._now())

    def _granted(self, wanted: frozenset[Kind]) -> frozenset[Kind]:
        """Start those; where that is refused, as many of them as the system hands out."""
        if self._starts(wanted) is None:
            return wanted
        granted: frozenset[Kind] = frozenset()
        for kind in wanted:
            problem = self._starts(frozenset({kind}))
            if problem is None:
                granted |= {kind}
            else:
                self._refused[kind] = problem
        problem = self._starts(granted) if granted else None
        if problem is None:
            return granted
        self._refused.update(dict.fromkeys(granted, problem))
        return frozenset()

    def _starts(self, kinds: frozenset[Kind]) -> str | None:
        """None where they tell from now on, else why not: then nothing does."""
        try:
            self._source.start(kinds, self._hear)
        except MotionError as problem:
            log.warning("%s", problem)
            self._source.stop()
            return str(problem)
        return None

    def _stop(self) -> None:
        self._source.stop()
        self._queue.clear()
        self._came.clear()
        self._running = frozenset()
        self._refused.clear()

    def _hear(self, kind: Kind, t: float, axes: Axes) -> None:
        """In any thread; neither a deque's own append nor a dict's needs a lock."""
        came = self._now()
        self._queue.append((kind, t, axes, came))
        self._came[kind] = came
