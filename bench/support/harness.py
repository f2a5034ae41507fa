"""The run of a bench: ours and the peer's way repeated in turn, with the machine's noise measured in between."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple, Protocol, cast

import bench
from bench.support.figures import Figure, Outcome, Samples
from bench.support.noise import Noise

__all__ = ["COUNTS", "ON_DEMAND", "Bench", "Context", "Result", "Sides", "load", "measure", "names"]

Side = Callable[[], Mapping[str, float]]
"""Measures once: a value for each figure's name. A figure may be left out."""


class Sides(NamedTuple):
    """The two ways to compare."""

    ours: Side
    peer: Side | None = None


COUNTS: Mapping[str, tuple[float, str]] = {
    "frames": (1_000_000, "hostile: frames of the attack"),
    "requests": (100_000, "hostile: HTTP requests of the attack"),
    "cuts": (5_000, "link_cuts: links to cut"),
    "kills": (200, "database: kills of the robot side"),
    "flips": (600, "flips: databases to damage"),
    "scenes": (500, "detector: scenes to judge"),
    "hours": (8, "soak: how long"),
}
"""By name of the option, how much a bench does unless told otherwise, and what that is."""


@dataclass(frozen=True, slots=True)
class Context:
    """What a bench may want to know."""

    data: Path | None = None
    """A folder of recordings, for the benches that judge a recogniser."""
    counts: Mapping[str, float] = field(default_factory=dict)
    """How much to do, by the names of `COUNTS`, where the default does not hold."""

    def count(self, name: str) -> float:
        """How much to do, by a name of `COUNTS`."""
        return self.counts.get(name, COUNTS[name][0])


class Bench(Protocol):
    """What a file in `bench/` must have; its docstring describes the method."""

    __doc__: str | None
    FIGURES: tuple[Figure, ...]
    REPEATS: int

    def prepare(self, context: Context) -> AbstractContextManager[Sides]:
        """Set up the measurement; taken down at the end."""
        ...


@dataclass(frozen=True, slots=True)
class Result:
    """What one bench found."""

    name: str
    how: str
    outcomes: list[Outcome]
    noise: Noise = field(default_factory=Noise)


ON_DEMAND = frozenset({"soak"})
"""Benches that take hours: they run only when they are named."""


def names() -> list[str]:
    """Every bench there is."""
    return sorted(
        m.name for m in pkgutil.iter_modules(bench.__path__) if not m.ispkg and m.name != "__main__"
    )


def load(name: str) -> Bench:
    """The bench of that name; ImportError when a library that it needs is missing."""
    return cast("Bench", importlib.import_module(f"bench.{name}"))


def measure(name: str, module: Bench, context: Context, noise: Noise) -> Result:
    """Take `REPEATS` samples a side, in turn; raises what the bench raises."""
    ours: list[Mapping[str, float]] = []
    peer: list[Mapping[str, float]] = []
    noise.sample()
    with module.prepare(context) as sides:
        for _ in range(module.REPEATS):
            ours.append(sides.ours())
            noise.sample()
            if sides.peer:
                peer.append(sides.peer())
                noise.sample()
    outcomes = [Outcome(f, _of(f, ours), _of(f, peer)) for f in module.FIGURES]
    return Result(name, (module.__doc__ or "").strip(), outcomes, noise)


def _of(figure: Figure, rounds: Iterable[Mapping[str, float]]) -> Samples:
    return Samples([values[figure.name] for values in rounds if figure.name in values])
