"""The app with its fingers: what is touched reaches the robot, and what the robot says reaches the glass."""

from __future__ import annotations

import gc
import itertools
import json
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from app.link.feeds import Post
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Twist
from bridge.msgs.pilothouse_msgs import ControlStatus, Event, RobotInfo, TaskStatus
from bridge.msgs.vision_msgs import Detection2D, Detection2DArray
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.headless import Stage
from tests.thrown import Lasting, throw_away
from widgets.core.theme import theme


def push(glass: Glass, robot: FakeRobot) -> Any:
    """Push the stick until the robot hears it; a push that springs back on a machine that stood still is pushed anew."""
    stick = glass.app.screens["drive"].stick
    pushes: list[Any] = []

    def heard() -> bool:
        if stick.finger is None and stick.state == "live":
            for touch in pushes[-1:]:
                touch.touch_up()
            pushes.append(glass.hold(stick))
            pushes[-1].touch_move(stick.center_x, stick.top - 10)
        return stick.finger is not None and any(twist.linear.x > 0.1 for twist in robot.twists())

    glass.until(heard, "the robot heard no push")
    return pushes[-1]


def rested(glass: Glass, robot: FakeRobot) -> None:
    glass.until(lambda: robot.twists()[-1] == Twist(), "the robot was not told to rest")
    assert glass.app.screens["drive"].stick.twist == Twist()


def test_nobody_at_an_address_is_said_and_can_be_cancelled(glass: Glass, robot: FakeRobot) -> None:
    robot.stop()
    glass.app.open(robot.url)
    glass.until(
        lambda: glass.app.connect._banner and "No robot answers" in glass.app.connect._banner.text,
        "no sentence",
    )
    assert glass.app.shell is None
    glass.app.connect._banner.close()
    assert glass.app.session is None
    robot.start()


def test_an_address_is_kept_once_something_has_answered_there(glass: Glass, robot: FakeRobot) -> None:
    app = glass.app
    robot.stop()
    app.robot_list.open_typed(robot.url)
    glass.until(lambda: app.connect._banner and "No robot answers" in app.connect._banner.text, "no sentence")
    assert app.robots.entries() == []
    assert app.session.robot.name == f"127.0.0.1:{robot.port}", "two robots of one host are told apart"
    robot.start()
    app.robot_list.open_typed(robot.url)
    glass.until(lambda: app.shell is not None, "no screens")
    assert [entry.url for entry in app.robots.entries()] == [robot.url]


def test_a_wrong_address_stays_in_the_field_with_a_sentence(glass: Glass) -> None:
    from app.screens.parts.dialogs import AddressDialog

    glass.app.robot_list.ask_address()
    glass.stage.frames(2)
    (dialog,) = (child for child in glass.app.root.children if isinstance(child, AddressDialog))
    dialog.ids.field.text = "http://10.0.0.3"
    glass.tap(dialog.ids.connect)
    assert dialog.problem == "An address begins with ws:// or wss://, not http://."
    assert dialog.ids.field.text == "http://10.0.0.3"
    assert glass.app.session is None


def test_a_push_reaches_the_robot_and_letting_go_stops_it(driving: Glass, robot: FakeRobot) -> None:
    touch = push(driving, robot)
    assert max(twist.linear.x for twist in robot.twists()) <= 0.8 + 1e-9
    touch.touch_up()
    rested(driving, robot)


LOSSES: dict[str, Callable[[Glass], object]] = {
    "turned": lambda glass: setattr(glass.stage.window, "size", glass.stage.window.size[::-1]),
    "resized": lambda glass: setattr(glass.stage.window, "size", (1000, 700)),
    "hidden": lambda glass: glass.stage.window.dispatch("on_hide"),
    "minimised": lambda glass: glass.stage.window.dispatch("on_minimize"),
    "out of focus": lambda glass: setattr(glass.stage.window, "_focus", False),
    "another screen": lambda glass: glass.app.show("mission"),
    "control given up": lambda glass: glass.app.session.authority.release(),
}


