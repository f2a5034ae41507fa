"""People: names, keys, and who is meant."""

from __future__ import annotations

import math

import pytest

from bridge.core.identity import Role
from robotside.core.refusal import Refusal
from robotside.trust.people import (
    GUEST,
    HANDHELD,
    MAX_PEOPLE,
    Person,
    added,
    make_person,
    read_people,
    removed,
    renamed,
    written,
)


def person(name: str = "tablet-A", *, ends: float = math.inf, now: float = 100.0) -> Person:
    return make_person(name, Role.DRIVE, HANDHELD, now=now, ends=ends)[0]


def test_only_the_token_proves_a_person_and_it_is_kept_nowhere() -> None:
    anna, token = make_person("Anna", Role.DRIVE, HANDHELD, now=100.0)
    id, _, secret = token.partition(".")
    assert id == anna.id
    assert anna.has(secret)
    assert not anna.has(secret[:-1] + ("A" if secret[-1] != "A" else "B"))
    assert not anna.has("")
    assert secret not in written([anna]).decode()


def test_two_tokens_and_two_salts_are_never_the_same() -> None:
    one, two = (make_person("Anna", Role.DRIVE, HANDHELD, now=100.0) for _ in range(2))
    assert one[1] != two[1]
    assert one[0].salt != two[0].salt


def test_a_person_is_read_as_it_was_written() -> None:
    people = (person(), person("guest", ends=500.0))
    assert read_people(written(people)) == people
    assert (people[0].end, people[1].end) == (math.inf, 500.0)
    assert people[1].identity.role is Role.DRIVE
    assert people[1].identity.proven


@pytest.mark.parametrize("name", ["", "  ", "x" * 41, "a\nb", "a\x00b", "a\u202eb"])
def test_a_name_that_cannot_be_shown_on_one_line_is_refused(name: str) -> None:
    with pytest.raises(Refusal, match="1 to 40 characters on one line"):
        person(name)


def test_of_two_of_one_name_the_id_says_which() -> None:
    one, two = person(), person()
    with pytest.raises(Refusal, match=f"2 people .*{one.id}, {two.id}"):
        removed([one, two], "tablet-A")
    assert removed([one, two], two.id) == ((one,), two)
    with pytest.raises(Refusal, match="nobody called 'Bert'"):
        removed([one], "Bert")


def test_a_person_may_get_another_name_and_keeps_its_key() -> None:
    (after,), changed = renamed([before := person()], "tablet-A", " kitchen ")
    assert after is changed
    assert (after.name, after.key, after.id) == ("kitchen", before.key, before.id)


def test_there_is_room_for_so_many_and_for_one_in_place_of_who_has_ended() -> None:
    full = [person(f"p{number}") for number in range(3)]
    crowd = full + [full[0]] * (MAX_PEOPLE - 3)
    with pytest.raises(Refusal, match="no more"):
        added(crowd, person())
    ended = make_person("guest", Role.WATCH, GUEST, now=1.0, ends=50.0)[0]
    fresh = person(now=60.0)
    assert ended not in added([*crowd[1:], ended], fresh)


@pytest.mark.parametrize(
    "damage",
    [
        b"",
        b"{}",
        b"[]",
        b'{"people": [1]}',
        b"\xff\xfe",
        written([person()])[:-20],
        written([person()]).replace(b'"drive"', b'"none"'),
        written([person()]).replace(b'"drive"', b'"king"'),
        written([person()]).replace(b'"handheld"', b'"robot"'),
        written([one := person(), one]),
    ],
)
def test_a_damaged_file_makes_nobody(damage: bytes) -> None:
    with pytest.raises(ValueError, match="."):
        read_people(damage)
