"""Recall of the shake recogniser, and its false alarms.

A trial is 4 s of a hand that holds still, or of a recorded walk with the phone in the hand, 2.25 cycles cut out of a recorded
take, and 1.5 s without; the first thing understood counts. Takes slower than 0.8 Hz are left out: they are waves. `others` are the same
people by other bodies: askew, in arcs, by the other hand, at half to nearly double the tempo, beginning within 0.1 to 0.8 s, held
still or walking. A lesson is the app's own, all three movements one after the other, in the first take of each of a person; the trials
are then cut from that person's other takes. Negatives are whole recordings one after the other, each with a fresh recogniser, and
starts: a person stands, walks or runs for 12 s, and stands, beginning and ending within 0.1 to 1.5 s. What is made of recordings is put
away into pockets and bags and fetched out, turned any way, and taken on stairs, a bicycle, bad roads and a boat (`handled`).
The thresholds were set on all recorded people that `--data` had, so that a row of one person is no row of a stranger. `--data DIR` takes the recordings from `DIR/NAME/index.json` and `acc.npz`: handwaving for shakes, the
walks of oxford_steps to walk with, every other folder's takes as negatives. Without it people are made up, and the arm exercises
of seglearn's wheel and made-up walks, drives and drawn circles are what must not fire. Rows of one person are those of the worst.

The other way is the Seismic rule of the square/seismic library: |a| above 13 m/s² for three quarters of half a second; it
knows no direction, so that any direction counts as right.
"""

from __future__ import annotations

import math
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from app.inputs.motion.shake import AXES, USUAL, Axis, Lesson, PersonalAxis, Recogniser, fitted
from app.inputs.motion.shake.lesson import MOVING_TIME, READY_TIME
from bench.support import handling, motion, people
from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bench.support.motion import Recording, Trial

SEISMIC = "square/seismic, 13 m/s²"
NAMES = {"lr": "left-right", "ud": "up-down", "fb": "forward-back"}
HOUR_OF_STOPS, HOUR_OF_OTHERS = 0.5, 1.0
BODIES_LEAST = {"still": 0.95, "walking": 0.85}
WORST_LEAST = {"still": 0.80, "walking": 0.60}
BODIES, BODY_SEED, HANDLED_SEED = 8, 4021, 4077
"""Seeds of the bench's own: nothing was tuned on what they draw."""


def _recalls() -> Iterator[Figure]:
    for kind, words, least in (
        ("still", "held still before, nothing calibrated", 0.95),
        ("walking", "while walking, nothing calibrated", 0.85),
        ("calibrated", "held still before, after the lesson", 0.95),
        ("calibrated_walking", "while walking, after the lesson", None),
        ("slow", "all speeds, down to 0.4 Hz, after the lesson", None),
        ("rate25", "held still before, at 25 Hz", None),
    ):
        for axis, name in NAMES.items():
            yield Figure(f"{kind}_{axis}", "", f"{name} understood, {words}", least, "more", against=SEISMIC)
    for kind, words in (("still", "held still before"), ("walking", "while walking")):
        for axis, name in NAMES.items():
            least = WORST_LEAST[kind] if axis == "lr" else None
            yield Figure(
                f"worst_{kind}_{axis}", "", f"{name}, {words}: the person understood least", least, "more"
            )
            yield Figure(
                f"low_{kind}_{axis}", "", f"{name}, {words}: 2.5 % of drawn people are below", better="more"
            )
        yield Figure(f"wrong_{kind}", "", f"understood as another direction, {words}")
        for axis, name in NAMES.items():
            words_of = f"{name}, {words}: other bodies"
            yield Figure(f"others_{kind}_{axis}", "", words_of, BODIES_LEAST[kind], "more", against=SEISMIC)


FIGURES = (
    *_recalls(),
    Figure("people", "", "people who shook", better="more"),
    Figure("finished", "", "share of them who finished the lesson with all three movements", better="more"),
    Figure("handled_hours", "h", "recordings put away, fetched out, turned and taken along", better="more"),
    Figure("handled_stops", "/h", "false STOP in those", HOUR_OF_STOPS, against=SEISMIC),
    Figure("handled_others", "/h", "false other commands in those", HOUR_OF_OTHERS),
    Figure("hours", "h", "negatives", better="more"),
    Figure("stops", "/h", "false STOP", HOUR_OF_STOPS, against=SEISMIC),
    Figure("others", "/h", "false other commands", HOUR_OF_OTHERS),
    Figure("travel", "", "false commands walking and driving, all of them", 0.0, against=SEISMIC),
    Figure(
        "own_stops", "/h", "false STOP with each person's own thresholds, mean over the people", HOUR_OF_STOPS
    ),
    Figure("own_others", "/h", "false other commands, the same", HOUR_OF_OTHERS),
    Figure("own_worst", "/h", "false STOP, the person for whom it is worst"),
    Figure("circles", "", "share of drawn circles taken for a shake", 0.02, against=SEISMIC),
    Figure("stop_after", "s", "from its onset to STOP, median", against=SEISMIC),
    Figure("sample", "µs", "a sample, mean over the negatives", 50.0),
)
REPEATS = 1
EACH = 5
TRAVEL = ("walk", "car", "drive", "driv", "start_walk")
"""Beginnings of the labels of walks and drives."""


