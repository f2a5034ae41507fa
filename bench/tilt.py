"""Commands of a tablet's tilt: in the hand of a person who walks with the clutch held, and after the clutch is released.

The walker is made of steps of 1.5 to 2.2 Hz in all three axes, with their overtones, noise, and a hand that slowly sinks, seen
by an accelerometer alone as on a device without a gyroscope, which is the hard case; with `--data DIR` the recordings of
walking with the phone in the hand that lie in folders below DIR (index.json and acc.npz) are replayed as well. The clutch is
closed once, after a second, and held to the end; walking is switched on. `mean` is the mean length of the command in shares of
full command, `busy` the share of heartbeats with any. Each recording counts by its length; the worst one stands beside.

`turns` is of the same walkers with the upper edge down by 16° from 3 s on: the share of heartbeats after the fifth second that
command anything to a side.

The other way is the common one: the accelerometer's own angles from level, a low pass of 2 Hz, and the same dead zone.

`release` is the greatest command of the first heartbeat after a release, over every instant of 100 tilts; `sample` and `look`
are the costs of a sample and of a heartbeat.
"""

from __future__ import annotations

import json
import math
import random
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np

from app.device.motion import GRAVITY, Axes, leaned
from app.inputs.motion.tilt import Level, Tilt, TiltSettings, between, shaped
from bench.support.figures import Figure
from bench.support.harness import Context, Sides

NAIVE = "angles from level, low pass 2 Hz"
WALKING = TiltSettings(walking=True)
BEAT = 0.03
"""Between two heartbeats [s]."""
CLOSES = 1.0
"""When the clutch is closed [s]."""
LEANS, LEANS_AT, SETTLED = 16.0, 3.0, 5.0
"""The upper edge goes down by so much [deg], at that time [s]; what is commanded counts from the third on [s]."""
FIGURES = (
    Figure("made_mean", "", "synthesised walker, mean command", 0.02, against=NAIVE),
    Figure("made_busy", "%", "synthesised walker, heartbeats with a command", 5, against=NAIVE),
    Figure("walk_mean", "", "recorded walkers, mean command", 0.02, against=NAIVE, needs_data=True),
    Figure(
        "walk_busy",
        "%",
        "recorded walkers, heartbeats with a command",
        5,
        against=NAIVE,
        needs_data=True,
    ),
    Figure("walk_worst", "", "the worst recording, mean command", against=NAIVE, needs_data=True),
    Figure("made_turns", "%", "synthesised walker at 16° ahead, heartbeats with a turn", 5, against=NAIVE),
    Figure(
        "walk_turns",
        "%",
        "recorded walkers at 16° ahead, heartbeats with a turn",
        5,
        against=NAIVE,
        needs_data=True,
    ),
    Figure("release", "", "command at the first look after a release, worst", 0),
    Figure("reach", "s", "from a sudden tilt of 30° to 90 % of the command, fused gravity", 0.6),
    Figure("sample", "µs", "a sample, fused gravity, median"),
    Figure("look", "µs", "a heartbeat, median"),
)
REPEATS = 1

Walk = tuple[float, list[Axes]]
"""Rate [Hz] and samples [m/s²]."""


class Commands(NamedTuple):
    """The commands of one walk, to the right and ahead, one a heartbeat."""

    told: list[tuple[float, float]]

    @property
    def lengths(self) -> list[float]:
        """Of all."""
        return [math.hypot(*one) for one in self.told]

    @property
    def mean(self) -> float:
        """Of all."""
        return sum(self.lengths) / max(1, len(self.told))


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """Read what there is."""
    made = [_made(seed) for seed in range(8)]
    recorded = list(_recorded(context.data)) if context.data else []
    yield Sides(
        lambda: _walks(_ours, made, recorded) | {"release": _release(), "reach": _reach()} | _costs(),
        lambda: _walks(_naive, made, recorded),
    )


def _walks(
    way: Callable[[Walk], Commands], made: Sequence[Walk], recorded: Sequence[Walk]
) -> dict[str, float]:
    found: dict[str, float] = {}
    for name, walks in (("made", made), ("walk", recorded)):
        if walks:
            told = [way(walk) for walk in walks]
            together = Commands([one for each in told for one in each.told])
            found[f"{name}_mean"] = together.mean
            found[f"{name}_busy"] = 100.0 * sum(one > 0.0 for one in together.lengths) / len(together.told)
            settled = math.ceil((SETTLED - CLOSES) / BEAT)
            turns = [one[0] != 0.0 for walk in walks for one in way(_leaning(walk)).told[settled:]]
            found[f"{name}_turns"] = 100.0 * sum(turns) / len(turns)
            if name == "walk":
                found["walk_worst"] = max(each.mean for each in told)
    return found


def _ours(walk: Walk) -> Commands:
    rate, samples = walk
    tilt, level, due = Tilt(WALKING), Level(), CLOSES
    told: list[tuple[float, float]] = []
    for n, a in enumerate(samples):
        t = n / rate
        tilt.feed(t, level(t, a))
        tilt.feel(t, a)
        if t >= due:
            if (
                not tilt.pressed or tilt.why
            ):  # a clutch that opened is pressed anew: what opened it hides nothing
                tilt.release()
                tilt.press(t)
            told.append(tilt.update(t))
            due += BEAT
    return Commands(told)


