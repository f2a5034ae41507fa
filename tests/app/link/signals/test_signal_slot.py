"""What is held ends in its rest whatever happens, what is said once leaves soon or never, and no topic is flooded."""

from __future__ import annotations

import pytest

from app.link.signals.signal_slot import HOLD_TIMEOUT, ONCE_TIMEOUT, REST_REPEATS, SignalSlot
from bridge.msgs.std_msgs import Bool
from tests.bridge.wires import Clock

ON, OFF = Bool(True), Bool(False)


class Desk:
    """A slot, looked at every 10 ms."""

    def __init__(self) -> None:
        self.clock, self.allowed, self.reached = Clock(), True, True
        self.slot = SignalSlot(self.clock)

    def look(self, seconds: float = 0.0, *, finger: bool = False) -> list[bool]:
        """What goes out meanwhile; a `finger` says its button again every 0.1 s."""
        out: list[bool] = []
        steps = round(seconds / 0.01) + 1
        for step in range(steps):
            if finger and step % 10 == 0:
                self.slot.hold("/horn", ON, OFF)
            for one in self.slot.due(lambda *_: self.allowed):
                if self.reached:
                    out.append(one.msg.data)
                    self.slot.sent(one)
            if step + 1 < steps:
                self.clock.time += 0.01
        return out


@pytest.fixture
def desk() -> Desk:
    return Desk()


def test_a_switch_is_said_once_and_of_two_in_a_hurry_the_newest(desk: Desk) -> None:
    desk.slot.say("/lamp", ON)
    assert desk.look(1.0) == [True]
    for value in (False, True, False):
        desk.slot.say("/lamp", Bool(value))
    assert desk.look(1.0) == [False]


def test_no_topic_gets_more_than_twenty_messages_a_second(desk: Desk) -> None:
    out: list[bool] = []
    for step in range(100):
        desk.slot.say("/lamp", Bool(step % 2 == 0))
        out += desk.look(0.01)
    assert 15 <= len(out) <= 21


def test_what_is_held_is_said_ten_times_a_second_and_rests_when_it_is_let_go(desk: Desk) -> None:
    held = desk.look(1.0, finger=True)
    assert 9 <= len(held) <= 12
    assert all(held)
    desk.slot.let_go("/horn")
    assert desk.look(1.0) == [False] * REST_REPEATS
    assert not desk.slot.busy


def test_what_nobody_says_again_rests_and_stays_so_until_it_is_pressed_anew(desk: Desk) -> None:
    desk.look(0.5, finger=True)
    assert False in desk.look(HOLD_TIMEOUT + 0.05)
    assert True not in desk.look(1.0, finger=True), "the same finger"
    desk.slot.let_go("/horn")
    assert True in desk.look(0.2, finger=True)


@pytest.mark.parametrize("how", ["not allowed", "dropped"])
def test_what_is_held_when_nothing_may_be_sent_rests_and_must_be_pressed_anew(desk: Desk, how: str) -> None:
    desk.look(0.5, finger=True)
    desk.allowed = how != "not allowed"
    if how == "dropped":
        desk.slot.drop()
    assert set(desk.look(0.3, finger=True)) == {False}
    desk.allowed = True
    assert True not in desk.look(0.5, finger=True)


def test_a_rest_that_did_not_reach_the_robot_is_owed_until_it_does(desk: Desk) -> None:
    desk.look(0.5, finger=True)
    desk.reached = False
    desk.slot.drop()
    assert desk.look(5.0) == []
    assert desk.slot.busy
    desk.reached = True
    assert desk.look(0.5) == [False] * REST_REPEATS


def test_who_held_nothing_says_no_rest(desk: Desk) -> None:
    desk.slot.let_go("/horn")
    desk.allowed = False
    desk.slot.hold("/horn", ON, OFF)
    assert desk.look(1.0) == []
    assert not desk.slot.busy


@pytest.mark.parametrize("how", ["not allowed", "dropped", "too late"])
def test_a_switch_that_cannot_be_said_now_is_never_said(desk: Desk, how: str) -> None:
    desk.slot.say("/lamp", ON)
    if how == "dropped":
        desk.slot.drop()
    desk.allowed, desk.reached = how != "not allowed", how != "too late"
    assert desk.look(ONCE_TIMEOUT + 0.1) == []
    desk.allowed = desk.reached = True
    assert desk.look(1.0) == []


def test_a_finger_that_is_lifted_while_its_message_leaves_is_followed_by_a_rest(desk: Desk) -> None:
    desk.slot.hold("/horn", ON, OFF)
    (one,) = desk.slot.due(lambda *_: True)
    desk.slot.hold("/horn", Bool(True), OFF)
    desk.slot.let_go("/horn")
    desk.slot.sent(one)
    assert desk.look(0.3) == [False] * REST_REPEATS