class Material(NamedTuple):
    """What a run listens to."""

    takes: list[Recording]
    walks: list[Recording]
    negatives: list[Recording]
    circles: list[Recording]
    handled: list[Recording]


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """Everything is read or made before."""
    material = _read(context.data) if context.data else _made()
    yield Sides(partial(figures, material, Ours), partial(figures, material, Seismic))


def _read(path: Path) -> Material:
    folders = {
        each.name: motion.folder(each) for each in sorted(path.iterdir()) if (each / "acc.npz").exists()
    }
    if "handwaving" not in folders:
        raise ValueError(f"{path} has no folder handwaving with index.json and acc.npz.")
    waves = folders.pop("handwaving")
    others = [take for takes in folders.values() for take in takes if take.gravity]
    walks = [take for take in folders.get("oxford_steps", []) if take.label == "walk_inhand"]
    feet = [take for take in others if take.label in ("running", "walking")]
    return Material(
        [take for take in waves if take.label in motion.SHAKES],
        walks or [motion.walking(120.0, seed) for seed in range(3)],
        [*others, *motion.starts(feet), *motion.car(0.5)],
        [take for take in waves if take.label == "circles"],
        handling.handled(others, motion.car(0.2), HANDLED_SEED),
    )


def _made() -> Material:
    people = range(len(motion.PEOPLE))
    takes = [motion.made(axis, person, seed) for person in people for axis in AXES for seed in range(3)]
    walks = [motion.walking(120.0, seed) for seed in range(10)]
    negatives = [*motion.packaged(), *walks, *motion.starts(walks[:2]), *motion.car(0.5)]
    return Material(takes, walks, negatives, [motion.ellipse(seed) for seed in range(200)], [])


Fires = Callable[[float, tuple[float, float, float]], str]


class Ours:
    """The recogniser, for anybody or for one person; says the direction, empty for nothing."""

    def __init__(self, own: dict[Axis, PersonalAxis] | None = None) -> None:
        self._recogniser = Recogniser(fitted(USUAL, own or {}))

    def __call__(self, t: float, axes: tuple[float, float, float]) -> str:
        """One sample."""
        shake = self._recogniser.feed(t, axes)
        return shake.axis if shake else ""


class Seismic:
    """The rule of the peer, in its default sensitivity."""

    def __init__(self, _: object = None) -> None:
        self._recent: deque[tuple[float, bool]] = deque()
        self._after = -math.inf

    def __call__(self, t: float, axes: tuple[float, float, float]) -> str:
        """One sample."""
        recent = self._recent
        recent.append((t, math.hypot(*axes) > 13.0))
        while recent[0][0] < t - 0.5:
            recent.popleft()
        long = len(recent) >= 4 and t - recent[0][0] >= 0.25
        if t < self._after or not long or sum(fast for _, fast in recent) < 0.75 * len(recent):
            return ""
        self._after = t + 1.0
        return "any"


Made = type[Ours] | type[Seismic]


def figures(material: Material, made: Made) -> dict[str, float]:
    """All of them, of ours or of the peer."""
    takes, walks = material.takes, material.walks
    still, walking = motion.trials(takes, EACH), motion.trials(takes, EACH, walks)
    found = _recall("still", still, made) | _recall("walking", walking, made)
    slower = [Trial(t.axis, t.take.again(25.0), t.began, t.ended) for t in still]
    found |= {
        name: value for name, value in _recall("rate25", slower, made).items() if name.startswith("rate")
    }
    found |= _bodies(takes, walks, made)
    found |= _lessons(takes, walks, made)
    found["people"] = float(len({take.person for take in takes}))
    found["stop_after"] = _delay([trial for trial in still if trial.axis == "lr"], made)
    found |= _false(material.negatives, made)
    if material.handled:
        false = _false(material.handled, made)
        found |= {f"handled_{name}": false[name] for name in ("hours", "stops", "others")}
    if made is Ours:
        found |= _false_of_people(material, made)
    drawn = motion.trials(material.circles, EACH, slow=0.5) or [
        Trial("", take, 0.0, math.inf) for take in material.circles
    ]
    found["circles"] = sum(bool(_first(trial, made())) for trial in drawn) / max(1, len(drawn))
    return found


def _first(trial: Trial, fires: Fires) -> tuple[str, float] | None:
    """What was understood first, and when."""
    for index, (x, y, z) in enumerate(trial.take.samples.tolist()):
        t = index / trial.take.rate
        if said := fires(t, (x, y, z)):
            return said, t
    return None


