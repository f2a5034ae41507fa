"""Fields of a message type that stand for themselves: paths, kinds, units, names of values."""

from __future__ import annotations

import math
from typing import ClassVar

import pytest

from bridge.client.type_learning import learn
from bridge.msgs import TYPES, Msg
from bridge.msgs.diagnostic_msgs import DiagnosticStatus
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import BatteryState, Imu, LaserScan, NavSatFix
from bridge.msgs.std_msgs import Bool, String
from widgets.fields.field_kinds import (
    ENUM,
    MAX_FIELDS,
    NUMBER,
    TEXT,
    TRUTH,
    enum_names,
    plain_fields,
)


def field(kind, path):
    return next(one for one in plain_fields(kind) if one.path == path)


def test_numbers_are_found_in_messages_inside_messages_with_the_unit_of_the_outer_field():
    speed = field(Odometry, "twist.twist.linear.x")
    assert (speed.kind, speed.unit, speed.factor, speed.title) == (NUMBER, "m/s", 1.0, "Linear x")


def test_angles_are_read_in_degrees_and_a_quaternion_by_its_angles():
    turn = field(Imu, "angular_velocity.z")
    assert (turn.unit, turn.factor) == ("°/s", pytest.approx(180 / math.pi))
    yaw = field(Odometry, "pose.pose.orientation.yaw")
    assert (yaw.unit, yaw.title) == ("°", "Orientation yaw")
    assert not [one for one in plain_fields(Odometry) if one.path.endswith("orientation.w")]


def test_a_place_in_degrees_has_the_decimals_that_it_takes():
    assert field(NavSatFix, "latitude").digits == 6


def test_headers_lists_and_how_well_things_are_known_are_left_out():
    paths = [one.path for kind in (LaserScan, NavSatFix, Imu) for one in plain_fields(kind)]
    assert not [path for path in paths if "header" in path or "ranges" in path or "variance" in path]
    assert "range_max" in paths


@pytest.mark.parametrize(("kind", "sort"), [(Bool, TRUTH), (String, TEXT)])
def test_a_truth_and_a_text(kind, sort):
    assert [(one.path, one.kind, one.title) for one in plain_fields(kind)] == [("data", sort, "")]


def test_constants_whose_names_begin_with_the_fields_name_are_names_of_its_values():
    assert field(BatteryState, "power_supply_status").kind == ENUM
    names = field(BatteryState, "power_supply_status").names
    assert names[3] == "not charging"
    assert len(names) == 5


def test_constants_without_a_prefix_belong_to_the_only_whole_number():
    assert enum_names(DiagnosticStatus, "level") == {0: "ok", 1: "warn", 2: "error", 3: "stale"}
    goal = TYPES["actionlib_msgs/GoalStatus"]
    assert field(goal, "status").names[3] == "succeeded"


class Two(Msg, frozen=True, gc=False):
    MSGTYPE: ClassVar[str] = "x/Two"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8", "uint8")
    OFF: ClassVar[int] = 0
    ON: ClassVar[int] = 1
    one: int = 0
    other: int = 0


class Same(Msg, frozen=True, gc=False):
    MSGTYPE: ClassVar[str] = "x/Same"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8",)
    MODE_A: ClassVar[int] = 1
    MODE_B: ClassVar[int] = 1
    mode: int = 0


@pytest.mark.parametrize(("kind", "name"), [(Two, "one"), (Two, "other"), (Same, "mode")])
def test_names_that_cannot_be_told_apart_are_no_names(kind, name):
    assert enum_names(kind, name) == {}
    assert field(kind, name).kind == NUMBER


def test_a_learned_type_is_read_like_any_other():
    kind = learn(
        [
            {
                "type": "acme_msgs/Pump",
                "fieldnames": ["state", "flow", "primed"],
                "fieldtypes": ["uint8", "float32", "bool"],
                "fieldarraylen": [-1, -1, -1],
                "constnames": ["STATE_IDLE", "STATE_DRY_RUN"],
                "constvalues": ["0", "1"],
            }
        ]
    )
    assert [(one.path, one.kind) for one in plain_fields(kind)] == [
        ("state", ENUM),
        ("flow", NUMBER),
        ("primed", TRUTH),
    ]
    assert field(kind, "state").names == {0: "idle", 1: "dry run"}


def test_a_type_of_very_many_fields_is_cut():
    kind = learn(
        [
            {
                "type": "acme_msgs/Long",
                "fieldnames": [f"f{n}" for n in range(200)],
                "fieldtypes": ["float64"] * 200,
                "fieldarraylen": [-1] * 200,
            }
        ]
    )
    assert len(plain_fields(kind)) == MAX_FIELDS
