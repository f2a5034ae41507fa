"""What message types are made of."""

from __future__ import annotations

import pytest

from bridge.msgs import TYPES
from bridge.typedefs import typedefs


def test_a_type_comes_first_and_then_what_it_is_made_of():
    found = typedefs("geometry_msgs/Twist")
    assert [each["type"] for each in found] == ["geometry_msgs/Twist", "geometry_msgs/Vector3"]
    assert found[0]["fieldnames"] == ["linear", "angular"]
    assert found[1]["fieldtypes"] == ["float64", "float64", "float64"]


def test_lists_and_arrays_have_any_length():
    scan = typedefs("sensor_msgs/LaserScan")[0]
    kinds = dict(
        zip(scan["fieldnames"], zip(scan["fieldtypes"], scan["fieldarraylen"], strict=True), strict=True)
    )
    assert kinds["ranges"] == ("float32", 0)
    assert kinds["angle_min"] == ("float64", -1)
    path = typedefs("nav_msgs/Path")[0]
    assert (path["fieldtypes"][1], path["fieldarraylen"][1]) == ("geometry_msgs/PoseStamped", 0)


def test_a_time_is_built_in_and_needs_no_definition():
    (header,) = typedefs("std_msgs/Header")
    assert header["fieldtypes"] == ["time", "string"]


@pytest.mark.parametrize("name", sorted(set(TYPES) - {"time", "duration"}))
def test_every_type_can_be_told_with_columns_of_one_length(name):
    found = typedefs(name)
    assert found[0]["type"] == name
    for each in found:
        columns = [each[key] for key in ("fieldnames", "fieldtypes", "fieldarraylen", "examples")]
        assert len({len(column) for column in columns}) == 1


def test_an_unknown_type_has_no_definition():
    assert typedefs("nobody_msgs/Nothing") == []
