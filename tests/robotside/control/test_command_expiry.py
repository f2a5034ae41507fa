"""Which drive commands come too late."""

from __future__ import annotations

import math

import pytest

from robotside.control.command_expiry import (
    HOLD_TIME,
    LEAD_DECAY,
    MAX_CLOCK_LEAD,
    MAX_UNSTAMPED_AGE,
    VALID_TIME,
    CommandExpiry,
)
from tests.fakes import FakeClient

NOW = 100.0


@pytest.fixture
def client() -> FakeClient:
    return FakeClient("anna", NOW)


def test_a_stamp_of_a_clock_that_was_never_compared_does_not_count(client: FakeClient) -> None:
    client.asked_time = False
    said = CommandExpiry().fault(client, NOW, NOW, rest=False)
    assert said.endswith("never compared with the robot's; ask /rosapi/get_time first.")
    client.asked_time = True
    assert CommandExpiry().fault(client, NOW, NOW, rest=False) == ""


@pytest.mark.parametrize(
    ("age", "counts"), [(0.0, True), (HOLD_TIME - 1e-6, True), (HOLD_TIME + 0.01, False)]
)
def test_a_command_that_moves_has_to_come_while_it_would_be_in_force(
    client: FakeClient, age: float, counts: bool
) -> None:
    assert (CommandExpiry().fault(client, NOW, NOW - age, rest=False) == "") == counts


@pytest.mark.parametrize(("age", "counts"), [(VALID_TIME - 1e-6, True), (VALID_TIME + 0.01, False)])
def test_one_to_rest_counts_for_three_tenths_of_a_second(
    client: FakeClient, age: float, counts: bool
) -> None:
    assert (CommandExpiry().fault(client, NOW, NOW - age, rest=True) == "") == counts


@pytest.mark.parametrize("stamp", [None, math.nan])
def test_one_that_is_not_stamped_counts_while_the_link_shows_that_it_cannot_be_old(
    client: FakeClient, stamp: float | None
) -> None:
    client.answered = NOW - MAX_UNSTAMPED_AGE + 0.01
    assert CommandExpiry().fault(client, NOW, stamp, rest=False) == ""
    client.answered = NOW - 3.0
    said = "A drive command was dropped: it has no stamp and may be 3.0 s old; 0.7 s is allowed."
    assert CommandExpiry().fault(client, NOW, stamp, rest=False) == said


def test_a_zero_that_is_not_stamped_is_as_right_late_as_in_time(client: FakeClient) -> None:
    client.answered = NOW - 60.0
    assert CommandExpiry().fault(client, NOW, None, rest=True) == ""


def test_who_went_leaves_no_order_behind(client: FakeClient) -> None:
    expiry = CommandExpiry()
    assert expiry.fault(client, NOW, NOW, rest=False) == ""
    assert "a newer one came before it" in expiry.fault(client, NOW, NOW, rest=False)
    expiry.forget(client)
    assert expiry.fault(client, NOW, NOW, rest=False) == ""


def test_who_went_leaves_no_clock_behind(client: FakeClient) -> None:
    expiry = CommandExpiry()
    expiry.fault(client, NOW, NOW + 0.5, rest=False)
    expiry.forget(client)
    assert expiry.given(client, NOW, NOW) == NOW


@pytest.mark.parametrize("ahead", [0.2, 0.9])
def test_of_a_clock_that_is_ahead_what_waited_is_late_all_the_same(client: FakeClient, ahead: float) -> None:
    expiry = CommandExpiry()
    assert expiry.fault(client, NOW, NOW + ahead, rest=False) == ""
    assert expiry.given(client, NOW, NOW + ahead) == pytest.approx(NOW)
    assert expiry.fault(client, NOW + 0.3, NOW + 0.1 + ahead, rest=False) == ""
    assert expiry.given(client, NOW + 0.3, NOW + 0.1 + ahead) == pytest.approx(NOW + 0.1, abs=0.01)
    said = expiry.fault(client, NOW + 0.5, NOW + 0.15 + ahead, rest=False)
    assert said == "A drive command was dropped: it came 0.3 s late and has to come within 0.25 s."


def test_what_comes_over_a_slow_way_was_given_before_its_clock_says_so(client: FakeClient) -> None:
    expiry = CommandExpiry()
    client.rtt = 0.2
    assert expiry.fault(client, NOW, NOW, rest=False) == ""
    assert expiry.given(client, NOW, NOW) == pytest.approx(NOW - 0.1)
    client.rtt = 3.0  # for a moment: the quickest way is what counts
    assert expiry.fault(client, NOW + 0.05, NOW + 0.05, rest=False) == ""
    assert expiry.given(client, NOW + 0.05, NOW + 0.05) == pytest.approx(NOW - 0.05)


def test_a_right_clock_is_believed_over_a_slow_way(client: FakeClient) -> None:
    expiry = CommandExpiry()
    client.rtt = 0.2
    assert expiry.fault(client, NOW, NOW - 0.1, rest=False) == ""
    assert expiry.given(client, NOW, NOW - 0.1) == pytest.approx(NOW - 0.1)


def test_a_clock_that_was_set_right_is_believed_again_after_a_while_but_not_for_a_silence(
    client: FakeClient,
) -> None:
    expiry = CommandExpiry()
    expiry.fault(client, NOW, NOW + 0.2, rest=False)
    assert expiry.given(client, NOW, NOW) == pytest.approx(NOW - 0.2)
    later = NOW + 60.0
    expiry.fault(client, later, later, rest=False)
    assert expiry.given(client, later, later) == pytest.approx(later - 0.2 + LEAD_DECAY)
    for second in range(1, round(0.2 / LEAD_DECAY) + 1):
        expiry.fault(client, later + second, later + second, rest=False)
    assert expiry.given(client, later, later) == pytest.approx(later)


def test_a_clock_too_far_ahead_is_refused_and_teaches_nothing(client: FakeClient) -> None:
    expiry = CommandExpiry()
    said = expiry.fault(client, NOW, NOW + MAX_CLOCK_LEAD + 0.2, rest=False)
    assert said == "A drive command was dropped: its clock is 1.2 s ahead of the robot's."
    assert expiry.given(client, NOW, NOW) == NOW


def test_nothing_was_given_later_than_it_came(client: FakeClient) -> None:
    expiry = CommandExpiry()
    assert expiry.given(client, NOW, NOW + 0.2) == NOW
    assert expiry.given(client, NOW, NOW - 0.2) == NOW - 0.2
    assert expiry.given(client, NOW, None) == NOW
