"""Trust: who a connection is, wrong keys, ends of roles, and changes by another program."""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from msgspec.structs import replace

from bridge.core.errors import Refused
from bridge.core.identity import STRANGER, Identity, Role
from robotside.core.config import TrustSettings
from robotside.core.refusal import Refusal
from robotside.trust import people as keys
from robotside.trust.attempt_limit import MAX_HOSTS
from robotside.trust.people import HANDHELD, TOKEN, Person
from robotside.trust.people_file import PeopleFile, Unkept
from robotside.trust.trust import MAX_WRONG, MAX_WRONG_BEHIND, Trust

FAR, HERE = "192.0.2.9:1", "127.0.0.1:5"
WRONG = "does not accept the key"


class House:
    """A robot's trust in virtual time."""

    def __init__(self, state: Path, *, plain: Role | None = None, **settings: str) -> None:
        self.state, self.clock = state, 1000.0
        self.lost: list[str] = []
        self.trust = Trust(
            PeopleFile(state),
            lambda: self.clock,
            TrustSettings(**settings),
            plain=plain,  # type: ignore[arg-type]
        )
        self.trust.on_lost = self.lost.extend

    async def known(self, role: Role = Role.DRIVE, ends: float = math.inf) -> tuple[Person, str]:
        return await self.trust.add("Anna", role, TOKEN, ends)

    def refused(self, token: str, address: str = FAR) -> str:
        with pytest.raises(Refused) as refused:
            self.trust.identify(token, address)
        return str(refused.value)


@pytest.fixture
def house(tmp_path: Path) -> Iterator[House]:
    made = House(tmp_path)
    yield made
    made.trust.close()


class TestWithoutAKey:
    def test_a_program_of_this_machine_may_manage(self, house: House) -> None:
        for address in (HERE, "::1:7", "[::1]:7", "::ffff:127.0.0.1:7", "127.8.8.8:1"):
            assert house.trust.admit(address, trusted=True) == Identity("", "", Role.MANAGE)

    def test_a_web_page_on_this_machine_is_a_stranger(self, house: House) -> None:
        assert house.trust.admit(HERE, trusted=False) is STRANGER

    def test_somebody_elsewhere_is_a_stranger(self, house: House) -> None:
        for address in (FAR, "localhost.evil.example:1", "unknown:0", "2001:db8::1:9", ""):
            assert house.trust.admit(address, trusted=True) is STRANGER

    def test_the_setting_lowers_what_a_program_of_this_machine_may(self, tmp_path: Path) -> None:
        house = House(tmp_path, local_role="none")
        assert house.trust.admit(HERE, trusted=True).role is Role.NONE

    def test_plain_programs_have_the_role_that_was_given_on_purpose(self, tmp_path: Path) -> None:
        house = House(tmp_path, plain=Role.WATCH)
        assert house.trust.admit(FAR, trusted=True).role is Role.WATCH
        assert house.trust.admit(FAR, trusted=False) is STRANGER


