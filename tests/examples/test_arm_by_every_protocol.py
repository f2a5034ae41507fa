"""The arm, by every protocol at once: limits and STOP are the same, and one of those who ask at the same time moves it."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest

from bridge.client import RemoteRobot
from bridge.msgs.pilothouse_msgs import ArmState
from examples.protocols.ways import Answer, Way, way_to
from tests.examples.everywhere import Everywhere, everywhere

pytestmark = pytest.mark.slow

POSES = {"home": [0.0, -1.05, 0.35, 0.70, 0.0], "rest": [0.0, -1.6, 1.25, 0.35, 0.0]}


@pytest.fixture(scope="module")
def rex(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Everywhere]:
    options = ("--robot", "sim:patrol", "--world", "parking_lot", "--payloads", "arm", "--speed", "0.25")
    with everywhere(tmp_path_factory.mktemp("rex"), *options) as served:
        yield served


@pytest.fixture
def arm(rex: Everywhere) -> Iterator[list[ArmState]]:
    """What is heard of the arm, the newest at the end."""
    told: list[ArmState] = []
    with RemoteRobot(rex.process.url) as robot:
        robot.on("/arm", told.append)
        yield told


@contextmanager
def ways(rex: Everywhere) -> Iterator[dict[str, Way]]:
    """A client by each protocol, called as the protocol is."""
    with ExitStack() as stack:
        yield {name: stack.enter_context(way_to(url, f"by {name}")) for name, url in rex.ways.items()}


def until(condition: Any, what: str) -> None:
    end = time.monotonic() + 120
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.02)


def rested(arm: list[ArmState]) -> list[float]:
    """Where it is once three messages in a row, all after this call, say that it goes nowhere."""
    first = len(arm)
    until(lambda: len(arm) > first + 3 and all(list(m.angles) == list(m.wanted) for m in arm[-3:]), "no rest")
    return list(arm[-1].angles)


def by(joint: int, angle: float) -> Answer:
    """An increment of one joint [rad]."""
    return {"order": {"increments": [angle if number == joint else 0.0 for number in range(5)]}}


def test_an_increment_beyond_a_joint_is_refused_whole_and_in_the_same_words_by_each(
    rex: Everywhere, arm: list[ArmState]
) -> None:
    before = rested(arm)
    with ways(rex) as each:
        for name, way in each.items():
            answer = way.call("/arm/move", {"order": {"increments": [0.1, 0.0, 0.0, 0.0, 3.0]}})
            assert (answer["success"], answer["code"]) == (False, "equipment_refused")
            words = "wrist_roll goes from -2.83 to 2.83 rad, not to 3 rad, which is 0 and 3"
            assert words in answer["message"], name
            way.call("/control/release", {})
    assert rested(arm) == before


def test_named_poses_and_increments_are_the_same_by_each(rex: Everywhere, arm: list[ArmState]) -> None:
    with ways(rex) as each:
        for number, way in enumerate(each.values()):
            pose = [*POSES][number % 2]
            answer = way.call("/arm/move", {"order": {"pose": pose}, "wait": True})
            assert (answer["success"], answer["message"]) == (True, "The arm is there.")
            assert rested(arm) == pytest.approx(POSES[pose])
            assert way.call("/arm/move", {**by(4, 0.2), "wait": True})["success"]
            assert rested(arm)[4] == pytest.approx(0.2)
            assert way.call("/control/release", {})["success"]


def test_of_those_who_ask_at_once_one_moves_it_and_the_others_are_told_who_does(
    rex: Everywhere, arm: list[ArmState]
) -> None:
    with ways(rex) as each, ThreadPoolExecutor(len(each)) as pool:
        assert each["rosbridge"].call("/arm/move", {"order": {"pose": "home"}, "wait": True})["success"]
        each["rosbridge"].call("/control/release", {})
        before = rested(arm)
        ready = threading.Barrier(len(each))

        def ask(joint: int, way: Way) -> Answer:
            ready.wait(60)
            return way.call("/arm/move", {**by(joint % 5, 0.1), "wait": True})

        asked = [pool.submit(ask, number, way) for number, way in enumerate(each.values())]
        answers = dict(zip(each, (one.result() for one in asked), strict=True))
        winners = [name for name, answer in answers.items() if answer["success"]]
        assert len(winners) == 1, answers
        winner = winners[0]
        for name in answers.keys() - {winner}:
            assert answers[name]["code"] == "control_held"
            assert answers[name]["message"].startswith(f"by {winner}")
        after = rested(arm)
        moved = [abs(b - a) > 0.01 for a, b in zip(before, after, strict=True)]
        assert moved == [number == [*each].index(winner) % 5 for number in range(5)]
        each[winner].call("/control/release", {})


def test_stop_by_each_ends_a_motion_of_another_and_the_arm_stays(
    rex: Everywhere, arm: list[ArmState]
) -> None:
    with ways(rex) as each, ThreadPoolExecutor(1) as pool:
        for name, way in each.items():
            driver = next(other for other in each.values() if other is not way)
            here = rested(arm)
            goal = -2.8 if here[0] > 0 else 2.8  # more than five seconds away
            order = {"order": {"angles": [goal, *here[1:]]}, "wait": True}
            motion = pool.submit(driver.call, "/arm/move", order)
            until(lambda goal=goal: arm[-1].wanted[0] == goal, "no motion")
            assert way.call("/stop", {})["success"], name
            assert motion.result(120)["code"] == "stop_is_pressed", motion.result()
            held = rested(arm)
            assert abs(held[0] - goal) > 0.01
            assert driver.call("/arm/move", by(0, 0.1))["code"] == "stop_is_pressed"
            assert rested(arm) == held
            until(lambda driver=driver: driver.call("/stop/hold", {})["success"], "the pause after a release")
            time.sleep(1.2)
            released = driver.call("/stop/release", {})
            assert released["success"], released
            driver.call("/control/release", {})
