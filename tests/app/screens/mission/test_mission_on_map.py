"""Points on the map while they are drawn: bad ones are red and say why, and Start sends what is drawn."""

from __future__ import annotations

from typing import Any

import pytest

from bridge.msgs.arrays import Int8Array
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from bridge.msgs.pilothouse_msgs import Check, Checklist, Mission, RobotInfo, TaskStatus, Waypoint
from bridge.msgs.sensor_msgs import NavSatFix, NavSatStatus
from bridge.msgs.std_msgs import Header
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

GRID = OccupancyGrid(
    info=MapMetaData(resolution=0.5, width=40, height=40, origin=Pose(Point(-10.0, -10.0))),
    data=Int8Array(
        bytes(100 if column == 20 and row < 20 else 0 for row in range(40) for column in range(40))
    ),
)
"""20 m by 20 m with a wall from the middle of its lower edge to its middle."""
FREE, IN_WALL = (5.0, 5.0), (0.2, -3.0)


@pytest.fixture
def mission(driving: Glass, robot: FakeRobot) -> Any:
    """Points are drawn on the map of a robot that has told its walls."""
    robot.publish("/robot/info", RobotInfo(name="Fake-1", kind="wheels", max_speed=0.8, radius=0.2))
    robot.publish("/map", GRID)
    driving.app.show("mission")
    screen = driving.app.screens["mission"]
    driving.until(lambda: screen.map.grid is not None, "no map")
    driving.until(lambda: driving.app.session.robot.info.radius, "no size")
    screen.mode = "points"
    return screen


def services(robot: FakeRobot) -> list[str]:
    return [name for name in robot.services() if name in ("/mission/set", "/task/start")]


def start_of(mission: Any) -> Any:
    """The button that starts."""
    return next(one for one in mission.panel.tasks.walk() if getattr(one, "text", "").startswith("Start"))


def test_a_point_in_a_wall_is_red_says_why_and_start_is_not_lit_until_it_is_moved(
    driving: Glass, mission: Any
) -> None:
    for place in (FREE, IN_WALL):
        mission.map.dispatch("on_add", *place)
    driving.until(lambda: not mission.panel.tasks.disabled, "nothing can be asked")
    said = "Point 2 at (0.2, −3.0) is in a wall or another obstacle."
    assert list(mission.map.refused) == [(*IN_WALL, "in a wall")]
    assert (mission.panel._send.note, mission.selection.trouble) == (said, said)
    driving.stage.frames(8)
    assert not mission.panel.tasks.inviting
    assert "in a wall" in mission.map._layers[0][1].texts
    mission.map.dispatch("on_move", 1, 3.0, -3.0)
    driving.stage.run_for(0.3)
    assert list(mission.map.refused) == []
    assert mission.panel.tasks.inviting


