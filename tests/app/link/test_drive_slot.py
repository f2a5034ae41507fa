"""The drive slot: nothing old leaves late, and silence of anybody means rest."""

from __future__ import annotations

import math

import pytest

from app.link.drive_slot import Drive, DriveSlot, stamped_at
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.control.neutral_interlock import NeutralInterlock, Origin

AHEAD, TURN, ZERO = Twist.planar(0.4, 0.0), Twist.planar(0.0, 1.0), Twist()
STEER = Manoeuvre(kind="steer", throttle=0.5, steering=0.2)


class Clock:
    now = 50.0

    def __call__(self) -> float:
        return self.now


class Hand:
    """A drive slot whose clock and heartbeat the test owns."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.slot = DriveSlot(self.clock)
        self.sent: list[tuple[float, Drive]] = []

    def pass_time(self, seconds: float, *, alive: bool = True) -> list[Drive]:
        """Let time pass in steps of 10 ms, asking each time what is due."""
        before = len(self.sent)
        start = self.clock.now
        for step in range(round(seconds * 100)):
            self.clock.now = start + (step + 1) / 100
            if alive:
                self.slot.beat()
            twist = self.slot.due()
            if twist is not None:
                self.sent.append((self.clock.now, twist))
        return [twist for _, twist in self.sent[before:]]


@pytest.fixture
def hand() -> Hand:
    hand = Hand()
    hand.slot.beat()
    return hand


def test_a_twist_that_is_not_finite_means_rest(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.1)
    hand.slot.want(Twist(Vector3(math.nan)))
    assert set(hand.pass_time(0.3)) == {ZERO}


def test_a_dead_user_interface_brings_the_robot_to_rest(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    after = hand.pass_time(0.6, alive=False)
    assert after[-3:] == [ZERO] * 3
    assert after.count(AHEAD) <= 4
    first_zero = next(at for at, twist in hand.sent if twist == ZERO)
    assert first_zero <= 50.2 + 0.15 + 0.021


def test_the_sender_looks_again_the_moment_that_the_heartbeat_is_too_old(hand: Hand) -> None:
    assert hand.slot.patience(0.05) == 0.05
    hand.slot.want(AHEAD)
    hand.pass_time(0.5)
    stopped, waits = hand.clock.now, []
    while hand.sent[-1][1] != ZERO:
        waits.append(hand.slot.patience(0.05))
        hand.clock.now += waits[-1]
        if (twist := hand.slot.due()) is not None:
            hand.sent.append((hand.clock.now, twist))
    assert hand.sent[-1][0] - stopped == pytest.approx(0.151)
    assert all(0 < wait <= 0.05 for wait in waits)


def test_a_stick_held_through_a_short_stall_drives_on(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    hand.pass_time(0.4, alive=False)
    assert AHEAD in hand.pass_time(0.1)


def test_a_stick_held_through_a_long_stall_must_be_pushed_anew(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    hand.pass_time(1.5, alive=False)
    assert hand.pass_time(1.0) == []


def test_what_a_held_stick_means_anew_is_sent_at_once_but_pushes_no_stick(hand: Hand) -> None:
    hand.slot.amend(AHEAD)
    assert hand.pass_time(0.1) == [], "nobody pushed"
    hand.slot.want(AHEAD)
    hand.pass_time(0.1)
    hand.slot.amend(TURN)
    assert hand.pass_time(0.01) == [TURN]
    hand.pass_time(1.2, alive=False)
    hand.slot.amend(AHEAD)
    assert hand.pass_time(0.3) == [], "after a long stall the stick must be pushed anew"
    hand.slot.want(AHEAD)
    hand.slot.drop()
    hand.slot.amend(AHEAD)
    assert hand.pass_time(0.3) == [], "it did not wait for the lost link"


def test_a_twist_that_waited_for_a_lost_link_is_never_sent(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.slot.drop()
    assert hand.pass_time(1.0) == []


def lose_the_link(hand: Hand, how: str) -> None:
    """While somebody drives."""
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    if how == "cut":
        hand.slot.drop()
    else:
        hand.slot.due(allowed=False)
        hand.clock.now += 1.0
        hand.slot.beat()


@pytest.mark.parametrize("how", ["cut", "silence"])
def test_the_first_push_after_a_lost_link_says_rest_before_it_drives(hand: Hand, how: str) -> None:
    lose_the_link(hand, how)
    hand.slot.want(ZERO)
    hand.pass_time(1.0)
    hand.slot.want(TURN)
    assert hand.slot.due() == ZERO, "the robot may have heard of no rest"
    assert hand.slot.due() == TURN, "at once"
    hand.slot.want(ZERO)
    hand.pass_time(0.5)
    hand.slot.want(AHEAD)
    assert hand.slot.due() == AHEAD, "once it was heard it is not said again"


def counted(hand: Hand, sticks: NeutralInterlock, connection: str, seconds: float) -> set[bool]:
    """Whether the robot takes what is sent to it over a connection while so much time passes."""
    hand.sent.clear()
    hand.pass_time(seconds)
    anna = Origin("192.0.2.1", "anna")
    return {
        sticks.on_command(connection, twist != ZERO, at, at, lambda: anna) for at, twist in hand.sent
    } or {False}


@pytest.mark.parametrize("lifted", [True, False])
def test_the_robot_takes_the_first_push_over_the_next_link_and_no_finger_that_was_held_all_along(
    hand: Hand, lifted: bool
) -> None:
    sticks = NeutralInterlock()
    hand.slot.want(AHEAD)
    assert counted(hand, sticks, "first", 0.5) == {True}
    hand.slot.drop()
    sticks.forget("first", Origin("192.0.2.1", "anna"))
    hand.pass_time(3.0)
    if lifted:
        hand.slot.want(ZERO)
    hand.slot.want(AHEAD)
    assert counted(hand, sticks, "second", 0.5) == {lifted}
    assert hand.slot.driving


def test_a_push_that_was_let_go_just_before_the_link_was_lost_is_one_more_that_says_rest_first(
    hand: Hand,
) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    hand.slot.want(ZERO)
    hand.pass_time(0.5)
    hand.slot.drop()
    hand.slot.want(TURN)
    assert [hand.slot.due(), hand.slot.due()] == [ZERO, TURN]
    hand.slot.drop()
    hand.slot.want(ZERO)
    hand.slot.want(TURN)
    assert [hand.slot.due(), hand.slot.due()] == [ZERO, TURN], "and again, over the link after that"


@pytest.mark.parametrize("how", ["cut", "silence"])
def test_a_hand_that_never_let_go_says_no_rest_over_the_next_link(hand: Hand, how: str) -> None:
    lose_the_link(hand, how)
    hand.pass_time(0.5)
    hand.sent.clear()
    hand.slot.want(TURN)  # a finger that is moved, before it was told that its push is over
    assert ZERO not in hand.pass_time(0.3), "the robot has to refuse it"
    hand.slot.want(ZERO)
    assert ZERO in hand.pass_time(0.3)


def test_who_never_drove_says_no_rest_before_the_first_push(hand: Hand) -> None:
    hand.slot.drop()
    hand.slot.due(allowed=False)
    hand.slot.want(AHEAD)
    assert hand.slot.due() == AHEAD


def test_a_twist_that_is_not_allowed_is_forgotten(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    assert hand.slot.due(allowed=False) is None
    assert hand.pass_time(0.3) == []


def test_a_latched_slot_sends_rest_ten_times_a_second_whatever_is_wanted(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    hand.slot.latch(True)
    assert hand.slot.due() == ZERO, "at once"
    for alive in (True, False):  # a glass that hangs does not end it
        hand.slot.want(AHEAD)
        sent = hand.pass_time(3.0, alive=alive)
        assert set(sent) == {ZERO}
        assert 27 <= len(sent) <= 32
    hand.slot.drop()
    assert hand.slot.latched, "a lost link does not release it"


def test_a_released_slot_waits_for_a_new_push(hand: Hand) -> None:
    hand.slot.latch(True)
    hand.slot.want(AHEAD)
    hand.pass_time(0.5)
    hand.slot.latch(False)
    assert AHEAD not in hand.pass_time(1.0)
    assert hand.pass_time(1.0) == []
    hand.slot.want(AHEAD)
    assert hand.pass_time(0.1)[0] == AHEAD


def test_what_was_pushed_under_the_latch_is_forgotten_with_it_though_nothing_was_due_in_between(
    hand: Hand,
) -> None:
    hand.slot.latch(True)
    hand.pass_time(0.2)
    hand.slot.want(AHEAD)
    hand.slot.latch(False)
    assert AHEAD not in hand.pass_time(1.0)
    assert hand.slot.voided == 1, "what pushed is told to spring back"


def test_nothing_is_sent_before_the_stick_was_touched(hand: Hand) -> None:
    assert hand.pass_time(1.0) == []


def test_a_change_is_sent_at_once_and_a_held_stick_twenty_times_a_second(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    assert hand.slot.due() == AHEAD
    hand.slot.want(TURN)
    assert hand.slot.due() == TURN
    assert hand.slot.due() is None
    assert len(hand.pass_time(1.0)) == 20


def test_letting_go_sends_three_zeros_and_then_nothing(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    hand.slot.want(ZERO)
    assert hand.pass_time(1.0) == [ZERO] * 3
    assert not hand.slot.driving


def test_pushing_again_during_the_zeros_drives_at_once(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    hand.slot.want(ZERO)
    hand.pass_time(0.02)
    hand.slot.want(TURN)
    assert hand.slot.due() == TURN
    assert hand.slot.driving


def test_a_manoeuvre_is_sent_as_a_twist_is_and_ends_in_the_same_rest(hand: Hand) -> None:
    hand.slot.want(STEER)
    assert hand.slot.due() == STEER
    hand.slot.want(Manoeuvre(kind="steer", throttle=0.5, steering=0.2, speed=float("nan")))
    assert hand.slot.due() is None, "one NaN is like another"
    assert len(hand.pass_time(1.0)) == 20
    after = hand.pass_time(0.6, alive=False)
    assert after[-3:] == [ZERO] * 3
    assert len(after) <= 7


def test_a_twist_takes_the_place_of_a_manoeuvre_at_once(hand: Hand) -> None:
    hand.slot.want(STEER)
    assert hand.slot.due() == STEER
    hand.slot.want(AHEAD)
    assert hand.slot.due() == AHEAD


@pytest.mark.parametrize(
    "faulty",
    [
        Manoeuvre(kind="steer", steering=math.nan, throttle=1.0),
        Manoeuvre(kind="steer", throttle=math.inf),
        Manoeuvre(kind="tilt", roll=math.inf),
        Manoeuvre(kind="tilt", pitch=0.1, twist=Twist(Vector3(0.0, 0.0, math.nan))),
    ],
)
def test_a_manoeuvre_that_is_not_finite_means_rest(hand: Hand, faulty: Manoeuvre) -> None:
    hand.slot.want(STEER)
    hand.pass_time(0.1)
    hand.slot.want(faulty)
    assert set(map(repr, hand.pass_time(0.3))) == {repr(ZERO)}


def test_what_lasts_is_no_drive_command(hand: Hand) -> None:
    with pytest.raises(ValueError, match="driven by twist, steer, tilt, not by the manoeuvre 'hover'"):
        hand.slot.want(Manoeuvre(kind="hover"))


def test_a_manoeuvre_says_when_the_finger_was_there() -> None:
    assert stamped_at(STEER, 12.5).header.stamp.seconds == 12.5
    assert stamped_at(STEER, math.nan).header.stamp.seconds == 0.0


def test_a_push_that_is_dropped_is_counted_and_one_that_is_let_go_is_not(hand: Hand) -> None:
    hand.slot.want(AHEAD)
    hand.pass_time(0.2)
    hand.slot.want(ZERO)
    hand.pass_time(0.2)
    assert hand.slot.voided == 0
    hand.slot.want(AHEAD)
    hand.pass_time(1.5, alive=False)
    assert hand.slot.voided == 1
    hand.pass_time(1.5, alive=False)
    assert hand.slot.voided == 1
