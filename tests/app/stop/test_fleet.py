"""STOP ALL: who is stopped, by which way, and how many are."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from dataclasses import replace

import pytest

from app.discovery.known_robots import Entry
from app.stop.fleet import HEAD_START, Fleet
from app.stop.robot_count import count
from app.stop.stop_lane import Report
from bridge.msgs.pilothouse_msgs import ControlStatus
from bridge.msgs.std_msgs import Time
from tests.app.stop.lanes import PATIENCE, A, B, C, Lane, Lanes, Link, heard, phases, until

# who is stopped, and by which way


def test_each_robot_gets_a_lane_and_the_connected_one_its_own_link(fleet: Fleet, lanes: Lanes) -> None:
    link = Link(A)
    fleet.press([heard(A, "Linked"), heard(B, "Boat"), heard(C, "Truck")], link)
    until(lambda: len(lanes.open) == 2, "no lanes")
    assert (link.stops, set(lanes.open)) == (1, {B, C})
    assert phases(fleet, link) == {"Linked": "sent", "Boat": "sent", "Truck": "sent"}


def test_the_link_is_told_before_anything_else_happens(fleet: Fleet, lanes: Lanes) -> None:
    link, order = Link(A), []
    link.stop = lambda: order.append("link")  # type: ignore[method-assign]

    def others() -> Iterator[Entry]:
        order.append("others")
        yield heard(B)

    fleet.press(others(), link)
    assert (order, lanes.pressed) == (["link", "others"], {}), "the others wait for its head start"
    until(lambda: B in lanes.open, "no lane")


def test_what_is_let_go_before_its_turn_is_never_begun(fleet: Fleet, lanes: Lanes) -> None:
    fleet.press([heard(B)], Link(A))
    fleet.let_go()
    assert fleet._lanes._network is not None
    fleet._lanes._network.start(asyncio.sleep(2 * HEAD_START)).result(PATIENCE)  # its turn was before
    assert lanes.pressed == {}


def test_it_counts_who_says_that_it_is_stopped(fleet: Fleet, lanes: Lanes) -> None:
    link = Link(A)
    fleet.press([heard(B, "Boat"), heard(C, "Truck")], link)
    until(lambda: len(lanes.open) == 2, "no lanes")
    lanes.reports = {B: Report("stopped"), C: Report("no_answer", "No robot answers.")}
    link.robot_stop.phase = "stopped"
    fleet.update(link)
    assert (fleet.stopped, fleet.total, fleet.sending) == (2, 3, True)
    lanes.reports[C] = Report("stopped")
    fleet.update(link)
    assert (fleet.stopped, fleet.sending) == (3, False)
    lanes.reports[C] = Report("stopped", foreign=True)
    fleet.update(link)
    assert fleet.sending, "a robot without a STOP is held for as long as zero speed is sent"


@pytest.mark.parametrize(
    ("silent", "sentence"),
    [
        (0.4, "No reply."),
        (180.0, "Not heard for 3 min. No reply."),
        (float("nan"), "Never heard here. No reply."),
    ],
)
def test_saved_robots_are_tried_too_and_it_says_how_long_they_were_not_heard(
    fleet: Fleet, lanes: Lanes, silent: float, sentence: str
) -> None:
    lanes.reports[B] = Report("no_answer", "No reply.")
    fleet.press([replace(heard(B, "Boat", silent), saved=True)])
    until(lambda: B in lanes.open, "no lane")
    fleet.update(None)
    assert fleet.rows[0].sentence == sentence
    lanes.reports[B] = Report("stopped", "", reached=True)
    fleet.update(None)
    assert fleet.rows[0].sentence == "", "it was heard now"


def test_a_second_press_presses_each_again_and_adds_who_came_meanwhile(fleet: Fleet, lanes: Lanes) -> None:
    fleet.press([heard(A)])
    fleet.press([heard(A), heard(B)])
    until(lambda: lanes.pressed == {A: 2, B: 1}, "not pressed")
    assert fleet.total == 2


def test_more_than_can_be_stopped_at_once_are_counted_and_not_forgotten(fleet: Fleet, lanes: Lanes) -> None:
    fleet.press([heard(f"ws://10.0.1.{n}:9090") for n in range(8)])
    assert (len(fleet.rows), fleet.untried, fleet.total) == (5, 3, 8)


def test_letting_go_ends_every_lane(fleet: Fleet, lanes: Lanes) -> None:
    fleet.press([heard(A), heard(B)])
    until(lambda: len(lanes.open) == 2, "no lanes")
    fleet.let_go()
    until(lambda: not lanes.open, "they go on")
    assert (fleet.active, fleet.rows, fleet.total) == (False, [], 0)


def test_letting_go_waits_for_no_lane(fleet: Fleet, lanes: Lanes) -> None:
    lanes.may_end.clear()
    fleet.press([heard(A), heard(B)])
    until(lambda: len(lanes.open) == 2, "no lanes")
    fleet.let_go()
    assert set(lanes.open) == {A, B}, "it returned only after their end"
    lanes.may_end.set()
    until(lambda: not lanes.open, "they go on")


# one robot under two addresses


def test_one_robot_under_two_addresses_is_stopped_at_both_and_counted_once(
    fleet: Fleet, lanes: Lanes
) -> None:
    one, other = ("Boat", "minnow", Time(7, 1)), ("Boat", "minnow", Time(7, 2))
    fleet.press([heard(A, "Boat"), heard(B, "Boat"), heard(C, "Boat")])
    until(lambda: len(lanes.open) == 3, "no lanes")
    lanes.reports = {
        A: Report("sent", identity=one),
        B: Report("stopped", identity=one),
        C: Report("stopped", identity=other),
    }
    fleet.update(None)
    assert (fleet.stopped, fleet.total) == (1, 2), "what one address says does not confirm for the other"
    assert [(row.also, row.phase) for row in fleet.rows] == [(1, "sent"), (0, "stopped")]
    lanes.reports[A] = Report("no_answer", identity=("Boat", "minnow", Time(6, 0)))
    fleet.update(None)
    assert fleet.total == 2, "what was one robot once is one"


def test_the_connected_robot_is_not_counted_again_under_another_address(fleet: Fleet, lanes: Lanes) -> None:
    link = Link("ws://localhost:9090")
    link.control_status = ControlStatus(stamp=Time(7, 1), stopped=True)
    fleet.press([heard(A, "Linked")], link)
    until(lambda: A in lanes.open, "no lane")
    lanes.reports[A] = Report("stopped", identity=("Linked", "patrol", Time(7, 1)))
    link.robot_stop.phase = "stopped"
    fleet.update(link)
    assert (fleet.stopped, fleet.total) == (1, 1)


def test_what_moves_at_one_address_is_not_stopped_because_another_says_so(fleet: Fleet, lanes: Lanes) -> None:
    same = ("Boat", "minnow", Time(7, 1))
    lanes.reports = {A: Report("stopped", identity=same), B: Report("moves", identity=same)}
    fleet.press([heard(A), heard(B)])
    until(lambda: len(lanes.open) == 2, "no lanes")
    fleet.update(None)
    assert (fleet.stopped, fleet.total) == (0, 1)


def test_one_robot_that_says_hello_from_two_addresses_is_counted_once(fleet: Fleet, lanes: Lanes) -> None:
    link = Link("ws://localhost:9090")
    link.boot = "log of the boat"
    entries = [replace(heard(url, "Boat"), boot="log of the boat") for url in (A, B)]
    assert count(entries, None).robots == count(entries, link).robots == 1
    assert count([*entries, heard(C)], link).robots == 2
    fleet.press(entries[:1], link)
    assert fleet.since(entries) == 0, "it is the one that is stopped"
    assert fleet.since([*entries, heard(C)]) == 1
    fleet.press(entries, link)
    until(lambda: set(lanes.open) == {A, B}, "not tried at every address")
    fleet.update(link)
    assert fleet.total == 1


def test_it_says_of_the_connected_robot_what_its_session_says(fleet: Fleet) -> None:
    link = Link(A)
    fleet.press([], link)
    link.robot_stop.phase, link.robot_stop.sentence = (
        "moves",
        "STOP is pressed, and it does not come to rest.",
    )
    fleet.update(link)
    assert (fleet.rows[0].phase, fleet.rows[0].sentence) == (link.robot_stop.phase, link.robot_stop.sentence)


def test_a_lane_that_the_network_thread_takes_away_meanwhile_was_there_or_not(fleet: Fleet) -> None:
    class Robot:
        """Its lane is gone when it is looked at again."""

        url, name, heard, boot, boot_by_link, last, credentials = A, "Boat", "", "", "", None, None
        met = True

        def __init__(self) -> None:
            self.lanes = [Lane(Lanes(), A)]

        @property
        def lane(self) -> Lane | None:
            return self.lanes.pop() if self.lanes else None

    fleet._robots = {A: Robot()}  # type: ignore[dict-item]
    seen = fleet._seen(fleet._robots[A], None)
    fleet._robots = {}
    assert seen.row.url == A


# while robots are connected and left


def test_who_leaves_a_robot_whose_stop_is_under_way_goes_on_stopping_it(fleet: Fleet, lanes: Lanes) -> None:
    link = Link(A)
    fleet.press([], link)
    fleet.update(link)
    assert not lanes.open
    fleet.update(None)
    until(lambda: A in lanes.open, "nobody stops it any more")


def test_one_whose_stop_was_released_is_not_stopped_anew_by_leaving_it(fleet: Fleet, lanes: Lanes) -> None:
    link = Link(A)
    fleet.press([heard(B)], link)
    link.robot_stop.phase = "stopped"
    fleet.update(link)
    link.robot_stop.phase = "ready"
    assert phases(fleet, link)["Linked"] == "released"
    assert phases(fleet, None)["Linked"] == "released"
    until(lambda: B in lanes.open, "no lane")
    assert A not in lanes.open


def test_a_stop_that_has_not_begun_to_show_is_sent_and_not_released(fleet: Fleet) -> None:
    link = Link(A)
    link.stop = lambda: None  # type: ignore[method-assign]
    fleet.press([], link)
    assert phases(fleet, link) == {"Linked": "sent"}


def test_a_robot_without_a_stop_goes_over_to_its_link_where_it_can_be_released(
    fleet: Fleet, lanes: Lanes
) -> None:
    fleet.press([heard(A), heard(B)])
    until(lambda: len(lanes.open) == 2, "no lanes")
    link = Link(A, foreign=True)
    fleet.update(link)
    until(lambda: set(lanes.open) == {B}, "its lane still says zero")
    assert link.stops == 1
    link.robot_stop.phase = "ready"
    assert phases(fleet, link)["Linked"] == "released"


# a robot that was left before it confirmed its STOP


def left(fleet: Fleet, lanes: Lanes, phase: str = "no_answer", *, foreign: bool = False) -> Link:
    """STOP was pressed at one robot alone, and it was left; its lane says `phase`."""
    link = Link(A, foreign=foreign)
    link.stop()
    assert fleet.leave(link), "forgotten"
    until(lambda: A in lanes.open, "nobody stops it any more")
    lanes.reports[A] = Report(phase, foreign=foreign)
    return link


@pytest.mark.parametrize("phase", ["sent", "no_answer", "moves"])
def test_one_that_is_left_before_it_confirmed_its_own_stop_goes_on_being_stopped(
    fleet: Fleet, lanes: Lanes, phase: str
) -> None:
    link = Link(A)
    link.robot_stop.phase = phase
    assert fleet.leave(link)
    until(lambda: A in lanes.open, "nobody stops it any more")
    lanes.reports[A] = Report("no_answer", "No robot answers.")
    assert phases(fleet) == {"Linked": "no_answer"}
    assert (fleet.sending, fleet.stopped, fleet.total) == (True, 0, 1)
    assert (fleet.meant_all, fleet.since([heard(A), heard(B)])) == (False, 0), "STOP ALL was not pressed"
    lanes.reports[A] = Report("stopped")
    assert phases(fleet) == {"Linked": "stopped"}
    assert not fleet.sending


@pytest.mark.parametrize("phase", ["ready", "stopped", "lost"])
def test_one_that_was_released_or_has_confirmed_is_left_to_itself(
    fleet: Fleet, lanes: Lanes, phase: str
) -> None:
    link = Link(A)
    link.robot_stop.phase = phase
    assert not fleet.leave(link)
    assert (fleet.active, lanes.pressed) == (False, {})


def test_the_same_robot_opened_again_has_one_who_stops_it_and_may_release_it(
    fleet: Fleet, lanes: Lanes
) -> None:
    left(fleet, lanes)
    again = Link(A)
    again.connected = False
    assert phases(fleet, again) == {"Linked": "no_answer"}, "nobody says so while it is not there"
    assert (again.stops, set(lanes.open)) == (0, {A})
    again.connected = True
    assert phases(fleet, again) == {}
    until(lambda: not lanes.open, "two stop it, and one of them knows of no release")
    assert again.stops == 1
    again.robot_stop.phase = "ready"
    assert not fleet.leave(again)
    assert (fleet.active, lanes.pressed) == (False, {A: 1})


@pytest.mark.parametrize("phase", ["stopped", "released", "lost"])
def test_what_it_confirmed_meanwhile_is_not_sent_again_when_it_is_opened(
    fleet: Fleet, lanes: Lanes, phase: str
) -> None:
    left(fleet, lanes, phase)
    again = Link(A)
    assert phases(fleet, again) == {}
    assert again.stops == 0


def test_the_link_that_was_left_takes_nothing_back(fleet: Fleet, lanes: Lanes) -> None:
    """The app was put away: its session still says that it is connected, and its link is closed."""
    link = left(fleet, lanes)
    assert phases(fleet, link) == {"Linked": "no_answer"}
    link.link = object()
    assert phases(fleet, link) == {}
    assert link.stops == 2


def test_a_robot_without_a_stop_is_held_until_its_link_holds_it(fleet: Fleet, lanes: Lanes) -> None:
    left(fleet, lanes, "stopped", foreign=True)
    again = Link(A)
    assert phases(fleet, again) == {"Linked": "stopped"}, "it is not known yet that its link has to hold it"
    again.robot.foreign = True
    assert phases(fleet, again) == {}
    assert again.stops == 1
    until(lambda: not lanes.open, "its lane still says zero")


def test_stop_all_means_who_was_left_too_and_keeps_it(fleet: Fleet, lanes: Lanes) -> None:
    left(fleet, lanes)
    fleet.press([heard(A), heard(B)])
    until(lambda: lanes.pressed == {A: 2, B: 1}, "not pressed")
    assert (fleet.meant_all, fleet.total) == (True, 2)
    fleet.update(Link(A))
    assert fleet.total == 2


def test_a_stop_of_its_own_after_stop_all_is_sent_anew_over_its_lane(fleet: Fleet, lanes: Lanes) -> None:
    fleet.press([heard(A)])
    until(lambda: A in lanes.open, "no lane")
    lanes.reports[A] = Report("released")
    link = Link(A)
    fleet.update(link)
    link.stop()
    assert fleet.leave(link)
    until(lambda: lanes.pressed == {A: 2}, "not pressed")
    assert fleet.meant_all


def test_a_stop_pressed_after_a_release_and_left_at_once_is_not_taken_for_released(
    fleet: Fleet, lanes: Lanes
) -> None:
    link = Link(A)
    fleet.press([], link)
    link.robot_stop.phase = "ready"
    assert phases(fleet, link) == {"Linked": "released"}
    link.stop()
    assert fleet.leave(link)
    until(lambda: A in lanes.open, "nobody stops it any more")


# what is no robot


def mistyped(url: str) -> Entry:
    """An address that was saved and where nothing ever answered."""
    return Entry(url, "", saved=True, kept=True, met=False)


def test_an_address_where_nothing_was_ever_met_gets_stop_and_is_not_counted(
    fleet: Fleet, lanes: Lanes
) -> None:
    entries = [heard(A, "Boat"), mistyped(B)]
    assert count(entries, None).robots == 1
    fleet.press(entries)
    until(lambda: set(lanes.open) == {A, B}, "not tried")
    lanes.reports = {A: Report("stopped", reached=True), B: Report("no_answer", "No reply.")}
    assert phases(fleet) == {"Boat": "stopped"}
    assert (fleet.stopped, fleet.total, fleet.unmet, fleet.sending) == (1, 1, 1, False)


def test_who_answers_at_such_an_address_is_a_robot_from_then_on(fleet: Fleet, lanes: Lanes) -> None:
    fleet.press([mistyped(B)])
    until(lambda: B in lanes.open, "not tried")
    lanes.reports[B] = Report("sent", reached=True, name="Boat")
    fleet.update(None)
    assert (fleet.total, fleet.unmet) == (1, 0)
    lanes.reports[B] = Report("no_answer", "No reply.")
    fleet.update(None)
    assert (fleet.total, fleet.unmet) == (1, 0), "it is lost, and still a robot"


@pytest.mark.parametrize(
    "entry",
    [
        Entry(B, "Boat", saved=True, kept=True),
        replace(heard(B, "Boat", 3600.0), saved=True),
        heard(B, "Boat", 40.0),
    ],
    ids=["of an earlier day", "silent for an hour", "silent and not saved"],
)
def test_a_robot_that_was_met_and_is_lost_is_tried_and_counted(
    fleet: Fleet, lanes: Lanes, entry: Entry
) -> None:
    assert count([entry], None).robots == 1
    fleet.press([entry])
    until(lambda: B in lanes.open, "not tried")
    lanes.reports[B] = Report("no_answer", "No reply.")
    assert phases(fleet) == {"Boat": "no_answer"}
    assert (fleet.stopped, fleet.total, fleet.unmet) == (0, 1, 0)


def test_a_link_to_a_mistyped_address_is_told_and_not_counted_until_a_robot_answers(fleet: Fleet) -> None:
    link = Link(A)
    link.ever_connected = link.connected = False
    assert count([], link).robots == 0
    fleet.press([], link)
    fleet.update(link)
    assert (link.stops, fleet.total, fleet.unmet) == (1, 0, 1)
    link.ever_connected = link.connected = True
    fleet.update(link)
    assert (fleet.total, fleet.unmet) == (1, 0)
    link.connected = False
    fleet.update(link)
    assert (fleet.total, fleet.unmet) == (1, 0)
