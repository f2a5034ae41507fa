"""A build without the study: the app starts, drives and stops a robot, and offers neither log nor study."""

from __future__ import annotations

import ast
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from pathlib import Path
from typing import Any

import pytest

from app.core.optional_parts import is_included
from app.intents.intents import Heard
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

APP = Path(__file__).parents[2] / "app"
LEFT_OUT = ("app.study", "app.screens.inputs.study")


def _is_left_out(module: str) -> bool:
    return any(module == part or module.startswith(f"{part}.") for part in LEFT_OUT)


class Without(MetaPathFinder):
    """Finds what is left out no more than an interpreter whose folders lack it."""

    def find_spec(self, name: str, path: Sequence[str] | None, target: Any = None) -> None:
        if _is_left_out(name):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


@pytest.fixture
def without_study(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if _is_left_out(name)]:
        monkeypatch.delitem(sys.modules, name)
    for part in LEFT_OUT:
        parent, _, leaf = part.rpartition(".")
        monkeypatch.delattr(sys.modules[parent], leaf, raising=False) if parent in sys.modules else None
    monkeypatch.setattr(sys, "meta_path", [Without(), *sys.meta_path])


def test_nothing_beside_the_study_imports_it() -> None:
    wrong = []
    for path in APP.rglob("*.py"):
        module = ".".join(("app", *path.relative_to(APP).with_suffix("").parts)).removesuffix(".__init__")
        if _is_left_out(module):
            continue
        for node in ast.walk(ast.parse(path.read_text())):
            named = []
            if isinstance(node, ast.ImportFrom) and node.module:
                named = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
            elif isinstance(node, ast.Import):
                named = [alias.name for alias in node.names]
            wrong += [f"{module} imports {name}" for name in named if _is_left_out(name)]
    assert not wrong


def test_the_app_works_without_it_and_offers_no_log(
    without_study: None, glass: Glass, robot: FakeRobot
) -> None:
    app = glass.app
    assert not is_included("app.study.response_recording")
    assert app.methods.get("log") is None
    assert app.methods.faults == {}, "what is left out is no fault"
    for name in ("voice", "shake", "tilt", "switches", "gamepad", "keyboard"):
        assert app.methods.get(name) is not None, name
    app.open(robot.url)
    glass.until(lambda: app.shell is not None, "no screens")
    glass.until(lambda: app.session.control == "mine", "no control")
    app.show("inputs")
    glass.stage.frames(3)
    screen = app.screens["inputs"]
    assert "study" not in screen.rows
    for name in screen.rows:
        screen.open(name)
        glass.stage.frames(3)
        assert screen.pane(name).parent is not None, name
    app.intents.submit(Heard("screen.drive", "keyboard", began=app.now(), said="d"))
    glass.until(lambda: app.shell.screen == "drive", "the command was not carried out")
    app.intents.submit(Heard("stop", "keyboard", began=app.now()))
    glass.until(lambda: any(name == "/stop" for name, _ in robot.asked), "STOP was not sent")
