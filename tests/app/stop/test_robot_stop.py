"""STOP of the connected robot: the robot's own word counts where it has a STOP, ours where it has none."""

from __future__ import annotations

import pytest

from app.link.commands import Outcome
from app.link.feeds import Feeds, Post
from app.stop.robot_stop import RobotStop
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import ControlStatus
from tests.bridge.wires import Clock


class Watch:
    def __init__(self, *, foreign: bool) -> None:
        self.clock, self.foreign, self.topic = Clock(), foreign, True
        self.feeds = Feeds(self.clock)
        self.stop = RobotStop(self, self.feeds, self.clock, "me", lambda: self.topic)
        self.stop.set_reachable(True)

    def says(self, *, stopped: bool, at_rest: bool) -> None:
        status = ControlStatus(stopped=stopped, at_rest=at_rest)
        self.feeds.put("/control/status", Post(status, self.clock.time, 1))
        self.stop.on_status(status, self.clock.time)


@pytest.fixture
def ours() -> Watch:
    return Watch(foreign=False)


@pytest.fixture
def bare() -> Watch:
    return Watch(foreign=True)


def test_a_robot_of_ours_is_stopped_when_it_says_so(ours: Watch) -> None:
    ours.stop.press()
    assert (ours.stop.phase, ours.stop.latched) == ("sent", False)
    ours.stop.on_outcome(Outcome("stop", "1", "accepted", ""))
    ours.says(stopped=True, at_rest=True)
    assert (ours.stop.phase, ours.stop.latched) == ("stopped", True)
    ours.says(stopped=False, at_rest=True)
    assert (ours.stop.phase, ours.stop.latched) == ("ready", False)


def test_zero_speed_held_here_latches_a_robot_without_a_stop(bare: Watch) -> None:
    bare.stop.local.press()
    assert bare.stop.latched
    for _ in range(6):
        bare.clock.time += 0.1
        bare.stop.on_odometry(Odometry(), bare.clock.time)
    assert bare.stop.phase == "stopped"
    bare.stop.release()
    assert (bare.stop.phase, bare.stop.latched) == ("ready", False)


def test_what_a_robot_without_a_stop_publishes_under_our_names_does_not_latch_it(bare: Watch) -> None:
    bare.says(stopped=True, at_rest=True)
    assert (bare.stop.phase, bare.stop.latched) == ("ready", False)


def test_the_sentence_says_that_nothing_can_be_sent(bare: Watch) -> None:
    bare.stop.local.press()
    bare.stop.set_reachable(False)
    assert bare.stop.sentence.startswith("Nothing reaches it until the link is back.")
    bare.topic = False
    assert bare.stop.sentence.endswith("it cannot be stopped from here.")


def test_it_is_known_for_how_long_a_stopped_robot_is_out_of_reach(ours: Watch) -> None:
    ours.says(stopped=True, at_rest=True)
    ours.stop.set_reachable(False, "The connection was cut.")
    ours.clock.time += 4.0
    assert (ours.stop.phase, ours.stop.lost_for) == ("lost", 4.0)


def test_a_stop_is_owed_from_its_press_until_the_robot_rests(ours: Watch) -> None:
    assert not ours.stop.owed
    ours.stop.press()
    assert (ours.stop.phase, ours.stop.owed) == ("sent", True)
    ours.clock.time += 3.0
    assert (ours.stop.phase, ours.stop.owed) == ("no_answer", True)
    ours.says(stopped=True, at_rest=False)
    ours.clock.time += 3.0
    assert (ours.stop.phase, ours.stop.owed) == ("moves", True)
    ours.says(stopped=True, at_rest=True)
    assert (ours.stop.phase, ours.stop.owed) == ("stopped", False)
    ours.stop.set_reachable(False, "The connection was cut.")
    assert (ours.stop.phase, ours.stop.owed) == ("lost", False)


def test_nothing_is_owed_that_was_released_here_or_is_another_s(ours: Watch) -> None:
    ours.says(stopped=True, at_rest=False)
    assert (ours.stop.phase, ours.stop.owed) == ("sent", False), "somebody else pressed it"
    ours.stop.press()
    assert ours.stop.owed
    ours.stop.release()
    assert (ours.stop.phase, ours.stop.owed) == ("sent", False), "its release is on its way"


def test_a_robot_without_a_stop_is_owed_zero_speed_until_the_release(bare: Watch) -> None:
    bare.stop.local.press()
    for _ in range(6):
        bare.clock.time += 0.1
        bare.stop.on_odometry(Odometry(), bare.clock.time)
    assert (bare.stop.phase, bare.stop.owed) == ("stopped", True)
    bare.stop.release()
    assert not bare.stop.owed
