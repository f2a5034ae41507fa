"""A kind of vehicle that no table foresaw: one record, and the robot side and the app have all that they need of it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import msgspec
import pytest

from app.discovery.known_robots import KnownRobots
from app.screens.connect.robot_card import RobotCard
from bridge.codec import from_json, to_json
from bridge.discovery.beacon import Hello
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import RobotInfo, StartTaskRequest, TaskOrder, Waypoint
from robotside.control.safe_state import SafeState
from robotside.core.config import DEFAULT_CONFIG, LimitSettings
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import KINDS
from robotside.kinds.vehicle_kind import Handling, PursuitParameters, SafeStateDefaults, VehicleKind
from robotside.limits.limits import LimitKeeper
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import PlanarVelocity
from robotside.navigation.course_controller import CourseController
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene
from widgets.core.task_words import fields, will
from widgets.tasks.order_form import OrderForm

AIRBOAT = VehicleKind(
    name="airboat",
    description="Airboat with a propeller",
    icon="air",
    moves="Skims",
    holds="Floats where it is",
    order_fields=("throttle",),
    path_controller="course",
    pursuit=PursuitParameters(goal_tolerance=1.0, passed_tolerance=2.0, lookahead=2.0),
    handling=Handling(braking=0.3, turning=0.5, drifts=True),
    safe_state=SafeStateDefaults("hold_heading"),
    comes_about=True,
    at_rest=(0.15, 0.10),
    astray=4.0,
)


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Scene:
    monkeypatch.setitem(KINDS, AIRBOAT.name, AIRBOAT)
    robot = FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, kind="airboat", description="")
    scene = Scene(robot, tmp_path)
    scene.run(3.5)  # until it knows where it is
    return scene


@pytest.fixture
def info(scene: Scene) -> RobotInfo:
    """As a handheld has it."""
    return from_json(to_json(scene.station.bus.last("/robot/info")), RobotInfo)


def near_its_fence(kind: str) -> float:
    """The speed that is left of 1 m/s ahead, 0.7 m from its fence [m/s]."""
    settings = LimitSettings(keep_in=[[(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)]])
    keeper = LimitKeeper(settings, RobotInfo(kind=kind, radius=0.3, max_speed=2.0, max_yaw_rate=1.0))
    measured = MeasuredState(pose=Pose2(4.0, 0.0, 0.0), moving=PlanarVelocity(0.1, 0.0, 0.0))
    return keeper.clamp(Twist.planar(1.0, 0.0), measured).twist.linear.x


def test_it_goes_brakes_and_rests_by_its_record(scene: Scene) -> None:
    controller = scene.station.autonomy.navigator.controller
    assert isinstance(controller, CourseController)
    assert controller.turning > 0.0
    safe = SafeState("airboat", DEFAULT_CONFIG.safe_state)
    safe.enter(0.0, MeasuredState())
    assert safe.step(0.0, MeasuredState(), lost=True).phase == "idles and holds its heading"
    assert 0.0 < near_its_fence("airboat") < 0.8 * near_its_fence("wheels")


def test_it_patrols_and_no_event_calls_it_unknown(scene: Scene) -> None:
    scene.set(Waypoint(5.0, 0.0), laps=1)
    scene.start()
    assert scene.run_task().reason == "Patrol done: 1 point visited."
    assert math.dist(scene.robot.pose[:2], (5.0, 0.0)) < 2.1
    events = scene.station.events.since(0, scene.station.events.boot)
    assert not [event.text for event in events if "not known here" in event.text]


def test_it_takes_every_task_that_its_record_allows(scene: Scene, info: RobotInfo) -> None:
    assert "hold" in info.tasks
    assert not {"dock", "land", "surface"} & set(info.tasks)
    scene.ask("/task/start", StartTaskRequest(order=TaskOrder(task="hold")))


def test_the_app_has_its_words_and_its_fields(info: RobotInfo) -> None:
    heading = TaskOrder(task="follow_heading", heading=0.0, throttle=0.6)
    assert will(heading, robot=info) == "Skims straight towards 090° with 60 % throttle until you stop it."
    assert will(TaskOrder(task="hold"), robot=info) == "Floats where it is until you stop it."
    assert fields("follow_heading", info) == ("heading", "throttle", "duration")


def test_its_order_form_asks_for_a_throttle(info: RobotInfo, stage: Any) -> None:
    form = stage.show(OrderForm(robot=info), size=(388, 340))
    form.begin("follow_heading")
    form.set(throttle=0.5)
    assert form.sentence == "Skims straight towards where it points now with 50 % throttle until you stop it."


def test_its_card_has_its_icon_and_name(info: RobotInfo, stage: Any) -> None:
    robots = KnownRobots(lambda: 0.0)
    url = "ws://10.0.0.3:9090"
    hello = Hello(name="Gust-1", kind=info.kind, description=info.description, icon=info.icon, url=url)
    robots.heard(from_json(to_json(hello), Hello), 0.0)
    card = stage.show(RobotCard(), size=(440, 200))
    card.show_entry(robots.entries()[0], "me")
    assert (card.icon, card.subtitle) == ("air", "10.0.0.3 · Airboat with a propeller")


@pytest.mark.parametrize("icon", ["", "no_such_icon"])
def test_a_robot_without_an_icon_that_the_app_has_gets_the_generic_one(icon: str, stage: Any) -> None:
    robots = KnownRobots(lambda: 0.0)
    robots.heard(Hello(name="Odd-1", kind="odd", icon=icon, url="ws://10.0.0.4:9090"), 0.0)
    card = stage.show(RobotCard(), size=(440, 200))
    card.show_entry(robots.entries()[0], "me")
    assert card.icon == "smart_toy_fill"


def test_the_icon_of_a_saved_robot_is_kept() -> None:
    robots = KnownRobots(lambda: 0.0)
    url = robots.add("10.0.0.5")
    robots.name(url, "Gust-1", "airboat", "Airboat with a propeller", "air")
    assert KnownRobots(lambda: 0.0, robots.save()).entries()[0].icon == "air"
