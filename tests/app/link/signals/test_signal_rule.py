"""No signal goes where Pilothouse itself drives, stops or commands, by another type, or to what only the robot says."""

from __future__ import annotations

import pytest

from app.link.capabilities import Capabilities
from app.link.commands import COMMANDS, SERVICES
from app.link.signals.signal_rule import hearing_fault, is_owned, topic_fault
from bridge.core.topics import TOPICS
from bridge.msgs.std_msgs import Bool

STRANGE = {
    "/lamp": "std_msgs/Bool",
    "/base/cmd_vel": "geometry_msgs/Twist",
    "/base_scan": "sensor_msgs/LaserScan",
}
FOREIGN = Capabilities.of(STRANGE, frozenset({"/beep"}))
TABLE = {entry.name: entry.type.MSGTYPE for entry in TOPICS}
OURS = Capabilities.of(TABLE | {"/horn": "std_msgs/Bool"}, frozenset({"/stop"}))


def fault(offer: Capabilities | None, topic: str) -> str:
    return topic_fault(offer, topic, Bool, SERVICES)


def test_a_bool_that_the_robot_lists_under_a_name_of_its_own_may_be_sent():
    assert fault(FOREIGN, "/lamp") == fault(OURS, "/horn") == ""


def test_nothing_may_be_sent_before_the_robot_said_what_it_has():
    assert fault(None, "/lamp") == "The robot has not said yet which topics it has."


@pytest.mark.parametrize("offer", [FOREIGN, OURS])
def test_every_topic_of_the_table_and_every_command_is_owned_even_as_a_bool(offer):
    names = {entry.name for entry in TOPICS} | {kind.service for kind in COMMANDS.values()}
    claimed = Capabilities.of({**offer.topics, **dict.fromkeys(names, "std_msgs/Bool")}, offer.services)
    assert all(" belongs to driving, STOP and commands" in fault(claimed, name) for name in names)


def test_what_drives_or_stands_for_one_of_ours_or_is_a_service_is_owned():
    told = {**STRANGE, "/beep": "std_msgs/Bool", "/arm/cmd_vel": "geometry_msgs/TwistStamped"}
    offer = Capabilities.of(told, frozenset({"/beep"}))
    assert offer.drive == "/base/cmd_vel"
    for name in ("/base/cmd_vel", "/arm/cmd_vel", "/base_scan", "/beep"):
        assert is_owned(offer, name), name
    assert not is_owned(offer, "/lamp")


def test_another_type_and_a_topic_that_is_not_there_are_refused_with_what_there_is():
    offer = Capabilities.of({**STRANGE, "/level": "std_msgs/Float64"}, frozenset())
    assert fault(offer, "/level") == "/level takes std_msgs/Float64, not std_msgs/Bool."
    assert fault(offer, "/nowhere") == "This robot has no topic /nowhere."
    assert fault(OURS, "/nowhere").startswith("A Pilothouse robot takes no switches: only a program")


def test_a_part_of_the_robot_must_listen_and_none_may_say_it_itself():
    bridge = "/rosbridge_websocket"
    assert hearing_fault("/lamp", [], ["/disc", bridge], ours=False) == ""
    assert hearing_fault("/lamp", [bridge], ["/disc"], ours=False) == ""
    assert "Nothing on the robot listens" in hearing_fault("/lamp", [], [bridge], ours=False)
    assert "itself publishes /touch" in hearing_fault("/touch", ["/disc"], ["/disc"], ours=False)


def test_on_a_robot_of_ours_only_a_program_beside_it_can_listen():
    assert hearing_fault("/horn", ["/client_7"], ["/client_9"], ours=True) == ""
    assert "A Pilothouse robot takes no switches" in hearing_fault("/horn", [], [], ours=True)
    assert "A Pilothouse robot takes no switches" in hearing_fault("/horn", [], ["/pilothouse"], ours=True)
