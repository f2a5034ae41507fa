"""Thresholds of the recogniser of shakes, those of one person, and how they are kept in the settings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

from app.core.checked_settings import number
from app.inputs.motion.shake.gravity import Motion
from widgets.core.language import mark, tr, within

__all__ = [
    "AXES",
    "LEAST_GAP",
    "LEAST_PEAK",
    "MOST_GAP",
    "MOST_PEAK",
    "USUAL",
    "WORDS",
    "Axis",
    "PersonalAxis",
    "Tuning",
    "Way",
    "fitted",
    "own_from",
    "own_to",
]

Axis = Literal["lr", "ud", "fb"]
"""Left-right, up-down, forward-back."""
AXES: tuple[Axis, ...] = get_args(Axis)
WORDS: dict[Axis, str] = {"lr": mark("Left-right"), "ud": mark("Up-down"), "fb": mark("Forward-back")}


@dataclass(frozen=True, slots=True)
class Way:
    """What counts along one of the three directions."""

    way: Motion
    """Its direction, of length 1: right, up, forward."""
    threshold: float
    """A half cycle counts from here on [m/s²]."""
    gap: float
    """Two of them come no farther apart [s]."""
    halves: int
    """At least so many."""
    evidence: float
    """At least so much: each gives its peak over the threshold, up to a cap."""
    above: float
    """The mean peak is so many times the background."""
    beyond: float
    """The same of what is loud in the background."""
    speed: float
    """At least so fast, root of the mean square [m/s]: a step or a knock is hard and yet moves the phone hardly at all."""
    outrun: float
    """The speed is so many times that of the background."""
    weight: float
    """Of its speed where the directions are compared: up and down is more than it seems, since a hand that swings leans the phone."""
    share: float
    """At least so much of the movement, 0 to 1."""
    straight: float
    """Least share of the direction with most of it, 1/3 to 1: a circle has a half, and one that is drawn long and thin has more."""
    hasty: float = 0.0
    """Half cycles that follow each other quicker than that [s] are not how this person shakes,"""
    hard: float = 0.0
    """and count only where the mean of their peaks is so much [m/s²]: steps are quick, and who is frightened shakes hard."""
    own: bool = False
    """It is where one person's hand goes, and not where anybody's may."""


@dataclass(frozen=True, slots=True)
class Tuning:
    """What all three share, and the three. Found on the recordings of five people and on others made of them (`python -m bench shake`)."""

    ways: tuple[Way, ...]
    """Left-right, up-down, forward-back."""
    settling: float = 0.9
    """Time constant of gravity [s]."""
    leak: float = 0.25
    """Time constant with which velocity is forgotten [s]."""
    cap: float = 1.7
    """Most that one half cycle is evidence for."""
    raised: float = 1.2
    """No half cycle counts below so many times the background."""
    loud: float = 0.85
    """The quantile of the background that is called loud."""
    without: float = 0.7
    """Share of the background's velocity that is taken off, 0 to 1."""
    round: float = 0.55
    """Most that a movement may go round, 0 to 1, however quick: an ellipse a quarter as wide as long."""
    round_of_pace: float = 0.065
    """And so much of its pace [s]: who draws a circle is slower than who shakes, so that what is slow has to be the purer for it."""
    ahead: float = 1.0
    """For STOP left-right is so many times either other direction, squared."""
    softly: float = 0.51
    """Beside left-right so much of up-down is counted where nothing in it is as hard as a step: the benefit of the doubt is STOP's."""
    gently: float = 0.85
    """And so much beside forward-back."""
    aslant: float = 1.25
    """Half cycles along a line between two directions count from so many times the threshold on."""
    begins: float = 2.0
    """A burst begins above this [m/s², root of the mean square over a block]."""
    begins_above: float = 2.3
    """And above so many times the background."""
    ends: float = 0.3
    """It ends below this share of its loudest block, which counts for 12 m/s² at most."""
    ends_above: float = 1.6
    """Or below so many times the background."""
    as_before: float = 1.4
    """Or where the mean is below so many times the background: who walked walks on."""
    quiet: float = 0.35
    """For so long [s]."""
    longest: float = 3.25
    """A burst that took longer is a jog, a drive or a dance [s]."""
    stop_within: float = 1.9
    """Nor is STOP meant so long after it began [s]."""
    rough: float = 6.0
    """Above this background nothing but STOP is understood [m/s²]."""


@dataclass(frozen=True, slots=True)
class PersonalAxis:
    """How one person does one of the three, as the lesson measured it."""

    way: Motion
    """Where it goes, of length 1: right, up, forward."""
    peak: float
    """Median of its half cycles' peaks [m/s²]."""
    gap: float
    """Median time between two of them [s]."""


# the evidence of one half cycle is its peak over the threshold, so that four gentle ones count like three strong ones
_LEFT_RIGHT = Way((1.0, 0.0, 0.0), 2.3, 0.75, 3, 4.05, 1.8, 0.7, 0.24, 1.7, 1.0, 0.35, 0.62)
_UP_DOWN = Way((0.0, 1.0, 0.0), 2.5, 0.75, 3, 4.2, 2.2, 1.2, 0.2, 2.0, 1.4, 0.5, 0.77)
_FORWARD_BACK = Way((0.0, 0.0, 1.0), 2.7, 0.8, 3, 4.0, 2.2, 1.2, 0.2, 2.0, 1.0, 0.5, 0.7)
USUAL = Tuning((_LEFT_RIGHT, _UP_DOWN, _FORWARD_BACK))
"""For anybody."""

