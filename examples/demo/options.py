"""Command-line options of the demo."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

from app.__main__ import SIZE, THEMES
from sim.robot import model_of
from sim.vehicles.model import suits
from sim.world.world_files import load

__all__ = ["STORIES", "options"]

_MEETING = ("connect-screen", "connected", "profile")
_STOP = ("stop", "released", "phone")

STORIES = {
    "patrol": (
        *("connect-screen", "connected", "misplaced", "initialised", "points", "dragged", "reordered"),
        *(
            "deleted",
            "undone",
            "home",
            "motion",
            "sent",
            "streets",
            "started",
            "on-the-way",
            "paused",
            "resumed",
        ),
        *("patrolled", "stop", "released", "going-home", "at-home", "drive-screen", "driven"),
        "stop-while-driving",
    ),
    "errand": (
        *("fenced", "place-made", "place-here", "ordered", "picked-up", "handed-over", "delivered"),
        *("asked-for-control", "control-handed-over", "control-back", "power-cut", "offered", "discarded"),
    ),
    "scout": (*_MEETING, "driven", *_STOP, "goal", "on-the-way", "at-goal"),
    "commander": (*_MEETING, "slow", "driven", "rear", *_STOP, "points", "patrolling", "patrolled"),
    "minnow": (*_MEETING, "driven", *_STOP, "course", "on-course", "points", "patrolled", "home"),
    "aqua": (*_MEETING, "driven", *_STOP, "switches", "depth-held", "warm", "surfaced"),
    "ardrone": (*_MEETING, "let-go", "taken-off", "driven", "hover", *_STOP, "landed"),
}
"""The steps of each story, in their order."""
ROBOTS = {"patrol": ("patrol", "errand")} | {name: (name,) for name in list(STORIES)[2:]}
"""The stories of each robot, the usual one first."""
MAX_SPEED = 100.0
"""The robot's own limit of `--speed`."""


class _Parser(argparse.ArgumentParser):
    """Reports a mistake in one sentence."""

    def error(self, message: str) -> NoReturn:
        raise ValueError(f"{message[:1].upper()}{message[1:]}.")


def options(argv: Sequence[str] | None, description: str | None) -> argparse.Namespace:
    """Read the command line; ValueError with one sentence for a mistake."""
    parser = _Parser(prog="python -m examples.demo", description=description)
    parser.add_argument("--robot", default="patrol", metavar="NAME", help=f"one of {', '.join(ROBOTS)}")
    parser.add_argument(
        "--world", default="", help="where it is: a name or a TOML file; its home if left out"
    )
    parser.add_argument(
        "--out", type=Path, help="where the pictures go; out/demo for the patrol, else out/demo-STORY"
    )
    parser.add_argument(
        "--speed", type=float, default=1.0, help="robot seconds per second; the app shows true ages only at 1"
    )
    parser.add_argument("--size", default="1280x800", metavar="WxH", help="of the window")
    parser.add_argument("--theme", default="dark", help="dark, sunlight or night")
    parser.add_argument("--pictures", type=Path, metavar="DIR", help="where the guide's pictures go as well")
    parser.add_argument(
        "--story",
        default="",
        help="of the patrol robot, which has two; patrol: place the robot, set points, patrol, stop, drive; errand: places, a delivery, a queue, hand-over, a power cut",
    )
    parser.add_argument("--until", metavar="STEP", help="end after this step, as in sent")
    parser.add_argument(
        "--drawn",
        type=int,
        default=1,
        metavar="N",
        help="draw one frame in N, and every picture all the same",
    )
    parser.add_argument("--window", action="store_true", help="in a window, to watch it")
    chosen = parser.parse_args(argv)
    _choose(chosen)
    _check(chosen)
    return chosen


def _choose(chosen: argparse.Namespace) -> None:
    """Fill in the defaults of the robot for options that were left out."""
    if chosen.robot not in ROBOTS:
        raise ValueError(f"There is no robot {chosen.robot!r}; there are {', '.join(ROBOTS)}.")
    stories = ROBOTS[chosen.robot]
    chosen.story = chosen.story or stories[0]
    if chosen.story not in stories:
        raise ValueError(
            f"There is no story {chosen.story!r} of {chosen.robot}; there is {', '.join(stories)}."
        )
    model = model_of(chosen.robot)
    chosen.world = chosen.world or model.home
    if not suits(model, load(chosen.world)):
        raise ValueError(f"A {chosen.robot} cannot be in the world {chosen.world!r}.")
    chosen.out = chosen.out or Path("out/demo" if chosen.story == "patrol" else f"out/demo-{chosen.story}")


def _check(chosen: argparse.Namespace) -> None:
    if not (math.isfinite(chosen.speed) and 0 < chosen.speed <= MAX_SPEED):
        raise ValueError(f"The speed must be above 0 and at most {MAX_SPEED:g}, not {chosen.speed}.")
    if not SIZE.fullmatch(chosen.size):
        raise ValueError(f"A size is written as 412x892, not {chosen.size!r}.")
    if chosen.theme not in THEMES:
        raise ValueError(f"There is no theme {chosen.theme!r}; there are {', '.join(THEMES)}.")
    if chosen.drawn < 1:
        raise ValueError(f"One frame in 1 or more is drawn, not one in {chosen.drawn}.")
    steps = STORIES[chosen.story]
    if chosen.until is not None and chosen.until not in steps:
        raise ValueError(f"There is no step {chosen.until!r}; there are {', '.join(steps)}.")