def _recall(
    kind: str, trials: list[Trial], made: Made, own: dict[str, dict[Axis, PersonalAxis]] | None = None
) -> dict[str, float]:
    """Shares understood, by direction, of the worst person, and misunderstood."""
    people: dict[tuple[str, str], list[bool]] = {}
    wrong = 0
    for trial in trials:
        first = _first(trial, made((own or {}).get(trial.take.person)))
        right = first is not None and first[0] in (trial.axis, "any")
        wrong += first is not None and not right
        people.setdefault((trial.axis, trial.take.person), []).append(right)
    found = {f"wrong_{kind}": wrong / max(1, len(trials))}
    for axis in AXES:
        each = [tried for (of, _), tried in people.items() if of == axis]
        if each:
            found[f"{kind}_{axis}"] = sum(map(sum, each)) / sum(map(len, each))
            shares = np.array([sum(tried) / len(tried) for tried in each])
            found[f"worst_{kind}_{axis}"] = float(shares.min())
            drawn = np.random.default_rng(1).choice(shares, (2000, len(shares))).mean(axis=1)
            found[f"low_{kind}_{axis}"] = float(np.quantile(drawn, 0.025))
    return found


def _bodies(takes: list[Recording], walks: list[Recording], made: Made) -> dict[str, float]:
    """The same people by other bodies."""
    found: dict[str, float] = {}
    for kind, under in (("still", None), ("walking", walks)):
        tried = people.trials(takes, BODIES, BODY_SEED, under)
        told = _recall(f"others_{kind}", tried, made)
        found |= {name: value for name, value in told.items() if name.startswith("others")}
    return found


def lesson(takes: list[Recording]) -> dict[str, dict[Axis, PersonalAxis]]:
    """What the app's lesson measures of each person, in the first take of each movement; what is asked for again is done farther on."""
    first: dict[str, dict[str, Recording]] = {}
    for take in takes:
        first.setdefault(take.person, {}).setdefault(motion.SHAKES[take.label], take)
    return {person: _taught(shown) for person, shown in first.items() if len(shown) == len(AXES)}


def _taught(shown: dict[str, Recording]) -> dict[Axis, PersonalAxis]:
    asked, t = Lesson(), 0.0
    tries: Counter[Axis] = Counter()
    while asked.axis is not None:
        axis, take = asked.axis, shown[asked.axis]
        count = int((MOVING_TIME + 0.2) * take.rate)
        begin = int(tries[axis] * MOVING_TIME * take.rate) % max(1, len(take.samples) - count)
        tries[axis] += 1
        still = np.tile(take.samples.mean(axis=0), (int(READY_TIME * take.rate) + 2, 1))
        for x, y, z in np.concatenate([still, take.samples[begin : begin + count]]).tolist():
            t += 1.0 / take.rate
            before = asked.elapsed
            asked.feed(t, (x, y, z))
            if asked.elapsed < before:
                break
    return asked.own


def _lessons(takes: list[Recording], walks: list[Recording], made: Made) -> dict[str, float]:
    own = lesson(takes)
    seen: set[tuple[str, str]] = set()
    rest = []
    for take in takes:
        if (take.person, take.label) in seen:
            rest.append(take)
        seen.add((take.person, take.label))
    found = _recall("calibrated", motion.trials(rest, EACH), made, own)
    found |= _recall("calibrated_walking", motion.trials(rest, EACH, walks), made, own)
    found |= _recall("slow", motion.trials(rest, EACH, slow=0.4), made, own)
    found = {name: value for name, value in found.items() if not name.startswith(("worst", "wrong", "low"))}
    found["finished"] = sum(len(one) == len(AXES) for one in own.values()) / max(1, len(own))
    return found


def _delay(trials: list[Trial], made: Made) -> float:
    after = sorted(first[1] - trial.began for trial in trials if (first := _first(trial, made())))
    return after[len(after) // 2] if after else math.nan


def _fired(takes: list[Recording], fires: Callable[[], Fires]) -> list[tuple[str, str]]:
    """Everything that was understood: the direction, and of which recording."""
    fired = []
    for take in takes:
        one = fires()
        for index, (x, y, z) in enumerate(take.samples.tolist()):
            if said := one(index / take.rate, (x, y, z)):
                fired.append((said, take.label))
    return fired


def _false(takes: list[Recording], made: Made) -> dict[str, float]:
    hours = sum(take.hours for take in takes)
    began = time.process_time()
    fired = _fired(takes, made)
    spent = time.process_time() - began
    stops = sum(said in ("lr", "any") for said, _ in fired)
    return {
        "hours": hours,
        "stops": stops / hours,
        "others": (len(fired) - stops) / hours,
        "travel": float(sum(label.startswith(TRAVEL) for _, label in fired)),
        "sample": spent / sum(len(take.samples) for take in takes) * 1e6,
    }


def _false_of_people(material: Material, made: Made) -> dict[str, float]:
    """With what each one's lesson measured."""
    hours = sum(take.hours for take in material.negatives)
    stops, others = list[int](), list[int]()
    for own in lesson(material.takes).values():
        fired = _fired(material.negatives, partial(made, own))
        stops.append(sum(said == "lr" for said, _ in fired))
        others.append(len(fired) - stops[-1])
    return {
        "own_stops": sum(stops) / len(stops) / hours,
        "own_others": sum(others) / len(others) / hours,
        "own_worst": max(stops) / hours,
    }
