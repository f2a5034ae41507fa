"""Tasks of robots of every kind that know nothing but twists, as those behind somebody else's bridge do."""

from __future__ import annotations

import ast
import math
from pathlib import Path

import msgspec
import pytest

import robotside
from app.discovery.simulator_options import SimulatorOptions
from bridge.msgs.pilothouse_msgs import (
    FlightState,
    Manoeuvre,
    RobotInfo,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from robotside.__main__ import main
from robotside.control.safe_state import SafeState
from robotside.core.config import DEFAULT_CONFIG, Config, LimitSettings
from robotside.kinds.registry import GENERIC, KINDS, described, kind_of, unknown
from robotside.motion.measured import MeasuredState
from robotside.navigation.differential_controller import DifferentialController
from robotside.navigation.navigator import PATH_CONTROLLERS
from robotside.tasks.task_factory import tasks_of
from sim.robot import ROBOTS
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene
from widgets.core.icons import ICONS

ROOT = Path(robotside.__file__).parents[1]
EVERYWHERE = ["patrol", "deliver", "guide", "go_to", "go_home", "hold", "follow_heading"]


class Agile(FakeRobot):
    """One that is told manoeuvres and does none of them."""

    def __init__(self) -> None:
        super().__init__()
        self.orders: list[str] = []

    def manoeuvre(self, order: Manoeuvre) -> None:
        self.orders.append(order.kind)


def scene(kind: str, state: Path, *manoeuvres: str, config: Config = DEFAULT_CONFIG) -> Scene:
    robot = Agile() if manoeuvres else FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, kind=kind, manoeuvres=list(manoeuvres))
    scene = Scene(robot, state, config=config)
    scene.run(3.5)  # until it knows where it is
    return scene


@pytest.mark.parametrize(
    ("kind", "near"), [("ackermann", 0.8), ("boat", 3.1), ("hexapod", 0.9), ("quadrotor", 0.7)]
)
def test_it_patrols_by_twists_alone(kind: str, near: float, tmp_path: Path) -> None:
    run = scene(kind, tmp_path)
    run.set(Waypoint(5.0, 0.0), laps=1)
    run.start()
    assert run.run_task().reason == "Patrol done: 1 point visited."
    assert math.dist(run.robot.pose[:2], (5.0, 0.0)) < near


def test_which_tasks_there_are_depends_on_kind_and_manoeuvres() -> None:
    def known(kind: str, *manoeuvres: str) -> list[str]:
        return tasks_of(RobotInfo(kind=kind, manoeuvres=list(manoeuvres)))

    assert known("wheels", "twist") == [*EVERYWHERE, "dock", "undock"]
    assert known("ackermann", "twist", "steer") == [*EVERYWHERE, "dock", "undock"]
    assert known("hexapod", "course", "surface") == [*EVERYWHERE, "surface"]
    assert known("quadrotor", "hover", "take_off", "land") == [*EVERYWHERE, "take_off", "land"]
    looks = RobotInfo(kind="hexapod", manoeuvres=["course", "surface"], cameras=["front"])
    assert tasks_of(looks) == [*EVERYWHERE, "dock", "undock", "surface"]
    afloat = RobotInfo(kind="boat", manoeuvres=["steer", "course"], cameras=["front"])
    assert tasks_of(afloat) == [*EVERYWHERE, "dock", "undock"]
    assert known("boat", "steer", "course") == EVERYWHERE
    sees = RobotInfo(kind="quadrotor", manoeuvres=["take_off", "land"], cameras=["front", "down"])
    assert tasks_of(sees) == [*EVERYWHERE, "dock", "take_off", "land"]


def test_the_tasks_are_told_with_the_robots_information(tmp_path: Path) -> None:
    info = scene("boat", tmp_path).station.bus.last("/robot/info")
    assert isinstance(info, RobotInfo)
    assert info.tasks == EVERYWHERE


def test_a_height_is_refused_by_what_keeps_none(tmp_path: Path) -> None:
    run = scene("wheels", tmp_path)
    order = TaskOrder(task="hold", height=1.0)
    assert (
        run.refused("/task/start", StartTaskRequest(order=order)) == "Fake-1 keeps no height; leave it out."
    )