def test_whatever_happens_to_a_pushed_stick_it_lets_go_and_the_robot_is_told_to_rest(
    driving: Glass, robot: FakeRobot
) -> None:
    window, stick = driving.stage.window, driving.app.screens["drive"].stick
    size = tuple(window.size)
    for name, happens in LOSSES.items():
        robot.heard.clear()
        touch = push(driving, robot)
        try:
            happens(driving)
            assert (stick.finger, stick.twist) == (None, Twist()), name
            driving.until(lambda: robot.twists()[-1] == Twist(), name)
        finally:
            window.size, window._focus = size, True
            touch.touch_up()
        driving.app.show("drive")
        driving.stage.frames(3)


def test_stop_is_sent_when_the_finger_comes_down_and_shown_when_the_robot_confirms(
    driving: Glass, robot: FakeRobot
) -> None:
    stop = driving.app.shell.stop
    touch = driving.hold(stop)
    assert robot.until(lambda: "/stop" in robot.services())
    touch.touch_up()
    driving.until(lambda: stop.phase == "stopped", "not confirmed")
    driving.until(lambda: driving.app.screens["drive"].stick.state == "disabled", "the stick still lives")
    touch = driving.hold(stop)
    driving.stage.run_for(0.5)
    assert "/stop/release" not in robot.services(), "it has to be held for a second"
    driving.until(lambda: "/stop/release" in robot.services(), "a hold did not release")
    told = robot.services()
    assert told.index("/stop/hold") < told.index("/stop/release")
    touch.touch_up()
    driving.until(lambda: stop.phase == "ready", "not released")


def test_escape_is_stop_on_every_screen(driving: Glass, monkeypatch: pytest.MonkeyPatch) -> None:
    stopped: list[str] = []
    monkeypatch.setattr(driving.app.session, "stop", lambda: stopped.append(driving.app.shell.screen))
    for screen in driving.app.shell.screens:
        driving.app.show(screen)
        driving.stage.window.dispatch("on_key_down", 27, 41, None, [])
        driving.stage.window.dispatch("on_key_up", 27, 41)
    assert stopped == list(driving.app.shell.screens)


def test_a_link_that_is_silent_says_so_before_it_is_lost(driving: Glass, robot: FakeRobot) -> None:
    chip, link = driving.app.shell.ids.link, driving.app.session.link
    driving.until(lambda: chip.text.endswith("ms") or "ms ·" in chip.text, "no round trip")
    heard = driving.app.now() - 1.5
    link._on_message("/pose", PoseWithCovarianceStamped(), heard)
    link.health.measure = lambda: None
    driving.until(lambda: "silent" in chip.text, chip.text)
    assert chip.quality == "silent"


def test_a_lost_link_is_said_and_takes_the_stick_away(driving: Glass, robot: FakeRobot) -> None:
    driving.app.session.mission.add(1.0, 2.0)
    push(driving, robot)
    robot.stop()
    driving.until(lambda: any("Trying again" in text for text in driving.banners()), "no sentence")
    stick = driving.app.screens["drive"].stick
    assert (stick.state, stick.twist) == ("disabled", Twist())
    assert driving.app.session.mission.draft.points == ((1.0, 2.0),)
    robot.heard.clear()
    robot.start()
    driving.until(lambda: stick.state == "live" and not driving.banners(), "did not come back")
    assert robot.twists() == []


def test_a_second_tap_on_pause_does_not_resume(
    driving: Glass, robot: FakeRobot, monkeypatch: pytest.MonkeyPatch
) -> None:
    pause, asked = driving.app.screens["drive"].ids["pause"], []
    monkeypatch.setattr(driving.app.session, "command", asked.append)
    robot.publish("/task/status", TaskStatus(task="patrol", state="RUNNING"))
    driving.until(lambda: not pause.disabled, "cannot be paused")
    driving.tap(pause)
    robot.publish("/task/status", TaskStatus(task="patrol", state="PAUSED"))
    driving.until(lambda: pause.text == "Resume", "not paused")
    driving.tap(pause)
    driving.stage.run_for(0.6)
    assert asked == ["pause"]
    driving.tap(pause)
    assert asked == ["pause", "resume"]


