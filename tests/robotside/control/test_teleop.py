"""Who steers a whole station, and what it does when nobody does."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from bridge.core.identity import public_id
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest, SetModeRequest, SetOptionRequest, TaskOrder, Waypoint
from robotside.control.command_gate import STOP_SENTENCE
from robotside.core.config import DEFAULT_CONFIG, Config, ControlSettings, SafeStateSettings
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.scene import SQUARE, Scene

AHEAD = Twist.planar(0.3, 0.0)


def named(scene: Scene, name: str) -> FakeClient:
    """A client with a name; anna is there from the beginning."""
    client = scene.anna if name == "anna" else scene.client(name)
    scene.station.controls.introduce(client, f"tablet-{name}", name.capitalize())
    return client


def ask(scene: Scene, service: str, client: FakeClient) -> str:
    answer = scene.ask(service, CommandRequest(), client)
    assert answer.success, answer.message
    return answer.message


def patrolling(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    assert scene.control.mode == "AUTO"


def test_everyone_sees_who_asks_for_control_and_when_it_goes_over(scene: Scene) -> None:
    anna, bert = named(scene, "anna"), named(scene, "bert")
    ask(scene, "/control/acquire", anna)
    said = ask(scene, "/control/request", bert)
    assert said == "Anna is asked; you have control in 10 s unless Anna objects."
    assert (scene.control.driver, scene.control.requested_by) == ("Anna", "Bert")
    assert scene.control.requested_by_id == public_id("tablet-bert")
    assert scene.control.handover.seconds == pytest.approx(scene.clock + 10.0, abs=1e-3)
    scene.run(10.1)
    assert (scene.control.driver, scene.control.requested_by) == ("Bert", "")
    assert scene.control.handover.seconds == 0
    assert scene.events("control") == [
        "Anna has control.",
        "Bert asks for control; it goes over in 10 s unless Anna objects.",
        "Bert has control.",
    ]


def test_an_objection_is_told_to_everyone(scene: Scene) -> None:
    anna, bert = named(scene, "anna"), named(scene, "bert")
    ask(scene, "/control/acquire", anna)
    ask(scene, "/control/request", bert)
    assert ask(scene, "/control/object", anna) == "You keep control; Bert is notified."
    assert scene.events("control")[-1] == "Anna objected: Bert does not get control."
    scene.run(11.0)
    assert (scene.control.driver, scene.control.requested_by) == ("Anna", "")


def test_a_robot_that_is_handed_over_in_motion_comes_to_rest_first(scene: Scene) -> None:
    anna, bert = named(scene, "anna"), named(scene, "bert")
    scene.drive(AHEAD, anna)
    ask(scene, "/control/request", bert)
    assert not scene.robot.at_rest
    assert ask(scene, "/control/grant", anna) == "Bert has control."
    assert scene.robot.at_rest
    scene.drive(AHEAD, anna)
    assert scene.robot.at_rest
    assert scene.events("command")[-1].startswith("Bert has control")
    scene.drive(AHEAD, bert)
    assert not scene.robot.at_rest


def test_a_task_goes_on_when_control_is_handed_over(scene: Scene) -> None:
    anna, bert = named(scene, "anna"), named(scene, "bert")
    patrolling(scene)
    ask(scene, "/control/request", bert)
    ask(scene, "/control/grant", anna)
    scene.run(0.5)
    assert (scene.control.driver, scene.control.mode) == ("Bert", "AUTO")


def test_the_mode_is_a_command_with_an_answer(scene: Scene) -> None:
    assert scene.refused("/mode/set", SetModeRequest(mode="AUTO")) == (
        "There is no task to resume; start one."
    )
    assert scene.refused("/mode/set", SetModeRequest(mode="FAST")) == (
        "The mode is MANUAL or AUTO, not 'FAST'."
    )
    patrolling(scene)
    assert scene.ask("/mode/set", SetModeRequest(mode="MANUAL")).message == (
        "The robot is driven by hand; its task is paused."
    )
    assert (scene.control.mode, scene.task.state) == ("PAUSED", "PAUSED")
    assert scene.ask("/mode/set", SetModeRequest(mode="MANUAL")).message == (
        "The robot is driven by hand already."
    )
    assert scene.ask("/mode/set", SetModeRequest(mode="AUTO")).message == "The robot drives itself."
    assert scene.control.mode == "AUTO"
    bert = scene.client("bert")
    assert "has control" in scene.refused("/mode/set", SetModeRequest(mode="MANUAL"), bert)
    scene.ask("/stop")
    assert scene.refused("/mode/set", SetModeRequest(mode="AUTO")) == STOP_SENTENCE


def test_taking_the_stick_pauses_the_task_and_says_so_and_letting_go_does_not_resume_it(scene: Scene) -> None:
    named(scene, "anna")
    patrolling(scene)
    scene.drive(AHEAD)
    assert scene.task.state == "PAUSED"
    assert scene.events("task")[-1] == "Paused: Anna took the stick."
    scene.drive(Twist())
    scene.run(5.0)
    assert scene.task.state == "PAUSED"
    assert scene.robot.at_rest


@pytest.mark.parametrize("how", ["silent", "gone"])
def test_a_lost_handheld_does_not_stop_a_task_unless_told_to(scene: Scene, how: str) -> None:
    def lose(client: FakeClient) -> None:
        scene.clients.remove(client)
        if how == "gone":
            scene.station.on_gone(client)
        scene.run(2.5)

    anna, bert = named(scene, "anna"), named(scene, "bert")
    patrolling(scene)
    lose(anna)
    assert (scene.control.driver, scene.task.state) == ("", "RUNNING")
    scene.ask("/control/acquire", client=bert)
    told = SetOptionRequest(name="lost_link_stops_task", value="on")
    assert scene.ask("/settings/set", told, bert).success
    lose(bert)
    assert (scene.control.driver, scene.task.state) == ("", "PAUSED")
    assert scene.task.reason == "Paused: the link to Bert was lost."
    assert scene.robot.at_rest


def test_a_slow_link_slows_the_driver_and_that_is_shown_and_can_be_switched_off(scene: Scene) -> None:
    scene.drive(Twist.planar(0.7, 1.9))
    assert scene.robot.twist == Twist.planar(0.7, 1.9)
    scene.anna.rtt = 0.3
    scene.drive(Twist.planar(0.7, 1.9))
    assert scene.robot.twist.linear.x == pytest.approx(0.7 * 0.575)
    assert scene.robot.twist.angular.z == pytest.approx(1.9 * 0.575)
    scene.drive(Twist.planar(0.1, 0.0))
    assert scene.robot.twist == Twist.planar(0.1, 0.0)
    assert (scene.control.speed_cap, scene.control.follows_link) == (pytest.approx(0.55), True)
    scene.anna.rtt = 2.0
    scene.drive(Twist.planar(0.7, 0.0))
    assert scene.robot.twist.linear.x == pytest.approx(0.7 * 0.15)
    off = SetOptionRequest(name="follow_link", value="off")
    assert scene.ask("/settings/set", off).message == "The speed does not follow the link any more."
    assert (scene.control.speed_cap, scene.control.follows_link) == (1.0, False)
    scene.drive(Twist.planar(0.7, 0.0))
    assert scene.robot.twist == Twist.planar(0.7, 0.0)


def test_a_task_does_not_go_slower_for_a_slow_link(scene: Scene) -> None:
    scene.anna.rtt = 2.0
    patrolling(scene)
    scene.run(2.0)
    assert max(abs(each.linear.x) for each in scene.robot.commands if each) > 0.3


def test_a_setting_is_kept_over_a_restart_and_a_wrong_one_is_refused(scene: Scene, tmp_path: Path) -> None:
    assert scene.ask("/settings/set", SetOptionRequest(name="follow_link", value="off")).success
    assert not Scene(FakeRobot(), tmp_path).control.follows_link
    assert scene.refused("/settings/set", SetOptionRequest(name="colour", value="on")) == (
        "There is no setting 'colour'; there are follow_link, lost_link_stops_task."
    )
    assert scene.refused("/settings/set", SetOptionRequest(name="follow_link", value="yes")) == (
        "follow_link is on or off, not 'yes'."
    )


def test_the_configuration_says_what_the_settings_are_at_first(tmp_path: Path) -> None:
    config = Config(control=ControlSettings(follow_link=False))
    scene = Scene(FakeRobot(), tmp_path, config=config)
    assert not scene.control.follows_link
    assert scene.ask("/settings/set", SetOptionRequest(name="follow_link", value="on")).success
    assert scene.control.follows_link


def test_everybody_is_told_how_the_settings_stand(scene: Scene) -> None:
    assert not scene.control.lost_link_stops_task
    assert scene.ask("/settings/set", SetOptionRequest(name="lost_link_stops_task", value="on")).success
    assert scene.control.lost_link_stops_task


class Kind(FakeRobot):
    """A robot of another kind; it flies or dives in name only."""

    def __init__(self, kind: str) -> None:
        super().__init__()
        self.info = msgspec.structs.replace(self.info, kind=kind)


def after_the_link(tmp_path: Path, kind: str, seconds: float, config: Config = DEFAULT_CONFIG) -> Scene:
    """A robot of a kind whose driver was lost in motion, so long ago."""
    scene = Scene(Kind(kind), tmp_path, config=config)
    scene.run(4.0)
    scene.drive(Twist.planar(0.3, 0.5))
    scene.run(0.1)
    scene.clients.clear()
    scene.run(seconds)
    return scene


def test_wheels_brake_once_when_the_link_is_lost_and_are_left_alone(tmp_path: Path) -> None:
    scene = after_the_link(tmp_path, "wheels", 60.0)
    assert scene.robot.commands[-2:] == [Twist.planar(0.3, 0.5), None]


def test_a_truck_brakes_straight(tmp_path: Path) -> None:
    scene = after_the_link(tmp_path, "ackermann", 3.0)
    assert scene.robot.commands[-1] is None
    assert Twist() in scene.robot.commands


def test_a_boat_goes_on_holding_its_heading(tmp_path: Path) -> None:
    scene = after_the_link(tmp_path, "boat", 30.0)
    scene.robot.pose = (*scene.robot.pose[:2], scene.robot.pose[2] + 0.3)
    scene.robot._odom = (*scene.robot._odom[:2], scene.robot._odom[2] + 0.3)
    scene.run(0.2)
    assert scene.robot.twist.angular.z < -0.05
    assert scene.robot.twist.linear.x == 0


def test_a_quadrotor_hovers_lands_and_says_so(tmp_path: Path) -> None:
    scene = after_the_link(tmp_path, "quadrotor", 11.0)
    assert "No one drives the robot: it lands." not in scene.events("control")
    scene.run(4.0)
    assert scene.events("control")[-1].startswith("No one drives the robot: it ")
    assert scene.robot.at_rest


def test_who_drives_again_ends_the_safe_state(tmp_path: Path) -> None:
    scene = after_the_link(tmp_path, "boat", 5.0)
    anna = scene.client("anna again")
    scene.run(0.1)
    scene.drive(AHEAD, anna)
    assert scene.robot.twist == AHEAD
    scene.run(0.2)
    assert scene.robot.twist == AHEAD


def test_wheels_that_are_told_to_return_go_home_by_themselves(tmp_path: Path) -> None:
    config = Config(safe_state=SafeStateSettings(then="return", hold_for=5.0))
    scene = Scene(FakeRobot(), tmp_path, config=config)
    scene.run(4.0)
    scene.set(home=[SQUARE[0]])
    scene.drive(AHEAD)
    scene.clients.clear()
    scene.run(6.0)
    assert not scene.task.task
    scene.run(2.5)
    assert (scene.task.task, scene.control.mode) == ("go_home", "AUTO")
    assert scene.events("control")[-1] == "No one drives the robot: it goes home."


def test_a_robot_that_has_come_home_by_itself_stays_there(tmp_path: Path) -> None:
    config = Config(safe_state=SafeStateSettings(then="return", hold_for=2.0))
    scene = Scene(FakeRobot(), tmp_path, config=config)
    scene.run(4.0)
    scene.set(home=[Waypoint(1.0, 0.0)])
    scene.drive(AHEAD)
    scene.clients.clear()
    scene.run(40.0)
    assert scene.events("control").count("No one drives the robot: it goes home.") == 1
    assert (scene.task.state, scene.robot.at_rest) == ("SUCCEEDED", True)


def test_with_stop_pressed_no_safe_state_moves_the_robot_nor_when_it_is_released(tmp_path: Path) -> None:
    scene = after_the_link(tmp_path, "boat", 5.0)
    bert = scene.client("bert")
    scene.ask("/stop", client=bert)
    scene.robot._odom = (*scene.robot._odom[:2], scene.robot._odom[2] + 0.3)
    before = len(scene.robot.commands)
    scene.run(5.0)
    assert scene.release_stop(bert).success
    scene.run(1.0)
    assert not any(scene.robot.commands[before:])


def test_control_that_is_given_back_in_motion_leaves_a_robot_at_rest_at_once(scene: Scene) -> None:
    scene.drive(AHEAD)
    assert not scene.robot.at_rest
    ask(scene, "/control/release", scene.anna)
    assert scene.robot.at_rest


def test_the_cap_rises_again_with_the_link_though_nobody_drives(scene: Scene) -> None:
    ask(scene, "/control/acquire", scene.anna)
    scene.anna.rtt = 2.0
    scene.run(0.1)
    assert scene.control.speed_cap == pytest.approx(0.15)
    scene.anna.rtt = 0.05
    scene.run(3.0)
    assert scene.control.speed_cap == 1.0


def test_who_drove_and_is_gone_leaves_a_robot_that_goes_home_by_itself_alone(scene: Scene) -> None:
    scene.set(home=[Waypoint(-1.0, 0.0)])
    scene.drive(AHEAD)
    home = scene.station.autonomy.task_factory.task(TaskOrder(task="go_home"))
    scene.station.autonomy.engine.start(home, scene.now)
    before = len(scene.robot.commands)
    scene.clients.remove(scene.anna)
    scene.station.on_gone(scene.anna)
    assert len(scene.robot.commands) == before
    assert scene.task.state == "RUNNING"
