"""STOP ALL: who is stopped, by which way, and how many are."""

from __future__ import annotations

import asyncio
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from app.discovery.known_robots import Entry
from app.stop.fleet import HEAD_START, Fleet, known
from app.stop.stop_lane import Report
from bridge.client.credentials import Credentials
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import ControlStatus, RobotInfo
from bridge.msgs.std_msgs import Time
from tests.app.fakes import FakeRobot
from tests.app.strange import strange_robot

PATIENCE = 10.0
"""A fault, not a delay, uses this up [s]."""
A, B, C = "ws://10.0.0.1:9090", "ws://10.0.0.2:9090", "ws://10.0.0.3:9090"


def until(condition: Callable[[], Any], what: str) -> None:
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.005)


class Lanes:
    """Lanes that do what a test tells them, by address."""

    def __init__(self) -> None:
        self.reports: dict[str, Report] = {}
        self.open: dict[str, _Lane] = {}
        self.pressed: dict[str, int] = {}
        self.pinned: dict[str, Credentials | None] = {}
        self.may_end = threading.Event()
        self.may_end.set()

    def __call__(self, url: str, credentials: Credentials | None = None) -> _Lane:
        self.pinned[url] = credentials
        self.pressed[url] = self.pressed.get(url, 0) + 1
        return _Lane(self, url)


class _Lane:
    def __init__(self, lanes: Lanes, url: str) -> None:
        self._lanes, self._url = lanes, url

    @property
    def report(self) -> Report:
        return self._lanes.reports.get(self._url, Report("sent"))

    def press(self) -> None:
        self._lanes.pressed[self._url] += 1

    async def run(self) -> None:
        self._lanes.open[self._url] = self
        try:
            await asyncio.Event().wait()
        finally:
            if not self._lanes.may_end.is_set():
                await asyncio.to_thread(self._lanes.may_end.wait)
            del self._lanes.open[self._url]


class Link:
    """The session with the robot that is connected."""

    def __init__(self, url: str, *, foreign: bool = False) -> None:
        info = RobotInfo(name="Linked", model="patrol")
        self.robot = SimpleNamespace(url=url, name="Linked", foreign=foreign, info=info)
        self.boot, self.fingerprint, self.control_status = "", "", ControlStatus()
        self.robot_stop = SimpleNamespace(phase="ready", sentence="")
        self.stops = 0

    def stop(self) -> None:
        self.stops += 1
        self.robot_stop.phase = "sent"


@pytest.fixture
def lanes() -> Lanes:
    return Lanes()


@pytest.fixture
def fleet(lanes: Lanes) -> Iterator[Fleet]:
    fleet = Fleet(client_id="me", client_name="tablet", open_lane=lanes, most=5)
    yield fleet
    fleet.let_go()
    fleet.close()
    assert not lanes.open


@pytest.fixture
def real() -> Iterator[Fleet]:
    fleet = Fleet(client_id="me", client_name="tablet")
    yield fleet
    fleet.close()
    assert not any(thread.name == "STOP ALL" for thread in threading.enumerate())


def heard(url: str, name: str = "", silent: float = 0.2) -> Entry:
    return Entry(url, name, silent=silent)


def phases(fleet: Fleet, connected: Any = None) -> dict[str, str]:
    fleet.update(connected)
    return {row.name: row.phase for row in fleet.rows}


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
    assert fleet._network is not None
    fleet._network.start(asyncio.sleep(2 * HEAD_START)).result(PATIENCE)  # its turn was before
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
    assert known(entries, None) == known(entries, link) == 1
    assert known([*entries, heard(C)], link) == 2
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

        def __init__(self) -> None:
            self.lanes = [_Lane(Lanes(), A)]

        @property
        def lane(self) -> _Lane | None:
            return self.lanes.pop() if self.lanes else None

    fleet._robots = {A: Robot()}  # type: ignore[dict-item]
    seen = fleet._seen(fleet._robots[A], None)
    fleet._robots = {}
    assert seen.row.url == A


# who lies


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
    assert known([saved, claim], None) == 2


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


