from __future__ import annotations

import pytest

from bridge.msgs.geometry_msgs import Point32, Polygon
from bridge.msgs.pilothouse_msgs import Limits, RobotInfo
from tests.app.glass import Glass
from widgets.map.geo_map import GeoMap

LOT = RobotInfo(name="Fake-1", world="parking_lot", latitude=45.5069, longitude=-73.579, radius=0.2)


def test_buttons_and_fence_are_of_the_map_that_is_shown(driving: Glass, robot):
    corners = [Point32(x, y) for x, y in ((0, 0), (10, 0), (10, 10), (0, 10))]
    robot.publish("/robot/info", LOT)
    robot.publish("/limits", Limits(keep_in=[Polygon(corners)]))
    driving.app.show("mission")
    mission = driving.app.screens["mission"]
    driving.until(lambda: mission.map.fence, "no fence")
    first = mission.map
    before = first.view
    driving.tap(mission.ids["layers"])
    assert isinstance(mission.map, GeoMap)
    assert len(mission.map.fence.keep_in) == 1
    scale = mission.map.view.scale
    driving.tap(mission.ids["zoom_in"])
    assert mission.map.view.scale == pytest.approx(1.5 * scale)
    assert first.view == before


def test_leaving_the_robot_ends_the_reading_of_aerial_pictures(driving: Glass, robot):
    robot.publish("/robot/info", LOT)
    driving.app.show("mission")
    mission = driving.app.screens["mission"]
    driving.until(lambda: driving.app.session.robot.info.world == "parking_lot", "no world")
    driving.tap(mission.ids["layers"])
    pictures = mission.map.ground.source
    driving.tap(mission.ids["layers"])
    driving.app.leave()
    assert pictures._reader._closed
