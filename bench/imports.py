"""What the handheld imports before its first frame, and for a robot, beside Kivy with its window and one button.

Each is a process of its own, off screen, with modules that are compiled already, as from a program's second start on.
Processor time counts from the start of the process, Python's own start included; other programs hardly change it. The
modules that the first frame must not load are named in `tests/app/test_start.py`.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from bench.support.child import child
from bench.support.figures import Figure
from bench.support.harness import Context, Sides

KIVY = "Kivy with its window"
FIGURES = (
    Figure(
        "first_frame", "s", "processor time of all imports before the first frame", against=KIVY, share=1.5
    ),
    Figure("modules", "", "modules loaded then", against=KIVY, share=1.8),
    Figure("robot", "s", "the same with what a robot needs besides", against=KIVY, share=2.5),
    Figure("robot_modules", "", "modules loaded then", against=KIVY, share=3),
)
REPEATS = 7


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Everything is compiled once before it is measured."""
    ours()
    yield Sides(ours, peer)


def _imported(what: str) -> tuple[float, float]:
    with child("bench.support.importing", what) as process:
        told = process.receive()
    return told["cpu"], told["modules"]


def ours() -> dict[str, float]:
    """One sample of every figure."""
    (cpu, modules), (robot_cpu, robot_modules) = _imported("app"), _imported("robot")
    return {"first_frame": cpu, "modules": modules, "robot": robot_cpu, "robot_modules": robot_modules}


def peer() -> dict[str, float]:
    """Kivy alone."""
    cpu, modules = _imported("kivy")
    return {"first_frame": cpu, "modules": modules, "robot": cpu, "robot_modules": modules}