def test_a_robot_comes_onto_the_glass_with_all_that_is_known_of_it(glass: Glass, robot: FakeRobot) -> None:
    robot.publish("/robot/info", RobotInfo(name="Rover-1"))
    robot.publish("/control/status", ControlStatus(driver_id="t2", driver="Anna", mode="MANUAL"))
    app = glass.app
    enter = app.visit.enter
    app.visit.enter = lambda: None  # until all is told that there is to tell
    app.open(robot.url)
    glass.until(lambda: app.session.control == "other" and app.session.robot.info.name, "nothing told")
    enter()
    bar, mission = app.shell.bar, app.screens["mission"]
    assert (bar.robot_name, bar.mode_text, mission.panel.tasks.state) == (
        "Rover-1",
        "MANUAL · Anna",
        "disabled",
    )


def test_nothing_can_be_asked_for_before_it_is_known_who_has_control(driving: Glass) -> None:
    app = driving.app
    feed = app.session.feeds["/control/status"]
    told, feed.message = feed.message, None
    app.session.deliver("/robot/info", Post(app.session.robot.info, app.now(), 1))
    app.shell.tick()
    drive, mission = app.screens["drive"], app.screens["mission"]
    mission.tick()
    assert (drive.ids.home.disabled, mission.panel.tasks.state) == (True, "disabled")
    assert not app.screens["tasks"].mine
    feed.message = told
    app.session.deliver("/control/status", Post(told, app.now(), 1))
    assert app.shell.bar.control_text == "you have control", "in the same frame, not at the next tick"
    assert not drive.ids.home.disabled


def test_what_became_of_stop_is_shown_when_it_is_known_and_not_at_the_next_tick(
    driving: Glass, robot: FakeRobot
) -> None:
    shown = []
    for stopped in (True, False):
        told = replace(robot.control, stopped=stopped, at_rest=True)
        driving.app.session.deliver("/control/status", Post(told, 0.0, 1))
        shown.append(driving.app.shell.stop.phase)
    assert shown == ["stopped", "ready"]


@pytest.mark.parametrize("screen", ["drive", "mission"])
def test_boxes_leave_the_video_when_no_more_come(driving: Glass, robot: FakeRobot, screen: str) -> None:
    driving.app.show(screen)
    video = driving.app.screens[screen].video
    seen = Detection2DArray(detections=[Detection2D()])
    for ended in (lambda: None, robot.stop):
        robot.publish("/detections", seen)
        driving.until(lambda: video.boxes, "no boxes")
        ended()
        driving.until(lambda: not video.boxes, "the boxes stayed")
    robot.start()


def test_a_refused_command_is_said_over_the_screen(driving: Glass, robot: FakeRobot) -> None:
    robot.refusals["/task/go_home"] = "Home is not set."
    driving.tap(driving.app.screens["drive"].ids["home"])
    driving.until(lambda: driving.banners() == ["Refused: go home. Home is not set."], driving.banners())


def test_an_alarm_leaves_when_what_it_told_is_over(driving: Glass, robot: FakeRobot) -> None:
    held = ControlStatus(stopped=True, driver=robot.control.driver, driver_id=robot.control.driver_id)
    robot.publish("/control/status", held)
    driving.until(lambda: driving.app.shell.stop.phase == "stopped", "not stopped")
    robot.publish("/events", Event(id=1, kind="task", level="alarm", text="Stopped by vm."))
    driving.until(lambda: driving.banners() == ["Stopped by vm."], driving.banners())
    robot.publish("/events", Event(id=2, kind="control", level="info", text="vm has control."))
    driving.stage.run_for(0.3)
    assert driving.banners() == ["Stopped by vm."]
    robot.publish("/control/status", robot.control)
    heard = driving.app.session.feeds
    driving.until(lambda: not heard.latest("/control/status").stopped, "still stopped")
    began = driving.stage.time.now
    driving.until(lambda: not driving.banners(), driving.banners())
    assert driving.stage.time.now - began < 2.0


def test_the_next_of_its_kind_takes_an_alarm_away(driving: Glass, robot: FakeRobot) -> None:
    robot.publish("/events", Event(id=1, kind="stop", level="alarm", text="STOP pressed by vm."))
    driving.until(lambda: driving.banners() == ["STOP pressed by vm."], driving.banners())
    heard: list[str] = []
    driving.app.session.listeners.append(lambda channel, _: heard.append(channel))
    robot.publish("/events", Event(id=2, kind="stop", level="ok", text="STOP released by vm."))
    driving.until(lambda: "event" in heard, "not heard")
    began = driving.stage.time.now
    driving.until(lambda: not driving.banners(), driving.banners())
    assert driving.stage.time.now - began < 2.0