def test_a_height_that_is_not_allowed_is_refused_before_it_takes_off(tmp_path: Path) -> None:
    run = scene("quadrotor", tmp_path, "take_off", config=Config(limits=LimitSettings(max_height=2.0)))
    order = StartTaskRequest(order=TaskOrder(task="take_off", height=3.0))
    assert (
        run.refused("/task/start", order) == "The height of Fake-1 in hall must be from 0.3 to 2 m, not 3 m."
    )
    order = StartTaskRequest(order=TaskOrder(task="take_off", height=2.0))
    run.ask("/task/start", order)


def test_who_rises_no_farther_than_half_way_gives_up_and_says_so(tmp_path: Path) -> None:
    run = scene("quadrotor", tmp_path, "take_off")
    run.robot.more.append(("/flight", FlightState(phase="flying")))
    run.ask("/task/start", StartTaskRequest(order=TaskOrder(task="take_off", height=9.0)))
    status = run.run_task(30.0)
    assert status.state == "FAILED"
    assert status.reason == "It comes no nearer to 9 m than 0.0 m; it stays there."


def test_who_does_not_come_off_the_ground_gives_up_and_says_so(tmp_path: Path) -> None:
    run = scene("quadrotor", tmp_path, "take_off")
    run.robot.more.append(("/flight", FlightState(phase="landed")))
    run.ask("/task/start", StartTaskRequest(order=TaskOrder(task="follow_heading")))
    run.run(1.0)
    assert run.task.phase == "taking off"
    status = run.run_task(30.0)
    assert status.state == "FAILED"
    assert status.reason == "Taking off took longer than 20 s; the robot stays where it is."
    assert isinstance(run.robot, Agile)
    assert set(run.robot.orders) == {"take_off"}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_known_wherever_it_counts(kind: str) -> None:
    """A record that names a strategy or an icon that does not exist fails here and not in the field."""
    record = kind_of(kind)
    assert (record.name, unknown(kind)) == (kind, "")
    assert record.path_controller in PATH_CONTROLLERS
    assert record.icon in ICONS
    assert set(record.order_fields) <= {"speed", "throttle", "height"}
    safe = SafeState(kind, DEFAULT_CONFIG.safe_state)
    safe.enter(0.0, MeasuredState())
    assert safe.step(0.0, MeasuredState(), lost=True).phase


def test_a_robot_keeps_the_words_of_its_own() -> None:
    own = described(RobotInfo(kind="boat", description="Tug", icon="anchor", moves="Tugs"))
    assert (own.description, own.icon, own.moves) == ("Tug", "anchor", "Tugs")
    assert own.holds == "Keeps its place on the water"


def test_a_robot_of_an_unknown_kind_has_the_generic_record() -> None:
    assert kind_of("submarine") is GENERIC
    info = described(RobotInfo(kind="submarine"))
    assert (info.kind, info.description, info.icon, info.moves) == ("submarine", "", GENERIC.icon, "Drives")
    assert (info.dives, info.flies) == (False, False)


def test_every_simulated_vehicle_is_of_a_known_kind() -> None:
    assert {model.parameters.info.kind for model in ROBOTS.values()} == set(KINDS)


def test_no_other_place_decides_by_a_kind() -> None:
    kinds = set(KINDS) - {"wheels"}
    found = {
        path.relative_to(ROOT).as_posix()
        for package in ("robotside", "app", "widgets", "sim", "bridge")
        for path in (ROOT / package).rglob("*.py")
        for text in [path.read_text()]
        if any(kind in text for kind in kinds)
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Constant) and node.value in kinds
    }
    assert {Path(name).parent.as_posix() for name in found} == {"robotside/kinds"}


def test_an_unknown_kind_is_said_once_and_goes_as_if_on_wheels(tmp_path: Path) -> None:
    run = scene("hovercraft", tmp_path)
    run.run(1.0)
    said = "A robot of the kind 'hovercraft' is not known here; it is driven as if on wheels. Known are"
    told = run.station.events.since(0, run.station.events.boot)
    events = [event.text for event in told if event.text.startswith(said)]
    assert len(events) == 1
    assert isinstance(run.station.autonomy.navigator.controller, DifferentialController)
    assert "dock" not in run.station.info.tasks


def test_the_simulators_offer_has_the_icon_of_each_kind(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["offer", "--json"]) == 0
    offered = SimulatorOptions.read(capsys.readouterr().out)
    assert {robot.kind: robot.icon for robot in offered.robots} == {
        kind: record.icon for kind, record in KINDS.items()
    }