LEAST_PEAK, MOST_PEAK = 2.5, 60.0
"""What a lesson may have measured [m/s²]."""
LEAST_GAP, MOST_GAP = 0.1, 1.2
"""[s]"""
GENTLE_SHARE = 1.0
"""A threshold below so much of the usual one is gentle."""
SLOW_HALF_CYCLE = 0.7
"""Half a cycle that takes longer is slow [s]."""
MIN_SLOW_PACE = 0.35
"""Who goes slowly goes far, and so no slower than this [m/s]; somebody who walks sways by less."""
CLOSE, TRUE = 0.58, 0.75
"""Whose line is known stays closer to it, and straighter, than anybody does: what the lesson loosens elsewhere is made up for."""
HASTY, HARD = 0.6, 2.0
"""Of the person's own gap, and of the usual threshold."""
SWUNG_WEIGHT = 1.4
"""Weight of up-down where the person's own directions are known."""
MAX_BURST = 9.0
"""No burst of anybody's is longer [s]."""


def fitted(tuning: Tuning, own: Mapping[Axis, PersonalAxis]) -> Tuning:
    """The same for one person; what the lesson did not measure stays as it is."""
    if not own:
        return tuning
    ways = tuple(_fitted(way, own.get(axis)) for axis, way in zip(AXES, tuning.ways, strict=True))
    slow = max(one.gap for one in own.values())
    return replace(
        tuning,
        ways=ways,
        settling=max(tuning.settling, 1.6 * slow),
        leak=max(tuning.leak, 0.5 * slow),
        longest=max(tuning.longest, min(7.5 * slow, MAX_BURST)),
        stop_within=max(tuning.stop_within, min(7.5 * slow, MAX_BURST)),
        quiet=max(tuning.quiet, min(0.65 * slow, 0.7)),
        begins=min(tuning.begins, 0.6 * min(way.threshold for way in ways)),
    )


def _fitted(way: Way, own: PersonalAxis | None) -> Way:
    if own is None:
        return way
    threshold = min(max(0.5 * own.peak, 1.6), 1.5 * way.threshold)
    found = replace(
        way,
        way=own.way,
        threshold=threshold,
        gap=min(max(1.75 * own.gap, 0.6), 1.7),
        weight=SWUNG_WEIGHT if way.weight > 1.0 else 1.0,
        outrun=way.outrun + 0.2,
        share=max(way.share, CLOSE),
        straight=max(way.straight, TRUE),
        hasty=HASTY * own.gap,
        hard=HARD * way.threshold,
        own=True,
    )
    if threshold >= GENTLE_SHARE * way.threshold and own.gap <= SLOW_HALF_CYCLE:
        return found
    # what is gentle or slow is like much else that a phone is moved by: it has to be the purer for it
    return replace(
        found,
        halves=way.halves + 1,
        evidence=way.evidence + 0.8,
        share=max(way.share, 0.62),
        straight=max(way.straight, 0.84),
        above=way.above + 0.6,
        speed=MIN_SLOW_PACE if own.gap > SLOW_HALF_CYCLE else way.speed,
        outrun=way.outrun + 1.0,
    )


def own_to(own: Mapping[Axis, PersonalAxis]) -> dict[str, Any]:
    """What a lesson measured, for the settings."""
    return {axis: {"way": list(one.way), "peak": one.peak, "gap": one.gap} for axis, one in own.items()}


def own_from(kept: object) -> dict[Axis, PersonalAxis]:
    """What the settings say; ValueError with one sentence for what cannot be."""
    if not isinstance(kept, Mapping):
        sentence = tr("What the lesson of shaking measured is a table, not {kept}.")
        raise ValueError(sentence.format(kept=repr(str(kept)[:40])))  # noqa: TRY004 - the file is wrong, not the program
    return {axis: _own(axis, kept[axis]) for axis in AXES if axis in kept}


def _own(axis: Axis, kept: object) -> PersonalAxis:
    name = within(tr(WORDS[axis]))
    if not isinstance(kept, Mapping) or not isinstance(kept.get("way"), list) or len(kept["way"]) != 3:
        raise ValueError(
            tr("What the lesson measured of {name} is a way of three numbers, a peak and a gap.").format(
                name=name
            )
        )
    peak, gap = _number(kept.get("peak")), _number(kept.get("gap"))
    x, y, z = (_number(value) for value in kept["way"])
    length = math.sqrt(x * x + y * y + z * z)
    if not 0.9 < length < 1.1:
        raise ValueError(
            tr("The way of {name} has a length of 1, not {length:.3g}.").format(name=name, length=length)
        )
    if not LEAST_PEAK <= peak <= MOST_PEAK:
        raise ValueError(
            tr("The peak of {name} is {least_peak:g} to {most_peak:g} m/s², not {peak:.3g}.").format(
                name=name, least_peak=LEAST_PEAK, most_peak=MOST_PEAK, peak=peak
            )
        )
    if not LEAST_GAP <= gap <= MOST_GAP:
        raise ValueError(
            tr("The gap of {name} is {least_gap:g} to {most_gap:g} s, not {gap:.3g}.").format(
                name=name, least_gap=LEAST_GAP, most_gap=MOST_GAP, gap=gap
            )
        )
    return PersonalAxis((x / length, y / length, z / length), peak, gap)


def _number(value: object) -> float:
    found = number(value, -1e6, 1e6)
    return math.nan if found is None else found