def test_with_stop_pressed_nothing_on_the_drive_screen_moves_the_robot(
    driving: Glass, robot: FakeRobot
) -> None:
    ids = driving.app.screens["drive"].ids
    driving.until(lambda: not ids.home.disabled, "cannot go home")
    robot.publish("/task/status", TaskStatus(task="patrol", state="PAUSED"))
    driving.until(lambda: ids.pause.text == "Resume" and not ids.pause.disabled, "cannot resume")
    robot.control = ControlStatus(
        stopped=True, driver=robot.control.driver, driver_id=robot.control.driver_id
    )
    robot.publish("/control/status", robot.control)
    driving.until(lambda: ids.home.disabled and ids.pause.disabled, "still offered")


def test_only_the_screen_on_the_glass_looks_chosen(driving: Glass, tmp_path: Path) -> None:
    shell = driving.app.shell
    driving.app.records.start(tmp_path / "run.mcap", driving.app.session)
    driving.stage.run_for(0.3)
    assert [button.text for button in shell.rail if getattr(button, "active", False)] == ["Drive"]
    assert shell.ids.record.text.startswith("REC 00:0") or shell.form == "tall"
    assert shell.ids.record.parent is shell.bar
    driving.app.records.stop()
    driving.stage.run_for(0.3)
    assert shell.ids.record.parent is None


def test_points_are_tapped_sent_and_stored(driving: Glass, robot: FakeRobot) -> None:
    driving.app.show("mission")
    robot.publish("/pose", PoseWithCovarianceStamped(pose=PoseWithCovariance(pose=Pose(Point(1.0, 1.0)))))
    mission = driving.app.screens["mission"]
    driving.until(lambda: mission.map.located, "no pose")
    mission.mode = "points"
    driving.stage.frames(2)
    area = mission.map
    for share in (0.3, 0.5):
        driving.stage.tap(area.x + area.width * share, area.center_y + 60)
    assert len(driving.app.session.mission.draft.points) == 2
    driving.until(lambda: mission.ids["send"].disabled is False, "cannot be sent")
    driving.tap(mission.ids["send"])
    driving.until(lambda: driving.app.session.mission.state == "stored", "not stored")
    assert len(robot.asked[-1][1].mission.waypoints) == 2


def test_the_robot_is_placed_by_hand(driving: Glass, robot: FakeRobot) -> None:
    driving.app.show("mission")
    mission = driving.app.screens["mission"]
    mission.mode = "place_robot"
    driving.stage.frames(3)
    driving.until(lambda: not mission.ids["place_here"].disabled, "cannot be placed")
    theme.gloves = not theme.gloves  # the buttons stay within their bar whatever the size of a finger
    driving.stage.frames(3)
    for name in ("place_here", "place_cancel"):
        assert mission.selection.top - mission.ids[name].top >= 6
    theme.gloves = not theme.gloves
    driving.stage.frames(3)
    driving.tap(mission.ids["place_here"])
    assert robot.until(lambda: any(topic == "/initialpose" for topic, _ in robot.heard))
    assert mission.mode == "view"


def test_start_drops_the_robot_that_is_being_placed(driving: Glass, robot: FakeRobot) -> None:
    driving.app.show("mission")
    mission = driving.app.screens["mission"]
    mission.mode = "place_robot"
    mission.panel.tasks.ask("stop")
    assert mission.mode == "place_robot"
    mission.panel.tasks.ask("start")
    assert (mission.mode, mission.map.mode, list(mission.map.placed)) == ("view", "view", [])
    assert robot.until(lambda: "/task/start" in robot.services())
    assert not any(topic == "/initialpose" for topic, _ in robot.heard)


