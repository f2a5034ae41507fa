"""The link and the session on a robot that is not ours: heard by type, driven by its own topic, stopped by zero speed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from app.link.capabilities import CAMERA
from app.link.signals.signal_sender import SignalNews
from app.session.topic_list import TopicListing
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.std_msgs import Bool, String
from tests.app.link.test_link import AHEAD, Operator
from tests.app.strange import Strange, strange_robot


@pytest.fixture(params=[1, 2], ids=["ROS 1", "ROS 2"])
def strange(request: pytest.FixtureRequest) -> Iterator[Strange]:
    with strange_robot(request.param) as robot:
        yield robot


@pytest.fixture
def operator(strange: Strange, tmp_path: Path) -> Iterator[Operator]:
    operator = Operator(strange.url, tmp_path, wants_control=True)
    operator.until(lambda: operator.session.robot.foreign and operator.session.connected)
    yield operator
    operator.close()


def drives(operator: Operator, strange: Strange) -> None:
    operator.until(lambda: operator.session.may_drive)
    operator.link.drive(AHEAD)
    operator.until(lambda: strange.robot.speed > 0.2)


def holds(operator: Operator, seconds: float, each: Callable[[], Any] = lambda: None) -> None:
    end = time.monotonic() + seconds
    operator.until(lambda: each() or time.monotonic() > end)


def told(strange: Strange) -> list[dict[str, Any]]:
    return [op for op in strange.operations("publish") if op["topic"] == "/cmd_vel"]


def test_what_it_has_is_heard_and_nothing_else_is_asked_for(operator: Operator, strange: Strange) -> None:
    for name in ("/odom", "/imu/data", "/scan", "/battery_state", "/pose"):
        operator.until(lambda name=name: operator.session.feeds.latest(name) is not None)
    assert strange.listened() == {"/odom", "/imu/data", "/scan", "/battery_state"}
    assert operator.session.cameras.wanted(None) == ""
    called = {op["service"] for op in strange.operations("call_service")}
    assert not {name for name in called if not str(name).startswith("/rosapi/")}


def test_pictures_come_by_the_topic_of_their_type(
    operator: Operator, strange: Strange, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[bytes] = []
    monkeypatch.setattr(operator.link._camera, "_on_frame", lambda frame, _: seen.append(frame.jpeg))
    operator.link.watch(operator.session.cameras.wanted(None))
    operator.until(lambda: seen)
    assert seen[0].startswith(b"\xff\xd8")
    assert operator.session.robot.capabilities.source(CAMERA) in strange.listened()
    operator.link.watch(None)
    operator.until(lambda: operator.session.robot.capabilities.source(CAMERA) not in strange.listened())


def test_there_is_no_control_to_take_and_none_is_asked_for(operator: Operator) -> None:
    assert operator.session.control == "none"
    holds(operator, 0.3)
    assert operator.session.outcomes == {}


def test_it_drives_and_rests_when_let_go(operator: Operator, strange: Strange) -> None:
    drives(operator, strange)
    operator.link.drive(Twist())
    operator.until(lambda: strange.robot.speed == 0.0)


def test_stop_sends_zero_again_and_again_until_it_is_released(operator: Operator, strange: Strange) -> None:
    drives(operator, strange)
    operator.session.stop()
    assert operator.session.robot_stop.phase == "sent"
    operator.until(lambda: operator.session.robot_stop.phase == "stopped")
    assert strange.robot.speed == 0.0
    before = len(told(strange))
    holds(operator, 1.0, lambda: operator.link.drive(AHEAD))
    sent = told(strange)[before:]
    assert 7 <= len(sent) <= 13
    assert all(op["msg"]["linear"]["x"] == 0.0 for op in sent)
    assert not operator.session.may_drive
    operator.session.release_stop()
    assert operator.session.robot_stop.phase == "ready"
    holds(operator, 0.4)
    quiet = len(told(strange))
    holds(operator, 0.4)
    assert len(told(strange)) == quiet
    drives(operator, strange)


def test_stop_outlives_a_cut_connection(operator: Operator, strange: Strange) -> None:
    operator.session.stop()
    operator.until(lambda: operator.session.robot_stop.phase == "stopped")
    strange.cut()
    operator.until(lambda: not operator.session.connected)
    operator.until(lambda: operator.session.connected)
    operator.until(lambda: len(told(strange)) > 3)
    operator.until(lambda: operator.session.robot_stop.phase == "stopped")


@pytest.fixture
def careless(monkeypatch: pytest.MonkeyPatch) -> None:
    """Strange robots keep their last command for ever."""
    monkeypatch.setattr("tests.bridge.foreign_robot.WATCHDOG", 1e9)


@pytest.mark.usefixtures("careless")
def test_a_robot_that_drove_rests_first_of_all_when_the_link_is_back(
    operator: Operator, strange: Strange
) -> None:
    drives(operator, strange)
    strange.cut()
    operator.until(lambda: not operator.session.connected)
    assert strange.robot.speed > 0.2
    operator.until(lambda: operator.session.connected)
    operator.until(lambda: len(told(strange)) > 2)
    assert strange.robot.speed == 0.0
    assert all(op["msg"]["linear"]["x"] == 0.0 for op in told(strange))


def test_who_only_watched_says_nothing_when_the_link_is_back(operator: Operator, strange: Strange) -> None:
    strange.cut()
    operator.until(lambda: not operator.session.connected)
    operator.until(lambda: operator.session.connected)
    holds(operator, 0.4)
    assert told(strange) == []


def test_of_a_stick_held_into_a_server_that_hangs_little_is_left_and_rest_comes_last(
    operator: Operator, strange: Strange
) -> None:
    drives(operator, strange)
    before = len(told(strange))
    strange.faint()
    holds(operator, 1.5, lambda: operator.link.drive(AHEAD) if operator.session.may_drive else None)
    strange.wake()
    operator.until(lambda: len(told(strange)) > before and told(strange)[-1]["msg"]["linear"]["x"] == 0.0)
    moving = [op for op in told(strange)[before:] if op["msg"]["linear"]["x"] != 0.0]
    assert len(moving) <= 9


def test_a_robot_that_does_not_obey_is_not_said_to_be_stopped(operator: Operator, strange: Strange) -> None:
    drives(operator, strange)
    strange.robot.command = lambda _: None  # type: ignore[method-assign]
    strange.robot.step = lambda _: None  # type: ignore[method-assign]
    operator.session.stop()
    operator.until(lambda: operator.session.robot_stop.phase == "no_answer")
    assert "does not yet say that it rests" in operator.session.robot_stop.local.sentence(drives=True)


def test_a_topic_of_a_type_that_nobody_knew_is_learned_and_let_go(
    operator: Operator, strange: Strange
) -> None:
    topics = TopicListing(operator.session)
    operator.session.listeners.append(topics.on_post)
    topics.open("/gripper")
    assert topics.notice == "Learning acme_msgs/Gripper …"
    operator.until(lambda: topics.message is not None)
    assert topics.kind.__struct_fields__[:3] == ("header", "mode", "fingers")
    assert [finger.name for finger in topics.message.fingers] == ["left", "right"]
    assert "/gripper" in strange.listened()
    operator.until(lambda: topics.rate > 2.0)
    assert (topics.state, topics.notice) == ("live", "")
    topics.close()
    operator.until(lambda: "/gripper" not in strange.listened())


def test_a_type_that_cannot_be_learned_is_said(operator: Operator) -> None:
    topics = TopicListing(operator.session)
    operator.session.listeners.append(topics.on_post)
    offer = operator.session.robot.capabilities
    object.__setattr__(offer, "topics", {**offer.topics, "/odd": "odd_msgs/Odd"})
    topics.open("/odd")
    operator.until(lambda: topics.problem)
    assert topics.problem.startswith("odd_msgs/Odd cannot be shown: this app does not know it")
    assert topics.message is None
    topics.open("/scan")
    operator.until(lambda: topics.message is not None)
    assert topics.problem == ""


@pytest.fixture
def bare(tmp_path: Path) -> Iterator[Callable[..., tuple[Operator, Strange]]]:
    """Connects to a robot of ROS 1 that lacks some of rosapi's services."""
    with strange_robot() as robot:
        made: list[Operator] = []

        def connect(*withheld: str) -> tuple[Operator, Strange]:
            robot.withhold(*withheld)
            made.append(Operator(robot.url, tmp_path, wants_control=True))
            made[0].until(lambda: made[0].session.robot.foreign and made[0].session.connected)
            return made[0], robot

        yield connect
        for operator in made:
            operator.close()


