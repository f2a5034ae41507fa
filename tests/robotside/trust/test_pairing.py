"""Pairing: what a stranger, a guesser and somebody between get, which is nothing."""

from __future__ import annotations

import hashlib

import pytest
from spake2 import SPAKE2_A

from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.trust.pairing import PairLink, confirmations, sides, split_code
from robotside.core.refusal import Refusal
from robotside.trust.pairing import MAX_GUESTS, Offer, Pairing

PRINT, OTHER = "ab" * 32, "cd" * 32
FAR = "192.0.2.9:1"
CLOSED = "Pairing is not open"


class Robot:
    """The pairing of a robot in virtual time, and handhelds that meet it."""

    def __init__(self) -> None:
        self.clock, self.changes = 1000.0, 0
        self.pairing = Pairing(PRINT, "Patrol-1", lambda: self.clock)
        self.pairing.host, self.pairing.port = "192.0.2.1", 9090
        self.pairing.on_change = self._note
        self._first_messages: dict[tuple[str, str], tuple[bytes, bytes]] = {}
        """Of a handheld that types a code and sees a certificate, with what it keeps: one of each is enough for many tries."""

    def _note(self) -> None:
        self.changes += 1

    def begun(self, code: str, *, sees: str = PRINT, connection: str = "c", address: str = FAR) -> bytes:
        """The key of a handheld that types `code` and sees the certificate `sees`."""
        tag, digits = split_code(code)
        if (digits, sees) not in self._first_messages:
            handheld, robot = sides(sees)
            spake = SPAKE2_A(digits.encode(), idA=handheld, idB=robot)
            self._first_messages[digits, sees] = spake.start(), spake.serialize()
        message, kept = self._first_messages[digits, sees]
        answer = self.pairing.begin(connection, address, tag, message.hex())
        key: bytes = SPAKE2_A.from_serialized(kept).finish(bytes.fromhex(answer))
        return key

    def typed(self, code: str, *, sees: str = PRINT, address: str = FAR) -> Offer:
        key = self.begun(code, sees=sees, address=address)
        own, robots = confirmations(key)
        offer, confirmation = self.pairing.finish("c", own)
        assert confirmation == robots
        return offer

    def wrong(self, address: str = FAR) -> None:
        offer = self.pairing.offer
        assert offer is not None
        other = f"{(int(offer.code) + 1) % 1_000_000:06d}"
        with pytest.raises(Refused, match="code is wrong"):
            self.typed(other, address=address)


@pytest.fixture
def robot() -> Robot:
    return Robot()


