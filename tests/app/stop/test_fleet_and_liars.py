"""STOP ALL among robots of which some lie: who says to be another, or that it has stopped, keeps nobody moving."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest

from app.stop.fleet import Fleet
from app.stop.robot_count import count
from app.stop.stop_lane import Report
from bridge.client.credentials import Credentials
from bridge.msgs.std_msgs import Time
from tests.app.stop.lanes import A, B, C, Lanes, Link, heard, until

F, G = "f" * 64, "a" * 64


@pytest.fixture
def paired(lanes: Lanes) -> Iterator[Fleet]:
    """A handheld that is paired with the robot at A, whoever claims to be it."""
    keys = {A: Credentials(F), "claims F": Credentials(F)}
    fleet = Fleet(
        client_id="me",
        client_name="tablet",
        open_lane=lanes,
        credentials=lambda url, key: keys.get("claims F" if key == F[:32] else url),
        most=5,
    )
    yield fleet
    fleet.let_go()
    fleet.close()


def told(fleet: Fleet, lanes: Lanes, reports: dict[str, Report]) -> dict[str, str]:
    """Phase at each address once its lane reports that."""
    until(lambda: set(reports) <= set(lanes.open), "no lanes")
    lanes.reports = reports
    fleet.update(None)
    return {row.url: row.phase for row in fleet.rows}


@pytest.mark.parametrize("phase", ["sent", "no_answer", "moves", "lost"])
@pytest.mark.parametrize("lie", ["stopped", "released"])
def test_a_hello_with_the_boot_of_a_robot_hides_it_from_nobody_while_it_has_not_confirmed(
    fleet: Fleet, lanes: Lanes, phase: str, lie: str
) -> None:
    fleet.press([replace(heard(url), boot="b1") for url in (B, A)])
    assert told(fleet, lanes, {A: Report(phase), B: Report(lie)}) == {A: phase}
    assert (fleet.stopped, fleet.total, fleet.sending) == (0, 1, True)


def test_a_copy_of_what_a_robot_says_does_not_confirm_for_it(fleet: Fleet, lanes: Lanes) -> None:
    same = ("Boat", "minnow", Time(7, 1))
    fleet.press([heard(B), heard(A)])
    reports = {A: Report("moves", identity=same), B: Report("stopped", identity=same)}
    assert told(fleet, lanes, reports) == {A: "moves"}
    assert fleet.stopped == 0


def test_a_robot_without_a_stop_is_held_though_another_address_says_to_be_it(
    fleet: Fleet, lanes: Lanes
) -> None:
    fleet.press([replace(heard(url), boot="b1") for url in (B, A)])
    told(fleet, lanes, {A: Report("stopped", foreign=True), B: Report("stopped")})
    assert (fleet.stopped, fleet.total, fleet.sending) == (1, 1, True)


def test_a_paired_robot_is_stopped_only_where_it_proved_its_key(paired: Fleet, lanes: Lanes) -> None:
    paired.press([heard(A, "Boat")])
    assert told(paired, lanes, {A: Report("stopped")}) == {A: "no_answer"}
    assert (lanes.pinned, paired.stopped, paired.sending) == ({A: Credentials(F)}, 0, True)
    assert paired.rows[0].sentence == "It has not proved to be your paired robot."
    assert told(paired, lanes, {A: Report("stopped", proven=G)}) == {A: "no_answer"}
    assert told(paired, lanes, {A: Report("stopped", proven=F)}) == {A: "stopped"}


def test_addresses_that_proved_one_key_are_one_robot_and_what_it_says_there_counts(
    paired: Fleet, lanes: Lanes
) -> None:
    paired.press([heard(A), replace(heard(B), key=F[:32])])
    told(paired, lanes, {A: Report("stopped", proven=F), B: Report("sent")})
    assert (paired.stopped, paired.total) == (1, 2), "B only claims it"
    told(paired, lanes, {A: Report("stopped", proven=F), B: Report("sent", proven=F)})
    assert (paired.stopped, paired.total) == (1, 1)


def test_who_proves_nothing_is_never_one_with_who_proved_a_key(paired: Fleet, lanes: Lanes) -> None:
    same = ("Boat", "minnow", Time(7, 1))
    paired.press([replace(heard(url), boot="b1") for url in (A, B)])
    reports = {A: Report("stopped", identity=same, proven=F), B: Report("moves", identity=same)}
    assert told(paired, lanes, reports) == {A: "stopped", B: "moves"}


def test_the_connected_robot_counts_by_the_key_that_its_link_saw(paired: Fleet, lanes: Lanes) -> None:
    link = Link(A)
    paired.press([], link)
    link.robot_stop.phase = "stopped"
    paired.update(link)
    assert (paired.stopped, paired.rows[0].phase) == (0, "no_answer")
    link.fingerprint = F
    paired.update(link)
    assert (paired.stopped, paired.rows[0].phase) == (1, "stopped")
    link.robot_stop.phase = "ready"
    paired.update(link)
    paired.update(None)
    assert paired.rows[0].phase == "released", "it proved its key when it was released"


def test_a_flood_of_hellos_crowds_no_robot_out(fleet: Fleet, lanes: Lanes) -> None:
    flood = [replace(heard(f"ws://10.9.0.{n}:9090"), known_for=1.0) for n in range(50)]
    saved, kept = replace(heard(A), saved=True), replace(heard(B), kept=True)
    old = replace(heard(C), known_for=60.0)
    fleet.press([*flood, saved, kept, old], Link("ws://10.0.0.9:9090"))
    urls = [row.url for row in fleet.rows]
    assert {A, B, C, "ws://10.0.0.9:9090"} <= set(urls)
    assert (len(urls), fleet.total) == (5, 54)


def test_a_saved_robot_is_stopped_though_all_places_are_taken(fleet: Fleet, lanes: Lanes) -> None:
    fleet.press([heard(f"ws://10.9.0.{n}:9090") for n in range(5)])
    fleet.press([replace(heard(A), kept=True)])
    until(lambda: A in lanes.open, "crowded out")
    assert len(fleet.rows) == 6


def test_a_claimed_boot_does_not_keep_a_robot_from_being_announced_as_new(fleet: Fleet, lanes: Lanes) -> None:
    fleet.press([replace(heard(A), boot="b2")])
    assert fleet.since([replace(heard(B), boot="b2")]) == 1


def test_what_says_to_be_a_saved_robot_is_counted_beside_it() -> None:
    saved, claim = replace(heard(A), boot="b1", kept=True), replace(heard(B), boot="b1")
    assert count([saved, claim], None).robots == 2
