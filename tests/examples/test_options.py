from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

from bridge.discovery.domain import VARIABLE
from examples.demo import (
    aqua,
    ardrone,
    commander,
    connecting,
    errand,
    minnow,
    others,
    patrol,
    prepare,
    scout,
    streets,
    vehicle,
)
from examples.demo.__main__ import main
from examples.demo.options import STORIES, options


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--size", "foo"], "A size is written as 412x892, not 'foo'."),
        (["--theme", "foo"], "There is no theme 'foo'; there are dark, sunlight, night."),
        (["--until", "foo"], f"There is no step 'foo'; there are {', '.join(STORIES['patrol'])}."),
        (["--story", "foo"], "There is no story 'foo' of patrol; there is patrol, errand."),
        (["--robot", "scout", "--story", "errand"], "There is no story 'errand' of scout; there is scout."),
        (
            ["--robot", "foo"],
            "There is no robot 'foo'; there are patrol, scout, commander, minnow, aqua, ardrone.",
        ),
        (
            ["--world", "foo"],
            "There is no world 'foo'; there is lake, office, orchard, parking_lot, tank.",
        ),
        (["--robot", "minnow", "--world", "office"], "A minnow cannot be in the world 'office'."),
        (["--speed", "0"], "The speed must be above 0 and at most 100, not 0.0."),
        (["--drawn", "0"], "One frame in 1 or more is drawn, not one in 0."),
        (["--speed", "fast"], "Argument --speed: invalid float value: 'fast'."),
        (["--sizes", "1"], "Unrecognized arguments: --sizes 1."),
    ],
)
def test_a_mistake_is_told_in_one_sentence_with_exit_code_2(arguments, sentence, capsys):
    assert main(arguments) == 2
    assert capsys.readouterr().err == f"demo: {sentence}\n"


def test_what_is_allowed_is_taken():
    chosen = options(["--size", "412x892", "--theme", "night", "--until", "sent", "--speed", "2"], None)
    assert (chosen.size, chosen.theme, chosen.until, chosen.speed) == ("412x892", "night", "sent", 2.0)


@pytest.mark.parametrize(
    ("robot", "world"),
    [("patrol", "parking_lot"), ("scout", "office"), ("minnow", "lake"), ("aqua", "tank")],
)
def test_a_robot_has_its_home_its_story_and_its_folder(robot, world):
    chosen = options(["--robot", robot], None)
    folder = "out/demo" if robot == "patrol" else f"out/demo-{robot}"
    assert (chosen.story, chosen.world, chosen.out) == (robot, world, Path(folder))


def test_a_drone_can_be_elsewhere_than_at_home():
    assert options(["--robot", "ardrone", "--world", "office"], None).world == "office"


VEHICLE = (connecting, vehicle)


@pytest.mark.parametrize(
    ("story", "modules"),
    [
        ("patrol", (connecting, prepare, streets, patrol)),
        ("errand", (errand, others)),
        ("scout", (*VEHICLE, scout)),
        ("commander", (*VEHICLE, commander)),
        ("minnow", (*VEHICLE, minnow)),
        ("aqua", (*VEHICLE, aqua)),
        ("ardrone", (*VEHICLE, ardrone)),
    ],
)
def test_the_steps_are_those_of_the_story(story, modules):
    trees = [ast.parse(Path(module.__file__).read_text()) for module in modules]
    steps = [name for tree in trees for name in _steps(tree)]
    assert set(steps) == set(STORIES[story])
    assert len(steps) == len(STORIES[story])


def _steps(tree):
    """The names of steps, written in the call or in what the call's loop runs over."""
    loops = [node for node in ast.walk(tree) if isinstance(node, ast.For)]
    looped = {
        loop.target.elts[0].id: [item.elts[0].value for item in loop.iter.elts]
        for loop in loops
        if isinstance(loop.target, ast.Tuple) and isinstance(loop.iter, ast.Tuple)
    }
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr == "step":
            name = call.args[0]
            yield from [name.value] if isinstance(name, ast.Constant) else looped[name.id]


def test_the_demo_is_in_a_discovery_domain_of_its_own() -> None:
    """It sets Kivy up as well, which a process does once: one of its own."""
    code = (
        "import os; from bridge.discovery.domain import discovery_domain; from examples.demo.__main__ import _prepare\n"
        "_prepare('800x600', window=False); print(discovery_domain() == f'demo-{os.getpid()}')"
    )
    root = Path(__file__).parents[2]
    around = {**os.environ, VARIABLE: "somebody_elses", "PYTHONPATH": str(root)}
    ran = subprocess.run(
        [sys.executable, "-c", code], cwd=root, env=around, capture_output=True, text=True, check=True
    )
    assert ran.stdout.splitlines()[-1] == "True"
