"""What pockets, bags, stairs and vehicles do with a phone: recordings of other movements, turned, joined, and carried along.

Each begins with recorded motion; what is added is the least that makes it the other thing. Everything is drawn from a seed.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from bench.support.motion import GRAVITY, TREMBLE, Recording, Samples, in_frame
from bench.support.people import strength

__all__ = [
    "by_bicycle",
    "by_boat",
    "handled",
    "held_anyhow",
    "on_bad_roads",
    "on_stairs",
    "put_away",
    "rotation",
]

AWAY, TRIPS = 100, 12
"""How often a phone is put away, and how many trips of each kind there are."""
REACH, MOVE_TIME = (0.2, 0.7), (0.5, 1.3)
"""A hand that puts a phone away goes so far [m] in such a time [s]."""
FUMBLES, FUMBLE_TIME = (0, 4), (0.12, 0.3)
"""It pushes so often, each half cycle in such a time [s]."""


def handled(takes: list[Recording], drives: list[Recording], seed: int) -> list[Recording]:
    """All of these things, of recorded walks, runs and people who stand; nothing where one of them was not recorded."""
    rng = np.random.default_rng(seed)
    walks = [take for take in takes if take.label.startswith("walk_")]
    held = [take for take in walks if take.label == "walk_inhand"]
    carried = [take for take in walks if take.label != "walk_inhand"]
    runs = [take for take in takes if take.label == "running"]
    stands = [take for take in takes if take.label == "stationary"]
    if not (held and carried and runs and stands):
        return []

    def one(of: list[Recording]) -> Recording:
        return of[int(rng.integers(len(of)))]

    found = [put_away(one(held), one(carried), rng) for _ in range(AWAY)]
    found += [held_anyhow(take, rng) for take in walks]
    for _ in range(TRIPS):
        found.append(held_anyhow(on_stairs(one(walks), rng), rng))
        found.append(held_anyhow(by_bicycle(one(walks), one(runs), rng), rng))
        found.append(on_bad_roads(one(drives), one(runs), rng))
        found.append(by_boat(one(stands), one(runs), rng))
    return found


def rotation(axis: Samples, angle: float) -> Samples:
    """Of a vector, as a column, about an axis of any length [rad]."""
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn: Samples = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    return turn


def held_anyhow(take: Recording, rng: np.random.Generator) -> Recording:
    """The same with the phone turned about every axis, all ways alike."""
    turn, upper = np.linalg.qr(rng.normal(size=(3, 3)))
    turn = turn * np.sign(np.diag(upper))
    turn[:, 0] *= np.sign(np.linalg.det(turn))
    return replace(take, samples=take.samples @ turn.T)


def put_away(
    held: Recording, carried: Recording, rng: np.random.Generator, seconds: float = 8.0
) -> Recording:
    """A walk with the phone in the hand, which puts it where `carried` was recorded; and the same out again.

    The hand goes there and turns the phone meanwhile, by any angle and about any axis, and fumbles. Sometimes the person stands.
    """
    first, last = _piece(held, rng, seconds), _piece(held_anyhow(carried.again(held.rate), rng), rng, seconds)
    if rng.random() < 0.5:
        first = np.tile(first.mean(axis=0), (len(first), 1)) + rng.normal(0.0, TREMBLE, first.shape)
    there = _joined(first, last, held.rate, rng)
    back = _joined(last, first, held.rate, rng)
    samples = np.concatenate([first, there, last, back, first])
    return replace(held, label=f"put_{carried.label}", samples=samples)


def _piece(take: Recording, rng: np.random.Generator, seconds: float) -> Samples:
    count = min(int(seconds * take.rate), len(take.samples) - 1)
    begin = int(rng.integers(0, len(take.samples) - count))
    return take.samples[begin : begin + count]


def _joined(before: Samples, after: Samples, rate: float, rng: np.random.Generator) -> Samples:
    """From the pose of the one to that of the other."""
    one, other = (part.mean(axis=0) / np.linalg.norm(part.mean(axis=0)) for part in (before, after))
    took = rng.uniform(*MOVE_TIME)
    at = np.arange(int(took * rate)) / rate / took
    done = at**3 * (10.0 - 15.0 * at + 6.0 * at**2)
    axis = np.cross(one, other)
    if np.linalg.norm(axis) < 1e-3:
        axis = np.cross(one, (0.3, 0.5, 0.8))
    angle = math.acos(float(np.clip(one @ other, -1.0, 1.0)))
    gravity = np.array([rotation(axis, angle * share) @ one for share in done]) * GRAVITY
    jerkily = (60.0 * at - 180.0 * at**2 + 120.0 * at**3) * rng.uniform(*REACH) / took**2
    moved = np.outer(jerkily, _way(rng))
    for _ in range(int(rng.integers(*FUMBLES))):
        half = max(3, int(rng.uniform(*FUMBLE_TIME) * rate))
        begin = int(rng.integers(0, max(1, len(at) - half)))
        push = np.sin(math.pi * np.arange(half) / half)[: len(at) - begin] * rng.uniform(2.0, 9.0)
        moved[begin : begin + half] += np.outer(push, _way(rng))
    turned: Samples = gravity + moved + rng.normal(0.0, 0.3, moved.shape)
    return turned


def _way(rng: np.random.Generator) -> Samples:
    way = rng.normal(size=3)
    unit: Samples = way / np.linalg.norm(way)
    return unit


def on_stairs(walk: Recording, rng: np.random.Generator) -> Recording:
    """Steps of a walk, harder and slower up, harder and quicker down."""
    down = rng.random() < 0.5
    taken = strength(walk, rng.uniform(1.2, 1.8), rng.uniform(1.0, 1.3) if down else rng.uniform(0.7, 1.0))
    return replace(taken, label=f"walk_stairs_{walk.label}")


def by_bicycle(walk: Recording, run: Recording, rng: np.random.Generator) -> Recording:
    """The cadence of slow steps, with the knocks of recorded steps, quicker and without their sway, from the road."""
    pedals = strength(walk, rng.uniform(0.3, 0.7), rng.uniform(0.5, 0.8))
    road = strength(run.again(walk.rate), rng.uniform(0.1, 0.4), rng.uniform(2.0, 4.0))
    return replace(_along(pedals, road), label="drive_bicycle")


def on_bad_roads(car: Recording, run: Recording, rng: np.random.Generator) -> Recording:
    """A drive with the blows of recorded steps: now and then, and of any tempo."""
    blows = strength(run.again(car.rate), rng.uniform(0.2, 0.6), rng.uniform(0.5, 2.0))
    return replace(_along(car, blows, now_and_then=rng), label="drive_bad_road")


def by_boat(stands: Recording, run: Recording, rng: np.random.Generator) -> Recording:
    """The swell leans and lifts whoever stands, and the hull slams into it."""
    at = np.arange(len(stands.samples)) / stands.rate
    frame = in_frame(stands.samples.mean(axis=0))
    swell = math.tau * rng.uniform(0.08, 0.35)
    phase = rng.uniform(0.0, math.tau, 3)
    lean, lift = rng.uniform(0.05, 0.3), rng.uniform(0.3, 2.0)
    moved = np.stack(
        [
            GRAVITY * np.sin(lean * np.sin(swell * at + phase[0])),
            lift * np.sin(swell * at + phase[1]),
            GRAVITY * np.sin(0.5 * lean * np.sin(swell * at + phase[2])),
        ],
        axis=1,
    )
    sea = replace(stands, samples=stands.samples + moved @ frame)
    slams = strength(run.again(stands.rate), rng.uniform(0.1, 0.4), rng.uniform(0.4, 1.2))
    return replace(_along(sea, slams, now_and_then=rng), label="drive_boat")


def _along(take: Recording, other: Recording, now_and_then: np.random.Generator | None = None) -> Recording:
    """Both at once, the motion of the other in its own right, up and forward; with `now_and_then` in gusts."""
    count = len(take.samples)
    mean = other.samples.mean(axis=0)
    moved = (other.samples - mean) @ in_frame(mean).T @ in_frame(take.samples.mean(axis=0))
    moved = np.resize(moved, (count, 3))
    if now_and_then is not None:
        knots = np.arange(0, count + take.rate, take.rate)
        gusts = np.maximum(0.0, now_and_then.normal(0.0, 0.7, len(knots)))
        moved = moved * np.interp(np.arange(count), knots, gusts)[:, None]
    return replace(take, samples=take.samples + moved)
