"""What a link's other end is, and whether it still lives."""

from __future__ import annotations

import pytest

from bridge.client.liveness import Liveness
from bridge.core.address import LinkLost


def life(ours: bool = False) -> Liveness:
    return Liveness("boat:9090", ours, 0.0)


def kept_alive(one: Liveness, until: float) -> None:
    """Something comes twice a second, and it is looked at each time."""
    for step in range(1, round(until / 0.5) + 1):
        one.on_message(step * 0.5)
        one.check(step * 0.5)


def test_silence_of_three_seconds_is_the_end():
    one = life(ours=True)
    one.on_time(known=True)
    one.on_message(1.0)
    one.check(3.9)
    with pytest.raises(LinkLost, match=r"^Nothing came from boat:9090 for 3 s\.$"):
        one.check(4.0)


def test_after_a_change_of_the_network_one_second_is_enough():
    one = life(ours=True)
    one.on_time(known=True)
    one.on_message(1.0)
    one.alert(1.2)
    one.alert(2.1)
    one.check(2.1)
    with pytest.raises(LinkLost, match="Nothing came from boat:9090 after the network changed"):
        one.check(2.2)


def test_a_link_that_goes_on_after_a_change_is_left_alone():
    one = life(ours=True)
    one.on_time(known=True)
    one.alert(1.0)
    one.on_message(1.5)
    one.check(3.0)
    with pytest.raises(LinkLost, match="for 3 s"):
        one.check(4.6)


@pytest.mark.parametrize("known", [True, False])
def test_who_answers_the_question_for_the_time_is_a_robot(known):
    one = life()
    assert not one.robot
    one.on_time(known)
    assert one.robot
    assert one.tells_time is known


def test_our_own_server_is_none_before_it_told_its_time():
    one = life(ours=True)
    one.on_answer()
    one.on_pong(0.5)
    with pytest.raises(LinkLost, match="is a WebSocket but no robot: it did not answer within 3 s"):
        kept_alive(one, 3.0)
    assert not one.robot


def test_a_foreign_server_that_answers_something_else_is_a_robot_after_a_second_in_which_it_might_tell_its_time():
    one = life()
    one.on_answer()
    kept_alive(one, 0.5)
    assert not one.robot
    kept_alive(one, 1.0)
    assert one.robot


def test_a_foreign_server_that_answers_nothing_but_pings_is_one_after_three_seconds():
    one = life()
    one.on_pong(0.1)
    kept_alive(one, 2.5)
    assert not one.robot
    kept_alive(one, 3.0)
    assert one.robot


def test_not_even_pings_make_a_robot_of_what_sends_something_strange():
    one = life()
    one.on_pong(0.1)
    one.on_strange()
    with pytest.raises(LinkLost, match="is a WebSocket but no robot"):
        kept_alive(one, 3.0)


def test_without_pongs_what_comes_is_not_enough():
    with pytest.raises(LinkLost, match="is a WebSocket but no robot"):
        kept_alive(life(), 3.0)


def test_what_is_sent_after_a_second_of_silence_may_be_late():
    one = life()
    one.on_message(5.0)
    assert not one.is_late(6.0)
    assert one.is_late(6.1)


def asked(one: Liveness, beats: int) -> list[int]:
    return [beat for beat in range(beats) if one.should_ask_time()]


def test_ours_is_asked_for_its_time_with_every_ping():
    assert asked(life(ours=True), 5) == [0, 1, 2, 3, 4]


def test_a_foreign_server_is_asked_for_its_time_every_other_second_if_it_tells_it_and_seldom_if_not():
    telling, silent, refusing = life(), life(), life()
    telling.on_time(known=True)
    refusing.on_time(known=False)
    assert asked(telling, 10) == [0, 4, 8]
    assert asked(refusing, 50) == [0, 20, 40]
    assert asked(silent, 50) == [0, 1, 2, 3, 20, 40]
