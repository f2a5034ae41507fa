"""The pane of the switches: what is chosen by fingers, which key comes next, and the test that finds a pace."""

from __future__ import annotations

import random
from types import SimpleNamespace
from typing import Any

import pytest

from app.inputs.base.button_presses import Press, Presses
from app.inputs.switch_access.scan.engine import Engine
from app.inputs.switch_access.scan.plan import Planner
from app.inputs.switch_access.scan.settings import DEFAULTS, Key
from app.inputs.switch_access.switches import SwitchAccess
from app.screens.inputs.panes.switch_pane import SwitchPane
from tests.headless import Stage


class Settings(dict[str, Any]):
    def set(self, name: str, value: Any) -> None:
        self[name] = value


class Nothing:
    """A glass with nothing on it, and nobody to tell."""

    place = "inputs"

    def __getattr__(self, _: str) -> Any:
        return lambda *_: []


@pytest.fixture
def pane(stage: Stage) -> Any:
    clock = SimpleNamespace(now=0.0)
    app = SimpleNamespace(
        settings=Settings(),
        methods={},
        now=lambda: clock.now,
        inputs=SimpleNamespace(presses=Presses(lambda _: False, lambda _: None), is_switch=None),
    )
    switches = app.methods["switches"] = SwitchAccess(app)
    switches._engine = Engine(Nothing(), Planner({}), Nothing())
    switches.start()
    pane = stage.show(SwitchPane(app=app), (600, 800))
    pane.clock, pane.presses = clock, app.inputs.presses
    pane.enter()
    stage.frames(2)
    yield pane
    pane.leave()
    switches.stop()


def press(pane: Any, name: str) -> None:
    pane.presses.press(Press("key", 1, name, pane.clock.now))
    pane.presses.release("key", 0, name)


def test_what_is_only_for_one_switch_is_there_only_then(pane: Any) -> None:
    assert pane.rows["a"].parent is not None
    assert pane.picture.parent is None
    pane.kind.choose("one")
    assert pane.switches.options.one
    assert pane.rows["a"].parent is None
    assert pane.picture.parent is not None


def test_the_next_key_becomes_the_switch_and_leaves_the_other_one(pane: Any) -> None:
    pane._ask("a")
    assert "Press the key" in pane.rows["a"].detail
    press(pane, "enter")
    assert pane.switches.options.a == (Key("key", "tab"), Key("key", "enter"))
    assert pane.switches.options.b == (Key("key", "numpadenter"),)
    assert "Tab, Enter" in pane.rows["a"].detail


def test_leaving_asks_for_no_key_any_more(pane: Any) -> None:
    pane._ask("b")
    assert pane.back()
    press(pane, "f5")
    assert pane.switches.options.b == DEFAULTS.b


def test_without_a_key_it_says_so(pane: Any) -> None:
    for _ in range(2):
        pane._clear("b")
    assert "No key is assigned to the switch" in pane.remark.text


def test_a_figure_is_kept_and_all_are_put_back_by_one_button(pane: Any) -> None:
    pane.numbers["acceptance"].count(4)
    assert pane.switches.options.acceptance == pytest.approx(0.2)
    pane._ask("a")
    press(pane, "f5")
    pane.reset.dispatch("on_release")
    assert pane.switches.options == DEFAULTS


def test_the_test_proposes_an_interval_and_a_button_takes_it(pane: Any) -> None:
    pane.kind.choose("one")
    pane.test._rng = random.Random(1)
    pane.begin.dispatch("on_release")
    for _ in range(pane.test.of):
        while pane.picture.phase != "go":
            pane.clock.now += 0.05
            pane.switches.update(pane.clock.now)
            pane._watch()
        pane.clock.now += 0.6
        press(pane, "enter")
        pane.clock.now += 0.2
        pane.switches.update(pane.clock.now)
    assert pane.picture.phase == "done"
    assert pane.begin.text == "Take 1.0 s"
    pane.begin.dispatch("on_release")
    assert pane.switches.options.interval == 1.0
    assert pane.picture.phase == "idle"


def test_leaving_ends_the_test_and_gives_the_switch_back(pane: Any) -> None:
    pane.kind.choose("one")
    pane.begin.dispatch("on_release")
    assert pane.switches.engine.first == pane._hear
    pane.leave()
    assert pane.switches.engine.first != pane._hear
    assert pane.picture.phase == "idle"
