from __future__ import annotations

from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import BatteryState, JointState, LaserScan
from widgets.core.field_paths import number_at
from widgets.fields.field_samples import scan
from widgets.fields.number_fields import MAX_FIELDS, MAX_PARTS, number_fields, unit_at


def paths(message) -> list[str]:
    return [field.path for field in number_fields(message)]


def test_every_number_is_found_with_its_way_and_unit():
    fields = {field.path: field.unit for field in number_fields(Odometry())}
    assert fields["twist.twist.linear.x"] == "m/s"
    assert fields["twist.twist.angular.z"] == "rad/s"
    assert fields["pose.pose.position.y"] == "m"
    assert unit_at(BatteryState, "voltage") == "V"
    assert unit_at(BatteryState, "nothing") == ""


def test_each_way_leads_to_a_number():
    for message in (Odometry(), BatteryState(), scan(5), JointState(name=["a"], position=[1.0, 2.0])):
        for path in paths(message):
            number_at(message, path)


def test_stamps_and_texts_are_none():
    assert not any("stamp" in path or "frame_id" in path for path in paths(Odometry()))
    assert "name[0]" not in paths(JointState(name=["a"], position=[1.0]))


def test_of_a_list_the_first_are_told_one_by_one():
    told = [path for path in paths(scan(360)) if path.startswith("ranges")]
    assert told == [f"ranges[{index}]" for index in range(MAX_PARTS)]
    assert not any(path.startswith("ranges") for path in paths(LaserScan()))
    assert len(number_fields(Odometry())) <= MAX_FIELDS
