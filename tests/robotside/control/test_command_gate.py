"""Whose word moves the robot, and for how long."""

from __future__ import annotations

import math

import pytest

from bridge.core.identity import public_id
from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.control.authority import TAKEOVER_SILENCE
from robotside.control.command_expiry import HOLD_TIME, VALID_TIME
from robotside.control.command_gate import STOP_SENTENCE, CommandGate, Ruling
from robotside.control.neutral_interlock import LET_GO_SENTENCE
from tests.fakes import FakeClient

AHEAD = Twist.planar(0.3, 0.1)
REST = Twist()


@pytest.fixture
def controls() -> CommandGate:
    return CommandGate(RobotInfo(max_speed=0.7, max_yaw_rate=1.9))


@pytest.fixture
def anna() -> FakeClient:
    return FakeClient("anna", now=10.0)


@pytest.fixture
def bert() -> FakeClient:
    return FakeClient("bert", now=10.0)


def test_a_drive_command_within_the_limits_passes_unchanged(controls: CommandGate, anna: FakeClient) -> None:
    assert controls.drive(anna, AHEAD, 10.0).order == AHEAD


def test_a_drive_command_expires_after_its_validity_and_only_once(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    assert not controls.expired(10.0 + HOLD_TIME - 0.01)
    assert controls.expired(10.0 + HOLD_TIME)
    assert not controls.expired(10.0 + VALID_TIME + 1.0)


def test_a_newer_drive_command_extends_the_time(controls: CommandGate, anna: FakeClient) -> None:
    controls.drive(anna, AHEAD, 10.0)
    controls.drive(anna, AHEAD, 10.2)
    assert not controls.expired(10.4)
    assert controls.expired(10.5)


def test_the_first_valid_drive_command_takes_free_control(controls: CommandGate, anna: FakeClient) -> None:
    controls.introduce(anna, "tablet-1", "Anna's tablet")
    controls.drive(anna, AHEAD, 10.0)
    driver = controls.driver
    assert driver is not None
    assert (driver.client_id, driver.name) == (public_id("tablet-1"), "Anna's tablet")


def test_somebody_else_is_refused_with_the_drivers_name(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.introduce(anna, "tablet-1", "Anna's tablet")
    controls.acquire(anna, 10.0)
    ruling = controls.drive(bert, AHEAD, 10.0)
    assert ruling.order is None
    assert ruling.said.startswith("Anna's tablet has control")
    assert controls.dropped == 1


def test_a_refused_command_does_not_keep_the_robot_moving(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    controls.drive(bert, AHEAD, 10.29)
    assert controls.expired(10.0 + VALID_TIME)


def test_control_lapses_when_its_driver_falls_silent(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.acquire(anna, 10.0)
    assert controls.update(10.0 + CONTROL_TIMEOUT) == ""
    assert controls.acquire(bert, 10.0 + CONTROL_TIMEOUT) != ""
    assert controls.acquire(bert, 10.1 + CONTROL_TIMEOUT) == ""


def test_a_client_that_was_cut_takes_its_control_back_over_a_new_socket(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.introduce(anna, "tablet-1", "Anna")
    controls.acquire(anna, 10.0)
    controls.introduce(bert, "tablet-1", "Anna")
    bert.last_heard = 10.1 + TAKEOVER_SILENCE
    assert controls.objection(bert) == ""
    assert controls.acquire(bert, bert.last_heard) == ""
    assert not controls.on_gone(anna)
    assert controls.driver is not None


def test_two_with_the_same_id_are_two_while_both_are_heard(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.introduce(anna, "tablet-1", "Anna")
    controls.acquire(anna, 10.0)
    controls.introduce(bert, "tablet-1", "Anna")
    bert.last_heard = 10.0 + TAKEOVER_SILENCE
    said = "Anna has control over another connection with the same client_id"
    assert controls.drive(bert, AHEAD, bert.last_heard).said.startswith(f"{said}; ask there")
    assert controls.acquire(bert, bert.last_heard).startswith(said)
    assert controls.objection(bert).startswith(said)
    assert controls.release(bert) == f"{said}; only its holder can release it."
    assert controls.drive(anna, AHEAD, bert.last_heard).order == AHEAD


def test_closing_the_socket_while_driving_stops_the_robot_and_frees_control(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    assert controls.drives(anna)
    assert controls.on_gone(anna), "it had control"
    assert not controls.driving
    assert controls.driver is None
    assert not controls.expired(11.0)


def test_a_socket_that_closes_tells_whether_it_had_control_driving_or_not(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.acquire(anna, 10.0)
    assert not controls.drives(anna)
    assert controls.on_gone(anna)


def test_closing_a_watchers_socket_stops_nothing(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    assert not controls.drives(bert)
    assert not controls.on_gone(bert)
    assert controls.drives(anna)
    assert controls.driver is not None


def test_a_late_command_is_dropped_and_says_how_late(controls: CommandGate, anna: FakeClient) -> None:
    ruling = controls.drive(anna, AHEAD, 10.0, stamp=9.5)
    assert ruling.order is None
    assert "0.5 s late" in ruling.said


def test_a_command_as_old_as_allowed_passes(controls: CommandGate, anna: FakeClient) -> None:
    assert controls.drive(anna, AHEAD, 10.0, stamp=9.75).order == AHEAD


@pytest.mark.parametrize("stamp", [9.9, 9.95])
def test_a_command_that_was_overtaken_is_dropped(
    controls: CommandGate, anna: FakeClient, stamp: float
) -> None:
    controls.drive(anna, REST, 10.0, stamp=9.95)
    assert controls.drive(anna, AHEAD, 10.0, stamp=stamp).order is None


def test_each_client_has_its_own_order(controls: CommandGate, anna: FakeClient, bert: FakeClient) -> None:
    controls.drive(anna, AHEAD, 10.0, stamp=9.95)
    controls.release(anna)
    assert controls.drive(bert, AHEAD, 10.0, stamp=9.9).order == AHEAD


def test_a_command_from_a_wrong_clock_does_not_lock_its_sender_out(
    controls: CommandGate, anna: FakeClient
) -> None:
    assert "1e+308 s late" in controls.drive(anna, AHEAD, 10.0, stamp=-1e308).said
    assert "1e+308 s ahead" in controls.drive(anna, AHEAD, 10.0, stamp=1e308).said
    assert "ahead of the robot's" in controls.drive(anna, AHEAD, 10.0, stamp=99.0).said
    controls.drive(anna, REST, 10.05, stamp=10.05)
    assert controls.drive(anna, AHEAD, 10.1, stamp=10.1).order == AHEAD


@pytest.mark.parametrize("ahead", [0.1, 0.9])
def test_a_clock_that_is_ahead_lengthens_no_command(
    controls: CommandGate, anna: FakeClient, ahead: float
) -> None:
    assert controls.drive(anna, AHEAD, 10.0, stamp=10.0 + ahead).order == AHEAD
    assert controls.expired(10.0 + HOLD_TIME)


def test_what_was_under_way_for_longer_than_the_one_before_is_over_sooner(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0, stamp=10.9)
    controls.drive(anna, AHEAD, 10.25, stamp=11.0)
    assert controls.driving
    assert controls.expired(10.1 + HOLD_TIME + 0.01)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("part", range(6))
def test_a_command_with_a_speed_that_is_no_number_is_dropped(
    controls: CommandGate, anna: FakeClient, bad: float, part: int
) -> None:
    numbers = [0.1] * 6
    numbers[part] = bad
    ruling = controls.drive(anna, Twist(Vector3(*numbers[:3]), Vector3(*numbers[3:])), 10.0)
    assert ruling.order is None
    assert "not all numbers" in ruling.said
    assert controls.driver is None


def test_speeds_are_cut_to_the_limits_with_their_direction_kept(
    controls: CommandGate, anna: FakeClient
) -> None:
    twist = controls.drive(anna, Twist(Vector3(-3.0, 4.0), Vector3(0.0, 0.0, -9.0)), 10.0).order
    assert isinstance(twist, Twist)
    assert math.hypot(twist.linear.x, twist.linear.y) == pytest.approx(0.7)
    assert twist.linear.y / twist.linear.x == pytest.approx(-4 / 3)
    assert twist.angular.z == -1.9


def test_after_stop_nothing_drives_until_it_is_released(controls: CommandGate, anna: FakeClient) -> None:
    controls.drive(anna, AHEAD, 10.0)
    controls.stop("Bert")
    assert controls.drive(anna, AHEAD, 10.1).said == STOP_SENTENCE
    assert not controls.expired(11.0)
    controls.release_stop()
    controls.drive(anna, REST, 10.2)
    assert controls.drive(anna, AHEAD, 10.3).order == AHEAD


def held(
    controls: CommandGate, client: FakeClient, start: float, until: float, lag: float = 0.0
) -> list[Ruling]:
    """A stick held from `start` on, twenty times a second; each command comes `lag` later [s]."""
    moments = [start + number * 0.05 for number in range(round((until - start) / 0.05))]
    return [controls.drive(client, AHEAD, moment + lag, stamp=moment) for moment in moments]


def test_a_stick_held_from_rest_on_counts_from_its_first_command(
    controls: CommandGate, anna: FakeClient
) -> None:
    assert all(ruling.order == AHEAD for ruling in held(controls, anna, 10.0, 13.0, lag=0.2))


def test_a_stick_held_while_the_robot_was_halted_counts_again_when_it_was_at_rest(
    controls: CommandGate, anna: FakeClient
) -> None:
    held(controls, anna, 10.0, 11.0)
    controls.halt()
    after = held(controls, anna, 11.0, 15.0)
    assert {(ruling.order, ruling.said) for ruling in after} == {(None, LET_GO_SENTENCE)}
    assert not controls.driving
    controls.drive(anna, REST, 15.0, stamp=15.0)
    assert controls.drive(anna, AHEAD, 15.05, stamp=15.05).order == AHEAD


def test_no_pause_of_a_stick_stands_for_its_rest(controls: CommandGate, anna: FakeClient) -> None:
    controls.drive(anna, AHEAD, 10.0)
    controls.halt()
    for pause in (0.1, 0.5, 1.0, 60.0):
        assert controls.drive(anna, AHEAD, 10.0 + pause).said == LET_GO_SENTENCE
    controls.drive(anna, REST, 71.0)
    assert controls.drive(anna, AHEAD, 71.1).order == AHEAD


@pytest.mark.parametrize("stamped", [False, True])
@pytest.mark.parametrize("looked", [False, True])
@pytest.mark.parametrize("pause", [VALID_TIME, 0.5, 3.0, 60.0])
def test_a_client_that_fell_silent_with_a_held_stick_moves_nothing_before_it_was_at_zero(
    controls: CommandGate, anna: FakeClient, pause: float, looked: bool, stamped: bool
) -> None:
    def push(moment: float) -> Ruling:
        return controls.drive(anna, AHEAD, moment, stamp=moment if stamped else None)

    assert [push(10.0 + number / 20).order for number in range(20)] == [AHEAD] * 20
    again = 10.95 + pause
    if looked:
        assert controls.expired(again - 0.01)
    anna.last_heard = again
    after = [push(again + number / 20) for number in range(40)]
    assert {(ruling.order, ruling.said) for ruling in after} == {(None, LET_GO_SENTENCE)}
    controls.drive(anna, REST, again + 2.0, stamp=again + 2.0 if stamped else None)
    assert push(again + 2.05).order == AHEAD


def test_a_command_without_a_stamp_that_may_be_too_old_voids_the_stick(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    anna.answered = 9.0
    assert "no stamp" in controls.drive(anna, AHEAD, 10.1).said
    anna.answered = 10.2
    assert controls.drive(anna, AHEAD, 10.2).said == LET_GO_SENTENCE


def test_a_command_that_came_too_late_voids_the_stick(controls: CommandGate, anna: FakeClient) -> None:
    controls.drive(anna, AHEAD, 10.0, stamp=10.0)
    assert "late" in controls.drive(anna, AHEAD, 10.1, stamp=9.8).said
    assert controls.drive(anna, AHEAD, 10.15, stamp=10.15).said == LET_GO_SENTENCE


def test_a_command_that_comes_twice_leaves_the_stick_as_it_is(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0, stamp=10.0)
    assert controls.drive(anna, AHEAD, 10.1, stamp=10.0).order is None
    assert controls.drive(anna, AHEAD, 10.15, stamp=10.15).order == AHEAD


def test_a_stick_whose_holder_lost_control_is_let_go_before_it_drives_again(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    controls.release(anna)
    assert controls.expired(10.05), "who drove has control no longer"
    assert controls.drive(anna, AHEAD, 10.1).said == LET_GO_SENTENCE
    assert controls.drive(bert, AHEAD, 10.1).order == AHEAD


def test_a_stick_that_another_took_over_from_is_let_go_before_it_drives_again(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    controls.release(anna)
    controls.drive(bert, AHEAD, 10.02)
    controls.release(bert)
    assert controls.drive(anna, AHEAD, 10.05).said == LET_GO_SENTENCE


def test_a_stick_held_at_the_moment_of_stop_is_let_go_before_it_drives_again(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    controls.stop("Bert")
    controls.release_stop()
    assert controls.drive(anna, AHEAD, 10.05).said == LET_GO_SENTENCE


def test_an_older_stop_does_not_wind_back_when_the_latest_was_given(controls: CommandGate) -> None:
    controls.stop("Bert", given=12.0)
    controls.stop("Anna", given=11.0)
    controls.stop("Carl")
    assert controls.stop_given == 12.0


def test_a_stick_pushed_while_there_is_trouble_does_not_drive_off_when_it_ends(
    controls: CommandGate, anna: FakeClient
) -> None:
    trouble = "The robot cannot be reached."
    assert controls.drive(anna, AHEAD, 10.0, trouble=trouble).said == trouble
    assert controls.drive(anna, AHEAD, 10.05).said == LET_GO_SENTENCE
    assert controls.drive(anna, REST, 10.1, trouble=trouble) == Ruling(None)
    assert controls.drive(anna, AHEAD, 10.15).order == AHEAD


def test_a_stick_held_through_stop_does_not_drive_off_when_stop_is_released(
    controls: CommandGate, anna: FakeClient
) -> None:
    held(controls, anna, 10.0, 11.0)
    controls.stop("Bert")
    held(controls, anna, 11.0, 12.0)
    controls.release_stop()
    assert {ruling.said for ruling in held(controls, anna, 12.0, 13.0)} == {LET_GO_SENTENCE}


def test_a_stick_held_while_another_has_control_does_not_drive_off_when_he_goes(
    controls: CommandGate, anna: FakeClient, bert: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    held(controls, bert, 10.0, 11.0)
    controls.on_gone(anna)
    assert controls.drive(bert, AHEAD, 11.0, stamp=11.0).said == LET_GO_SENTENCE
    assert controls.driver is None


def test_a_stick_held_through_an_outage_of_its_link_does_not_drive_off_after_it(
    controls: CommandGate, anna: FakeClient
) -> None:
    held(controls, anna, 10.0, 11.0)
    assert controls.expired(12.0)
    held(controls, anna, 11.0, 11.2, lag=2.0)
    late = [controls.drive(anna, AHEAD, 13.2, stamp=11.2 + number * 0.05) for number in range(40)]
    assert {ruling.order for ruling in late} == {None}
    assert controls.drive(anna, AHEAD, 13.25, stamp=13.25).said == LET_GO_SENTENCE


def test_a_hiccup_of_the_link_costs_a_release_of_the_stick(controls: CommandGate, anna: FakeClient) -> None:
    held(controls, anna, 10.0, 11.0)
    assert controls.expired(11.3)
    held(controls, anna, 11.0, 11.2, lag=0.4)
    assert controls.drive(anna, AHEAD, 11.6, stamp=11.5).said == LET_GO_SENTENCE
    controls.drive(anna, REST, 11.7, stamp=11.65)
    assert controls.drive(anna, AHEAD, 11.75, stamp=11.7).order == AHEAD


def test_a_zero_that_was_overtaken_does_not_stand_for_rest(controls: CommandGate, anna: FakeClient) -> None:
    controls.drive(anna, AHEAD, 10.0, stamp=10.0)
    controls.halt()
    controls.drive(anna, REST, 10.05, stamp=9.9)
    assert controls.drive(anna, AHEAD, 10.1, stamp=10.1).said == LET_GO_SENTENCE


def test_who_went_with_a_held_stick_is_heard_at_zero_when_back(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    controls.on_gone(anna)
    again = FakeClient("anna's next connection")
    assert controls.drive(again, AHEAD, 10.1).said == LET_GO_SENTENCE
    controls.drive(again, REST, 10.2)
    assert controls.drive(again, AHEAD, 10.3).order == AHEAD


def test_a_stick_at_rest_is_not_scolded_while_stopped(controls: CommandGate, anna: FakeClient) -> None:
    controls.stop("Bert")
    ruling = controls.drive(anna, REST, 10.0)
    assert (ruling.order, ruling.said, controls.dropped) == (None, "", 0)


def test_the_first_who_pressed_stop_is_remembered(controls: CommandGate) -> None:
    controls.stop("Bert", "b")
    controls.stop("Anna", "a")
    assert (controls.stopped_by, controls.stopped_by_id) == ("Bert", "b")
    controls.release_stop()
    assert (controls.stopped_by, controls.stopped_by_id) == ("", "")


def test_a_stick_at_rest_does_not_disturb_a_robot_that_drives_itself(
    controls: CommandGate, anna: FakeClient
) -> None:
    assert controls.drive(anna, REST, 10.0, auto=True).order is None
    assert controls.driver is None
    assert controls.drive(anna, AHEAD, 10.0, auto=True).order == AHEAD


def test_only_its_holder_releases_control(controls: CommandGate, anna: FakeClient, bert: FakeClient) -> None:
    controls.acquire(anna, 10.0)
    assert "has control" in controls.release(bert)
    assert controls.release(anna) == ""
    assert controls.driver is None


def test_stop_is_latched_whoever_pressed_it_even_without_a_name() -> None:
    controls = CommandGate(RobotInfo(max_speed=1.0, max_yaw_rate=1.0))
    controls.stop("")
    assert controls.stopped
    assert controls.stopped_by == "somebody"
    controls.release_stop()
    assert (controls.stopped, controls.stopped_by) == (False, "")


FULL = Twist.planar(0.7, 0.0)


@pytest.mark.parametrize("follows", [True, False])
def test_an_operator_whose_link_is_not_measured_never_drives_at_full_speed(
    anna: FakeClient, follows: bool
) -> None:
    anna.rtt = math.nan
    controls = CommandGate(RobotInfo(max_speed=0.7, max_yaw_rate=1.9), follows=lambda: follows)
    assert controls.drive(anna, FULL, 10.0).order == Twist.planar(0.35, 0.0)
    assert controls.pace.shown == 0.5
    controls.update_speed_cap(12.0)
    controls.drive(anna, REST, 11.95)
    assert controls.drive(anna, FULL, 12.0).order == Twist.planar(0.35, 0.0), "it does not rise with time"


def test_the_cap_of_an_unmeasured_link_is_set_and_ends_with_the_first_measurement(anna: FakeClient) -> None:
    anna.rtt = math.nan
    controls = CommandGate(RobotInfo(max_speed=0.7, max_yaw_rate=1.9), unmeasured_share=0.2)
    controls.acquire(anna, 10.0)
    controls.update_speed_cap(10.0)
    assert controls.pace.share == 0.2
    anna.rtt = 0.05
    controls.update_speed_cap(12.0)
    assert controls.pace.share == 1.0
    anna.rtt = math.nan
    controls.update_speed_cap(12.1)
    assert controls.pace.share == 0.2, "it falls at once"
    controls.release(anna)
    controls.update_speed_cap(15.0)
    assert controls.pace.share == 1.0, "nobody drives"


def test_a_stick_whose_command_ran_out_is_heard_at_zero_before_it_drives_again(
    controls: CommandGate, anna: FakeClient
) -> None:
    controls.drive(anna, AHEAD, 10.0)
    assert controls.expired(10.0 + HOLD_TIME)
    assert controls.drive(anna, AHEAD, 10.0 + (HOLD_TIME + VALID_TIME) / 2) == Ruling(None, LET_GO_SENTENCE)
    controls.drive(anna, REST, 10.4)
    assert controls.drive(anna, AHEAD, 10.5).order == AHEAD
