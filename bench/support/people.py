"""Other people, made of recorded ones: they hold the phone askew, swing aslant or in an arc, gently, slowly, on another sensor.

Five people are few. The changes are those in which people differ; none of them is measured.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from bench.support.motion import (
    AFTER,
    CYCLES,
    GRAVITY,
    SHAKES,
    SLOW,
    STILL,
    TREMBLE,
    Recording,
    Samples,
    Trial,
    in_frame,
    underfoot,
)

__all__ = ["Body", "Sensor", "bodies", "as_done_by", "measured", "sensors", "strength", "trial", "trials"]

RAMPS, TEMPOS, MAX_FREQUENCY = (0.1, 0.8), (0.5, 1.8), 3.6
"""From rest to full [s], as many times as quick, and no quicker than that [Hz]."""
MIN_FREQUENCY = 0.3
"""Lowest frequency of the movement [Hz]."""


@dataclass(frozen=True)
class Body:
    """In what a person differs from the one who was recorded."""

    yaw: float = 0.0
    """The line turned about the vertical [rad]."""
    roll: float = 0.0
    """About forward, so that left-right is aslant [rad]."""
    pitch: float = 0.0
    """About right, so that up-down is aslant [rad]."""
    arm: float = 0.0
    """Left-right swings about a joint so far below, above where negative [m]; 0 for on a line."""
    strong: float = 1.0
    """Acceleration."""
    quick: float = 1.0
    """Tempo."""
    ramp: float = 0.1
    """From rest to full [s]."""
    first: float = 1.0
    """The first half cycle beside the others."""


@dataclass(frozen=True)
class Sensor:
    """In what a phone differs."""

    rate: float = 60.0
    """[Hz]"""
    jitter: float = 0.0
    """Of the time between two samples, as a share of it."""
    lost: float = 0.0
    """Share of samples."""
    downward: bool = False
    """It measures gravity downward."""


def bodies(count: int, seed: int, much: float = 1.0) -> list[Body]:
    """People; with `much` above 1 they differ by more."""
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(count):
        yaw, roll, pitch = np.radians(rng.uniform(-1.0, 1.0, 3) * (25.0, 18.0, 18.0)) * much
        arm = rng.choice([0.0, 0.25, 0.35, 0.5, -0.5, -0.7])
        strong, quick = rng.uniform(0.6, 1.4), rng.uniform(0.75, 1.35)
        found.append(
            Body(
                float(yaw),
                float(roll),
                float(pitch),
                float(arm),
                strong,
                quick,
                rng.uniform(0.1, 0.4),
                rng.uniform(0.4, 1.0),
            )
        )
    return found


def sensors(count: int, seed: int) -> list[Sensor]:
    """Phones."""
    rng = np.random.default_rng(seed)
    rates = (25.0, 30.0, 50.0, 60.0, 100.0)
    return [
        Sensor(
            float(rng.choice(rates)), rng.uniform(0.0, 0.3), rng.uniform(0.0, 0.05), bool(rng.random() < 0.5)
        )
        for _ in range(count)
    ]


def as_done_by(body: Body, take: Recording) -> Recording:
    """The whole take as that body does it."""
    held = take.samples.mean(axis=0)
    frame = in_frame(held)
    moved = (take.samples - held) @ frame.T
    moved = _turned(moved, body) * body.strong * body.quick
    if body.arm and SHAKES.get(take.label) == "lr":
        moved = _swung(moved, body.arm, take.rate)
    samples = moved @ frame + held
    count = int(len(samples) / body.quick)
    at = np.arange(count) * body.quick
    known = np.arange(len(samples))
    samples = np.stack([np.interp(at, known, samples[:, i]) for i in range(3)], axis=1)
    return replace(take, samples=samples)


def _turned(moved: Samples, body: Body) -> Samples:
    """Right, up and forward."""
    for angle, (a, b) in ((body.yaw, (0, 2)), (body.roll, (0, 1)), (body.pitch, (1, 2))):
        turned = moved.copy()
        turned[:, a] = np.cos(angle) * moved[:, a] - np.sin(angle) * moved[:, b]
        turned[:, b] = np.sin(angle) * moved[:, a] + np.cos(angle) * moved[:, b]
        moved = turned
    return moved


def _swung(moved: Samples, arm: float, rate: float) -> Samples:
    """The same way to and fro about a joint: the phone rises and sinks twice as often, and leans."""
    at = np.fft.rfftfreq(len(moved), 1.0 / rate)
    spectrum = np.fft.rfft(moved[:, 0])
    once = np.where(at > MIN_FREQUENCY, 1.0 / (2j * np.pi * np.maximum(at, MIN_FREQUENCY)), 0.0)
    way, speed = (np.fft.irfft(spectrum * once**n, len(moved)) for n in (2, 1))
    lean = np.clip(way / arm, -1.0, 1.0)
    right = moved[:, 0]
    up = moved[:, 1] - (speed**2 + way * right) / arm + GRAVITY
    swung = moved.copy()
    # half of the lean is in what was recorded already
    swung[:, 0] = right * np.cos(lean / 2) - up * np.sin(lean / 2)
    swung[:, 1] = right * np.sin(lean / 2) + up * np.cos(lean / 2) - GRAVITY
    return swung


def trial(
    body: Body, take: Recording, start: float, rng: np.random.Generator, walk: Recording | None = None
) -> Trial:
    """2.25 cycles of a take from a share of it on [0 to 1], done by that body, held still or in the walk before and after."""
    done = as_done_by(body, take)
    frequency = take.frequency * body.quick
    count = int(CYCLES / frequency * take.rate)
    room = len(done.samples) - count - take.rate
    first = int(0.5 * take.rate + start * room)
    held = done.samples.mean(axis=0)
    second = np.arange(count) / take.rate
    shape = np.minimum(1.0, np.minimum(second / body.ramp, (second[-1] - second) / 0.1))
    shape[second < 0.5 / frequency] *= body.first
    before, after = int(STILL * take.rate), int(AFTER * take.rate)
    samples = np.zeros((before + count + after, 3)) + held
    samples[before : before + count] += (done.samples[first : first + count] - held) * shape[:, None]
    if walk is None:
        samples += rng.normal(0.0, TREMBLE, samples.shape)
    else:
        samples += underfoot(walk.again(take.rate), held, len(samples), rng)
    return Trial(
        SHAKES.get(take.label, take.label), replace(done, samples=samples), STILL, STILL + count / take.rate
    )


def trials(
    takes: list[Recording], count: int, seed: int, walks: list[Recording] | None = None
) -> list[Trial]:
    """So many bodies, each with every take that is then a shake and no wave: by either hand, at half to nearly double the tempo."""
    rng = np.random.default_rng(seed)
    found = []
    for body in bodies(count, seed):
        one = replace(
            body, ramp=float(rng.uniform(*RAMPS)), quick=float(np.exp(rng.uniform(*np.log(TEMPOS))))
        )
        for take in takes:
            shown = replace(take, samples=take.samples * (-1.0, 1.0, 1.0)) if rng.random() < 0.5 else take
            start, walk = rng.random(), walks[int(rng.integers(len(walks)))] if walks else None
            seconds = len(take.samples) / take.rate / one.quick
            frequency = take.frequency * one.quick
            if SLOW <= frequency < MAX_FREQUENCY and seconds > CYCLES / frequency + 2.0:
                found.append(trial(one, shown, start, rng, walk))
    return found


def measured(
    sensor: Sensor, take: Recording, rng: np.random.Generator
) -> Iterator[tuple[float, tuple[float, float, float]]]:
    """Times [s] and samples."""
    count = int(len(take.samples) / take.rate * sensor.rate)
    at = (np.arange(count) + rng.uniform(-0.5, 0.5, count) * sensor.jitter) / sensor.rate
    at = at[rng.random(count) >= sensor.lost]
    known = np.arange(len(take.samples)) / take.rate
    sign = -1.0 if sensor.downward else 1.0
    columns = [sign * np.interp(at, known, take.samples[:, i]) for i in range(3)]
    for t, x, y, z in zip(at.tolist(), *(column.tolist() for column in columns), strict=True):
        yield t, (x, y, z)


def strength(take: Recording, strong: float, quick: float) -> Recording:
    """A person who walks, or does another thing, harder and faster."""
    held = take.samples.mean(axis=0)
    samples = (take.samples - held) * strong + held
    at = np.arange(int(len(samples) / quick)) * quick
    known = np.arange(len(samples))
    return replace(take, samples=np.stack([np.interp(at, known, samples[:, i]) for i in range(3)], axis=1))