def test_a_robot_without_a_clock_is_driven_without_stamps(
    bare: Callable[..., tuple[Operator, Strange]],
) -> None:
    operator, strange = bare("get_time")
    drives(operator, strange)
    holds(operator, 0.3)
    assert all("stamp" not in op for op in told(strange))


def test_a_robot_without_rosapi_is_tried_by_the_usual_names(
    bare: Callable[..., tuple[Operator, Strange]],
) -> None:
    operator, strange = bare()
    assert not operator.session.robot.capabilities.rosapi
    operator.until(lambda: operator.session.feeds.latest("/odom") is not None)
    drives(operator, strange)
    operator.session.stop()
    operator.until(lambda: operator.session.robot_stop.phase == "stopped")
    assert TopicListing(operator.session).sentence == "This robot lists no topics: it runs no rosapi."


def test_a_robot_that_takes_stamped_commands_is_driven_by_them(tmp_path: Path) -> None:
    with strange_robot(2) as strange:
        strange.drive_by("/base/cmd_vel", "geometry_msgs/TwistStamped")
        operator = Operator(strange.url, tmp_path, wants_control=True)
        operator.until(lambda: operator.session.robot.foreign and operator.session.connected)
        drives(operator, strange)
        operator.link.drive(Twist())
        operator.until(lambda: strange.robot.speed == 0.0)
        (advertised,) = (op for op in strange.operations("advertise") if op["topic"] == "/base/cmd_vel")
        sent: list[Any] = [
            op["msg"] for op in strange.operations("publish") if op["topic"] == "/base/cmd_vel"
        ]
        operator.close()
    assert advertised["type"] == "geometry_msgs/msg/TwistStamped"
    assert all(abs(msg["header"]["stamp"]["sec"] - time.time()) < 60 for msg in sent)


