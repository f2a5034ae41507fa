"""`robotside people`: the list, and who is gone or called otherwise after it."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.core.identity import Role
from robotside.__main__ import main
from robotside.trust.people import HANDHELD, TOKEN, Person, make_person
from robotside.trust.people_file import PeopleFile


def known(state: Path, *names: str, ends: float = float("inf")) -> list[Person]:
    made = [make_person(name, Role.DRIVE, HANDHELD, now=1.0, ends=ends)[0] for name in names]
    PeopleFile(state).change(lambda people: [*people, *made])
    return made


def say(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str]:
    code = main(["people", *words])
    out, err = capsys.readouterr()
    return code, out + err


def test_the_list_has_everybody_and_no_key(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    state = ["--state", str(tmp_path)]
    assert say(capsys, *state) == (
        0,
        "This robot knows nobody: pair a handheld with serve --pair, or make a token.\n",
    )
    (anna,) = known(tmp_path, "Anna")
    (ended,) = known(tmp_path, "Eve", ends=2.0)
    code, text = say(capsys, "list", *state)
    lines = text.splitlines()
    assert (code, len(lines)) == (0, 3)
    assert lines[1].split() == ["Anna", "drive", "handheld", "never", anna.id]
    assert "has ended" in lines[2]
    assert anna.key not in text
    assert ended.salt not in text


def test_who_is_removed_is_gone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    known(tmp_path, "Anna", "Bert")
    assert say(capsys, "remove", "Anna", "--state", str(tmp_path)) == (
        0,
        "Anna was removed: its key opens nothing any more.\n",
    )
    assert [each.name for each in PeopleFile(tmp_path).read()] == ["Bert"]
    assert say(capsys, "remove", "Anna", "--state", str(tmp_path)) == (
        2,
        "robotside: This robot knows nobody called 'Anna'.\n",
    )


def test_who_is_renamed_keeps_its_key(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (anna,) = known(tmp_path, "Anna")
    assert say(capsys, "rename", anna.id, "Kitchen", "--state", str(tmp_path))[0] == 0
    (after,) = PeopleFile(tmp_path).read()
    assert (after.name, after.key) == ("Kitchen", anna.key)


@pytest.mark.parametrize(
    "words", [["remove"], ["list", "Anna"], ["rename", "Anna"], ["remove", "Anna", "Bert"]]
)
def test_half_a_command_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    known(tmp_path, "Anna")
    code, text = say(capsys, *words, "--state", str(tmp_path))
    assert (code, "Write people" in text) == (2, True)
    assert [each.name for each in PeopleFile(tmp_path).read()] == ["Anna"]


def test_a_damaged_list_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    PeopleFile(tmp_path).path.write_bytes(b"{")
    code, text = say(capsys, "--state", str(tmp_path))
    assert (code, "was damaged" in text) == (2, True)


def test_a_program_stands_in_the_list_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made, _ = make_person("script", Role.WATCH, TOKEN, now=1.0)
    PeopleFile(tmp_path).change(lambda people: [*people, made])
    assert "token" in say(capsys, "--state", str(tmp_path))[1]
