"""The built-in simulator as people start it: which robots, which world, and what is said of it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from app.discovery import simulator_process as simulator
from app.discovery.simulator_options import SimulationChoice
from app.screens.connect.simulator_dialog import SimulatorDialog
from sim.catalogue import catalogue
from tests.app.glass import Glass

FAILS = ["sh", "-c", "echo 'The world is flooded.' >&2; exit 2"]


@pytest.fixture(autouse=True)
def offered(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """What there is to choose from is told by a program that is quick."""
    (tmp_path / "offer.json").write_text(json.dumps(catalogue()))
    monkeypatch.setattr(simulator, "inquiry", lambda: ["cat", str(tmp_path / "offer.json")])


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, str]]:
    """What was started, each as robots and world; a program that says that it serves stands for it."""
    calls: list[tuple[str, str]] = []

    def command(robot: str = "sim:patrol", world: str = "") -> list[str]:
        calls.append((robot, world))
        ready = "".join(
            f"echo robotside: ready bridge=ws://127.0.0.1:{4711 + number} http=x robot=R;"
            for number in range(robot.count(",") + 1)
        )
        return ["sh", "-c", f"{ready} exec sleep 600"]

    monkeypatch.setattr(simulator, "command", command)
    return calls


def asked(glass: Glass) -> SimulatorDialog:
    glass.tap(glass.app.connect.ids.simulate)
    dialog = glass.app.simulating.dialog
    assert isinstance(dialog, SimulatorDialog)
    glass.until(lambda: dialog.offered or dialog.problem, "nobody said what there is")
    glass.stage.frames(3)
    return dialog


def test_robots_and_their_world_are_chosen_and_started_together(
    glass: Glass, started: list[tuple[str, str]]
) -> None:
    dialog = asked(glass)
    assert dialog.choice == SimulationChoice(("patrol",), "parking_lot")
    glass.tap(dialog.row("robot", "scout"))
    glass.tap(dialog.row("world", "office"))
    assert dialog.ids.start.text == "Start 2 robots"
    assert dialog.row("world", "lake").disabled
    glass.tap(dialog.ids.start)
    glass.until(lambda: started, "nothing was started")
    assert started == [("sim:patrol,scout", "office")]
    assert glass.app.simulating.dialog is None
    glass.until(lambda: glass.app.connect.simulator_text == "Start another simulation", "it is not ready")
    assert glass.app.session is None
    # the next time it is the same, and what there is is known already
    again = asked(glass)
    assert again.choice == SimulationChoice(("patrol", "scout"), "office")
    assert "The one that runs now ends." in again.sentence
    first = glass.app.simulating.current
    glass.tap(again.ids.start)
    glass.until(lambda: first._process.poll() is not None, "the first one did not end")
    assert len(started) == 2


def test_one_robot_is_connected_to_as_soon_as_it_is_served(
    glass: Glass, started: list[tuple[str, str]]
) -> None:
    dialog = asked(glass)
    glass.tap(dialog.ids.start)
    glass.until(lambda: glass.app.session, "nobody connected")
    assert glass.app.session.link.url == "ws://127.0.0.1:4711"
    assert started == [("sim:patrol", "parking_lot")]


def test_one_that_does_not_start_is_said_and_another_can_be_started(
    glass: Glass, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(simulator, "command", lambda *_: FAILS)
    glass.app.simulating.start(SimulationChoice(("patrol",), "lake"))
    glass.until(lambda: not glass.app.connect.simulating, "it did not fail")
    assert glass.app.connect._banner.text == "The simulator did not start: The world is flooded."
    assert glass.app.connect.simulator_text == "Start the built-in simulator"
    assert glass.app.simulating.current is None


def test_what_cannot_be_asked_is_said_in_the_question(glass: Glass, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simulator, "inquiry", lambda: FAILS)
    dialog = asked(glass)
    assert dialog.sentence == "What can be simulated could not be asked: The world is flooded."
    assert dialog.ids.start.disabled
    assert glass.app.back()
    assert glass.app.simulating.dialog is None


def test_an_answer_that_is_not_to_be_understood_is_said_too(
    glass: Glass, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(simulator, "inquiry", lambda: ["echo", "hello"])
    assert asked(glass).problem == "What the simulator offers is not to be understood."


def test_a_finger_beside_the_card_changes_nothing_and_closes_it(
    glass: Glass, started: list[tuple[str, str]]
) -> None:
    asked(glass)
    glass.stage.tap(3, 3)
    assert glass.app.simulating.dialog is None
    assert started == []
