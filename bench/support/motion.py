"""Recorded and made-up motion of a phone: trials of deliberate shakes, and motion that must not be taken for one."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "GRAVITY",
    "SHAKES",
    "Recording",
    "Trial",
    "car",
    "drawn",
    "ellipse",
    "folder",
    "in_frame",
    "made",
    "packaged",
    "starts",
    "trials",
    "underfoot",
    "walking",
]

Samples = NDArray[np.float64]
"""(n, 3): x, y, z of the device with gravity [m/s²]."""

GRAVITY = 9.80665
"""[m/s²]"""
SCALE = 400.0
"""Whole numbers a m/s² in the files."""
SHAKES = {"left_right": "lr", "up_down": "ud", "forward_backwards": "fb"}
"""Label of a recording to the direction that it is."""
STILL, AFTER = 4.0, 1.5
"""Before and after the shake of a trial [s]."""
CYCLES = 2.25
"""A trial is cut so long from a recording."""
RAMP = 0.1
"""In which it begins and ends [s]."""
START_TIMES = (0.1, 0.3, 0.6, 1.0, 1.5)
"""A person begins and ends to walk within such a time [s]."""
SLOW = 0.8
"""Slower ones are waves, not shakes [Hz]."""
TREMBLE = 0.05
"""A hand that holds still [m/s²]."""


@dataclass(frozen=True)
class Recording:
    """One take."""

    label: str
    person: str
    rate: float
    """[Hz]"""
    samples: Samples
    gravity: bool = True
    """It has gravity in it."""

    @property
    def hours(self) -> float:
        """How long it is [h]."""
        return len(self.samples) / self.rate / 3600.0

    @property
    def frequency(self) -> float:
        """Of the movement [Hz]: the strongest between 0.3 and 6."""
        moved = self.samples - self.samples.mean(axis=0)
        along = moved[:, moved.std(axis=0).argmax()]
        power = np.abs(np.fft.rfft(along * np.hanning(len(along)), 4096)) ** 2
        at = np.fft.rfftfreq(4096, 1.0 / self.rate)
        within = (at > 0.3) & (at < 6.0)
        return float(at[within][power[within].argmax()])

    def again(self, rate: float) -> Recording:
        """The same as a sensor of another rate measures it [Hz]."""
        count = int(len(self.samples) / self.rate * rate)
        at = np.arange(count) / rate
        known = np.arange(len(self.samples)) / self.rate
        columns = [np.interp(at, known, self.samples[:, i]) for i in range(3)]
        return replace(self, rate=rate, samples=np.stack(columns, axis=1))


@dataclass(frozen=True)
class Trial:
    """A shake after some seconds without one."""

    axis: str
    """`lr`, `ud` or `fb`; another label for any other motion."""
    take: Recording
    began: float
    """When the shake began [s]."""
    ended: float
    """[s]"""


def folder(path: Path) -> list[Recording]:
    """The takes of a folder with `index.json` and `acc.npz`; ValueError for one that is not so."""
    try:
        index = json.loads((path / "index.json").read_text(encoding="utf-8"))
        with np.load(path / "acc.npz") as arrays:
            return [
                Recording(
                    str(entry["label"]),
                    str(entry["subject"]),
                    float(entry["fs"]),
                    arrays[entry["key"]].astype(np.float64) / SCALE,
                    bool(entry.get("gravity", True)),
                )
                for entry in index
                if entry["key"] in arrays.files
            ]
    except (OSError, KeyError, TypeError, ValueError) as problem:
        raise ValueError(f"{path} has no index.json and acc.npz that can be read: {problem}") from None


def trials(
    takes: list[Recording],
    each: int = 5,
    walks: list[Recording] | None = None,
    slow: float = SLOW,
    seed: int = 1,
) -> list[Trial]:
    """`each` of every take that is not slower than `slow` [Hz], held still or, with `walks`, while walking."""
    rng = np.random.default_rng(seed)
    found = []
    for take in takes:
        frequency = take.frequency
        count = int(CYCLES / frequency * take.rate)
        first, last = 0.5 * take.rate, len(take.samples) - count - 0.5 * take.rate
        if frequency < slow or last <= first:
            continue
        for start in np.linspace(first, last, each).astype(int):
            cut = take.samples[start : start + count] - take.samples.mean(axis=0)
            found.append(_trial(take, cut, walks, rng))
    return found


def _trial(take: Recording, cut: Samples, walks: list[Recording] | None, rng: np.random.Generator) -> Trial:
    before, after = int(STILL * take.rate), int(AFTER * take.rate)
    samples = np.zeros((before + len(cut) + after, 3))
    samples[before : before + len(cut)] = cut * _ramps(len(cut), RAMP * take.rate)[:, None]
    held = take.samples.mean(axis=0)
    samples += held
    if walks:
        walk = walks[int(rng.integers(len(walks)))].again(take.rate)
        samples += underfoot(walk, held, len(samples), rng)
    else:
        samples += rng.normal(0.0, TREMBLE, samples.shape)
    began, ended = before / take.rate, (before + len(cut)) / take.rate
    return Trial(SHAKES.get(take.label, take.label), replace(take, samples=samples), began, ended)


def underfoot(walk: Recording, held: Samples, count: int, rng: np.random.Generator) -> Samples:
    """So many samples out of a walk, without gravity, as a phone feels them that is held so that it measures `held` at rest."""
    start = int(rng.integers(0, len(walk.samples) - count))
    mean = walk.samples.mean(axis=0)
    felt: Samples = (walk.samples[start : start + count] - mean) @ in_frame(mean).T @ in_frame(held)
    return felt


def _ramps(count: int, over: float) -> Samples:
    index = np.arange(count)
    return np.minimum(1.0, np.minimum(index, index[::-1]) / over)


def in_frame(gravity: Samples) -> Samples:
    """Rows: right, up and forward of a device that measures that gravity."""
    up = gravity / np.linalg.norm(gravity)
    side = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < 0.85 else np.array([0.0, 1.0, 0.0])
    right = side - up * (side @ up)
    right /= np.linalg.norm(right)
    return np.stack([right, up, np.cross(up, right)])


def starts(takes: list[Recording], length: float = 12.0, every: float = 6.0) -> list[Recording]:
    """A person stands, walks or runs for a while, and stands again: pieces of takes of that [s]."""
    rng = np.random.default_rng(3)
    found = []
    for take in takes:
        count, step = int(length * take.rate), int(every * take.rate)
        for first in range(0, max(1, len(take.samples) - count), step):
            piece = take.samples[first : first + count]
            held = piece.mean(axis=0)
            still = np.zeros((int(5.0 * take.rate), 3))
            over = float(rng.choice(START_TIMES)) * take.rate
            moved = (piece - held) * _ramps(len(piece), over)[:, None]
            samples = np.concatenate([still, moved, still]) + held
            samples += rng.normal(0.0, TREMBLE, samples.shape)
            found.append(replace(take, label=f"start_{take.label}", samples=samples))
    return found


def car(hours: float, seed: int = 5, rate: float = 50.0) -> list[Recording]:
    """A phone in its mount: bends, brakes, a rough road, and bumps on springs; made up."""
    rng = np.random.default_rng(seed)
    found = []
    count = int(120.0 * rate)
    at = np.fft.rfftfreq(count, 1.0 / rate)
    for _ in range(math.ceil(hours * 30.0)):
        samples = np.zeros((count, 3))
        for axis, (corner, slow, rough) in enumerate(((0.25, 1.6, 0.25), (0.25, 1.6, 0.25), (1.5, 0.8, 0.6))):
            for shape, much in (
                (1.0 / (1.0 + (at / corner) ** 2), slow),
                (np.exp(-(((at - 10.0) / 5.0) ** 2)), rough),
            ):
                noise = np.fft.irfft(np.fft.rfft(rng.normal(size=count)) * shape, count)
                samples[:, axis] += noise / noise.std() * much
        second = np.arange(int(rate)) / rate
        for start in rng.integers(0, count - len(second), 12):
            spring = np.exp(-second / 0.2) * np.sin(math.tau * rng.uniform(1.2, 2.0) * second)
            samples[start : start + len(second), 2] += rng.uniform(2.0, 8.0) * spring
        lean = rng.uniform(-0.5, 0.5)
        held = GRAVITY * np.array([0.1, math.cos(lean), math.sin(lean)])
        right, up, forward = in_frame(held)
        found.append(Recording("car", "made", rate, samples @ np.stack([right, forward, up]) + held))
    return found


def made(axis: str, person: int, seed: int, rate: float = 60.0, seconds: float = 15.0) -> Recording:
    """A take as one of six made-up people would shake: how fast, how far, how much along an arc and how much the hand leans."""
    rng = np.random.default_rng(1000 * person + seed)
    frequency, reach, arc, lean = PEOPLE[person % len(PEOPLE)]
    frequency *= rng.uniform(0.93, 1.07)
    at = np.arange(int(seconds * rate)) / rate
    phase = math.tau * np.cumsum(frequency * (1.0 + 0.04 * np.sin(0.9 * at + rng.uniform(0, 6)))) / rate
    swing = reach * np.sin(phase) + 0.03 * reach * np.sin(3.0 * phase + 0.4)
    away = arc * reach * np.cos(2.0 * phase)
    main = ("lr", "ud", "fb").index(axis)
    motion = np.zeros((len(at), 3))
    motion[:, main] = np.gradient(np.gradient(swing, 1.0 / rate), 1.0 / rate)
    motion[:, 2 if main == 1 else 1] += np.gradient(np.gradient(away, 1.0 / rate), 1.0 / rate)
    motion[:, 0 if main == 0 else 2] += GRAVITY * math.sin(lean) * np.sin(phase)
    motion += rng.normal(0.0, 0.25, motion.shape)
    upright = rng.uniform(0.2, 1.2)
    held = GRAVITY * np.array([0.05, math.sin(upright), math.cos(upright)])
    label = next(name for name, short in SHAKES.items() if short == axis)
    return Recording(label, f"made {person}", rate, motion @ in_frame(held) + held)


PEOPLE = (
    (1.2, 0.12, 0.1, 0.1),
    (1.0, 0.16, 0.1, 0.05),
    (1.6, 0.09, 0.05, 0.1),
    (2.2, 0.06, 0.03, 0.05),
    (3.0, 0.07, 0.03, 0.02),
    (1.1, 0.13, 0.14, 0.12),
)
"""How often a second [Hz], how far each way [m], how much of that along the arc, and how far the hand leans [rad]."""


def walking(seconds: float, seed: int, rate: float = 60.0) -> Recording:
    """A phone in the hand of a person who walks; made up."""
    rng = np.random.default_rng(seed)
    at = np.arange(int(seconds * rate)) / rate
    step = math.tau * np.cumsum(rng.normal(1.85, 0.03) * (1.0 + 0.03 * np.sin(0.4 * at))) / rate
    up = 2.2 * np.sin(step) + 1.1 * np.sin(2 * step + 1.0) + 0.6 * np.sin(3 * step)
    side, ahead = (
        1.0 * np.sin(step / 2) + 0.4 * np.sin(2 * step),
        1.1 * np.sin(step + 0.8) + 0.5 * np.sin(2 * step),
    )
    motion = np.stack([side, up, ahead], axis=1) * rng.normal(1.0, 0.06, (len(at), 1))
    motion += rng.normal(0.0, 0.3, motion.shape)
    held = GRAVITY * np.array([0.0, 0.5, 0.866])
    return Recording("walk_inhand", "made", rate, motion @ in_frame(held) + held)


def drawn(seconds: float, seed: int, rate: float = 60.0) -> Recording:
    """A hand that draws circles; made up."""
    rng = np.random.default_rng(seed)
    phase = math.tau * rng.uniform(0.9, 1.3) * np.arange(int(seconds * rate)) / rate
    size = rng.uniform(4.0, 8.0)
    plane = np.stack([np.cos(phase), np.sin(phase), 0.15 * np.sin(phase)], axis=1) * size
    still = int(4.0 * rate)
    motion = np.concatenate(
        [np.zeros((still, 3)), plane * _ramps(len(plane), 0.2 * rate)[:, None], np.zeros((still, 3))]
    )
    motion += rng.normal(0.0, TREMBLE, motion.shape)
    held = GRAVITY * np.array([0.0, 0.5, 0.866])
    return Recording("circle", "made", rate, motion @ in_frame(held) + held)


def ellipse(seed: int, rate: float = 60.0, thin: float = 0.6) -> Recording:
    """A person draws something round, with a shaky hand that leans: of any size, tempo, plane and number of turns; at least `thin` times as wide as long."""
    rng = np.random.default_rng(seed)
    pace = math.tau * rng.uniform(0.5, 2.6)
    at = np.arange(int(rng.uniform(1.5, 8.0) * math.tau / pace * rate)) / rate
    uneven = 1.0 + 0.1 * np.sin(rng.uniform(0.5, 3.0) * at + rng.uniform(0, 6))
    phase = rng.choice([-1.0, 1.0]) * np.cumsum(pace * uneven) / rate + rng.uniform(0.0, math.tau)
    size = math.exp(rng.uniform(math.log(3.0), math.log(25.0))) / pace**2
    planes = (np.eye(3)[:, :2], np.eye(3)[:, ::2], np.eye(3)[:, 1:], np.linalg.qr(rng.normal(size=(3, 2)))[0])
    plane = planes[seed % 4]
    way = np.stack([np.cos(phase), rng.uniform(thin, 1.0) * np.sin(phase)], axis=1)
    turn = rng.uniform(0.0, math.pi)
    way = way @ np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]]) * size
    speed = np.gradient(way @ plane.T, 1.0 / rate, axis=0)
    motion = np.gradient(speed * _ramps(len(at), rng.uniform(0.08, 0.4) * rate)[:, None], 1.0 / rate, axis=0)
    motion[:, 0] += GRAVITY * rng.uniform(0.0, 0.15) * np.sin(phase)
    motion += rng.normal(0.0, rng.uniform(0.05, 0.6), motion.shape)
    still = np.zeros((int(4.0 * rate), 3))
    motion = np.concatenate([still, motion, still[: int(2.0 * rate)]])
    motion += rng.normal(0.0, TREMBLE, motion.shape)
    upright = rng.uniform(-0.2, 1.5)
    held = GRAVITY * np.array([0.05, math.sin(upright), math.cos(upright)])
    return Recording("circle", "made", rate, motion @ in_frame(held) + held)


def packaged() -> list[Recording]:
    """The rhythmic arm exercises that come inside the wheel of seglearn; none where that is not installed."""
    found = find_spec("seglearn")
    if found is None or not found.submodule_search_locations:
        return []
    # the file and not the package, which wants pandas
    path = Path(found.submodule_search_locations[0]) / "data" / "watch_dataset.npy"
    watch = np.load(path, allow_pickle=True).item()
    return [
        Recording(
            f"arm_{watch['y_labels'][int(label)]}",
            str(person),
            50.0,
            samples[:, :3].astype(np.float64) * GRAVITY,
        )
        for samples, label, person in zip(watch["X"], watch["y"], watch["subject"], strict=True)
    ]
