"""The pane where tilting is set up, by an app that is only what it asks for."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.screens.inputs.panes.tilt_pane import AMOUNTS, FIXED, FREE, SWITCHES, TiltPane
from tests.app.inputs.motion.test_tilt_input import Handheld


@pytest.fixture
def shown() -> tuple[Handheld, TiltPane]:
    handheld: Any = Handheld()
    handheld.methods = SimpleNamespace(get=lambda _: handheld.tilting)
    handheld.inputs.mapped = SimpleNamespace(keys=SimpleNamespace(keys_of=lambda _: ["t"]))
    pane = TiltPane(app=handheld)
    pane.enter()
    return handheld, pane


def rows(pane: TiltPane) -> list[str]:
    return [row.title for row in reversed(pane._column.children) if hasattr(row, "title")]


def test_off_it_says_how_to_try_it(shown: tuple[Handheld, TiltPane]) -> None:
    _, pane = shown
    assert pane.circle.state == "disabled"
    assert pane.says.text == "Switch tilting on to try it here."


def test_on_it_leads_the_circle_of_the_pane_and_none_that_drives(shown: tuple[Handheld, TiltPane]) -> None:
    handheld, pane = shown
    handheld.on().run(1.0)
    pane.tick()
    assert pane.says.text == "Hold the circle, or the key T, and tilt. This one drives nothing."
    assert pane.sensor.text.endswith("Hz, fused gravity")
    handheld.tilting.clutch(down=True)
    handheld.run(0.1)
    handheld.run(1.0, roll=-10, pitch=20)
    pane.tick()
    assert pane.lean.text == "20° ahead\n10° left"
    assert pane.circle.forward > 0.3
    assert handheld.told == []
    pane.leave()
    assert pane.circle.forward == 0.0


def test_every_figure_and_every_switch_is_set_from_here(shown: tuple[Handheld, TiltPane]) -> None:
    handheld, pane = shown
    handheld.on().run(0.5)
    before = handheld.settings.get("tilt")
    for name in AMOUNTS:
        pane.steppers[name].count(1)
    for name in SWITCHES:
        if name != "simulate":
            pane.toggles[name].trigger_action(0)
    after = handheld.settings["tilt"]
    assert (after["full"], after["expo"]) == (26.0, 0.5)
    assert {name for name in after if after[name] != before[name]} == {*AMOUNTS, *SWITCHES} - {
        "simulate",
        "fixed",
    } | {"neutral"}


def test_neutral_can_be_set_where_it_is_known_and_given_free_again(shown: tuple[Handheld, TiltPane]) -> None:
    handheld, pane = shown
    pane.tick()
    assert pane._rows["fixed"].disabled
    handheld.on().run(0.5)
    pane.tick()
    for words in (FIXED, FREE):
        pane._rows["fixed"].dispatch("on_release")
        assert pane._rows["fixed"].detail == words


def test_only_where_there_is_no_sensor_a_tablet_is_simulated(shown: tuple[Handheld, TiltPane]) -> None:
    handheld, pane = shown
    assert "Simulate a tablet" not in rows(pane)
    handheld.source.kinds, handheld.source.possible = frozenset(), False  # type: ignore[misc]
    pane.tick()
    assert rows(pane)[-1] == "Simulate a tablet"


def test_without_a_sensor_the_circle_invites_to_nothing(shown: tuple[Handheld, TiltPane]) -> None:
    handheld, pane = shown
    handheld.on().run(0.5)
    pane.tick()
    assert (pane.circle.state, pane.circle.missing) == ("live", "")
    handheld.source.kinds, handheld.source.possible = frozenset(), False  # type: ignore[misc]
    handheld.source.sentence = "No sensor here."  # type: ignore[misc]
    pane.tick()
    assert (pane.circle.state, pane.circle.missing) == ("disabled", "No sensor here.")
    assert "hold it to tilt" not in " ".join(pane.circle.texts)


def test_what_is_wrong_with_the_sensor_is_said(shown: tuple[Handheld, TiltPane]) -> None:
    handheld, pane = shown
    handheld.on().run(0.5)
    handheld.time += 1.0
    pane.tick()
    assert (pane.sensor.text, pane.sensor.role) == ("The gravity sensor is silent.", "warn")
