from __future__ import annotations

import ast
from pathlib import Path

import pytest

from examples.demo import patrol, prepare
from examples.demo.__main__ import main
from examples.demo.options import STEPS, options


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--size", "foo"], "A size is written as 412x892, not 'foo'."),
        (["--theme", "foo"], "There is no theme 'foo'; there are dark, sunlight, night."),
        (["--until", "foo"], f"There is no step 'foo'; there are {', '.join(STEPS)}."),
        (["--speed", "0"], "The speed must be above 0 and at most 100, not 0.0."),
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


def test_the_steps_are_those_of_the_story():
    trees = [ast.parse(Path(module.__file__).read_text()) for module in (prepare, patrol)]
    calls = [node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Call)]
    steps = [c.args[0].value for c in calls if isinstance(c.func, ast.Attribute) and c.func.attr == "step"]
    assert set(steps) == set(STEPS)
    assert len(steps) == len(STEPS)
