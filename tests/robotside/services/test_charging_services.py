"""Charging over the services, in virtual time on a whole station: at a dock, before a patrol goes on, and out of it again."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import (
    Bumper,
    CommandRequest,
    Place,
    SetPlaceRequest,
    SetQueueRequest,
    StartTaskRequest,
    TaskOrder,
    TaskProgress,
    Waypoint,
)
from robotside.autonomy.power_supply import POWER_TIMEOUT
from robotside.core.config import ChargingSettings, Config
from tests.fakes import FakeDock, FakeRobot
from tests.robotside.scene import SQUARE, Scene

DOCK = Place(name="Dock", kind="dock", x=-4.0, y=0.0, yaw=math.pi)
LAB = Place(name="Lab", kind="lab", x=3.0, y=3.0)


def scene_of(state: Path, config: Config = Config()) -> Scene:  # noqa: B008
    dock = FakeDock(-4.18, 0.0, math.pi)
    made = Scene(FakeRobot(beams=360, dock=dock), state, config=config)
    made.run(4.0)
    for place in (DOCK, LAB):
        answer = made.ask("/places/set", SetPlaceRequest(place=place))
        assert answer.success, answer.message
    return made


def begin(house: Scene, task: str, *places: str) -> None:
    order = TaskOrder(task=task, places=list(places))
    answer = house.ask("/task/start", StartTaskRequest(order=order))
    assert answer.success, answer.message


@pytest.fixture
def house(tmp_path: Path) -> Iterator[Scene]:
    made = scene_of(tmp_path)
    yield made
    made.station.close()


def low(house: Scene, charge: float = 0.14) -> None:
    house.robot.battery = charge
    house.run(1.1)


def charging(house: Scene, limit: float = 120.0) -> None:
    house.until(lambda: house.task.phase == "charging", limit)


def test_a_patrol_charges_and_goes_on_with_the_point_that_it_was_heading_for(house: Scene) -> None:
    house.set(*SQUARE, laps=1)
    house.start()
    house.until(lambda: house.task.visited == 1, 60.0)
    number, heading = house.task.task_id, house.task.waypoint
    low(house)
    assert "Battery at 14%: going to Dock to charge; the patrol goes on at 80%." in house.events("battery")
    charging(house)
    assert (house.task.task, house.task.state, house.task.task_id) == ("patrol", "RUNNING", number)
    assert house.task.place == "Dock"
    assert house.robot.pose[0] == pytest.approx(-4.0, abs=0.03)
    house.robot.battery = 0.5
    house.run(2.0)
    assert house.task.reason.startswith("Charging at Dock, 50%, goes on at 80% in about")
    progress = [msg for _, msg in house.said if isinstance(msg, TaskProgress)][-1]
    assert math.isfinite(progress.time_left)
    house.robot.battery = 0.81
    house.until(lambda: house.task.phase == "undocking", 5.0)
    house.until(lambda: house.task.phase == "driving", 20.0)
    assert "Patrol goes on." in house.events("task")
    assert house.task.waypoint == heading
    assert house.run_task().state == "SUCCEEDED"
    assert (house.task.task_id, house.task.visited) == (number, 3)


@pytest.mark.slow
def test_an_operator_has_it_go_on_now_or_stay(house: Scene) -> None:
    house.set(*SQUARE, laps=1)
    house.start()
    low(house)
    charging(house)
    house.robot.battery = 0.4
    house.run(1.1)
    assert house.ask("/task/pause").success
    house.robot.battery = 0.9
    house.run(30.0)
    assert house.task.state == "PAUSED"
    assert house.robot.pose[0] == pytest.approx(-4.0, abs=0.03)
    house.robot.battery = 0.4
    house.run(1.1)
    assert house.ask("/task/resume").success
    house.run(1.0)
    assert house.task.phase == "charging"
    assert house.ask("/task/confirm").success
    house.until(lambda: house.task.phase == "undocking", 5.0)
    assert house.run_task().visited == 3


def test_an_operator_who_has_it_stay_is_told_that_it_stays_at_its_dock_and_how_it_goes_on(
    house: Scene,
) -> None:
    house.set(*SQUARE, laps=1)
    house.start()
    low(house)
    charging(house)
    assert house.ask("/task/pause").message == "It stays at Dock."
    assert (house.task.state, house.task.code) == ("PAUSED", Code.TASK_STAYS)
    assert {each.key: each.value for each in house.task.parameters}["place"] == "Dock"
    assert house.task.reason.endswith(" had it stay at Dock, charging. Resume lets it go on.")
    assert house.ask("/task/resume").success
    house.run(1.0)
    assert house.task.phase == "charging"


def test_sent_on_with_too_little_charge_is_refused_with_the_figures(house: Scene) -> None:
    house.set(*SQUARE, laps=1)
    house.start()
    low(house)
    charging(house)
    said = "Charging goes on: 14% is too little to go on with; 20% is needed."
    answer = house.ask("/task/confirm")
    assert (answer.success, answer.message, answer.code) == (False, said, Code.CHARGE_NEEDED)
    house.run(1.0)
    assert house.task.phase == "charging"
    house.robot.battery = 0.21
    house.run(1.1)
    assert house.ask("/task/confirm").success
    house.until(lambda: house.task.phase == "undocking", 5.0)


def test_a_patrol_that_is_canceled_while_it_charges_rests_in_the_dock(house: Scene) -> None:
    house.set(*SQUARE, laps=1)
    house.start()
    low(house)
    charging(house)
    assert house.ask("/task/cancel").success
    house.robot.battery = 0.9
    house.run(10.0)
    assert house.task.state == "CANCELED"
    assert house.robot.at_rest
    assert house.robot.pose[0] == pytest.approx(-4.0, abs=0.03)


@pytest.mark.slow
def test_stop_on_the_way_into_the_dock_is_obeyed_and_it_goes_on_after_resume(house: Scene) -> None:
    house.set(*SQUARE, laps=1)
    house.start()
    low(house)
    house.until(lambda: house.task.phase == "docking", 60.0)
    house.run(2.0)
    assert house.ask("/stop").success
    house.run(0.5)
    x = house.robot.pose[0]
    house.run(10.0)
    assert house.robot.pose[0] == pytest.approx(x, abs=0.005)
    assert house.release_stop().success
    house.run(5.0)
    assert house.robot.pose[0] == pytest.approx(x, abs=0.005)
    assert house.ask("/task/resume").success
    charging(house)


@pytest.mark.slow
def test_a_dock_that_cannot_be_reached_ends_the_patrol_at_rest_with_what_was_seen(house: Scene) -> None:
    house.robot.dock.strips = ()
    house.set(*SQUARE, laps=1)
    house.start()
    low(house)
    assert house.run_task().state == "FAILED"
    assert house.task.reason.startswith("Dock is not seen: ")
    assert house.robot.at_rest


def test_what_was_asked_to_keep_straight_on_does_not_go_on_after_it_has_charged(house: Scene) -> None:
    order = TaskOrder(task="follow_heading", heading=0.0, speed=0.1)
    assert house.ask("/task/start", StartTaskRequest(order=order)).success
    low(house)
    assert (house.task.task, house.task.state) == ("dock", "RUNNING")
    charging(house)
    house.robot.battery = 0.85
    assert house.run_task().reason == "Charged to 85% at Dock."


@pytest.mark.slow
def test_a_queue_that_only_the_battery_holds_up_charges_first_and_then_goes_on(house: Scene) -> None:
    low(house)
    order = TaskOrder(task="go_to", places=["Lab"])
    assert house.ask("/task/queue/set", SetQueueRequest(orders=[order])).success
    house.run(1.5)
    assert house.task.task == "dock"
    charging(house)
    house.robot.battery = 0.85
    house.until(lambda: house.task.task == "go_to", 10.0)
    assert house.task.phase == "undocking"
    assert house.run_task().reason == "Lab reached."


@pytest.mark.slow
def test_a_queue_is_held_when_charging_for_it_has_failed(house: Scene) -> None:
    house.robot.dock.strips = ()
    low(house)
    order = TaskOrder(task="go_to", places=["Lab"])
    assert house.ask("/task/queue/set", SetQueueRequest(orders=[order])).success
    house.run(1.5)
    assert house.run_task().state == "FAILED"
    house.run(5.0)
    assert house.task.task == "dock"
    assert house.station.agenda.held == "the battery is at 14%"


def test_with_the_setting_off_it_goes_home_as_without_a_dock(tmp_path: Path) -> None:
    house = scene_of(tmp_path, Config(charging=ChargingSettings(by_itself=False)))
    house.set(*SQUARE, home=[Waypoint(-2.0, -2.0)])
    house.start()
    low(house, 0.09)
    assert house.task.task == "go_home"
    house.station.close()


@pytest.mark.slow
def test_the_charge_to_go_on_with_is_a_setting(tmp_path: Path) -> None:
    house = scene_of(tmp_path, Config(charging=ChargingSettings(until=0.5)))
    house.set(*SQUARE, laps=1)
    house.start()
    low(house)
    charging(house)
    house.robot.battery = 0.51
    house.until(lambda: house.task.phase == "driving", 30.0)
    house.station.close()


@pytest.mark.slow
def test_docking_to_stay_until_a_charge_is_an_order(house: Scene) -> None:
    house.robot.battery = 0.3
    order = TaskOrder(task="dock", charge_to=0.6)
    assert house.ask("/task/start", StartTaskRequest(order=order)).success
    charging(house)
    house.run(10.0)
    assert house.task.state == "RUNNING"
    house.robot.battery = 0.6
    assert house.run_task().reason == "Charged to 60% at Dock."
    for wrong in (0.1, 1.2, -1.0):
        order = TaskOrder(task="dock", charge_to=wrong)
        said = house.refused("/task/start", StartTaskRequest(order=order))
        assert said == f"The charge to stay for must be from 20% to 100%, or left out, not {wrong:.0%}."


@pytest.mark.slow
def test_undocking_is_a_task_of_its_own_and_the_first_phase_of_those_that_move(house: Scene) -> None:
    for first in (TaskOrder(task="undock"), TaskOrder(task="go_to", places=["Lab"])):
        assert house.ask("/task/start", StartTaskRequest(order=TaskOrder(task="dock"))).success
        assert house.run_task().state == "SUCCEEDED"
        assert house.ask("/task/start", StartTaskRequest(order=first)).success
        house.run(1.0)
        assert (house.task.phase, house.task.reason) == ("undocking", "Leaving Dock.")
        house.until(lambda: house.task.phase != "undocking", 20.0)
        assert house.robot.pose[0] == pytest.approx(-3.3, abs=0.1)
        assert house.run_task().state == "SUCCEEDED"
    assert house.robot.at_rest


def test_undocking_outside_of_a_dock_says_so_and_does_not_move(house: Scene) -> None:
    assert house.ask("/task/start", StartTaskRequest(order=TaskOrder(task="undock"))).success
    house.run(0.5)
    assert house.task.reason == "The robot stands in no dock."
    assert house.robot.pose == (0.0, 0.0, 0.0)


def test_nothing_is_sent_on_that_does_not_charge(house: Scene) -> None:
    house.set(*SQUARE, laps=1)
    house.start()
    house.run(2.0)
    assert house.refused("/task/confirm", CommandRequest()) == "The robot asks nothing just now."


def test_a_touch_after_docking_was_canceled_is_told(house: Scene) -> None:
    order = TaskOrder(task="dock")
    assert house.ask("/task/start", StartTaskRequest(order=order)).success
    house.until(lambda: house.station.autonomy.situation.touches, 60.0)
    assert house.ask("/task/cancel").success
    house.robot.silent.add("/bumper")
    house.robot.more.append(("/bumper", Bumper(pressed=True, bearing=0.0)))
    house.run(0.3)
    assert house.events("contact") == ["The bumper touched something ahead."]


def test_the_last_word_of_a_battery_that_fell_silent_is_no_charge(house: Scene) -> None:
    begin(house, "dock")
    assert house.run_task().state == "SUCCEEDED"
    house.robot.silent.add("/battery_state")
    begin(house, "go_to", "Lab")
    assert house.run_task().state == "SUCCEEDED"
    begin(house, "dock")
    assert house.run_task().state == "FAILED"
    assert house.robot.pose[0] == pytest.approx(DOCK.x, abs=0.1)
    assert house.task.reason.startswith("Dock was reached, but the battery has said nothing for ")
    assert house.task.reason.endswith(" s, so nobody knows whether it charges; the robot stays there.")


def test_it_backs_out_of_its_dock_though_the_battery_fell_silent_there(house: Scene) -> None:
    begin(house, "dock")
    assert house.run_task().state == "SUCCEEDED"
    house.robot.silent.add("/battery_state")
    house.run(POWER_TIMEOUT + 2.0)
    begin(house, "undock")
    assert house.run_task().reason == "Out of Dock."
    assert house.robot.pose[0] == pytest.approx(DOCK.x + 0.7, abs=0.1)
