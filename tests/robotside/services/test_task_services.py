"""Every task as an order over the services, in virtual time on a whole station."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from bridge.msgs.pilothouse_msgs import (
    Bumper,
    CommandRequest,
    DeletePlaceRequest,
    Following,
    GetHistoryRequest,
    Mission,
    Place,
    SetMissionRequest,
    SetPlaceRequest,
    StartTaskRequest,
    TagRead,
    TaskOrder,
    TaskProgress,
    TaskStatus,
    Waypoint,
)
from tests.robotside.scene import SQUARE, Scene

PLACES = [
    Place(name="Office 12", kind="office", x=3.0, y=0.0, tag="card-12"),
    Place(name="Lab", kind="lab", x=3.0, y=3.0, tag="card-lab", note="Here we grow crystals."),
    Place(name="Dock", kind="dock", x=-4.0, y=0.0, yaw=math.pi),
]


@pytest.fixture
def house(scene: Scene) -> Scene:
    for place in PLACES:
        answer = scene.ask("/places/set", SetPlaceRequest(place=place))
        assert answer.success, answer.message
    return scene


def begin(scene: Scene, task: str, *places: str, **words: object) -> None:
    order = TaskOrder(task=task, places=list(places), **words)  # type: ignore[arg-type]
    answer = scene.ask("/task/start", StartTaskRequest(order=order))
    assert answer.success, answer.message


def until(scene: Scene, done: Callable[[TaskStatus], bool], limit: float = 60.0) -> TaskStatus:
    end = scene.now + limit
    while not done(scene.task) and scene.now < end:
        scene.run(0.1)
    assert done(scene.task), scene.task
    return scene.task


def test_a_delivery_by_tap_and_card(house: Scene) -> None:
    house.set(home=[Waypoint(0.0, -2.0)])
    begin(house, "deliver", "office 12", "Lab", "home", message="Two books")
    assert house.task.places == ["Office 12", "Lab", "Home"]
    status = until(house, lambda status: bool(status.asks))
    assert (status.phase, status.place, status.asks) == (
        "waiting",
        "Office 12",
        "Has it been picked up at Office 12?",
    )
    assert house.ask("/task/confirm", CommandRequest(client_name="Bert")).message == "Confirmed."
    house.run(0.2)
    assert (house.task.phase, house.task.place) == ("driving", "Lab")
    assert house.refused("/task/confirm") == "The robot asks nothing just now."
    until(house, lambda status: bool(status.asks))
    house.robot.more.append(("/tag", TagRead(tag="card-lab")))
    house.run(0.2)
    assert "Delivered at Lab, confirmed by the card." in house.events("task")
    assert house.run_task().reason == "Delivered at Lab."
    assert math.hypot(house.robot.pose[0], house.robot.pose[1] + 2.0) < 0.2


def test_a_tour_that_waits_for_who_follows(house: Scene) -> None:
    begin(house, "guide", "Office 12", "Lab")

    def follow(present: bool, seconds: float) -> None:
        for _ in range(round(seconds / 0.2)):
            house.robot.more.append(("/following", Following(present=present)))
            house.run(0.2)

    follow(True, 1.0)
    follow(False, 4.0)
    assert (house.task.phase, house.task.reason) == ("waiting", "Waiting: no one follows.")
    assert house.robot.at_rest
    while house.task.state == "RUNNING":
        follow(True, 0.2)
    assert house.task.reason == "Guided tour done: 2 places visited."
    assert "Lab reached: Here we grow crystals." in house.events("waypoint")


def test_going_to_a_place_and_to_points(house: Scene) -> None:
    begin(house, "go_to", "Lab")
    assert house.run_task().reason == "Lab reached."
    assert house.task.place == "Lab"
    begin(house, "go_to", goals=[Waypoint(0.0, 3.0), Waypoint(0.0, 1.0)])
    assert house.run_task().visited == 2
    assert house.events("waypoint") == ["Goal 1 of 2 reached.", "Goal 2 of 2 reached."]


def test_home_may_be_a_place(house: Scene) -> None:
    assert house.refused("/task/go_home") == "Home is not set; set it on the map first."
    house.ask("/places/set", SetPlaceRequest(place=Place(name="My corner", kind="home", x=2.0, y=-2.0)))
    begin(house, "go_home")
    assert house.run_task().reason == "Home."
    assert house.task.place == "Home"
    assert math.hypot(house.robot.pose[0] - 2.0, house.robot.pose[1] + 2.0) < 0.2


def test_holding_for_a_time(house: Scene) -> None:
    begin(house, "hold", duration=5.0)
    house.run(0.1)
    assert (house.task.phase, house.task.reason) == ("holding", "Holding here for 5 s.")
    began = house.now
    assert house.run_task().reason == "Held for 5 s."
    assert house.now - began == pytest.approx(5.0, abs=0.3)


def test_a_pause_does_not_count_as_holding(house: Scene) -> None:
    begin(house, "hold", duration=5.0)
    house.run(3.0)
    house.ask("/task/pause")
    house.run(60.0)
    house.ask("/task/resume")
    house.run(1.5)
    assert house.task.state == "RUNNING"
    house.run(0.8)
    assert house.task.state == "SUCCEEDED"


def test_following_a_heading_up_to_the_wall(house: Scene) -> None:
    begin(house, "follow_heading", heading=math.pi / 2, speed=0.5)
    assert house.run_task().state == "FAILED"
    assert house.task.reason.startswith("The way straight on ended at (")
    assert 5.0 < house.robot.pose[1] < 6.0
    assert house.robot.contacts == 0


def test_docking_until_the_charge_is_seen(house: Scene) -> None:
    begin(house, "dock")
    until(house, lambda status: status.phase == "docking")
    assert house.robot.pose[0] == pytest.approx(-2.0, abs=0.25)
    house.run(5.0)
    house.robot.charging = True
    assert house.run_task().reason == "Docked at Dock: the battery takes charge."
    assert house.robot.at_rest


def test_a_dock_may_stand_at_a_wall_and_is_left_again(house: Scene) -> None:
    wall = Place(name="Wall", kind="dock", x=-9.74, y=0.0, yaw=math.pi)
    assert house.ask("/places/set", SetPlaceRequest(place=wall)).success
    behind = Place(name="Behind", kind="dock", x=-9.74, y=0.0, yaw=0.0)
    said = house.refused("/places/set", SetPlaceRequest(place=behind))
    assert said.startswith("The place before Behind at (-10.5, 0.0) is in a wall")
    begin(house, "dock", "Wall")
    house.until(lambda: house.robot.pose[0] < -9.6, 90.0)
    house.robot.charging = True
    assert house.run_task().state == "SUCCEEDED"
    assert house.robot.pose[0] == pytest.approx(-9.7, abs=0.15)
    begin(house, "go_to", "Office 12")
    assert house.run_task().state == "SUCCEEDED"
    assert house.robot.contacts == 0


def test_touching_the_dock_is_no_accident(house: Scene) -> None:
    begin(house, "dock")
    house.until(lambda: house.robot.pose[0] < -3.7, 60.0)
    house.robot.silent.add("/bumper")
    house.robot.more.append(("/bumper", Bumper(pressed=True)))
    house.run(0.3)
    assert house.task.state == "RUNNING"
    assert house.robot.at_rest


def test_a_patrol_of_named_places_keeps_them_when_another_mission_is_set(house: Scene) -> None:
    house.set(*SQUARE, laps=1)
    begin(house, "patrol", "Lab", "Office 12")
    house.set(Waypoint(-2.0, -2.0), laps=1)
    assert house.run_task().visited == 2
    assert house.events("waypoint") == ["Lab reached.", "Office 12 reached."]


def test_points_of_a_mission_that_have_names_are_its_places(house: Scene) -> None:
    house.set(Waypoint(2.0, 0.0, name="Gate"), Waypoint(2.0, 2.0))
    house.start()
    house.run(0.2)
    assert (house.task.places, house.task.place) == (["Gate"], "Gate")
    assert house.task.reason == "Heading for point 1 of 2, Gate."


def test_a_mission_that_is_set_while_it_is_patrolled_is_taken_over_and_said(house: Scene) -> None:
    house.set(*SQUARE)
    house.start()
    until(house, lambda status: status.visited == 1)
    mission = Mission(waypoints=[SQUARE[0], Waypoint(2.0, -2.0)], laps=1)
    said = house.ask("/mission/set", SetMissionRequest(mission=mission)).message
    assert said == "Stored 2 points; the running patrol takes them over at its next point."
    assert house.run_task().state == "SUCCEEDED"
    assert "The patrol goes on with the new mission of 2 points." in house.events("task")
    assert house.task.waypoints == 2
    house.start()
    assert house.ask("/mission/set", SetMissionRequest(mission=Mission())).message == (
        "Stored 0 points; the running patrol keeps its own."
    )


@pytest.mark.parametrize("task", ["deliver", "guide", "go_to", "follow_heading", "patrol", "dock", "hold"])
def test_every_task_pauses_at_rest_wherever_it_is_and_goes_on(house: Scene, task: str) -> None:
    names = {"deliver": ["Office 12", "Lab"], "guide": ["Lab"], "go_to": ["Lab"], "patrol": ["Lab"]}
    house.set(Waypoint(3.0, 3.0), laps=1)
    begin(house, task, *names.get(task, []), heading=1.0, duration=20.0)
    for _ in range(4):
        house.run(1.5)
        assert house.ask("/task/pause").success
        house.run(0.3)
        x, y, _ = house.robot.pose
        house.run(3.0)
        assert house.task.state == "PAUSED"
        assert (house.task.phase, house.task.asks) == ("", "")
        assert math.hypot(house.robot.pose[0] - x, house.robot.pose[1] - y) < 0.01
        assert house.ask("/task/resume").success
        assert house.task.state == "RUNNING"


def without_dock(house: Scene) -> None:
    dock = next(place for place in house.station.records.places.all() if place.kind == "dock")
    assert house.ask("/places/delete", DeletePlaceRequest(id=dock.id)).success


@pytest.mark.parametrize("task", ["deliver", "guide", "go_to", "follow_heading", "patrol"])
def test_without_a_dock_a_low_battery_ends_every_task_that_moves_and_sends_it_home(
    house: Scene, task: str
) -> None:
    without_dock(house)
    names = {"deliver": ["Office 12", "Lab"], "guide": ["Lab"], "go_to": ["Lab"]}
    house.set(*SQUARE, home=[Waypoint(-2.0, -2.0)])
    begin(house, task, *names.get(task, []), heading=0.0)
    house.run(2.0)
    house.robot.battery = 0.09
    house.run(1.1)
    assert "Battery at 9%: going home." in house.events("battery")
    assert house.task.task == "go_home"
    assert house.run_task().reason == "Home."


def test_a_low_battery_lets_it_hold_dock_and_go_home(house: Scene) -> None:
    house.robot.battery = 0.09
    house.run(1.1)
    begin(house, "hold")
    house.run(3.0)
    assert house.task.task == "hold"
    house.ask("/task/cancel")
    begin(house, "dock")
    house.run(3.0)
    assert (house.task.task, house.task.state) == ("dock", "RUNNING")


def test_a_low_battery_with_no_dock_and_no_home_ends_the_task_and_says_why(house: Scene) -> None:
    without_dock(house)
    begin(house, "go_to", "Lab")
    house.robot.battery = 0.09
    house.run(1.1)
    assert house.task.state == "CANCELED"
    assert house.task.reason == (
        "Battery at 9%: the way to Lab ends here. Home is not set; set it on the map first."
    )


def test_a_low_battery_refuses_what_moves(house: Scene) -> None:
    house.robot.battery = 0.14
    house.run(1.1)
    order = TaskOrder(task="deliver", places=["Office 12", "Lab"])
    said = house.refused("/task/start", StartTaskRequest(order=order))
    assert said == "The battery is at 14%; a delivery needs at least 15%."


@pytest.mark.parametrize("state", ["low", "running", "paused"])
def test_a_goal_that_is_published_starts_nothing_that_the_service_would_refuse(
    house: Scene, state: str
) -> None:
    if state == "low":
        house.robot.battery = 0.12
        house.run(1.0)
    else:
        begin(house, "hold")
    if state == "paused":
        house.ask("/task/pause")
    before = house.task
    order = TaskOrder(task="go_to", goals=[Waypoint(2.0, 0.0)])
    said = house.refused("/task/start", StartTaskRequest(order=order))
    house.go_to(2.0, 0.0)
    assert house.events("command") == [said]
    assert house.task == before
    assert house.robot.at_rest


def test_a_goal_that_is_published_takes_the_place_of_the_one_before_it(house: Scene) -> None:
    house.go_to(6.0, 0.0)
    house.run(0.5)
    house.go_to(-1.0, 0.0)
    assert house.events("command") == []
    assert house.run_task().state == "SUCCEEDED"
    assert house.robot.pose[0] == pytest.approx(-1.0, abs=0.15)
    begin(house, "go_to", "Lab")
    house.go_to(6.0, 0.0)
    assert house.events("command") == ["A task is running already; stop it first."]


def test_a_task_that_is_asked_for_instead_ends_the_one_of_now_only_when_it_can_be_done(house: Scene) -> None:
    begin(house, "go_to", "Lab")
    before = house.task.task_id
    outside = TaskOrder(task="go_to", goals=[Waypoint(500.0, 0.0)])
    assert "off the map" in house.refused("/task/start", StartTaskRequest(order=outside, instead=True))
    house.run(0.2)
    assert (house.task.task_id, house.task.state) == (before, "RUNNING"), "a refused order ended the way"
    order = TaskOrder(task="go_to", goals=[Waypoint(6.0, 0.0)])
    assert house.ask("/task/start", StartTaskRequest(order=order, instead=True)).success
    assert (house.task.task_id, house.task.state) == (before + 1, "RUNNING")


@pytest.mark.parametrize("task", ["deliver", "guide", "go_to", "hold", "patrol", "dock"])
def test_progress_and_time_left_are_told_for_every_task(house: Scene, task: str) -> None:
    names = {"deliver": ["Office 12", "Lab"], "guide": ["Office 12", "Lab"], "go_to": ["Lab"]}
    house.set(*SQUARE, laps=1)
    begin(house, task, *names.get(task, []), duration=10.0)
    house.run(4.0)
    told = [msg for msg in house.of("/task/progress") if isinstance(msg, TaskProgress)]
    assert len(told) >= 4
    assert 0.0 < told[-1].progress < 1.0
    assert 0.0 < told[-1].time_left < told[1].time_left


@pytest.mark.parametrize(
    ("order", "said"),
    [
        (
            TaskOrder(task="go_to", places=["Office 99"]),
            "There is no place 'Office 99'; there are Office 12, Lab, Dock.",
        ),
        (TaskOrder(task="go_to"), "go_to needs one place, or points, not 0."),
        (TaskOrder(task="go_to", goals=[Waypoint(99.0, 0.0)]), "The goal at (99.0, 0.0) is off the map."),
        (TaskOrder(task="go_to", goals=[Waypoint(math.nan, 0.0)]), "The goal at (nan, 0.0) is off the map."),
        (
            TaskOrder(task="deliver", places=["Lab"]),
            "A delivery needs two places, from and to, and may have a third to go on to, not 1.",
        ),
        (TaskOrder(task="guide"), "A guided tour needs at least one place, not 0."),
        (
            TaskOrder(task="hold", duration=-1.0),
            "The duration must be above 0 and at most 86400 s, or left out until stopped, not -1 s.",
        ),
        (
            TaskOrder(task="follow_heading", speed=9.0),
            "The speed must be above 0 and at most 0.7 m/s, not 9 m/s.",
        ),
        (TaskOrder(task="follow_heading", heading=math.inf), "The heading must be a number [rad], not inf."),
        (
            TaskOrder(task="dock", places=["Lab"]),
            "Lab has no direction; docking needs the one to stand in there.",
        ),
    ],
)
def test_an_order_that_cannot_be_done_is_refused_with_what_is_allowed(
    house: Scene, order: TaskOrder, said: str
) -> None:
    assert house.refused("/task/start", StartTaskRequest(order=order)) == said
    assert house.task.state == "IDLE"


def test_a_place_that_came_to_lie_in_a_wall_is_refused_by_its_name(house: Scene) -> None:
    house.station.records.places.set(Place(name="Cellar", x=10.5, y=0.0))
    order = TaskOrder(task="go_to", places=["Cellar"])
    said = house.refused("/task/start", StartTaskRequest(order=order))
    assert said == "Cellar at (10.5, 0.0) is in a wall or another obstacle."


def test_a_confirmation_by_somebody_else_than_the_driver_is_refused(house: Scene) -> None:
    begin(house, "deliver", "Office 12", "Lab")
    until(house, lambda status: bool(status.asks))
    assert "has control" in house.refused("/task/confirm", None, house.client("bert"))
    house.ask("/control/release")
    assert house.ask("/task/confirm", None, house.client("carl")).success


def test_the_history_has_the_order_and_who_gave_it(house: Scene) -> None:
    order = TaskOrder(task="hold", duration=2.0)
    house.ask("/task/start", StartTaskRequest(order=order, client_name="Anna"))
    house.run_task()
    (run,) = house.ask("/history/get", GetHistoryRequest(limit=5)).runs  # type: ignore[attr-defined]
    assert (run.order.duration, run.by, run.state, run.reason) == (2.0, "Anna", "SUCCEEDED", "Held for 2 s.")


def test_an_answer_that_was_given_in_a_pause_does_not_count(house: Scene) -> None:
    begin(house, "deliver", "Office 12", "Lab")
    until(house, lambda status: bool(status.asks))
    house.ask("/task/pause")
    house.robot.more.append(("/tag", TagRead(tag="card-12")))
    house.run(0.5)
    assert house.refused("/task/confirm") == "The robot asks nothing just now."
    house.ask("/task/resume")
    house.run(1.0)
    assert house.task.asks == "Has it been picked up at Office 12?"


def test_endless_words_of_an_order_are_cut_and_endless_lists_refused(house: Scene) -> None:
    begin(house, "deliver", "Office 12", "Lab", message="x" * 9999, recipient_tag="y" * 9999)
    (run,) = house.ask("/history/get", GetHistoryRequest(limit=5)).runs  # type: ignore[attr-defined]
    assert (len(run.order.message), len(run.order.recipient_tag)) == (200, 64)
    house.ask("/task/cancel")
    order = TaskOrder(task="hold", goals=[Waypoint()] * 101)
    said = house.refused("/task/start", StartTaskRequest(order=order))
    assert said == "A task names at most 100 places or points, not 101."
