"""The bus, the demand, the events, the store and the robot's clock."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import Event, Mission, Waypoint
from bridge.msgs.std_msgs import Float64, Time
from robotside.bus import Bus
from robotside.clock import MOST, RobotClock
from robotside.demand import Demand
from robotside.events import KEPT, Events
from robotside.pose2 import Pose2
from robotside.store import Store


def test_the_bus_gives_a_message_to_its_topics_listeners_and_to_those_of_all() -> None:
    bus, heard = Bus(), []
    bus.subscribe("/a", lambda topic, msg: heard.append(("a", topic, msg)))
    bus.subscribe(None, lambda topic, msg: heard.append(("all", topic, msg)))
    bus.publish("/a", Float64(1.0))
    bus.publish("/b", Float64(2.0))
    assert heard == [("a", "/a", Float64(1.0)), ("all", "/a", Float64(1.0)), ("all", "/b", Float64(2.0))]


def test_who_comes_late_to_the_bus_hears_the_last_message_first() -> None:
    bus, heard = Bus(), list[Msg]()
    bus.publish("/a", Float64(1.0))
    bus.publish("/a", Float64(2.0))
    bus.subscribe("/a", lambda _, msg: heard.append(msg))
    assert heard == [Float64(2.0)]
    assert bus.last("/a") == Float64(2.0)
    assert bus.last("/b") is None


def test_who_left_the_bus_hears_nothing_even_while_a_message_is_on_its_way() -> None:
    bus, heard = Bus(), list[Msg]()
    leave = bus.subscribe("/a", lambda _, msg: heard.append(msg))
    leave()
    leave()
    bus.publish("/a", Float64(1.0))
    assert heard == []


def test_a_topic_is_made_from_the_first_who_wants_it_to_the_last() -> None:
    told: list[tuple[str, bool]] = []
    demand = Demand(lambda topic, wanted: told.append((topic, wanted)))
    for asker, wanted in (("x", True), ("y", True), ("x", True), ("x", False), ("y", False), ("y", False)):
        demand.set("/camera", asker, wanted)
    assert told == [("/camera", True), ("/camera", False)]


def test_events_are_numbered_from_one_and_carry_the_boot_and_the_place() -> None:
    heard: list[Event] = []
    events = Events("b1", lambda: 12.5, heard.append)
    events.say("task", "Started.")
    events.say("intruder", "A cone.", "alarm", at=(1.0, 2.0))
    assert [(e.id, e.boot, e.level, e.stamp) for e in heard] == [
        (1, "b1", "info", Time(12, 500_000_000)),
        (2, "b1", "alarm", Time(12, 500_000_000)),
    ]
    assert math.isnan(heard[0].position.x)
    assert (heard[1].position.x, heard[1].position.y) == (1.0, 2.0)


def test_the_newest_five_hundred_events_are_kept() -> None:
    events = Events("b1", lambda: 0.0, lambda _: None)
    for number in range(KEPT + 20):
        events.say("task", f"{number}")
    kept = events.since(0, "b1")
    assert (len(kept), kept[0].id, kept[-1].id) == (KEPT, 21, KEPT + 20)
    assert [event.id for event in events.since(KEPT + 18, "b1")] == [KEPT + 19, KEPT + 20]


MISSION = Mission(
    Time(5), [Waypoint(1.0, 2.0), Waypoint(3.0, 4.0, 0.5, "gate")], [Waypoint(0.0, 0.0)], "random"
)


def test_a_stored_mission_is_read_back_with_everything_that_is_not_known(tmp_path: Path) -> None:
    Store(tmp_path / "state").save(MISSION)
    mission, problem = Store(tmp_path / "state").load()
    assert problem == ""
    assert math.isnan(mission.waypoints[0].yaw)
    assert (mission.waypoints[1], mission.home, mission.motion) == (
        MISSION.waypoints[1],
        MISSION.home,
        "random",
    )


def test_a_robot_without_a_stored_mission_has_an_empty_one(tmp_path: Path) -> None:
    assert Store(tmp_path).load() == (Mission(), "")


def test_saving_leaves_nothing_but_the_file(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.save(MISSION)
    store.save(Mission())
    assert [path.name for path in tmp_path.iterdir()] == ["mission.json"]


@pytest.mark.parametrize("damage", [b"", b"{", b'{"laps": "many"}', b"\xff\xfe", b"[]"])
def test_a_damaged_file_is_set_aside_and_said(tmp_path: Path, damage: bytes) -> None:
    (tmp_path / "mission.json").write_bytes(damage)
    mission, problem = Store(tmp_path).load()
    assert mission == Mission()
    assert problem.startswith("The stored mission was damaged and is set aside as mission.damaged.json")
    assert (tmp_path / "mission.damaged.json").read_bytes() == damage
    assert Store(tmp_path).load() == (Mission(), "")


def test_the_robots_clock_follows_real_time_at_its_speed() -> None:
    clock = RobotClock(100.0, speed=4.0)
    assert clock.tick(100.1) == pytest.approx(100.4)
    assert clock.tick(100.2) == pytest.approx(100.8)


def test_after_a_long_halt_little_is_made_good_at_once_and_the_rest_slowly() -> None:
    clock = RobotClock(100.0)
    assert clock.tick(110.0) - 100.0 <= MOST * 1.1 + 1e-9
    before = clock.now
    assert clock.tick(110.1) - before == pytest.approx(0.11)
    for tick in range(2000):
        clock.tick(110.1 + tick * 0.1)
    assert clock.now == pytest.approx(110.1 + 199.9)


def test_the_robots_clock_never_goes_back() -> None:
    clock = RobotClock(100.0)
    clock.tick(101.0)
    now = clock.now
    assert clock.tick(90.0) == now
    assert clock.tick(101.0) == now


def test_poses_are_carried_between_frames_and_back() -> None:
    robot, seen = Pose2(1.0, 2.0, math.pi / 2), Pose2(3.0, 0.0, 0.1)
    there = robot.then(seen)
    assert there == pytest.approx((1.0, 5.0, math.pi / 2 + 0.1))
    assert there.since(robot) == pytest.approx(seen)
    assert Pose2.from_msg(there.to_msg()) == pytest.approx(there)
    assert robot.bearing(1.0, 5.0) == pytest.approx(0.0)
