from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import JointState
from widgets.core.field_paths import number_at, value_at, written

JOINTS = JointState(name=["left", "right"], velocity=[1.0, 2.5])


@pytest.mark.parametrize("path", ["velocity[1]", "velocity.1", "velocity[-1]"])
def test_a_number_picks_from_a_list_with_brackets_or_behind_a_dot(path):
    assert number_at(JOINTS, path) == 2.5


def test_names_lead_inwards():
    assert number_at(Odometry(), "twist.twist.linear.x") == 0.0
    assert value_at(JOINTS, "name[0]") == "left"


def test_several_letters_of_a_vector_are_how_long_it_is_in_those_directions():
    moving = Twist(linear=Vector3(3.0, 4.0, 12.0))
    assert number_at(moving, "linear.xy") == 5.0
    assert number_at(moving, "linear.xyz") == 13.0


def test_what_is_not_known_is_nan():
    class Told:
        level = None

    assert math.isnan(number_at(Told(), "level"))


@pytest.mark.parametrize(
    ("path", "error"),
    [("velocity[7]", IndexError), ("speed", AttributeError), ("name[0]", ValueError), ("header", TypeError)],
)
def test_a_way_that_leads_to_no_number_is_an_error(path, error):
    with pytest.raises(error):
        number_at(JOINTS, path)


def test_a_way_in_steps_is_written_as_people_write_it():
    assert written(("status", 0, "values", 1, "key")) == "status[0].values[1].key"
    assert written(("ranges", 3)) == "ranges[3]"
    assert written(()) == ""
