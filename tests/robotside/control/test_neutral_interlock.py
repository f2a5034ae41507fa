"""A stick that was held while the robot stopped is heard at zero before it counts again."""

from __future__ import annotations

import pytest

from robotside.control.neutral_interlock import NeutralInterlock


@pytest.fixture
def sticks() -> NeutralInterlock:
    return NeutralInterlock()


def push(sticks: NeutralInterlock, now: float, client: str = "anna") -> bool:
    return sticks.on_command(client, True, now, now)


def let_go(sticks: NeutralInterlock, now: float, client: str = "anna") -> None:
    assert sticks.on_command(client, False, now, now)


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
    sticks.on_command("anna", True, 10.0, 10.1)
    sticks.void_all()
    sticks.on_command("anna", False, 9.9, 10.1)
    assert not push(sticks, 10.2)
    sticks.on_command("anna", False, 10.2, 10.3)
    assert push(sticks, 10.4)


def test_a_stamp_from_the_future_does_not_keep_zero_out(sticks: NeutralInterlock) -> None:
    sticks.on_command("anna", True, 99.0, 10.0)
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


def test_who_left_is_forgotten(sticks: NeutralInterlock) -> None:
    push(sticks, 10.0)
    sticks.void("anna")
    sticks.forget("anna")
    assert push(sticks, 10.1)
