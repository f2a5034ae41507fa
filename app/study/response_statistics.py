"""Statistics of the response log: success with its interval, response times with their spread, false activations, presses.

Pure arithmetic on `app.study.response_log.Response`; nothing here knows a screen.
"""

from __future__ import annotations

import math
import statistics
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from app.study.response_log import Response

__all__ = [
    "PAPER",
    "FalseActivations",
    "Rate",
    "Spread",
    "counts",
    "false_activations",
    "presses",
    "rates",
    "seconds",
    "spread",
    "times",
    "used_well",
    "wilson",
    "wrong",
]

PAPER = {"button": 1.0, "voice": 0.775, "shake": 0.625}
"""Share recognised in the paper of the patrol robot, each command triggered ten times."""
Z95 = 1.959964
"""Of the normal distribution, 95 % two-sided."""
MAX_RESPONSE_TIME = 60.0
"""A time beyond is no response any more: the app was paused, or somebody went away [s]."""


@dataclass(frozen=True, slots=True)
class Rate:
    """So many of so many, with Wilson's interval at 95 %."""

    hits: int
    trials: int

    @property
    def share(self) -> float:
        """0 to 1; NaN without trials."""
        return self.hits / self.trials if self.trials else math.nan

    @property
    def interval(self) -> tuple[float, float]:
        """Low and high end, 0 to 1."""
        return wilson(self.hits, self.trials)


@dataclass(frozen=True, slots=True)
class Spread:
    """Of a handful of times [s]."""

    count: int
    median: float
    low: float
    """A quarter is quicker."""
    high: float
    """A quarter is slower."""
    mean: float
    deviation: float
    """Of a sample; 0 for one alone."""


@dataclass(frozen=True, slots=True)
class FalseActivations:
    """Commands that nobody meant."""

    count: int
    hours: float
    """That the method was listening."""

    @property
    def hourly(self) -> float:
        """NaN while it has not listened for a minute: nothing can be said then."""
        return self.count / self.hours if self.hours >= 1 / 60 else math.nan


def wilson(hits: int, trials: int, z: float = Z95) -> tuple[float, float]:
    """Wilson's score interval of `hits` in `trials`; (0, 1) without trials. ValueError for more hits than trials.

    Wilson 1927, JASA 22: centre (p + z²/2n) / (1 + z²/n), half width z √(p(1-p)/n + z²/4n²) / (1 + z²/n).
    """
    if not 0 <= hits <= trials:
        raise ValueError(f"{hits} of {trials} is no share: 0 to {trials} of them may be hits")
    if not trials:
        return 0.0, 1.0
    share, widened = hits / trials, 1 + z * z / trials
    centre = (share + z * z / (2 * trials)) / widened
    half = z * math.sqrt(share * (1 - share) / trials + z * z / (4 * trials * trials)) / widened
    return max(0.0, centre - half), min(1.0, centre + half)


def spread(values: Iterable[float]) -> Spread | None:
    """Median, quartiles, mean and deviation; None without values."""
    sorted_ = sorted(values)
    if not sorted_:
        return None
    low, median, high = (_quantile(sorted_, share) for share in (0.25, 0.5, 0.75))
    deviation = statistics.stdev(sorted_) if len(sorted_) > 1 else 0.0
    return Spread(len(sorted_), median, low, high, statistics.fmean(sorted_), deviation)


def _quantile(values: Sequence[float], share: float) -> float:
    """Between two of sorted `values`, linearly (type 7 of Hyndman and Fan)."""
    place = share * (len(values) - 1)
    index = min(int(place), len(values) - 2) if len(values) > 1 else 0
    after = values[min(index + 1, len(values) - 1)]
    return values[index] + (after - values[index]) * (place - index)


def _commands(responses: Iterable[Response]) -> Iterable[Response]:
    return (one for one in responses if one.kind == "command")


def _prompted(responses: Iterable[Response]) -> Iterable[Response]:
    return (one for one in _commands(responses) if one.prompt_id and one.intended)