HORN, ON, OFF = "/horn", Bool(True), Bool(False)


def honks(operator: Operator) -> Callable[[], None]:
    """What a finger does on a button for the horn; it may from now on."""
    signals = operator.link.signals
    signals.look({HORN: Bool})
    operator.until(lambda: ("signal", SignalNews(HORN)) in operator.said)
    return lambda: signals.hold(HORN, ON, OFF)


def test_a_bool_that_it_listens_to_is_true_while_it_is_held_and_stop_ends_it(tmp_path: Path) -> None:
    with strange_robot(2) as strange:
        heard = strange.take(HORN)
        operator = Operator(strange.url, tmp_path, wants_control=True)
        operator.until(lambda: operator.session.robot.foreign and operator.session.connected)
        press = honks(operator)
        operator.until(lambda: press() or len(heard) > 2)
        assert all(msg == {"data": True} for msg in heard)
        operator.session.stop()
        operator.until(lambda: press() or heard[-1] == {"data": False})
        quiet = len([msg for msg in heard if msg["data"]])
        holds(operator, 0.5, press)
        assert len([msg for msg in heard if msg["data"]]) == quiet
        (advertised,) = (op for op in strange.operations("advertise") if op["topic"] == HORN)
        assert advertised["type"] == "std_msgs/msg/Bool"
        operator.close()


def test_a_bool_that_was_held_when_the_link_was_cut_is_false_first_of_all_over_the_next(
    tmp_path: Path,
) -> None:
    with strange_robot() as strange:
        heard = strange.take(HORN)
        operator = Operator(strange.url, tmp_path, wants_control=True)
        operator.until(lambda: operator.session.robot.foreign and operator.session.connected)
        press = honks(operator)
        operator.until(lambda: press() or heard)
        strange.cut()
        operator.until(lambda: not operator.session.connected)
        before = len(heard)
        operator.until(lambda: press() or len(heard) > before)
        assert heard[before:][0] == {"data": False}
        operator.close()


def test_what_it_says_itself_or_nobody_listens_to_is_sent_nothing(tmp_path: Path) -> None:
    with strange_robot() as strange:
        operator = Operator(strange.url, tmp_path, wants_control=True)
        operator.until(lambda: operator.session.robot.foreign and operator.session.connected)
        signals = operator.link.signals
        signals.look({"/cmd_vel": Bool, "/scan": Bool, "/robot_description": String, "/nowhere": Bool})
        operator.until(lambda: len([one for channel, one in operator.said if channel == "signal"]) == 4)
        assert all(one.problem for channel, one in operator.said if channel == "signal")
        for topic in ("/cmd_vel", "/scan", "/nowhere"):
            signals.say(topic, ON)
            signals.hold(topic, ON, OFF)
        signals.say("/robot_description", String("no"))
        holds(operator, 0.5)
        assert strange.operations("publish") == []
        operator.close()