class TestALink:
    def test_names_address_certificate_and_secret(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        link = PairLink.read(robot.pairing.link(offer))
        assert link == PairLink("192.0.2.1", 9090, PRINT, offer.secret, "Patrol-1")

    def test_pairs_once_and_a_replay_gets_nothing(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.WATCH)
        assert robot.pairing.scan(offer.secret, FAR) is offer
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.scan(offer.secret, FAR)
        assert robot.pairing.offer is None

    def test_pairs_nobody_after_ten_minutes(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        robot.clock += 600.0
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.scan(offer.secret, FAR)

    def test_of_an_earlier_opening_is_worth_nothing(self, robot: Robot) -> None:
        before, after = robot.pairing.open(Role.DRIVE), robot.pairing.open(Role.DRIVE)
        assert before.secret != after.secret
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.scan(before.secret, FAR)

    @pytest.mark.parametrize("secret", ["", "x", "é", "\ud800"])
    def test_with_another_secret_pairs_nobody(self, robot: Robot, secret: str) -> None:
        robot.pairing.open(Role.DRIVE)
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.scan(secret, FAR)

    def test_is_not_guessed_by_trying(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        for _ in range(10):
            with pytest.raises(Refused, match=CLOSED):
                robot.pairing.scan("x" * 22, FAR)
        with pytest.raises(Refused, match="Too many tries"):
            robot.pairing.scan(offer.secret, FAR)
        assert robot.pairing.scan(offer.secret, "192.0.2.10:1") is offer


class TestACode:
    def test_pairs_who_types_it_and_sees_the_robots_certificate(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        assert robot.typed(offer.code) is offer
        with pytest.raises(Refused, match=CLOSED):
            robot.typed(offer.code)

    def test_gives_somebody_between_with_another_certificate_nothing(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        key = robot.begun(offer.code, sees=OTHER)  # a middle that passes every message on
        theirs, _ = confirmations(key)
        with pytest.raises(Refused, match="another computer answers"):
            robot.pairing.finish("c", theirs)
        assert robot.pairing.offer is offer

    def test_that_is_wrong_pairs_nobody_and_shows_no_confirmation(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        robot.wrong()
        assert robot.pairing.offer is offer, "it is still there for who knows the code"

    def test_is_another_one_after_five_wrong_ones_and_a_pause_that_doubles(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        for pause in (10.0, 20.0, 40.0):
            before = offer.code
            for number in range(5):
                robot.wrong(f"192.0.{pause:.0f}.{number}:1")
            assert offer.code != before
            with pytest.raises(Refused, match=f"try again in {pause:.0f} s"):
                robot.typed(offer.code, address=f"192.0.{pause:.0f}.9:1")
            robot.clock += pause - 0.1
            with pytest.raises(Refused, match="try again in 0 s"):
                robot.typed(offer.code, address=f"192.0.{pause:.0f}.9:1")
            robot.clock += 0.2
        assert robot.changes == 1 + 3  # shown anew each time
        assert robot.typed(offer.code, address="192.0.99.1:1") is offer

    def test_can_be_tried_so_seldom_that_guessing_is_hopeless(self, robot: Robot) -> None:
        robot.pairing.open(Role.DRIVE)
        wrong = 0
        for number in range(600):
            robot.clock += 1.0
            if robot.pairing.offer is None:
                break
            try:
                for attempt in range(6):
                    robot.wrong(f"10.{number // 250}.{number % 250}.{attempt}:1")
                    wrong += 1
            except (Refused, AssertionError):
                continue
        assert wrong <= 35  # of 1,000,000 codes

    def test_of_a_pause_does_not_hold_up_who_has_the_link(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        for number in range(5):
            robot.wrong(f"192.0.3.{number}:1")
        assert robot.pairing.scan(offer.secret, FAR) is offer

    def test_tries_that_began_before_the_pause_end_with_it(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        right = robot.begun(offer.code, connection="early", address="192.0.4.1:1")
        for number in range(5):
            robot.wrong(f"192.0.3.{number}:1")
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("early", confirmations(right)[0])

    def test_counts_in_no_pause_whoever_has_caused_it(self, robot: Robot) -> None:
        offer, guest = robot.pairing.open(Role.DRIVE), robot.pairing.invite(Role.WATCH, 600.0)
        right = robot.begun(offer.code, connection="early", address="192.0.4.1:1")
        wrong = f"{guest.tag}{(int(guest.digits) + 1) % 1_000_000:06d}"
        for number in range(5):
            with pytest.raises(Refused, match="code is wrong"):
                robot.typed(wrong, address=f"192.0.3.{number}:1")
        with pytest.raises(Refused, match="Too many wrong codes"):
            robot.pairing.finish("early", confirmations(right)[0])
        robot.clock += 10.0
        assert robot.typed(offer.code, address="192.0.4.1:1") is offer

    def test_of_one_host_is_tried_ten_times_a_minute_at_most(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        for _ in range(10):
            robot.begun(offer.code)
        with pytest.raises(Refused, match="Too many tries"):
            robot.begun(offer.code)
        robot.begun(offer.code, address="192.0.2.10:1")

    def test_of_one_host_two_are_under_way_at_most_and_those_of_others_stay(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        other = robot.begun(offer.code, connection="other", address="192.0.2.10:1")
        keys = {each: robot.begun(offer.code, connection=each) for each in ("first", "second", "third")}
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("first", confirmations(keys["first"])[0])
        own, robots = confirmations(other)
        assert robot.pairing.finish("other", own) == (offer, robots)

    def test_a_try_that_is_not_ended_within_a_minute_is_over(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        key = robot.begun(offer.code)
        robot.clock += 60.0
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("c", confirmations(key)[0])

    def test_a_try_ends_when_pairing_closes_or_another_was_paired(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        one, two = (robot.begun(offer.code, connection=each) for each in ("one", "two"))
        robot.pairing.finish("one", confirmations(one)[0])
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("two", confirmations(two)[0])
        offer = robot.pairing.open(Role.DRIVE)
        key = robot.begun(offer.code)
        robot.pairing.close()
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("c", confirmations(key)[0])

    def test_a_try_ends_within_a_minute_and_after_ten_of_pairing(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        key = robot.begun(offer.code)
        robot.clock += 60.0
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("c", confirmations(key)[0])
        robot.clock += 535.0
        key = robot.begun(offer.code)
        robot.clock += 5.0
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("c", confirmations(key)[0])

    def test_a_confirmation_is_for_its_own_connection_and_for_one_use(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        own, _ = confirmations(robot.begun(offer.code, connection="one"))
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("two", own)
        with pytest.raises(Refused, match="code is wrong"):
            robot.pairing.finish("one", "é")
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.finish("one", own)

    @pytest.mark.parametrize(
        "message",
        [
            "",
            "zz",
            "41",
            "42" + "00" * 32,
            "41" + "00" * 32,
            "41" + "01" + "00" * 31,
            "41" + "ff" * 32,
            "41" * 5000,
        ],
    )
    def test_a_message_that_is_none_is_refused(self, robot: Robot, message: str) -> None:
        robot.pairing.open(Role.DRIVE)
        with pytest.raises(Refused, match="none of SPAKE2"):
            robot.pairing.begin("c", FAR, "", message)

    def test_no_message_of_the_right_length_does_anything_else(self, robot: Robot) -> None:
        robot.pairing.open(Role.DRIVE)
        refused = 0
        for number in range(40):
            message = "41" + hashlib.sha256(bytes([number])).hexdigest()
            try:
                robot.pairing.begin("c", f"192.0.2.{number}:1", "", message)
            except Refused:
                refused += 1
        assert refused > 10  # half of all are on no curve, and most of the others not in the group

    def test_strangers_cannot_make_the_tries_grow(self, robot: Robot) -> None:
        offer = robot.pairing.open(Role.DRIVE)
        honest = robot.begun(offer.code, connection="honest", address="192.0.9.1:1")
        for number in range(9):
            robot.begun(offer.code, connection=f"evil {number}", address="192.0.8.1:1")
        assert robot.pairing.finish("honest", confirmations(honest)[0])[0] is offer


class TestGuests:
    def test_are_paired_by_their_own_link_or_code_of_eight(self, robot: Robot) -> None:
        owner = robot.pairing.open(Role.DRIVE)
        one, two = robot.pairing.invite(Role.WATCH, 3600.0), robot.pairing.invite(Role.DRIVE, 60.0)
        assert len(one.code) == 8
        assert one.tag != two.tag
        assert robot.typed(one.code) is one
        assert robot.pairing.scan(two.secret, FAR) is two
        assert (one.ends, two.ends) == (4600.0, 1060.0)
        assert robot.pairing.offer is owner

    def test_whose_time_is_over_come_too_late(self, robot: Robot) -> None:
        offer = robot.pairing.invite(Role.WATCH, 60.0)
        robot.clock += 60.0
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.scan(offer.secret, FAR)

    def test_whose_code_was_guessed_five_times_are_invited_no_more(self, robot: Robot) -> None:
        offer = robot.pairing.invite(Role.WATCH, 3600.0)
        other = f"{offer.tag}{(int(offer.digits) + 1) % 1_000_000:06d}"
        for _ in range(5):
            with pytest.raises(Refused, match="code is wrong"):
                robot.typed(other)
        robot.clock += 100.0
        with pytest.raises(Refused, match=CLOSED):
            robot.typed(offer.code)

    def test_never_manage_and_stay_a_day_at_most(self, robot: Robot) -> None:
        for role in (Role.NONE, Role.MANAGE):
            with pytest.raises(Refusal, match="watches or drives"):
                robot.pairing.invite(role, 3600.0)
        for duration in (59.0, 86401.0, float("nan"), float("inf")):
            with pytest.raises(Refusal, match="60 to 86400 s"):
                robot.pairing.invite(Role.WATCH, duration)

    def test_are_so_many_at_most(self, robot: Robot) -> None:
        offers = [robot.pairing.invite(Role.WATCH, 3600.0) for _ in range(MAX_GUESTS + 1)]
        with pytest.raises(Refused, match=CLOSED):
            robot.pairing.scan(offers[0].secret, FAR)
        assert robot.pairing.scan(offers[1].secret, FAR) is offers[1]


def test_somebody_who_could_not_be_kept_may_try_again(robot: Robot) -> None:
    offer = robot.pairing.open(Role.DRIVE)
    robot.pairing.scan(offer.secret, FAR)
    robot.pairing.restore(offer)
    assert robot.pairing.scan(offer.secret, FAR) is offer
