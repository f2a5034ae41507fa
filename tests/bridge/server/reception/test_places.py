"""Places on a socket: an address or a person never takes them all, and STOP always has one."""

from __future__ import annotations

from bridge.server.reception.places import SILENT_TIMEOUT, Limits, Place, Places
from tests.bridge.wires import Clock

FLOOD, HONEST, OTHER = "192.0.2.66", "192.0.2.7", "192.0.2.8"


class Socket:
    """A listening socket, with the connections that were cut."""

    def __init__(self, **limits: int) -> None:
        self.clock = Clock()
        given = {"total": 4, "per_address": 3, "per_identity": 2, "reserve": 2} | limits
        self.places = Places(Limits(**given), self.clock)
        self.cut: list[Place] = []

    def come(self, host: str = HONEST) -> Place:
        made = self.places.arrive(host, lambda: self.cut.append(made))
        return made

    def known(self, host: str = HONEST) -> Place:
        """One that has a role by its address, and asked something."""
        made = self.come(host)
        made.meet("", proven=False)
        made.asked = True
        return made

    def proven(self, identity: str, host: str = HONEST) -> Place:
        made = self.come(host)
        made.meet(identity, proven=True)
        return made


def test_an_idle_stranger_of_the_address_with_the_most_gives_way_the_oldest_first() -> None:
    socket = Socket()
    lone = socket.come(OTHER)
    flood = [socket.come(FLOOD) for _ in range(3)]
    assert not socket.come().only_stop
    assert socket.cut == flood[:1]
    assert not lone.only_stop
    assert not socket.come().only_stop
    assert socket.cut == flood[:2]


def test_one_address_fills_its_own_share_only() -> None:
    socket = Socket()
    flood = [socket.come(FLOOD) for _ in range(20)]
    assert socket.cut == flood[:-3]
    lone = socket.come()
    assert not lone.only_stop
    assert len(socket.places) == 4


def test_one_that_is_known_and_has_asked_nothing_gives_way_as_well() -> None:
    socket = Socket(total=2)
    quiet, busy = socket.come(), socket.known()
    quiet.meet("", proven=False)
    assert not socket.come(OTHER).only_stop
    assert socket.cut == [quiet]
    assert not busy.is_idle


def test_where_everybody_is_busy_a_newcomer_gets_a_place_of_the_reserve() -> None:
    socket = Socket(total=2)
    busy = [socket.known(), socket.known()]
    late = socket.come(OTHER)
    assert late.only_stop
    assert socket.cut == []
    busy[0].leave()
    assert not socket.come(OTHER).only_stop


def test_the_reserve_goes_round_and_a_flood_gives_up_its_own_first() -> None:
    socket = Socket(total=1, reserve=3)
    socket.known()
    flood = [socket.come(FLOOD) for _ in range(3)]
    honest = socket.come()
    more = [socket.come(FLOOD) for _ in range(50)]
    assert honest.only_stop
    assert socket.cut == [*flood, *more[:-2]]


def test_a_stranger_never_takes_the_place_of_one_who_is_known_and_busy() -> None:
    socket = Socket(per_address=4)
    for _ in range(4):
        socket.known(OTHER)
    socket.clock.time += 10 * SILENT_TIMEOUT
    assert all(socket.come(f"192.0.2.{n}").only_stop for n in range(100, 110))
    assert all(cut.only_stop for cut in socket.cut)


def test_an_operator_whose_link_broke_comes_back_in_the_place_of_its_dead_connection() -> None:
    socket = Socket(total=2)
    dead, other = socket.proven("ann"), socket.proven("ben", OTHER)
    socket.clock.time += SILENT_TIMEOUT
    other.hear()
    back = socket.proven("ann", "198.51.100.3")
    assert not back.only_stop
    assert socket.cut == [dead]


def test_a_connection_that_is_alive_is_not_taken_for_a_dead_one() -> None:
    socket = Socket(total=1)
    alive = socket.proven("ann")
    socket.clock.time += SILENT_TIMEOUT - 0.1
    alive.hear()
    socket.clock.time += 0.2
    assert socket.proven("ann").only_stop
    assert socket.cut == []


def test_who_is_known_by_its_address_alone_takes_over_from_its_own_address() -> None:
    socket = Socket(total=2)
    dead, other = socket.known(), socket.known(OTHER)
    socket.clock.time += SILENT_TIMEOUT
    assert not socket.known().only_stop
    assert socket.cut == [dead]
    assert not other.only_stop


def test_one_who_is_known_gets_the_place_of_an_address_that_has_more() -> None:
    socket = Socket(total=3, per_address=3)
    many = [socket.known(FLOOD) for _ in range(3)]
    assert not socket.known().only_stop
    assert socket.cut == many[:1]
    assert not socket.known(OTHER).only_stop
    assert socket.known("192.0.2.9").only_stop  # everybody has one now


def test_a_person_has_so_many_places_and_the_quietest_goes_first() -> None:
    socket = Socket(total=10)
    first, second = socket.proven("ann"), socket.proven("ann")
    socket.clock.time += 1.0
    first.hear()
    third = socket.proven("ann")
    assert socket.cut == [second]
    assert not third.only_stop
    assert not socket.proven("ben").only_stop


def test_those_who_proved_who_they_are_do_not_count_for_their_address() -> None:
    socket = Socket(total=10, per_address=1)
    assert not any(socket.proven(name).only_stop for name in ("ann", "ben", "cat"))
    assert not socket.known().only_stop
    assert socket.known().only_stop


def test_a_proven_person_outranks_whom_only_the_address_vouches_for() -> None:
    socket = Socket(total=1)
    local = socket.known()
    assert not socket.proven("ann", OTHER).only_stop
    assert socket.cut == [local]


def test_a_place_that_was_left_twice_is_free_once() -> None:
    socket = Socket(total=1)
    place = socket.known()
    place.leave()
    place.leave()
    place.meet("ann", proven=True)
    assert len(socket.places) == 0