def rates(responses: Iterable[Response], *, by_command: bool = False) -> dict[tuple[str, str], Rate]:
    """Share of prompts whose first answer was what was prompted, by method and command; by ("method", "") without `by_command`.

    The first answer counts, as it would have been acted upon; one that was not understood at all is a miss.
    """
    trials: Counter[tuple[str, str]] = Counter()
    hits: Counter[tuple[str, str]] = Counter()
    seen: set[tuple[str, str]] = set()
    for one in _prompted(responses):
        if (one.session, one.prompt_id) in seen:
            continue
        seen.add((one.session, one.prompt_id))
        key = one.method, one.intended if by_command else ""
        trials[key] += 1
        hits[key] += one.recognised == one.intended
    return {key: Rate(hits[key], count) for key, count in trials.items()}


def wrong(responses: Iterable[Response]) -> dict[str, Rate]:
    """Share of prompts that were answered by another command than the prompted one, by method: worse than none."""
    trials: Counter[str] = Counter()
    hits: Counter[str] = Counter()
    for one in _prompted(responses):
        trials[one.method] += 1
        hits[one.method] += bool(one.recognised) and one.recognised != one.intended
    return {method: Rate(hits[method], count) for method, count in trials.items()}


def used_well(responses: Iterable[Response], *, by_command: bool = False) -> dict[tuple[str, str], Rate]:
    """Outside of the study, where nobody knows what was meant: share that was done and not taken back again."""
    trials: Counter[tuple[str, str]] = Counter()
    hits: Counter[tuple[str, str]] = Counter()
    for one in _commands(responses):
        if one.prompt_id or not one.recognised:
            continue
        key = one.method, one.recognised if by_command else ""
        trials[key] += 1
        hits[key] += not one.undo and not one.rejected and one.outcome not in ("refused", "no_reply")
    return {key: Rate(hits[key], count) for key, count in trials.items()}


def seconds(one: Response, until: str = "sent") -> float:
    """From the begin of the input until the command was `sent`, the robot's `ack`, or the `effect` [s]; NaN where unknown.

    Where nothing was sent, as in a study without a robot, `sent` means until it was decided.
    """
    ends = {
        "sent": one.t_sent if one.t_sent is not None else one.t_decided,
        "ack": one.t_ack,
        "effect": one.t_effect,
    }
    end = ends[until]
    if one.t_input_start is None or end is None:
        return math.nan
    took = end - one.t_input_start
    return took if 0 <= took <= MAX_RESPONSE_TIME else math.nan


def times(responses: Iterable[Response], until: str = "sent") -> dict[tuple[str, str], Spread]:
    """Response times by command and method: of what was recognised, and in the study recognised rightly."""
    found: defaultdict[tuple[str, str], list[float]] = defaultdict(list)
    for one in _commands(responses):
        if not one.recognised or one.rejected or (one.intended and one.intended != one.recognised):
            continue
        took = seconds(one, until)
        if math.isfinite(took):
            found[one.recognised, one.method].append(took)
    return {key: made for key, values in found.items() if (made := spread(values)) is not None}


def false_activations(responses: Iterable[Response]) -> dict[str, FalseActivations]:
    """Commands nobody meant, by method: in the study what came unprompted, outside of it what was taken back."""
    listening: defaultdict[str, float] = defaultdict(float)
    count: Counter[str] = Counter()
    for one in responses:
        if one.kind == "armed":
            listening[one.method] += one.seconds or 0.0
        elif one.kind == "command" and one.recognised:
            in_study = one.posture and one.user
            count[one.method] += bool(in_study and not one.intended) or (not in_study and one.undo)
    return {
        method: FalseActivations(count[method], listening[method] / 3600)
        for method in sorted({*listening, *(name for name, some in count.items() if some)})
    }


def presses(responses: Iterable[Response]) -> float:
    """Mean presses of switches for a selection; NaN without any."""
    pressed = [one.presses for one in responses if one.presses is not None and one.presses > 0]
    return statistics.fmean(pressed) if pressed else math.nan


def counts(responses: Iterable[Response]) -> Counter[str]:
    """How often each command was given, by whatever method: what scanning puts into cheap places."""
    return Counter(one.recognised for one in _commands(responses) if one.recognised and not one.undo)