def test_who_is_driven_by_another_is_only_watched(glass: Glass, robot: FakeRobot) -> None:
    robot.control = ControlStatus(driver="tablet-B", driver_id="b")
    robot.publish("/control/status", robot.control)
    glass.app.open(robot.url, watch=True)
    glass.until(
        lambda: glass.app.shell is not None and glass.app.shell.bar.control_text == "driven by tablet-B",
        "not said",
    )
    glass.app.show("drive")
    glass.stage.run_for(0.3)
    assert glass.app.screens["drive"].stick.state == "disabled"
    assert robot.services() == []


def test_taking_the_glass_away_ends_the_link_and_giving_it_back_heals_it(
    driving: Glass, robot: FakeRobot
) -> None:
    push(driving, robot)
    assert driving.app.on_pause() is True
    rested(driving, robot)
    driving.until(lambda: not driving.app.session.connected, "still connected")
    driving.app.on_resume()
    driving.until(lambda: driving.app.session.connected, "did not come back")
    assert robot.twists()[-1] == Twist()


def test_in_the_app_a_widget_that_was_thrown_away_does_not_vanish_in_the_middle_of_its_rule(
    collecting: None, glass: Glass
) -> None:
    lasting = Lasting()
    thrown = throw_away(lasting)
    lasting.name = "after"
    assert thrown().followed[0] == "after"


def test_screens_that_were_left_are_collected(collecting: None, driving: Glass) -> None:
    left = weakref.ref(driving.app.shell)
    driving.app.leave()
    driving.stage.run_for(0.5)
    assert left() is None


def test_while_the_glass_is_away_python_collects_by_itself(collecting: None, glass: Glass) -> None:
    glass.app.on_pause()
    assert gc.isenabled()
    glass.app.on_resume()
    assert not gc.isenabled()


def test_what_cannot_be_saved_is_said_on_the_glass(driving: Glass) -> None:
    problem = "The settings could not be saved: No space left on device."
    driving.app.settings.problem = problem
    driving.until(lambda: driving.banners() == [problem], driving.banners())
    driving.app.leave()
    driving.app.settings.problem = problem = "The settings could not be saved: Read-only file system."
    driving.until(lambda: driving.app.connect._banner and driving.app.connect._banner.text == problem, "no")


def test_the_theme_is_remembered(glass: Glass, tmp_path: Path) -> None:
    glass.app.themes.choose_next()
    glass.app.settings.close()
    assert theme.name == "sunlight"
    assert json.loads((tmp_path / "settings.json").read_text())["theme"] == "sunlight"


def test_a_recording_holds_what_came(driving: Glass, robot: FakeRobot, tmp_path: Path) -> None:
    from mcap.reader import make_reader

    path = tmp_path / "run.mcap"
    assert driving.app.records.start(path, driving.app.session)
    robot.publish("/pose", PoseWithCovarianceStamped())
    driving.until(lambda: driving.app.session.feeds.latest("/pose") is not None, "no pose")
    driving.app.records.stop()
    with path.open("rb") as file:
        topics = {channel.topic for _, channel, _ in make_reader(file).iter_messages()}
    assert {"/pose", "/robot/info", "/control/status"} <= topics


def test_a_recording_that_leaving_the_robot_ends_is_said(driving: Glass, tmp_path: Path) -> None:
    assert driving.app.records.start(tmp_path / "run.mcap", driving.app.session)
    driving.app.leave()
    assert driving.app.connect._banner.text == "Recording saved as run.mcap."


def test_turning_the_device_keeps_stop_in_its_corner(driving: Glass) -> None:
    forms = {(412, 892): "tall", (892, 412): "short", (1280, 800): "wide", (1920, 1200): "wide"}
    for screen, (size, form) in itertools.product(("mission", "drive"), forms.items()):
        driving.app.show(screen)
        driving.app.shell.size = driving.app.root.size = size
        driving.stage.frames(2)
        assert size[0] - driving.app.shell.stop.right <= 16, (screen, size)
        assert driving.app.shell.form == form, (screen, size)


def test_the_first_start_in_an_empty_home_makes_its_own_folder(
    stage: Stage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from app.application import PilothouseApp

    monkeypatch.delenv("XDG_CONFIG_HOME", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    app = PilothouseApp(theme="dark", discover=False)
    app.build()
    app.settings.close()
    assert (tmp_path / ".config" / "pilothouse").is_dir()
