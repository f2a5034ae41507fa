"""A robot that carries an arm and lights before the app, as a user starts it: a finger on its tip, and STOP."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.client.remote_robot import RemoteRobot
from bridge.msgs.pilothouse_msgs import ArmState, LightState
from examples.demo.robot import RobotProcess
from tests.e2e.handheld import Handheld, handheld


class Armed:
    """What a second client hears of the arm and the lights."""

    def __init__(self, url: str) -> None:
        self.robot = RemoteRobot(url)
        self.arm, self.lights = ArmState(), LightState()
        self.robot.on("/arm", lambda msg: setattr(self, "arm", msg))
        self.robot.on("/lights", lambda msg: setattr(self, "lights", msg))

    @property
    def moves(self) -> bool:
        return any(abs(a - b) > 1e-3 for a, b in zip(self.arm.angles, self.arm.wanted, strict=True))


@pytest.fixture(scope="module")
def carrier(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RobotProcess]:
    folder = tmp_path_factory.mktemp("carrier")
    options = ("--robot", "sim:patrol", "--world", "orchard", "--payloads", "arm,lights,camera")
    with RobotProcess(*options, "--state", str(folder / "state"), log=folder / "robot.log") as process:
        yield process


@pytest.fixture
def told(carrier: RobotProcess) -> Iterator[Armed]:
    armed = Armed(carrier.url)
    yield armed
    armed.robot.close()


def drag(glass: Handheld, by: tuple[float, float]) -> None:
    """A finger on the tip, and on by so many metres ahead and up."""
    panel = glass.one("ArmPanel")
    side = panel.side
    x, y = panel.to_window(*panel.tip_on_glass)
    way = [(x + share * by[0] * side.scale, y + share * by[1] * side.scale) for share in (0.0, 0.3, 0.7, 1.0)]
    finger = glass.hand.down(way[0])
    for place in way[1:]:
        glass.run(0.05)
        glass.hand.move(finger, place)
    glass.run(0.05)
    glass.hand.up(finger)
    glass.run(0.05)


def test_a_finger_leads_the_arm_what_it_does_not_reach_is_said_and_stop_holds_it(
    carrier: RobotProcess, told: Armed, tmp_path: Path
) -> None:
    with handheld(tmp_path, url=carrier.url, discover=False, screen="drive") as glass:
        glass.control()
        glass.tap("Arm", "Segment")
        glass.until(lambda: glass.one("ArmPanel").state == "live", "the arm's state")
        glass.tap("Home", "PoseKey")
        glass.until(
            lambda: told.arm.pose == "home" and glass.one("ArmPanel").pose == "home", "the arm at home"
        )
        before = told.arm.tip
        drag(glass, (0.05, -0.10))
        glass.until(
            lambda: math.dist((told.arm.tip.x, told.arm.tip.z), (before.x, before.z)) > 0.05, "a move"
        )
        glass.until(lambda: not told.moves, "the arm to arrive")
        assert told.arm.tip.x == pytest.approx(before.x + 0.05, abs=0.012)
        assert told.arm.tip.z == pytest.approx(before.z - 0.10, abs=0.012)
        there = told.arm.tip
        drag(glass, (0.18, 0.24))
        glass.until(lambda: any("does not reach" in words for words in glass.words()), "why it is refused")
        assert told.arm.tip == there

        panel = glass.one("ArmPanel")
        panel.turn(-2.6)
        glass.until(lambda: told.arm.angles[0] < -2.59, "the foot turned")
        panel.turn(2.6)  # nearly once round, which takes long enough to be stopped
        glass.until(lambda: told.moves, "the arm on its way")
        stop = glass.one("StopButton")
        glass.play(glass.hand.tap(stop.to_window(*stop.center)))
        glass.until(lambda: stop.phase == "stopped", "STOPPED on the button", 5.0)
        glass.until(lambda: not told.moves, "the arm at rest", 2.0)
        held = list(told.arm.angles)
        assert held[0] < 2.5, "it was stopped on its way"
        glass.run(0.5)
        assert list(told.arm.angles) == held
        assert glass.one("ArmPanel").disabled


def test_lights_and_the_camera_that_looks_back_have_buttons_by_themselves(
    carrier: RobotProcess, told: Armed, tmp_path: Path
) -> None:
    with handheld(tmp_path, url=carrier.url, discover=False, screen="drive") as glass:
        session = glass.app.session
        glass.control()
        # what the button would do follows from it
        glass.until(lambda: session.feeds.latest("/lights") is not None, "the lights' state")
        glass.tap("More", "QuietButton")
        glass.run(0.6)  # a button whose meaning has just changed takes no press
        glass.tap("Lights", "QuietButton")
        glass.until(lambda: told.lights.brightness == 1.0, "light")
        first = session.cameras.wanted(None)
        glass.tap("More", "QuietButton")
        glass.run(0.6)
        glass.tap("Camera", "QuietButton")
        glass.until(lambda: session.cameras.wanted(None) == "rear" != first, "the camera that looks back")
