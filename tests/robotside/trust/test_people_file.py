"""The file of people: private, whole, shared with the command line, and empty when it is damaged."""

from __future__ import annotations

import fcntl
import stat
from collections.abc import Sequence
from pathlib import Path

import pytest

from bridge.core.identity import Role
from robotside.trust.people import HANDHELD, Person, make_person
from robotside.trust.people_file import PeopleFile, Unkept


def somebody(name: str = "Anna") -> Person:
    return make_person(name, Role.DRIVE, HANDHELD, now=100.0)[0]


def test_who_is_added_is_there_for_every_program_and_only_for_its_user(tmp_path: Path) -> None:
    file, anna = PeopleFile(tmp_path / "state"), somebody()
    assert (file.read(), file.signature) == ((), None)
    before = file.signature
    file.change(lambda people: [*people, anna])
    other = PeopleFile(tmp_path / "state")
    assert other.read() == (anna,)
    assert other.signature == file.signature != before
    assert {stat.S_IMODE(each.stat().st_mode) for each in (tmp_path / "state").iterdir()} == {0o600}


def test_each_change_has_another_signature(tmp_path: Path) -> None:
    file = PeopleFile(tmp_path)
    seen = set()
    for name in "abc":
        file.change(lambda _, name=name: [somebody(name)])  # type: ignore[misc]
        seen.add(file.signature)
    assert len(seen) == 3


def test_a_damaged_file_lets_nobody_in_and_is_moved_aside(tmp_path: Path) -> None:
    file = PeopleFile(tmp_path)
    file.change(lambda people: [*people, somebody()])
    file.path.write_bytes(file.path.read_bytes()[:-10])
    assert file.read() == ()
    assert "knows nobody any more; pair again" in file.problem
    assert len(list(tmp_path.glob("people-damaged-*.json"))) == 1
    assert not file.path.exists()


def test_a_huge_file_is_damaged(tmp_path: Path) -> None:
    file = PeopleFile(tmp_path)
    file.path.write_bytes(b" " * 1_000_000)
    assert file.read() == ()


def test_a_change_that_fails_leaves_all_as_it_was(tmp_path: Path) -> None:
    file = PeopleFile(tmp_path)
    (anna,) = file.change(lambda people: [*people, somebody()])

    def fail(_: Sequence[Person]) -> Sequence[Person]:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        file.change(fail)
    assert file.read() == (anna,)


def test_where_nothing_can_be_kept_one_sentence_says_so(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    file = PeopleFile(tmp_path / "file")
    with pytest.raises(Unkept, match="cannot be written"):
        file.change(lambda people: people)
    with pytest.raises(Unkept, match="cannot be read"):
        file.read()


def test_it_waits_no_longer_than_told_for_another_program(tmp_path: Path) -> None:
    file = PeopleFile(tmp_path, patience=0.0)
    with (tmp_path / "people.json.lock").open("w") as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        with pytest.raises(Unkept, match="Another program"):
            file.change(lambda people: people)
    assert file.change(lambda people: people) == ()
