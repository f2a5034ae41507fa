"""Whose directory a command means."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest

from robotside.commands.state_directory import add_state, state_of
from robotside.commands.user_mistake import UserMistake


@pytest.fixture
def kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    return tmp_path / "pilothouse"


def asked(*words: str) -> Path:
    parser = argparse.ArgumentParser()
    add_state(parser)
    return state_of(parser.parse_args(words))


def test_the_only_robot_is_meant_when_nothing_is_said(kept: Path) -> None:
    (kept / "sim-patrol-office").mkdir(parents=True)
    (kept / "a file").write_text("")
    assert asked() == kept / "sim-patrol-office"


def test_one_of_several_must_be_named(kept: Path) -> None:
    for number in range(6):
        (kept / f"robot-{number}").mkdir(parents=True)
    with pytest.raises(UserMistake, match=r"6 robots .*\(robot-0, .*, robot-4, …\); name one by --state"):
        asked()
    assert asked("--state", str(kept / "robot-3")) == kept / "robot-3"


def test_there_is_none_before_the_first_start(kept: Path) -> None:
    with pytest.raises(UserMistake, match="No robot has kept anything in .* yet"):
        asked()


def test_a_directory_that_is_not_there_is_not_made(kept: Path) -> None:
    with pytest.raises(UserMistake, match="There is no directory '/nowhere'"):
        asked("--state", "/nowhere")