def _naive(walk: Walk) -> Commands:
    rate, samples = walk
    weight = 1.0 / (1.0 + rate / (2.0 * math.pi * 2.0))
    roll = pitch = 0.0
    neutral, due = (0.0, 0.0), CLOSES
    told: list[tuple[float, float]] = []
    for n, a in enumerate(samples):
        seen = between((0.0, 0.0, 1.0), a)
        roll, pitch = roll + weight * (seen[0] - roll), pitch + weight * (seen[1] - pitch)
        if n / rate >= due:
            neutral = neutral if told else (roll, pitch)
            told.append(_by_direction(roll - neutral[0], pitch - neutral[1]))
            due += BEAT
    return Commands(told)


def _by_direction(roll: float, pitch: float) -> tuple[float, float]:
    """The command along the tilt, with the same dead zone about neutral and none across."""
    share, tilt = math.hypot(*shaped(roll, pitch, WALKING)), math.hypot(roll, pitch)
    return (share * roll / tilt, share * pitch / tilt) if tilt > 0.0 else (0.0, 0.0)


def _leaning(walk: Walk) -> Walk:
    """The same with the upper edge down by so much from the third second on, however it is held."""
    rate, samples = walk
    held = np.mean(samples, axis=0)
    right = np.array([1.0, 0.0, 0.0]) - held * held[0] / (held @ held)
    x, y, z = right / np.linalg.norm(right)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angle = math.radians(LEANS)
    turn = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    begins = math.ceil(LEANS_AT * rate)
    leaning = np.array(samples)[begins:] @ turn.T
    return rate, samples[:begins] + [(a, b, c) for a, b, c in leaning.tolist()]


def _made(seed: int, seconds: float = 120.0, rate: float = 50.0) -> Walk:
    """Steps: up and down twice as strong as to the sides, sideways at half their rate."""
    chance = random.Random(seed)
    pace, strength = chance.uniform(1.5, 2.2), chance.uniform(1.2, 2.2)
    held = math.radians(chance.uniform(10, 45))
    samples: list[Axes] = []
    for n in range(round(seconds * rate)):
        step = 2 * math.pi * pace * n / rate
        sinks = math.radians(5.0 * math.sin(2 * math.pi * n / rate / 40.0 + seed))
        x, y, z = leaned(math.radians(1.5 * math.sin(step / 2)), -held + sinks)
        up = strength * (1.6 * math.sin(step) + 0.6 * math.sin(2 * step + 1))
        forth, aside = strength * math.sin(step + 0.7), 0.7 * strength * math.sin(step / 2)
        noise = [chance.gauss(0, 0.3) for _ in range(3)]
        samples.append((x + aside + noise[0], y + forth + noise[1], z + up + noise[2]))
    return rate, samples


def _recorded(data: Path) -> Iterator[Walk]:
    """Walks with the phone in the hand, wherever below the folder they are listed."""
    for index in sorted([*data.glob("index.json"), *data.glob("*/index.json")]):
        wanted = [one for one in json.loads(index.read_text()) if one["label"] == "walk_inhand"]
        if wanted:
            with np.load(index.with_name("acc.npz")) as kept:
                for one in wanted:
                    axes = kept[one["key"]].astype(float) / 400.0
                    yield one["fs"], [(x, y, z) for x, y, z in axes.tolist()]


def _tilted(tilt: Tilt, begun: float, seconds: float, axes: Axes) -> float:
    """Hold it so; the time afterwards."""
    for n in range(round(seconds * 50)):
        tilt.feed(begun + n / 50, axes)
        tilt.update(begun + n / 50)
    return begun + seconds


def _release() -> float:
    worst, chance = 0.0, random.Random(1)
    for n in range(100):
        tilt = Tilt()
        now = _tilted(tilt, 0.0, 0.4, (0.0, 0.0, GRAVITY))
        tilt.press(now)
        now = _tilted(tilt, now, 0.02 * n, leaned(chance.uniform(-0.7, 0.7), chance.uniform(-0.7, 0.7)))
        tilt.release()
        worst = max(worst, math.hypot(*tilt.update(now)))
    return worst


def _reach() -> float:
    tilt = Tilt()
    begun = _tilted(tilt, 0.0, 0.4, (0.0, 0.0, GRAVITY))
    tilt.press(begun)
    for n in range(100):
        now = begun + n / 50
        tilt.feed(now, leaned(0.0, math.radians(30)))
        if tilt.update(now)[1] >= 0.9:
            return now - begun
    return math.inf


def _costs() -> dict[str, float]:
    rounds = 2000
    tilt = Tilt()
    tilt.press(_tilted(tilt, 0.0, 0.4, (0.0, 0.0, GRAVITY)))
    spent: dict[str, list[float]] = {"sample": [], "look": []}
    for n in range(rounds):
        now, axes = 0.4 + n / 50, leaned(0.2 * math.sin(n / 20), 0.3)
        begun = time.perf_counter()
        tilt.feed(now, axes)
        between_ = time.perf_counter()
        tilt.update(now)
        spent["sample"].append(between_ - begun)
        spent["look"].append(time.perf_counter() - between_)
    return {name: 1e6 * sorted(those)[rounds // 2] for name, those in spent.items()}
