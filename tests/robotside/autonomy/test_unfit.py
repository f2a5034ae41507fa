"""A robot without a map, or one that cannot be reached: what still works, and what is said about the rest."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest

from bridge.msgs import Msg
from bridge.msgs.arrays import Int8Array
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Twist,
)
from bridge.msgs.nav_msgs import OccupancyGrid, Odometry
from bridge.msgs.pilothouse_msgs import CommandRequest, Event, SetMissionRequest, StartTaskRequest
from robotside.control.neutral_interlock import LET_GO_SENTENCE
from robotside.core.pose2 import ORIGIN
from robotside.station.fitness import NO_MAP
from tests.fakes import FakeRobot
from tests.robotside.scene import SQUARE, Scene

AHEAD = Twist.planar(0.3, 0.0)
LOST = "The robot cannot be reached: the connection was cut."


class Talking(FakeRobot):
    """Has messages beside what it measures."""

    def __init__(self) -> None:
        super().__init__()
        self.more: list[tuple[str, Msg]] = []

    def read(self, now: float) -> Iterator[tuple[str, Msg]]:
        yield from super().read(now)
        more, self.more = self.more, []
        yield from more


@pytest.fixture
def lost_map(tmp_path: Path) -> Iterator[Scene]:
    robot = Talking()
    robot.silent.add("/map")
    scene = Scene(robot, tmp_path)
    scene.run(1.0)
    yield scene
    scene.station.close()


def test_without_a_map_it_drives_by_hand_and_says_why_it_does_nothing_else(lost_map: Scene) -> None:
    lost_map.drive(Twist.planar(0.3, 0.0))
    assert lost_map.robot.twist == Twist.planar(0.3, 0.0)
    mission = SetMissionRequest(
        mission=msgspec.structs.replace(lost_map.station.missions.current, waypoints=SQUARE)
    )
    assert lost_map.refused("/mission/set", mission) == NO_MAP
    assert lost_map.refused("/task/start", StartTaskRequest()) == NO_MAP
    lost_map.go_to(1.0, 0.0)
    placed = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(1.0, 0.0))))
    lost_map.station.on_message(lost_map.anna, "/initialpose", placed, None)
    assert lost_map.events("command") == [NO_MAP, NO_MAP]
    assert lost_map.of("/pose") == []


def test_a_map_that_comes_later_is_taken(lost_map: Scene) -> None:
    assert isinstance(lost_map.robot, Talking)
    lost_map.robot.more = [("/map", lost_map.robot.map())]
    lost_map.run(4.0)
    assert lost_map.events("localisation")[0] == "There is a map now."
    lost_map.set(*SQUARE)
    lost_map.start()
    assert lost_map.task.state == "RUNNING"


def test_another_map_counts_when_the_task_is_over_and_the_position_stays(lost_map: Scene) -> None:
    robot = lost_map.robot
    assert isinstance(robot, Talking)
    robot.more = [("/map", robot.map())]
    lost_map.run(4.0)
    lost_map.set(*SQUARE)
    lost_map.start()
    planner = lost_map.station.autonomy.navigator.planner
    robot.more = [("/map", robot.map(0.05))]
    lost_map.run(1.0)
    assert lost_map.station.autonomy.navigator.planner is planner
    lost_map.ask("/task/cancel")
    lost_map.run(1.0)
    assert lost_map.station.autonomy.navigator.planner is not planner
    pose = lost_map.station.autonomy.pose_estimator.pose
    assert pose is not None
    assert pose.distance(robot.pose[0], robot.pose[1]) < 0.1


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"width": 7}, "The map cannot be used: it says 7 x 140 cells and has 30800."),
        *(
            (
                {"resolution": edge},
                f"The map cannot be used: its cells are {edge:.4g} m wide; 0.001 to 10 m are allowed.",
            )
            for edge in (0.0, 1e-9, 1e300, math.nan, math.inf, -0.1)
        ),
        (
            {"origin": Pose(Point(1e300, 0.0))},
            "The map cannot be used: it begins at (1e+300, 0.0), which is over 1e+08 m away.",
        ),
        (
            {"origin": Pose(Point(0.0, math.nan))},
            "The map cannot be used: it begins at (0.0, nan), which is over 1e+08 m away.",
        ),
        ({"width": 0, "height": 0}, "The map cannot be used: it says 0 x 0 cells and has 30800."),
    ],
)
def test_a_map_of_no_use_is_said_and_left_out(lost_map: Scene, change: dict[str, object], said: str) -> None:
    robot = lost_map.robot
    assert isinstance(robot, Talking)
    good = robot.map()
    robot.more = [
        ("/map", OccupancyGrid(good.header, msgspec.structs.replace(good.info, **change), good.data))
    ]
    lost_map.run(1.0)
    assert lost_map.events("localisation") == [said]
    assert not lost_map.station.autonomy.has_map


def test_a_robot_whose_first_map_is_of_no_use_is_driven_by_hand(tmp_path: Path) -> None:
    robot = FakeRobot()
    good = robot.map()
    endless = OccupancyGrid(good.header, msgspec.structs.replace(good.info, resolution=1e-9), good.data)
    robot.map = lambda resolution=0.1: endless  # type: ignore[method-assign]
    scene = Scene(robot, tmp_path)
    (said,) = (event.text for event in scene.station.events.since(0, "b1"))
    assert said.startswith("The map cannot be used: its cells are 1e-09 m wide")
    scene.drive(AHEAD)
    assert robot.commands[-1] == AHEAD
    assert scene.station.fitness.unfit == NO_MAP
    scene.station.close()


def test_a_map_that_does_not_fit_into_the_memory_is_left_out(
    lost_map: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    def too_large(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr("robotside.navigation.navigator.Planner", too_large)
    assert isinstance(lost_map.robot, Talking)
    lost_map.robot.more = [("/map", lost_map.robot.map())]
    lost_map.run(1.0)
    said = "The map cannot be used: 30800 cells are too many for this computer."
    assert lost_map.events("localisation")[-1] == said
    assert lost_map.station.fitness.unfit == NO_MAP


def test_a_map_without_cells_is_of_no_use(lost_map: Scene) -> None:
    assert isinstance(lost_map.robot, Talking)
    lost_map.robot.more = [("/map", OccupancyGrid(data=Int8Array()))]
    lost_map.run(1.0)
    assert not lost_map.station.autonomy.has_map


def test_what_a_robot_says_is_told_as_the_robot_sides_own(tmp_path: Path) -> None:
    robot = Talking()
    scene = Scene(robot, tmp_path)
    robot.more = [
        ("/events", Event(id=99, boot="its own", level="warn", kind="robot", text="There is no laser."))
    ]
    scene.run(0.1)
    (event,) = [msg for msg in scene.of("/events") if isinstance(msg, Event) and msg.kind == "robot"]
    assert (event.text, event.level, event.boot) == ("There is no laser.", "warn", "b1")
    assert event.id != 99
    scene.station.close()


def test_while_the_robot_cannot_be_reached_nothing_is_commanded_and_the_reason_is_said(scene: Scene) -> None:
    scene.robot.trouble = LOST
    scene.run(0.1)
    before = len(scene.robot.commands)
    scene.drive(Twist.planar(0.3, 0.0))
    assert len(scene.robot.commands) == before
    assert scene.events("robot") == [LOST]
    assert scene.events("command") == [LOST]
    scene.set(SQUARE[0])
    assert scene.refused("/task/start", StartTaskRequest()) == LOST
    scene.robot.trouble = ""
    scene.run(0.1)
    assert scene.events("robot")[-1] == "The robot can be driven again; it stands still."


def test_a_task_is_held_when_the_link_is_lost_and_goes_on_only_when_somebody_says_so(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(2.0)
    scene.robot.trouble = LOST
    scene.run(1.0)
    assert (scene.task.state, scene.task.reason) == ("PAUSED", f"Paused: t{LOST[1:]}")
    assert scene.refused("/task/resume") == LOST
    scene.robot.trouble = ""
    there = scene.robot.pose
    scene.run(2.0)
    assert (scene.task.state, scene.robot.pose) == ("PAUSED", there)
    assert scene.ask("/task/resume", CommandRequest()).success
    scene.run(2.0)
    assert scene.robot.pose != there


def test_a_drive_command_in_force_ends_with_the_link(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.0))
    scene.robot.trouble = LOST
    scene.run(0.05)
    assert not scene.station.controls.driving


@pytest.mark.parametrize(("topic", "sense"), [("/odom", "odometry"), ("/scan", "laser")])
def test_a_robot_that_never_says_how_it_moves_or_what_is_near_does_no_task(
    tmp_path: Path, topic: str, sense: str
) -> None:
    robot = FakeRobot()
    robot.silent.add(topic)
    scene = Scene(robot, tmp_path)
    scene.run(1.0)
    scene.station.autonomy.place(ORIGIN)
    scene.set(*SQUARE)
    said = f"It can be driven by hand only: the {sense} has sent no data yet."
    assert scene.refused("/task/start", StartTaskRequest()) == said
    assert scene.refused("/task/go_home") == said
    robot.silent.clear()
    scene.run(4.0)
    scene.start()
    assert scene.task.state == "RUNNING"


def test_a_task_that_became_blind_is_not_resumed_until_it_sees_again(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.robot.silent.add("/scan")
    scene.run(1.0)
    assert scene.task.reason == "Paused: the laser has been silent for 0.6 s."
    assert "the laser has been silent" in scene.refused("/task/resume")
    scene.robot.silent.clear()
    scene.run(1.0)
    assert scene.ask("/task/resume").message == "Resumed."


def test_without_odometry_nobody_says_that_it_stands_still(scene: Scene) -> None:
    assert scene.control.at_rest
    scene.robot.silent.add("/odom")
    scene.run(2.5)
    assert not scene.control.at_rest
    scene.robot.silent.clear()
    scene.run(0.2)
    assert scene.control.at_rest


def test_odometry_that_is_no_number_counts_as_none_and_spoils_nothing(tmp_path: Path) -> None:
    robot = Talking()
    scene = Scene(robot, tmp_path)
    scene.run(1.0)
    scene.station.autonomy.place(ORIGIN)
    scene.run(1.0)
    odometer = scene.station.autonomy.pose_estimator.odometer
    nowhere = PoseWithCovariance(Pose(Point(math.nan, 0.0)))
    robot.more = [("/odom", Odometry(pose=nowhere))]
    scene.run(1.0)
    assert scene.station.autonomy.pose_estimator.odometer == odometer
    assert scene.station.autonomy.pose_estimator.sure


@pytest.fixture
def lost(scene: Scene) -> Scene:
    """Cut off while it was driven, with the stick held."""
    scene.drive(AHEAD)
    scene.run(0.1)
    scene.robot.trouble = LOST
    scene.robot.silent |= {"/odom", "/scan"}
    for _ in range(20):
        scene.drive(AHEAD)
        scene.run(0.05)
    return scene


def back(scene: Scene) -> None:
    scene.robot.trouble = ""
    scene.robot.silent.clear()


def test_stop_on_a_robot_that_cannot_be_reached_is_pressed_and_not_done(lost: Scene) -> None:
    assert lost.refused("/stop") == f"STOP is pressed, but t{LOST[1:]}"
    assert (lost.control.stopped, lost.control.at_rest) == (True, False)
    back(lost)
    before = len(lost.robot.commands)
    assert lost.ask("/stop").message == "Stopped."
    assert lost.robot.commands[before:] == [None]
    assert not lost.control.at_rest
    lost.run(0.2)
    assert lost.control.at_rest


def test_a_robot_that_rested_when_it_was_lost_is_not_said_to_rest(scene: Scene) -> None:
    scene.run(1.0)
    assert scene.control.at_rest
    scene.robot.trouble = LOST
    assert not scene.station.at_rest
    scene.robot.silent.add("/odom")
    scene.run(0.05)
    assert not scene.control.at_rest
    scene.robot.trouble = ""
    scene.run(0.1)
    assert not scene.control.at_rest
    back(scene)
    scene.run(0.2)
    assert scene.control.at_rest


def test_a_robot_in_others_hands_that_tells_how_fast_it_is_may_be_said_to_rest(scene: Scene) -> None:
    scene.run(1.0)
    scene.robot.trouble = "The robot's own STOP is pressed, by Fred: release it there."
    scene.run(0.2)
    assert scene.control.at_rest
    assert scene.ask("/stop").message == "Stopped."


def test_a_stick_held_through_an_outage_moves_the_robot_only_when_it_was_let_go(lost: Scene) -> None:
    back(lost)
    before = len(lost.robot.commands)
    for _ in range(60):
        lost.run(0.05)
        lost.drive(AHEAD)
    assert not any(lost.robot.commands[before:])
    assert lost.events("command")[-1] == LET_GO_SENTENCE
    lost.drive(Twist())
    lost.drive(AHEAD)
    assert lost.robot.twist == AHEAD