def test_start_sends_the_points_that_are_drawn_and_then_starts(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    mission.map.dispatch("on_add", *FREE)
    button = start_of(mission)
    driving.until(lambda: not button.disabled, "cannot start")
    driving.tap(button)
    driving.until(lambda: "/task/start" in robot.services(), robot.services())
    assert services(robot) == ["/mission/set", "/task/start"]
    (sent,) = [request.mission for name, request in robot.asked if name == "/mission/set"]
    assert [(point.x, point.y) for point in sent.waypoints] == [FREE]


def test_nothing_starts_where_the_robot_does_not_take_the_points_and_its_reason_is_said_whole(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    reason = (
        "Point 1 at (5.0, 5.0) is on the flower bed, where nobody goes before the gardener has been there."
    )
    robot.refusals["/mission/set"] = reason
    mission.map.dispatch("on_add", *FREE)
    button = start_of(mission)
    driving.until(lambda: not button.disabled, "cannot start")
    driving.tap(button)
    driving.until(lambda: mission.panel._send.note.endswith(reason), mission.panel._send.note)
    driving.until(lambda: any(text.endswith(reason) for text in driving.banners()), driving.banners())
    driving.stage.run_for(0.5)
    assert services(robot) == ["/mission/set"]
    note = mission.panel._send.ids.note
    assert (note.shorten, note.height) == (False, note.texture_size[1])


def test_without_points_start_cannot_be_pressed(driving: Glass, mission: Any) -> None:
    button = start_of(mission)
    driving.until(lambda: not mission.panel.tasks.disabled, "nothing can be asked")
    driving.stage.run_for(0.3)
    assert button.disabled
    mission.map.dispatch("on_add", *FREE)
    driving.until(lambda: not button.disabled, "cannot start")


def test_the_map_does_not_say_that_nothing_is_known_of_its_place_beside_a_satellite_fix(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    def said() -> str:
        driving.stage.frames(2)
        return next(text for text in mission.map._layers[1][1].texts if "place on this map" in text)

    assert said() == "Its place on this map is not known yet"
    fix = NavSatFix(
        header=Header(frame_id="gps"),
        status=NavSatStatus(status=0),
        latitude=45.0,
        longitude=7.0,
        position_covariance=[0.64, *[0.0] * 8],
        position_covariance_type=1,
    )
    robot.publish("/fix", fix)
    wanted = "By satellite it is known to ±0.8 m; its place on this map is not yet"
    driving.until(lambda: said().replace("\u00a0", " ") == wanted, "the fix is not told of")
    robot.publish("/pose", PoseWithCovarianceStamped(pose=PoseWithCovariance(pose=Pose(Point(2.0, 3.0)))))
    driving.until(lambda: mission.map.located, "no pose")
    driving.stage.frames(2)
    assert not any("place on this map" in text for text in mission.map._layers[1][1].texts)


def home_of(mission: Any) -> Any:
    """The button that sends it home."""
    return next(one for one in mission.panel.tasks.walk() if getattr(one, "icon", "") == "home")


def test_the_way_home_goes_to_the_home_that_is_drawn_and_changes_no_points(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    robot.publish("/mission", Mission(waypoints=[Waypoint(1.0, 1.0)], home=[Waypoint(9.0, 9.0)]))
    driving.until(lambda: driving.app.session.mission.state == "stored", "no mission")
    mission.map.dispatch("on_add", *FREE)
    mission.map.dispatch("on_set_home", 2.0, 3.0)
    button = home_of(mission)
    driving.until(lambda: not button.disabled, "cannot go home")
    driving.tap(button)
    driving.until(lambda: "/task/start" in robot.services(), robot.services())
    (sent,) = [request.mission for name, request in robot.asked if name == "/mission/set"]
    assert [(point.x, point.y) for point in sent.waypoints] == [(1.0, 1.0)]
    assert [(point.x, point.y) for point in sent.home] == [(2.0, 3.0)]
    (start,) = [request.order.task for name, request in robot.asked if name == "/task/start"]
    assert start == "go_home"


def test_a_home_that_the_robot_does_not_take_is_not_driven_to(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    robot.refusals["/mission/set"] = "Home at (2.0, 3.0) is in a wall or another obstacle."
    mission.map.dispatch("on_set_home", 2.0, 3.0)
    button = home_of(mission)
    driving.until(lambda: not button.disabled, "cannot go home")
    driving.tap(button)
    driving.until(lambda: any("in a wall" in text for text in driving.banners()), driving.banners())
    driving.stage.run_for(0.5)
    assert not {"/task/start", "/task/go_home"} & set(robot.services())


def test_a_home_that_the_robot_has_is_gone_to_at_once(driving: Glass, robot: FakeRobot, mission: Any) -> None:
    robot.publish("/mission", Mission(waypoints=[Waypoint(1.0, 1.0)], home=[Waypoint(2.0, 3.0)]))
    driving.until(lambda: driving.app.session.mission.state == "stored", "no mission")
    mission.map.dispatch("on_add", *FREE)
    button = home_of(mission)
    driving.until(lambda: not button.disabled, "cannot go home")
    driving.tap(button)
    driving.until(lambda: "/task/go_home" in robot.services(), robot.services())
    assert services(robot) == []


def test_home_is_drawn_at_the_start_where_the_robot_is_sure_to_be_and_it_is_said(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    robot.know()
    robot.publish("/checklist", Checklist(checks=[Check("position", "ok", "The robot knows where it is.")]))
    driving.until(lambda: driving.app.session.feeds.latest("/checklist"), "no check list")
    driving.until(lambda: driving.app.session.feeds.latest("/places") is not None, "no places")
    robot.publish("/pose", PoseWithCovarianceStamped(pose=PoseWithCovariance(pose=Pose(Point(2.0, 3.0)))))
    driving.until(lambda: driving.app.session.mission.draft.home == (2.0, 3.0), "no home")
    assert list(mission.map.home) == [2.0, 3.0]
    assert any(text.startswith("Home is here") for text in driving.banners())
    assert services(robot) == [], "it is only drawn"
    assert mission.panel._send.note.startswith("Home is drawn, not on the robot yet.")


@pytest.mark.parametrize("mode", ["points", "home"])
def test_a_tap_on_the_map_of_a_robot_that_was_set_going_changes_no_point(
    driving: Glass, robot: FakeRobot, mission: Any, mode: str
) -> None:
    mission.map.dispatch("on_add", *FREE)
    mission.mode = mode
    for command in ("pause", "start"):
        mission.panel.tasks.ask(command)
        assert mission.mode == mode, "who pauses, or is refused, may go on drawing"
    runs = TaskStatus(task_id=1, task="patrol", state="RUNNING", waypoints=1)
    robot.publish("/task/status", runs)  # as by another handheld, or by voice
    driving.until(lambda: mission.mode == "view", "it is drawn on")
    area = mission.map
    driving.stage.tap(area.center_x + 60, area.center_y + 60)
    assert driving.app.session.mission.draft.points == (FREE,)
    assert not mission.selection.text, "nobody is told to tap"
    mission.mode = mode
    robot.publish(
        "/task/status", TaskStatus(task_id=1, task="patrol", state="RUNNING", waypoint=1, waypoints=1)
    )
    driving.until(lambda: driving.app.session.feeds.latest("/task/status").waypoint, "not told")
    assert mission.mode == mode, "who chose it while it drives means it"
