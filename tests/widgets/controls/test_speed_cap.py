from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import ControlStatus
from robotside.control.latency_speed_cap import share
from widgets.controls.speed_cap import SpeedCap

SLOW = ControlStatus(speed_cap=0.4)


@pytest.fixture
def cap(stage):
    cap = SpeedCap(size_hint=(None, None), width=420)
    stage.show(cap)
    cap.asked = []
    cap.bind(on_command=lambda _, value: cap.asked.append(value))
    return cap


def tap(stage, cap):
    stage.run_for(0.7)
    stage.tap(*cap.switch.to_window(*cap.switch.center))
    stage.frames(2)


def test_at_full_speed_that_follows_the_link_there_is_nothing_to_say(cap):
    cap.show(ControlStatus())
    assert not cap.open


def test_share_and_why_are_said(cap):
    cap.rtt = 0.32
    cap.show(SLOW)
    assert (cap.open, cap.headline, cap.said) == (True, "40 % speed", "Slow link, 320 ms.")
    cap.rtt = 0.05  # the share rises slowly after the link has healed
    assert cap.said == "The robot measured 341 ms a moment ago."
    cap.driver = "Anna"
    assert cap.said == "Slow link of Anna."


def test_that_it_is_off_is_said_on_any_link(cap):
    cap.show(ControlStatus(follows_link=False))
    assert (cap.open, cap.headline, cap.said) == (True, "Full speed always", "On a slow link as well.")
    cap.rtt = 0.32
    assert cap.said == "Slow link, 320 ms."


def test_it_is_switched_off_and_on_and_shown_so_when_the_robot_says_so(stage, cap):
    cap.show(SLOW)
    tap(stage, cap)
    tap(stage, cap)
    assert (cap.asked, cap.headline) == (["off"], "40 % speed")
    cap.show(ControlStatus(follows_link=False))
    tap(stage, cap)
    assert cap.asked == ["off", "on"]


def test_a_switch_that_failed_can_be_pressed_again(stage, cap):
    cap.show(SLOW)
    tap(stage, cap)
    cap.answer("refused")
    tap(stage, cap)
    assert cap.asked == ["off", "off"]


def test_who_does_not_drive_cannot_switch_it(stage, cap):
    cap.show(SLOW)
    cap.blocked = True
    tap(stage, cap)
    assert cap.asked == []


def test_a_link_that_is_fast_here_is_said_to_be_slow_as_the_robot_measures_it(cap):
    cap.show(ControlStatus(speed_cap=0.2))
    cap.rtt = 0.063
    assert cap.said == "The robot measured 388 ms a moment ago."
    cap.show(ControlStatus(speed_cap=0.15))
    assert cap.said == "The robot measured 400 ms or more a moment ago."
    cap.show(ControlStatus(follows_link=False))
    assert cap.said == "On a slow link as well."


def test_a_cap_that_nobody_would_notice_is_not_said_as_100_percent(cap):
    cap.show(ControlStatus(speed_cap=0.996))
    assert not cap.open


@pytest.mark.parametrize("rtt", [0.21, 0.25, 0.3, 0.39])
def test_the_robots_figure_is_the_one_that_its_share_comes_from(cap, rtt):
    cap.rtt = 0.01
    cap.show(ControlStatus(speed_cap=share(rtt)))
    assert cap.measured == f"{rtt * 1000:.0f} ms"


def test_a_card_that_goes_never_says_full_speed_as_if_it_were_a_limit(cap):
    cap.rtt = 0.01
    cap.show(SLOW)
    cap.show(ControlStatus(speed_cap=1.0))
    cap.rtt = 0.02
    assert (cap.open, cap.headline) == (False, "40 % speed")
