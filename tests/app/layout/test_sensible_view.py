"""The view of a robot that nobody made a layout for: chosen from its topics alone, on the glass without overlap."""

from __future__ import annotations

from itertools import combinations

import pytest

import widgets
from app.layout.layout import SLIDER
from app.layout.layout_faults import FaultList
from app.layout.panel_grid import COLUMNS, FORMS, ROWS
from app.layout.sensible_view import MAX_PANELS, sensible_view, tiled
from app.layout.view_checks import check_views
from app.link.capabilities import Capabilities
from bridge.client.type_learning import learn

ROVER = {
    "/rosout": "rosgraph_msgs/Log",
    "/tf": "tf2_msgs/TFMessage",
    "/robot_description": "std_msgs/String",
    "/arm/_action/status": "std_msgs/String",
    "/camera/rgb/image_raw/compressed": "sensor_msgs/CompressedImage",
    "/camera/rgb/camera_info": "sensor_msgs/CameraInfo",
    "/base_scan": "sensor_msgs/LaserScan",
    "/imu": "sensor_msgs/Imu",
    "/odometry": "nav_msgs/Odometry",
    "/battery": "sensor_msgs/BatteryState",
    "/gps/fix": "sensor_msgs/NavSatFix",
    "/gripper": "acme_msgs/Gripper",
    "/lamp": "std_msgs/Bool",
    "/cmd_vel": "geometry_msgs/Twist",
}


def view(topics: dict[str, str], learned=None):
    return sensible_view(Capabilities.of(topics, frozenset()), learned)


def shown(topics: dict[str, str]) -> list[tuple[str, str]]:
    return [(panel.widget, panel.topic) for panel in view(topics).panels]


def test_what_one_drives_by_comes_first_and_a_stick_with_it():
    found = shown(ROVER)
    assert found[:3] == [
        ("Video", "/camera/rgb/image_raw/compressed"),
        ("LaserScanView", "/base_scan"),
        ("Joystick", ""),
    ]
    assert {
        ("ArtificialHorizon", "/imu"),
        ("Battery", "/battery"),
        ("Readout", "/odometry"),
        ("TurnTape", "/odometry"),
        ("FieldView", "/gripper"),
    } <= set(found)


def test_no_heading_is_claimed_from_wheels():
    assert {name for name, topic in shown(ROVER) if topic == "/odometry"} == {"Readout", "TurnTape"}


def test_what_programs_tell_each_other_is_left_out():
    topics = {panel.topic for panel in view(ROVER).panels}
    assert not topics & {
        "/robot_description",
        "/arm/_action/status",
        "/rosout",
        "/tf",
        "/camera/rgb/camera_info",
        "/cmd_vel",
    }


def test_a_robot_that_takes_no_drive_command_has_no_stick():
    assert not [name for name, _ in shown({"/scan": "sensor_msgs/LaserScan"}) if name == "Joystick"]


def test_no_control_but_the_stick_is_chosen():
    found = {
        name for name, _ in shown({**ROVER, "/speed_cmd": "geometry_msgs/Twist", "/do/cmd": "std_msgs/Bool"})
    }
    assert not {
        name
        for name in found - {"Joystick"}
        if name != SLIDER and issubclass(getattr(widgets, name), widgets.core.base.Control)
    }


def test_a_map_shows_where_the_robot_is_in_it():
    robot = {
        "/map": "nav_msgs/OccupancyGrid",
        "/amcl_pose": "geometry_msgs/PoseWithCovarianceStamped",
        **ROVER,
    }
    grid = next(panel for panel in view(robot).panels if panel.widget == "GridMap")
    assert grid.also == ("/amcl_pose", "/base_scan")


def test_a_type_that_was_learned_gets_the_widget_of_its_field():
    kind = learn(
        [
            {
                "type": "acme_msgs/Level",
                "fieldnames": ["level"],
                "fieldtypes": ["float64"],
                "fieldarraylen": [-1],
            }
        ]
    )
    tank = {"/tank": "acme_msgs/Level"}
    assert [panel.widget for panel in view(tank).panels] == ["FieldView"]
    (panel,) = view(tank, {"acme_msgs/Level": kind}).panels
    assert (panel.widget, panel.field) == ("Readout", "level")


def test_of_very_many_topics_it_is_an_overview():
    cells = {f"/cell_{n}": ("std_msgs/Float32", "std_msgs/Int32")[n % 2] for n in range(50)}
    found = view({**ROVER, **cells}).panels
    assert len(found) == MAX_PANELS
    for part in (0, 1):
        assert sum(panel.topic in list(cells)[part::2] for panel in found) <= 2


def test_a_robot_without_topics_has_an_empty_view():
    assert view({}).panels == ()
    assert sensible_view(Capabilities({}, frozenset(), rosapi=False)).panels == ()


@pytest.mark.parametrize("topics", [ROVER, {"/scan": "sensor_msgs/LaserScan"}, dict(list(ROVER.items())[:6])])
def test_the_view_is_one_that_a_layout_file_may_have(topics):
    faults = FaultList("")
    check_views("Layout x", [view(topics)], list(widgets.CATALOGUE), faults)
    faults.raise_any()


@pytest.mark.parametrize("form", FORMS)
def test_places_fill_the_window_without_overlap(form):
    places = [panel.place(form) for panel in view(ROVER).panels]
    assert all(place.left >= 0 and place.right <= COLUMNS[form] for place in places)
    assert not [pair for pair in combinations(places, 2) if pair[0].overlaps(pair[1])]
    rows = max(ROWS[form], *(place.bottom for place in places))
    assert sum(place.width * place.height for place in places) >= 0.95 * COLUMNS[form] * rows


def test_one_panel_alone_has_the_whole_window():
    assert [tuple(place) for place in tiled([((3, 4), True)], "wide")] == [(0, 0, 12, 12)]
