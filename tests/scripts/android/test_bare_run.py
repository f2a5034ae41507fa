"""An app is started from its sources and from compiled files, and has to come up and draw."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from scripts.android.bare_run import check_runs, requirements
from scripts.android.failure import Failed
from scripts.android.recipes import Module, Recipe, Resolved

APP = """
import os
os.environ.update(KIVY_NO_ARGS="1", KIVY_NO_CONFIG="1", KIVY_NO_FILELOG="1")
from kivy.app import App
from kivy.uix.label import Label

class Small(App):
    def build(self):
        return Label(text="here")

if __name__ == "__main__":
    Small().run()
"""


def started(folder: Path, text: str) -> str:
    tree = folder / "tree"
    tree.mkdir()
    (tree / "main.py").write_text(text)
    return check_runs(Path(sys.executable), tree, folder)


def test_the_package_has_recipes_in_their_versions_and_modules_in_their_pins():
    recipes = (Recipe("numpy", "v2.3.0", "v2.3.0", 0), Recipe("sdl2_ttf", "2.22.0", "2.22.0", 0),
               Recipe("python3", "3.14.2", "3.14.2", 2))  # fmt: skip
    modules = (Module("plyer", "2.1.0", "", "", ""), Module("idna", "", "", "", ""))
    assert list(requirements(Resolved("sdl2", "3.14.2", recipes, modules))) == [
        "numpy==2.3.0",
        "plyer==2.1.0",
        "idna",
    ]


def test_an_app_that_draws_is_said_to_run_both_ways(tmp_path):
    assert started(tmp_path, APP).endswith("1 widgets from sources (-OO), 1 from compiled files")


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("from kivy.uix.label", "import nowhere\nfrom kivy.uix.label", "No module named 'nowhere'"),
        ("Small().run()", "pass", r"main\.py drew nothing"),
        (
            'Label(text="here")',
            'Label(text=__file__ if __file__.endswith(".py") else 1 / 0)',
            "division by zero",
        ),
    ],
)
def test_a_planted_fault_is_told(tmp_path, old, new, why):
    with pytest.raises(Failed, match=why):
        started(tmp_path, APP.replace(old, new))
