"""What the services do and refuse, without sockets and in virtual time."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import msgspec
import pytest

from bridge.core.identity import public_id
from bridge.msgs.arrays import Int32Array
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Twist,
)
from bridge.msgs.pilothouse_msgs import (
    AcknowledgeEventsRequest,
    CommandRequest,
    GetEventsRequest,
    GetMissionRequest,
    Mission,
    SetMissionRequest,
    StartTaskRequest,
    Waypoint,
)
from robotside.control.command_gate import STOP_SENTENCE
from robotside.control.stop_release import MAX_HOLD_TIME, MIN_HOLD_TIME, NOT_HELD, RELEASE_PAUSE
from tests.fakes import Box, FakeRobot
from tests.robotside.scene import SQUARE, Scene


def test_control_given_back_while_driving_stops_the_robot_at_once(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.2))
    assert scene.ask("/control/release").success
    assert scene.robot.at_rest
    assert scene.control.driver == ""
    braked = len(scene.robot.commands)
    scene.run(1.0)
    assert len(scene.robot.commands) == braked


def test_stop_is_obeyed_from_anyone_and_latched(scene: Scene) -> None:
    scene.ask("/control/acquire")
    scene.drive(Twist.planar(0.3, 0.0))
    bert = scene.client("bert")
    answer = scene.ask("/stop", CommandRequest(client_id="b", client_name="Bert"), bert)
    assert answer.success
    assert scene.robot.commands[-1] is None
    assert (scene.control.mode, scene.control.stopped_by) == ("STOPPED", "Bert")
    assert scene.control.stopped_by_id == public_id("b")
    scene.drive(Twist.planar(0.3, 0.0))
    assert scene.robot.commands[-1] is None
    assert "STOP is pressed" in scene.events("command")[-1]


def test_stop_is_obeyed_however_old_and_however_often_it_comes(scene: Scene) -> None:
    old = CommandRequest(command_id="s1", stamp=scene.now - 100.0)
    assert scene.ask("/stop", old).success
    assert scene.release_stop().success
    assert scene.ask("/stop", old).success
    assert scene.control.stopped


def test_stop_is_released_by_who_has_control_or_pressed_it(scene: Scene) -> None:
    bert, carl = scene.client("bert"), scene.client("carl")
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    scene.ask("/stop", client=bert)
    for service in ("/stop/hold", "/stop/release"):
        assert "Anna has control" in scene.refused(service, client=carl)
    assert scene.release_stop(bert).success
    assert scene.control.driver == "Anna"
    scene.run(RELEASE_PAUSE + 0.1)
    scene.ask("/stop", client=bert)
    assert scene.release_stop().success
    assert scene.control.mode == "MANUAL"


def test_who_began_to_hold_before_somebody_took_control_releases_no_stop_of_others(scene: Scene) -> None:
    bert, carl = scene.client("bert"), scene.client("carl")
    scene.ask("/stop", client=bert)
    assert scene.ask("/stop/hold", client=carl).success
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    scene.run(MIN_HOLD_TIME + 0.1)
    assert "Anna has control" in scene.refused("/stop/release", client=carl)
    assert scene.control.stopped


def test_a_release_that_was_asked_for_before_the_latest_stop_leaves_it(scene: Scene) -> None:
    bert = scene.client("bert")
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    scene.ask("/stop", CommandRequest(stamp=scene.now, client_name="Anna"))
    scene.ask("/stop/hold")
    late = CommandRequest(stamp=scene.now + 1.5, client_name="Anna")
    scene.run(2.0)
    scene.ask("/stop", CommandRequest(stamp=scene.now, client_name="Bert"), bert)
    said = scene.refused("/stop/release", late)
    assert said == "STOP was pressed after this request: it stays."
    assert scene.control.stopped
    scene.run(1.0)
    assert scene.refused("/stop/release") == said, "the hold was begun before"
    assert scene.release_stop().success


def test_a_stop_without_a_stamp_was_given_when_it_came(scene: Scene) -> None:
    """However old a release is that has one, it does not undo it."""
    scene.ask("/stop", CommandRequest(stamp=scene.clock))
    scene.ask("/stop/hold")
    scene.run(1.0)
    late = CommandRequest(stamp=scene.clock)
    scene.run(0.5)
    scene.ask("/stop")
    assert scene.refused("/stop/release", late) == "STOP was pressed after this request: it stays."
    assert scene.control.stopped


def test_a_release_that_was_late_on_its_way_does_not_end_the_hold_of_a_later_stop(scene: Scene) -> None:
    late = CommandRequest(stamp=scene.clock)
    scene.run(0.5)
    scene.ask("/stop")
    scene.ask("/stop/hold")
    scene.run(MIN_HOLD_TIME + 0.1)
    assert scene.refused("/stop/release", late) == "STOP was pressed after this request: it stays."
    assert scene.control.stopped
    assert scene.ask("/stop/release", CommandRequest(stamp=scene.clock)).success


def test_without_a_hold_of_a_second_stop_stays(scene: Scene) -> None:
    scene.ask("/stop")
    assert scene.refused("/stop/release") == NOT_HELD
    assert scene.ask("/stop/hold").success
    assert "longer" in scene.refused("/stop/release")
    scene.run(MIN_HOLD_TIME - 0.05)
    assert "longer" in scene.refused("/stop/release")
    assert scene.control.stopped
    scene.run(0.1)
    assert scene.ask("/stop/release").message == "STOP is released."
    assert not scene.control.stopped


def test_a_release_without_a_hold_begins_one_so_that_two_of_them_release_stop(scene: Scene) -> None:
    scene.ask("/stop")
    assert "call /stop/release again after 1 to 5 s" in scene.refused("/stop/release")
    assert "longer" in scene.refused("/stop/release"), "at once is no hold"
    scene.run(MIN_HOLD_TIME + 0.05)
    assert scene.ask("/stop/release").success
    scene.ask("/stop")
    assert "lately" in scene.refused("/stop/release"), "the pause after a release holds for this hold too"
    assert scene.control.stopped


def test_a_hold_is_of_one_operator_and_over_after_a_while(scene: Scene) -> None:
    bert = scene.client("bert")
    scene.ask("/stop")
    assert scene.ask("/stop/hold").success
    scene.run(1.5)
    assert scene.refused("/stop/release", client=bert) == NOT_HELD
    scene.run(MAX_HOLD_TIME)
    assert scene.refused("/stop/release") == NOT_HELD
    assert scene.control.stopped


def test_after_a_release_the_next_one_takes_a_pause(scene: Scene) -> None:
    scene.ask("/stop")
    assert scene.release_stop().success
    scene.ask("/stop")
    said = scene.refused("/stop/hold")
    assert said == "STOP was released lately; hold Release again in 3.0 s."
    scene.run(RELEASE_PAUSE - 0.1)
    assert "lately" in scene.refused("/stop/hold")
    scene.run(0.2)
    assert scene.release_stop().success


def test_a_refused_release_takes_no_control(scene: Scene) -> None:
    scene.ask("/stop", client=scene.client("bert"))
    scene.refused("/stop/release")
    assert scene.ask("/stop/hold").success
    scene.refused("/stop/release")
    assert scene.control.driver == ""
    scene.run(1.1)
    assert scene.ask("/stop/release").success
    assert scene.control.driver


def test_a_hold_without_stop_is_none(scene: Scene) -> None:
    assert scene.ask("/stop/hold").message == "STOP is not pressed."
    scene.run(1.1)
    scene.ask("/stop")
    assert scene.refused("/stop/release") == NOT_HELD


def test_a_stop_from_a_clock_ahead_is_released_all_the_same(scene: Scene) -> None:
    scene.ask("/control/acquire")
    scene.ask("/stop", CommandRequest(stamp=scene.now + 3600.0))
    scene.run(1.0)
    assert scene.ask("/stop/hold", CommandRequest(stamp=scene.now)).success
    scene.run(1.1)
    assert scene.ask("/stop/release", CommandRequest(stamp=scene.now)).success


def test_with_stop_pressed_tasks_are_refused(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.ask("/stop")
    for name, request in (
        ("/task/start", StartTaskRequest()),
        ("/task/go_home", None),
        ("/task/resume", None),
    ):
        assert "STOP is pressed" in scene.refused(name, request)


def test_with_stop_pressed_a_paused_task_stays_where_it_is_whatever_is_asked(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(2.0)
    scene.ask("/stop", CommandRequest(client_name="Anna"))
    before = len(scene.robot.commands)
    for name, request in (
        ("/task/start", StartTaskRequest()),
        ("/task/start", StartTaskRequest(task="go_home")),
        ("/task/go_home", None),
        ("/task/resume", None),
    ):
        assert scene.refused(name, request) == STOP_SENTENCE
        scene.run(0.5)
    assert (scene.task.task, scene.task.state, scene.task.reason) == ("patrol", "PAUSED", "Stopped by Anna.")
    assert not any(scene.robot.commands[before:])


def test_a_mission_without_points_is_refused_at_the_start(scene: Scene) -> None:
    said = scene.refused("/task/start", StartTaskRequest())
    assert said == "The mission has no points; set at least one."


def test_a_point_in_a_wall_is_refused_with_its_number_and_place(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(boxes=[Box(2.0, 1.0, 5.0, 3.0)]), tmp_path)
    mission = Mission(waypoints=[Waypoint(1.0, 0.0), Waypoint(3.5, 2.0)])
    said = scene.refused("/mission/set", SetMissionRequest(mission=mission))
    assert said == "Point 2 at (3.5, 2.0) is in a wall or another obstacle."


@pytest.mark.parametrize(
    ("mission", "said"),
    [
        (Mission(motion="zigzag"), "There is no motion 'zigzag'; there are loop, random, intermittent."),
        (Mission(dwell=math.nan), "The dwell must be 0 to 600 s, not nan s."),
        (Mission(laps=-1), "The laps must be 0 to 999, not -1."),
        (Mission(waypoints=[Waypoint(math.nan, 0.0)]), "Point 1 at (nan, 0.0) is off the map."),
        (Mission(home=[Waypoint(99.0, 0.0)]), "Home at (99.0, 0.0) is off the map."),
    ],
)
def test_a_mission_that_makes_no_sense_is_refused_with_what_is_allowed(
    scene: Scene, mission: Mission, said: str
) -> None:
    assert scene.refused("/mission/set", SetMissionRequest(mission=mission)) == said


def test_a_command_from_somebody_without_control_names_the_driver(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.ask("/control/acquire", CommandRequest(client_id="t1", client_name="tablet-A"))
    bert = scene.client("bert")
    for name, request in (
        ("/task/start", StartTaskRequest()),
        ("/task/pause", None),
        ("/mission/set", SetMissionRequest()),
    ):
        assert scene.refused(name, request, bert).startswith("tablet-A has control")


def test_a_low_battery_refuses_the_start_with_its_value(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.robot.battery = 0.14
    scene.run(1.1)
    said = scene.refused("/task/start", StartTaskRequest())
    assert said == "The battery is at 14%; a patrol needs at least 15%."


def test_a_command_that_is_too_old_is_refused(scene: Scene) -> None:
    request = CommandRequest(stamp=scene.now - 6.0)
    assert "too old" in scene.refused("/control/acquire", request)


def test_the_same_command_twice_is_done_once(scene: Scene) -> None:
    scene.set(*SQUARE)
    request = StartTaskRequest(command_id="c1")
    first = scene.ask("/task/start", request)
    assert scene.ask("/task/start", request) == first
    assert scene.task.task_id == 1
    assert "A task is running already" in scene.refused("/task/start", StartTaskRequest(command_id="c2"))


def test_what_one_client_was_answered_is_no_answer_for_another(scene: Scene) -> None:
    counted = CommandRequest(command_id="2", client_id="C")
    assert scene.ask("/control/acquire", counted).message == "You have control."
    scene.ask("/control/release", counted)
    scene.ask("/control/acquire", CommandRequest(command_id="2", client_id="D"), scene.client("bert"))
    assert scene.control.driver_id == public_id("D")


def test_who_repeats_the_ids_of_a_command_elsewhere_does_not_get_its_answer(scene: Scene) -> None:
    ids = CommandRequest(command_id="2", client_id="C", client_name="Carl")
    assert scene.ask("/control/acquire", ids).message == "You have control."
    thief, again = scene.client("thief"), scene.client("again")
    thief.address = "192.0.2.66:5000"
    assert "has control" in scene.refused("/control/acquire", ids, thief)
    assert scene.ask("/control/acquire", ids, again).message == "You have control.", "the same machine again"


@pytest.mark.parametrize(("x", "shown"), [(12.0, "12.0"), (1e6, "1e+06"), (-1e308, "-1e+308")])
def test_a_place_off_the_map_is_refused_with_what_the_map_holds(scene: Scene, x: float, shown: str) -> None:
    before = scene.station.autonomy.pose_estimator.pose
    far = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(x, 0.0))))
    scene.station.on_message(scene.anna, "/initialpose", far, None)
    assert scene.station.autonomy.pose_estimator.pose == before
    assert scene.events("command") == [
        f"The place at ({shown}, 0.0) is off the map, which is x -11.0 to 11.0 m, y -7.0 to 7.0 m."
    ]


def test_what_was_missed_can_be_asked_for(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    everything = scene.ask("/events/get", GetEventsRequest()).events  # type: ignore[attr-defined]
    assert [event.id for event in everything] == list(range(1, len(everything) + 1))
    later = scene.ask("/events/get", GetEventsRequest(2, "b1")).events  # type: ignore[attr-defined]
    assert later == everything[2:]
    assert scene.ask("/events/get", GetEventsRequest(2, "another")).events == everything  # type: ignore[attr-defined]


def test_the_answer_says_whether_there_is_more_and_what_others_have_seen_to(scene: Scene) -> None:
    for number in range(4):
        scene.station.events.say("contact", f"It touched something {number}.", "alarm")
    ask = GetEventsRequest(since=1, boot="b1", most=2)
    answer: Any = scene.ask("/events/get", ask)
    assert ([event.id for event in answer.events], answer.more, answer.oldest) == ([2, 3], True, 1)
    seen = AcknowledgeEventsRequest(client_name="Anna", ids=Int32Array([1]))
    assert scene.ask("/events/acknowledge", seen).success
    ask = msgspec.structs.replace(ask, since=3, open=Int32Array([1, 3]), most=500)
    last: Any = scene.ask("/events/get", ask)
    first, *later = last.events
    assert (first.id, first.acknowledged_by, last.more) == (1, "Anna", False)
    assert [event.id for event in later] == list(range(4, later[-1].id + 1))


def test_a_mission_survives_a_restart(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(), tmp_path)
    scene.set(*SQUARE, motion="intermittent", dwell=3.0)
    again = Scene(FakeRobot(), tmp_path)
    mission = again.ask("/mission/get", GetMissionRequest()).mission  # type: ignore[attr-defined]
    assert mission == scene.station.missions.current
    assert mission.waypoints == SQUARE
