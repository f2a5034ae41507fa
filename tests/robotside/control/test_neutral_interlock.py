"""A stick that was held while the robot stopped is heard at zero before it counts again."""

from __future__ import annotations

import pytest

from robotside.control.neutral_interlock import MAX_REMEMBERED, MEMORY_TIME, NeutralInterlock, Origin

ANNA = Origin("192.0.2.1", "anna")


@pytest.fixture
def sticks() -> NeutralInterlock:
    return NeutralInterlock()


def push(sticks: NeutralInterlock, now: float, client: str = "anna", origin: Origin = ANNA) -> bool:
    return sticks.on_command(client, True, now, now, lambda: origin)


def let_go(sticks: NeutralInterlock, now: float, client: str = "anna", origin: Origin = ANNA) -> None:
    assert sticks.on_command(client, False, now, now, lambda: origin)


def test_the_first_push_counts(sticks: NeutralInterlock) -> None:
    assert push(sticks, 10.0)


@pytest.mark.parametrize("pause", [0.05, 0.5, 5.0, 3600.0])
def test_no_pause_stands_for_zero(sticks: NeutralInterlock, pause: float) -> None:
    push(sticks, 10.0)
    sticks.void("anna")
    assert not push(sticks, 10.0 + pause)
    assert not push(sticks, 10.0 + 2 * pause)
    let_go(sticks, 10.0 + 3 * pause)
    assert push(sticks, 10.0 + 4 * pause)


def test_a_stick_whose_next_command_came_too_late_is_void_though_nobody_looked(
    sticks: NeutralInterlock,
) -> None:
    push(sticks, 10.0)
    sticks.obey("anna", 10.3)
    assert push(sticks, 10.29)
    assert not push(sticks, 10.3)
    assert not push(sticks, 10.31)


def test_zero_forgets_when_the_next_command_was_due(sticks: NeutralInterlock) -> None:
    push(sticks, 10.0)
    sticks.obey("anna", 10.3)
    let_go(sticks, 10.1)
    assert push(sticks, 20.0)


def test_a_zero_that_was_given_before_the_newest_push_is_none(sticks: NeutralInterlock) -> None:
    sticks.on_command("anna", True, 10.0, 10.1, lambda: ANNA)
    sticks.void_all()
    sticks.on_command("anna", False, 9.9, 10.1, lambda: ANNA)
    assert not push(sticks, 10.2)
    sticks.on_command("anna", False, 10.2, 10.3, lambda: ANNA)
    assert push(sticks, 10.4)


def test_a_stamp_from_the_future_does_not_keep_zero_out(sticks: NeutralInterlock) -> None:
    sticks.on_command("anna", True, 99.0, 10.0, lambda: ANNA)
    sticks.void("anna")
    let_go(sticks, 10.1)
    assert push(sticks, 10.2)


def test_each_stick_is_voided_for_itself_or_all_together(sticks: NeutralInterlock) -> None:
    push(sticks, 10.0), push(sticks, 10.0, "bert")
    sticks.void("bert")
    assert push(sticks, 10.1)
    assert not push(sticks, 10.1, "bert")
    sticks.void_all()
    assert not push(sticks, 10.2)


def test_a_stick_at_zero_cannot_be_voided(sticks: NeutralInterlock) -> None:
    push(sticks, 10.0)
    let_go(sticks, 10.1)
    sticks.void("anna"), sticks.void_all()
    assert push(sticks, 10.2)


def left_pushed(sticks: NeutralInterlock, origin: Origin = ANNA) -> None:
    push(sticks, 10.0, origin=origin)
    sticks.forget("anna", origin)


def test_who_comes_back_with_a_held_stick_is_heard_at_zero_first(sticks: NeutralInterlock) -> None:
    left_pushed(sticks)
    assert not push(sticks, 10.1, "anna again")
    assert not push(sticks, 10.2, "anna again")
    let_go(sticks, 10.3, "anna again")
    assert push(sticks, 10.4, "anna again")
    sticks.forget("anna again", ANNA)
    assert not push(sticks, 10.5, "anna a third time")


def test_who_left_at_zero_comes_back_freely(sticks: NeutralInterlock) -> None:
    push(sticks, 10.0)
    let_go(sticks, 10.1)
    sticks.forget("anna", ANNA)
    assert push(sticks, 10.2, "anna again")


@pytest.mark.parametrize(
    ("before", "after", "counts"),
    [
        (ANNA, Origin("198.51.100.7", "anna"), False),
        (ANNA, Origin("192.0.2.1", "bert"), True),
        (ANNA, Origin("192.0.2.1", ""), False),
        (Origin("192.0.2.1", ""), Origin("192.0.2.1", ""), False),
        (Origin("192.0.2.1", ""), ANNA, False),
        (Origin("192.0.2.1", ""), Origin("192.0.2.2", ""), True),
    ],
)
def test_a_name_tells_who_comes_back_and_without_one_the_machine(
    sticks: NeutralInterlock, before: Origin, after: Origin, counts: bool
) -> None:
    left_pushed(sticks, before)
    assert push(sticks, 10.1, "next", after) is counts


def test_it_is_forgotten_after_a_while_and_never_grows(sticks: NeutralInterlock) -> None:
    left_pushed(sticks)
    assert push(sticks, 10.1 + MEMORY_TIME, "anna again")
    for number in range(MAX_REMEMBERED + 5):
        push(sticks, 100.0, str(number), Origin("", str(number)))
        sticks.forget(str(number), Origin("", str(number)))
    assert push(sticks, 100.1, "again", Origin("", "0"))
    assert not push(sticks, 100.1, "again too", Origin("", "7"))


def test_a_zero_from_before_the_last_push_lets_go_of_no_stick_whose_connection_ended(
    sticks: NeutralInterlock,
) -> None:
    push(sticks, 10.0)
    sticks.forget("anna", ANNA)
    sticks.on_command("anna again", False, 9.9, 10.2, lambda: ANNA)
    assert not push(sticks, 10.3, "anna again")