class TestAKey:
    async def test_proves_its_person_from_anywhere(self, house: House) -> None:
        anna, token = await house.known()
        who = house.trust.identify(token, FAR)
        assert who == Identity(anna.id, "Anna", Role.DRIVE, proven=True)

    async def test_that_is_unknown_wrong_or_ended_is_refused_by_one_sentence(
        self, house: House, caplog: pytest.LogCaptureFixture
    ) -> None:
        anna, token = await house.known()
        _, ended = await house.known(ends=1010.0)
        house.clock = 1010.0
        said = {
            house.refused("nobody.secret"),
            house.refused(f"{anna.id}.{'A' * 43}"),
            house.refused(ended),
            house.refused(""),
        }
        assert len(said) == 1
        assert WRONG in said.pop()
        assert "unknown" in caplog.text
        assert "not the key of Anna" in caplog.text
        assert "has ended" in caplog.text
        assert token not in caplog.text
        assert ended not in caplog.text

    @pytest.mark.parametrize("token", ["\x00", "é.é", "\ud800.x", "." * 500, "x" * 100_000])
    async def test_that_is_none_is_refused(self, house: House, token: str) -> None:
        anna, _ = await house.known()
        assert WRONG in house.refused(token)
        assert WRONG in house.refused(f"{anna.id}.{token}")

    async def test_is_hashed_once_and_not_at_each_connection(
        self, house: House, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        anna, token = await house.known()
        house.trust.identify(token, FAR)
        monkeypatch.setattr(keys, "_hashed", None)  # a hash would fail
        assert house.trust.identify(token, FAR).id == anna.id

    async def test_that_follows_a_right_one_and_is_wrong_is_refused(self, house: House) -> None:
        anna, token = await house.known()
        house.trust.identify(token, FAR)
        assert WRONG in house.refused(f"{anna.id}.{'A' * 43}")

    async def test_after_five_wrong_ones_none_of_that_host_is_looked_at_for_a_minute(
        self, house: House, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        anna, token = await house.known()
        for _ in range(5):
            assert WRONG in house.refused(f"{anna.id}.{'A' * 43}")
        with monkeypatch.context() as patched:
            patched.setattr(keys, "_hashed", None)  # a hash would fail
            assert "try again in 60 s" in house.refused(token)
        assert house.trust.identify(token, "192.0.2.10:1").id == anna.id  # from elsewhere
        assert house.trust.identify(token, FAR).id == anna.id  # known by now, so it is no guess
        house.clock += 60.0
        assert WRONG in house.refused(f"{anna.id}.{'A' * 43}")

    async def test_after_five_wrong_ones_of_a_client_behind_a_broker_the_others_there_are_looked_at(
        self, house: House
    ) -> None:
        anna, token = await house.known()
        wrong = f"{anna.id}.{'A' * 43}"
        for _ in range(5):
            with pytest.raises(Refused, match=WRONG):
                house.trust.identify(wrong, FAR, "mallory")
        with pytest.raises(Refused, match="came under your name or by your broker: try again in 60 s"):
            house.trust.identify(token, FAR, "mallory")
        assert house.trust.identify(token, FAR, "anna").id == anna.id

    async def test_made_up_names_behind_a_broker_have_a_bounded_number_of_tries(self, house: House) -> None:
        anna, token = await house.known()
        for number in range(MAX_WRONG_BEHIND):
            with pytest.raises(Refused, match=WRONG):
                house.trust.identify(f"{anna.id}.{'A' * 43}", FAR, f"made up {number}")
        for name in ("one more", "anna"):
            with pytest.raises(Refused, match="Too many wrong keys"):
                house.trust.identify(token, FAR, name)
        assert house.trust.identify(token, FAR).id == anna.id  # which did not come by the broker
        assert house.trust.identify(token, FAR, "anna").id == anna.id  # known by now, so it is no guess

    async def test_wrong_ones_whose_address_may_be_forged_lock_out_nobody_who_connects(
        self, house: House
    ) -> None:
        anna, token = await house.known()
        for _ in range(MAX_WRONG):
            with pytest.raises(Refused, match=WRONG):
                house.trust.identify(f"{anna.id}.{'A' * 43}", FAR, forgeable=True)
        with pytest.raises(Refused, match="Too many wrong keys came from your address"):
            house.trust.identify(token, FAR, forgeable=True)
        assert house.trust.identify(token, FAR).id == anna.id

    async def test_wrong_ones_of_who_connects_are_counted_apart_from_those_that_may_be_forged(
        self, house: House
    ) -> None:
        anna, token = await house.known()
        for _ in range(MAX_WRONG):
            assert WRONG in house.refused(f"{anna.id}.{'A' * 43}")
        for number in range(MAX_HOSTS):
            with pytest.raises(Refused, match=WRONG):
                house.trust.identify("x", f"10.0.{number // 256}.{number % 256}:1", forgeable=True)
        assert "Too many wrong keys" in house.refused(token)

    async def test_of_nobody_counts_as_a_wrong_one(self, house: House) -> None:
        for number in range(5):
            assert WRONG in house.refused(f"{number:016x}.secret")
        assert "Too many wrong keys" in house.refused(f"{5:016x}.secret")
        assert WRONG in house.refused(f"{5:016x}.secret", "192.0.2.10:1")

    async def test_wrong_ones_fill_no_log(self, house: House, caplog: pytest.LogCaptureFixture) -> None:
        with caplog.at_level(logging.WARNING):
            for number in range(500):
                house.refused("nobody.x", f"192.0.{number % 250}.{number // 250}:1")
        assert len(caplog.records) == 20

    async def test_whose_end_has_come_is_refused_by_a_clock_that_is_behind_too(self, tmp_path: Path) -> None:
        before = House(tmp_path)
        _, token = await before.known(ends=2000.0)
        _, other = await before.known()
        before.clock = 2500.0
        before.trust.identify(other, FAR)
        before.trust.close()
        after = House(tmp_path)  # its clock says 1000
        assert WRONG in after.refused(token)
        assert after.trust.identify(other, FAR)


class TestPeople:
    async def test_the_first_handheld_ever_manages_and_the_next_ones_do_not(self, house: House) -> None:
        first, _ = await house.trust.add("one", Role.WATCH, HANDHELD)
        second, _ = await house.trust.add("two", Role.DRIVE, HANDHELD)
        assert (first.role, second.role) == ("manage", "drive")

    async def test_a_program_is_no_owner(self, house: House) -> None:
        program, _ = await house.trust.add("script", Role.DRIVE, TOKEN)
        first, _ = await house.trust.add("one", Role.DRIVE, HANDHELD)
        assert (program.role, first.role) == ("drive", "manage")

    async def test_who_is_removed_is_out_at_once_and_after_a_restart(self, house: House) -> None:
        anna, token = await house.known()
        house.trust.identify(token, FAR)
        await house.trust.remove(anna.id)
        assert house.lost == [anna.id]
        assert WRONG in house.refused(token)
        assert House(house.state).trust.people == ()

    async def test_who_is_removed_stays_out_though_the_disk_is_full(
        self, house: House, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        anna, token = await house.known()

        def full(*_: object) -> None:
            raise Unkept("The list of people cannot be written: no space.")

        monkeypatch.setattr(PeopleFile, "change", full)
        with pytest.raises(Unkept):
            await house.trust.remove(anna.id)
        monkeypatch.undo()
        PeopleFile(house.state).change(lambda people: people)  # another program
        house.trust.update()
        assert house.lost == [anna.id]
        assert WRONG in house.refused(token)

    async def test_who_was_seen_when_is_kept(self, house: House) -> None:
        _, token = await house.known()
        assert house.trust.people[0].last_seen is None
        house.clock = 1234.0
        house.trust.identify(token, FAR)
        assert house.trust.people[0].last_seen == 1234.0
        house.trust.close()
        assert House(house.state).trust.people[0].last_seen == 1234.0

    async def test_nobody_can_be_removed_who_is_not_there(self, house: House) -> None:
        with pytest.raises(Refusal, match="nobody called"):
            await house.trust.remove("x")


class TestAnotherProgram:
    """Changes by the command line, taken in at the next look."""

    async def test_that_removes_a_person_has_it_lost(self, house: House) -> None:
        anna, token = await house.known()
        PeopleFile(house.state).change(lambda _: [])
        house.trust.update()
        assert house.lost == [anna.id]
        assert WRONG in house.refused(token)

    async def test_that_adds_one_lets_it_in(self, house: House) -> None:
        made, token = keys.make_person("script", Role.DRIVE, TOKEN, now=1000.0)
        PeopleFile(house.state).change(lambda people: [*people, made])
        house.trust.update()
        assert house.trust.identify(token, FAR).role is Role.DRIVE
        assert house.lost == []

    @pytest.mark.parametrize(
        ("change", "loses"),
        [
            ({"role": "watch"}, True),
            ({"role": "manage"}, False),
            ({"name": "Berta"}, False),
            ({"ends": 1500.0}, True),
            ({"key": "AAAA"}, True),
            ({"last_seen": 1100.0}, False),
        ],
    )
    async def test_that_lowers_somebody_ends_what_it_does_now(
        self, house: House, change: dict[str, object], loses: bool
    ) -> None:
        anna, _ = await house.known()
        PeopleFile(house.state).change(lambda people: [replace(each, **change) for each in people])
        house.trust.update()
        assert house.lost == ([anna.id] if loses else [])

    async def test_that_gives_somebody_another_key_makes_the_old_one_worthless(self, house: House) -> None:
        anna, before = await house.known()
        house.trust.identify(before, FAR)
        other, token = keys.make_person("Anna", Role.DRIVE, TOKEN, now=1000.0)
        fresh = replace(anna, key=other.key, salt=other.salt)
        PeopleFile(house.state).change(lambda _: [fresh])
        house.trust.update()
        assert WRONG in house.refused(before)
        secret = token.partition(".")[2]
        assert house.trust.identify(f"{anna.id}.{secret}", FAR).id == anna.id

    async def test_that_damages_the_file_leaves_nobody(
        self, house: House, caplog: pytest.LogCaptureFixture
    ) -> None:
        anna, token = await house.known()
        PeopleFile(house.state).path.write_bytes(b"{")
        house.trust.update()
        assert house.lost == [anna.id]
        assert WRONG in house.refused(token)
        assert "pair again" in caplog.text

    async def test_that_deletes_the_file_leaves_nobody(self, house: House) -> None:
        anna, _ = await house.known()
        PeopleFile(house.state).path.unlink()
        house.trust.update()
        assert house.lost == [anna.id]


async def test_a_role_that_ends_is_told_once(house: House) -> None:
    anna, _ = await house.known(ends=1010.0)
    house.trust.update()
    assert house.lost == []
    house.clock = 1010.0
    for _ in range(3):
        house.trust.update()
    assert house.lost == [anna.id]


def test_stop_is_for_everybody_unless_the_settings_say_otherwise(tmp_path: Path) -> None:
    free, strict = House(tmp_path).trust, House(tmp_path, stop_role="drive").trust
    for verb in ("call", "page"):
        assert free.needed(verb, "/stop") is Role.NONE
        assert strict.needed(verb, "/stop") is Role.DRIVE
    assert strict.needed("call", "/task/start") is Role.DRIVE
    assert strict.needed("call", "/what/ever") is Role.MANAGE
