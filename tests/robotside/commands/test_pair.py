"""`robotside pair` and `guest`: what a running robot answers, as the terminal shows it."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from bridge.trust.pairing import PairLink
from robotside.__main__ import main
from robotside.commands import pair
from robotside.trust.pair_requests import NoRobot, PairAnswer, PairRequest

LINK = PairLink("192.0.2.1", 9090, "ab" * 32, "secret-of-22-letters-x", "Patrol-1").text


class Running:
    """A robot that answers."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, code: str) -> None:
        self.asked: list[tuple[Path, PairRequest]] = []
        self.code = code
        monkeypatch.setattr(pair, "ask", self.ask)

    def ask(self, state: Path, request: PairRequest) -> PairAnswer:
        self.asked.append((state, request))
        return PairAnswer("", LINK, self.code, time.time() + 600.0)


def test_it_shows_link_and_code_and_writes_the_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    robot, picture = Running(monkeypatch, "012345"), tmp_path / "qr.png"
    assert main(["pair", "--role", "watch", "--png", str(picture), "--state", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert LINK in out
    assert "type 012 345." in out
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert robot.asked == [(tmp_path, PairRequest("watch"))]


def test_a_guest_watches_for_an_hour_unless_told_otherwise(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    robot = Running(monkeypatch, "42012345")
    assert main(["guest", "--state", str(tmp_path)]) == 0
    assert main(["guest", "--role", "drive", "--hours", "2", "--state", str(tmp_path)]) == 0
    assert [request for _, request in robot.asked] == [
        PairRequest("watch", 3600.0),
        PairRequest("drive", 7200.0),
    ]
    assert "type 42 012 345." in capsys.readouterr().out
    assert main(["guest", "--hours", "0", "--state", str(tmp_path)]) == 2
    assert main(["guest", "--role", "manage", "--state", str(tmp_path)]) == 2


def test_a_picture_that_cannot_be_written_and_a_robot_that_is_not_there_are_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    Running(monkeypatch, "012345")
    assert main(["pair", "--png", str(tmp_path / "none" / "x"), "--state", str(tmp_path)]) == 2
    assert "picture cannot be written" in capsys.readouterr().err

    def nobody(*_: object) -> None:
        raise NoRobot("No robot runs.")

    monkeypatch.setattr(pair, "ask", nobody)
    assert main(["pair", "--state", str(tmp_path)]) == 2
    assert capsys.readouterr().err == "robotside: No robot runs.\n"
