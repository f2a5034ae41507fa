"""What a robot may and whether it is ready, on the glass of the app."""

from __future__ import annotations

import pytest

from bridge.msgs.geometry_msgs import Point32, Polygon
from bridge.msgs.pilothouse_msgs import Checklist, Limits, Place, RobotInfo
from tests.app.glass import Glass
from widgets.status.check_list import GOOD, UNTESTED

SQUARE = Polygon([Point32(x, y) for x, y in ((0, 0), (10, 0), (10, 10), (0, 10))])


@pytest.fixture
def fenced(driving: Glass, robot) -> Glass:
    """In front of a robot that has a fence, limits of its own, and a check that is not done."""
    robot.publish("/robot/info", RobotInfo(name="Fake-1", kind="wheels", max_speed=0.8, radius=0.2))
    robot.publish("/limits", Limits(max_speed=0.4, max_yaw_rate=0.5, keep_in=[SQUARE]))
    robot.publish("/checklist", Checklist(checks=[GOOD[0], UNTESTED]))
    driving.until(lambda: driving.app.session.refusals.fence, "no fence")
    driving.until(lambda: driving.app.session.feeds.latest("/checklist"), "no check list")
    return driving


def test_points_outside_are_said_while_they_are_edited_and_can_be_sent_all_the_same(fenced, robot):
    fenced.app.show("mission")
    mission = fenced.app.screens["mission"]
    mission.mode = "points"
    for x in (5.0, 12.0):
        mission.map.dispatch("on_add", x, 5.0)
    fenced.stage.frames(3)
    wanted = "Point 2 at (12.0, 5.0) is outside the robot's fence."
    assert mission.selection.trouble == wanted
    assert mission.panel._send.note == wanted
    robot.refusals["/mission/set"] = "The robot's own words."
    fenced.until(lambda: not mission.ids["send"].disabled, "nothing can be sent")
    fenced.tap(mission.ids["send"])
    fenced.until(lambda: mission.panel._send.note.endswith("The robot's own words."), "not refused")
    mission.map.selected = 0
    mission.map.dispatch("on_select", 0)
    assert mission.selection.trouble == ""
    mission.map.dispatch("on_move", 1, 6.0, 5.0)
    mission.mode = "view"
    assert mission.panel.refused == ""


def test_a_point_in_a_fingers_grip_is_judged_where_the_finger_is(fenced):
    fenced.app.show("mission")
    mission = fenced.app.screens["mission"]
    mission.mode = "points"
    mission.map.dispatch("on_add", 5.0, 5.0)
    fenced.stage.frames(3)
    area = mission.map
    touch = fenced.stage.touch(*area.to_window(*area.view.to_screen(5.0, 5.0)))
    touch.touch_down()
    touch.touch_move(*area.to_window(*area.view.to_screen(5.0, 9.8)))
    assert "needs 0.60\u00a0m" in mission.selection.trouble
    touch.touch_move(*area.to_window(*area.view.to_screen(5.0, 6.0)))
    assert mission.selection.trouble == ""
    touch.touch_up()


def test_places_and_orders_outside_are_said_before_they_are_asked_for(fenced, robot):
    robot.know(Place(id=1, name="Lab", x=12.0, y=5.0))
    fenced.app.show("tasks")
    tasks = fenced.app.screens["tasks"]
    fenced.until(lambda: tasks.places.places, "no places")
    tasks.edit_place(Place(name="Store", x=12.0, y=5.0))
    assert tasks.place_pane.sentence == "Store at (12.0, 5.0) is outside the robot's fence."
    tasks.pane.begin("go_to", ("Lab",))
    assert tasks.pane.sentence == "Lab at (12.0, 5.0) is outside the robot's fence."
    assert tasks.pane.complete


def test_the_check_list_is_unfolded_on_both_screens_and_folds_on_both(fenced):
    drive, mission = (fenced.app.screens[name].checks for name in ("drive", "mission"))
    fenced.until(lambda: drive.open and drive.total, "not unfolded")
    fenced.tap(drive.ids.head)
    fenced.until(lambda: not drive.open, "not folded")
    fenced.app.show("mission")
    fenced.stage.run_for(0.3)
    assert (mission.total, mission.open) == (2, False)


def test_when_all_is_good_the_check_list_folds_away(fenced, robot):
    drive = fenced.app.screens["drive"].checks
    fenced.until(lambda: drive.open and drive.total, "not unfolded")
    flashes = []
    drive.bind(checks=lambda *_: flashes.append(drive.ready and drive.open))
    robot.publish("/checklist", Checklist(checks=list(GOOD)))
    fenced.until(lambda: drive.ready and not drive.open, "not folded")
    assert not any(flashes)
    assert drive.height == drive.ids.head.height


def test_on_the_map_a_finger_on_an_unfolded_list_adds_no_point(fenced):
    fenced.app.show("mission")
    mission = fenced.app.screens["mission"]
    fenced.until(lambda: mission.checks.open and mission.checks.height, "not unfolded")
    assert mission.checks.parent is mission.corner
    mission.mode = "points"
    fenced.stage.frames(3)
    assert mission.checks.parent is None


def test_the_slider_ends_at_the_limit_and_says_so(fenced):
    drive = fenced.app.screens["drive"]
    fenced.until(lambda: drive.speed.ids.fader.maximum == pytest.approx(0.4), "not limited")
    assert drive.speed.limits == "limit 0.40\u00a0m/s\nturn 29°/s"
    drive.speed.maximum_speed = 0.4
    assert drive.stick.max_speed == pytest.approx(0.4)
    assert drive.stick.max_yaw_rate == pytest.approx(0.5)