def test_an_app_that_is_closed_right_after_the_press_leaves_it_a_moment_to_get_through() -> None:
    with fakes(1) as (robot,):
        fleet = Fleet(client_id="me", client_name="tablet")
        fleet.press([heard(robot.url)])
        fleet.close()
        assert robot.control.stopped


# over real sockets


@contextmanager
def fakes(count: int) -> Iterator[list[FakeRobot]]:
    with ExitStack() as stack:
        robots = [FakeRobot() for _ in range(count)]
        for robot in robots:
            stack.callback(robot.close)
        yield robots


def test_robots_on_the_network_are_stopped_by_who_drives_none_of_them(real: Fleet) -> None:
    with fakes(2) as robots:
        real.press(heard(robot.url) for robot in robots)
        until(lambda: (real.update(None), real.stopped == 2)[1], "not stopped")  # type: ignore[func-returns-value]
        assert [robot.services() for robot in robots] == [["/stop"], ["/stop"]]
        assert [robot.control.stopped for robot in robots] == [True, True]
        assert all(robot.asked[0][1].client_name == "tablet" for robot in robots)


def test_one_that_is_switched_on_later_is_stopped_then(real: Fleet) -> None:
    with fakes(2) as (here, later):
        later.stop()
        real.press([heard(here.url), heard(later.url)])
        until(lambda: (real.update(None), real.stopped == 1)[1], "not stopped")  # type: ignore[func-returns-value]
        later.start()
        until(lambda: (real.update(None), real.stopped == 2)[1], "not stopped")  # type: ignore[func-returns-value]
        assert later.control.stopped


def test_one_that_is_not_ours_gets_zero_speed_until_it_is_let_go(real: Fleet) -> None:
    with strange_robot() as strange:
        real.press([heard(strange.url)])
        until(lambda: (real.update(None), real.stopped == 1)[1], "not stopped")  # type: ignore[func-returns-value]
        assert real.rows[0].foreign
        assert real.sending
        assert "No STOP of its own" in real.rows[0].sentence
        before = strange.robot.heard
        until(lambda: strange.robot.heard > before + 2, "zero speed is sent no longer")
        told = [op for op in strange.operations("publish") if op["topic"] == "/cmd_vel"]
        assert all(Twist.planar(0.0, 0.0) == Twist() and op["msg"]["linear"]["x"] == 0 for op in told)  # type: ignore[index]
        real.let_go()
        until(lambda: not strange.clients, "what says zero speed is still there")


@contextmanager
def deaf() -> Iterator[str]:
    """An address that takes connections, and never says a word."""
    with socket.create_server(("127.0.0.1", 0), backlog=64) as listener:
        yield f"ws://127.0.0.1:{listener.getsockname()[1]}"


@contextmanager
def hole() -> Iterator[str]:
    """An address that never answers a SYN, as of a host that is switched off: its queue is full."""
    with socket.create_server(("127.0.0.1", 0), backlog=0) as listener, ExitStack() as stack:
        place = listener.getsockname()
        for _ in range(3):
            filler = stack.enter_context(socket.socket())
            filler.setblocking(False)
            filler.connect_ex(place)
        yield f"ws://127.0.0.1:{place[1]}"


def test_fifty_addresses_of_which_one_lives_hold_up_neither_the_glass_nor_that_one(
    real: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = set[int]()
    find = socket.getaddrinfo

    def noted(*args: Any, **kwargs: Any) -> Any:
        asked.add(threading.get_ident())
        return find(*args, **kwargs)

    monkeypatch.setattr(socket, "getaddrinfo", noted)
    with fakes(1) as (robot,), deaf() as silent, hole() as dead:
        entries = [heard(f"{dead}/{n}") for n in range(47)]
        entries += [heard(silent), heard("ws://no-such-robot.invalid:9090"), heard(robot.url)]
        real.press(entries)
        until(lambda: (real.update(None), real.stopped == 1)[1], "not stopped")  # type: ignore[func-returns-value]
        assert (real.stopped, real.total) == (1, 50)
        assert {row.phase for row in real.rows[:48]} == {"sent"}, "the living had to wait for the dead"
        real.let_go()
        assert threading.get_ident() not in asked, "the glass waited for the network"
