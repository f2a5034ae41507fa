"""Requests to a running robot by its state directory."""

from __future__ import annotations

import stat
from pathlib import Path

import pytest

from robotside.trust.pair_requests import NoRobot, PairAnswer, PairRequest, PairRequests, ask

LINK, CODE = "pilothouse://…", "123456"


def robot(state: Path, problem: str = "") -> PairRequests:
    def answer(request: PairRequest) -> PairAnswer:
        return PairAnswer(request.nonce, f"{LINK} {request.role}", CODE, 700.0, problem)

    return PairRequests(state, answer)


def test_a_robot_that_runs_answers_what_it_is_asked(tmp_path: Path) -> None:
    running = robot(tmp_path)
    answer = ask(tmp_path, PairRequest("watch"), sleep=lambda _: running.update())
    assert (answer.link, answer.code, answer.until) == (f"{LINK} watch", CODE, 700.0)
    assert list(tmp_path.iterdir()) == []


def test_only_the_robots_user_reads_request_and_answer(tmp_path: Path) -> None:
    running, modes = robot(tmp_path), set()

    def wait(_: float) -> None:
        modes.update(stat.S_IMODE(each.stat().st_mode) for each in tmp_path.iterdir())
        running.update()
        modes.update(stat.S_IMODE(each.stat().st_mode) for each in tmp_path.iterdir())

    ask(tmp_path, PairRequest("drive"), sleep=wait)
    assert modes == {0o600}


def test_where_no_robot_runs_one_sentence_says_so_and_nothing_is_left(tmp_path: Path) -> None:
    with pytest.raises(NoRobot, match="start it first"):
        ask(tmp_path, PairRequest("drive"), sleep=lambda _: None)
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "file").write_text("")
    with pytest.raises(NoRobot, match="cannot be asked"):
        ask(tmp_path / "file", PairRequest("drive"), sleep=lambda _: None)


def test_a_refusal_is_shown_as_it_is(tmp_path: Path) -> None:
    running = robot(tmp_path, "A guest stays 60 to 86400 s, not 1 s.")
    with pytest.raises(NoRobot, match="60 to 86400"):
        ask(tmp_path, PairRequest("watch", 1.0), sleep=lambda _: running.update())


def test_an_answer_to_another_request_is_passed_over(tmp_path: Path) -> None:
    (tmp_path / "pair-answer.json").write_text('{"nonce": "old", "link": "old"}')
    running = robot(tmp_path)
    assert ask(tmp_path, PairRequest("drive"), sleep=lambda _: running.update()).link == f"{LINK} drive"


def test_a_request_from_before_the_start_and_a_damaged_one_do_nothing(tmp_path: Path) -> None:
    request = tmp_path / "pair-request.json"
    request.write_text('{"role": "manage"}')
    running = robot(tmp_path)
    running.update()
    request.write_text("{")
    running.update()
    assert list(tmp_path.iterdir()) == []
