"""One-shot commands: judged by age, done once, always answered."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import CommandRequest
from robotside.core.refusal import Refusal
from robotside.records.answers import MAX_ANSWERS
from robotside.services.command_log import ANSWER_LIFETIME, CommandLog


class Counter:
    def __init__(self) -> None:
        self.done = 0

    def act(self) -> str:
        self.done += 1
        return f"Done {self.done}."

    def refuse(self) -> str:
        self.done += 1
        raise Refusal("Not now.")


@pytest.fixture
def commands() -> CommandLog:
    return CommandLog(lambda: 100.0)


@pytest.fixture
def counter() -> Counter:
    return Counter()


def test_a_command_is_done_and_answered(commands: CommandLog, counter: Counter) -> None:
    answer = commands.run("/x", CommandRequest(), counter.act)
    assert (answer.success, answer.message) == (True, "Done 1.")


def test_a_refusal_is_an_answer_with_the_reason(commands: CommandLog, counter: Counter) -> None:
    answer = commands.run("/x", CommandRequest(), counter.refuse)
    assert (answer.success, answer.message) == (False, "Not now.")


@pytest.mark.parametrize("action", ["act", "refuse"])
def test_the_same_id_gets_the_first_answer_and_is_not_done_again(
    commands: CommandLog, counter: Counter, action: str
) -> None:
    request = CommandRequest(command_id="c1")
    first = commands.run("/x", request, getattr(counter, action))
    assert commands.run("/x", request, counter.act) == first
    assert counter.done == 1


def test_the_same_id_on_another_service_is_another_command(commands: CommandLog, counter: Counter) -> None:
    request = CommandRequest(command_id="c1")
    commands.run("/x", request, counter.act)
    commands.run("/y", request, counter.act)
    assert counter.done == 2


def test_the_same_id_of_another_sender_is_another_command(commands: CommandLog, counter: Counter) -> None:
    request = CommandRequest(command_id="2")
    for sender in ("anna", "bert", "anna"):
        commands.run("/x", request, counter.act, sender=sender)
    assert counter.done == 2


def test_an_id_that_is_used_again_much_later_is_another_command(counter: Counter) -> None:
    now = 100.0
    commands, request = CommandLog(lambda: now), CommandRequest(command_id="1")
    for now in (100.0, 100.0 + ANSWER_LIFETIME, 100.1 + ANSWER_LIFETIME):  # noqa: B007 - it is the clock
        answer = commands.run("/x", request, counter.act)
    assert answer.message == "Done 2."


def test_commands_without_an_id_are_all_done(commands: CommandLog, counter: Counter) -> None:
    commands.run("/x", CommandRequest(), counter.act)
    commands.run("/x", CommandRequest(), counter.act)
    assert counter.done == 2


def test_an_id_that_would_have_to_be_cut_is_refused_and_nothing_is_done(
    commands: CommandLog, counter: Counter
) -> None:
    said = "A command_id has at most 64 characters, not 65."
    answer = commands.run("/x", CommandRequest(command_id="c" * 65), counter.act)
    assert (answer.success, answer.message, counter.done) == (False, said, 0)
    assert commands.run("/x", CommandRequest(command_id="c" * 64), counter.act).success


def test_only_the_newest_answers_are_kept(commands: CommandLog, counter: Counter) -> None:
    for number in range(MAX_ANSWERS + 1):
        commands.run("/x", CommandRequest(command_id=f"c{number}"), counter.act)
    commands.run("/x", CommandRequest(command_id=f"c{MAX_ANSWERS}"), counter.act)
    assert counter.done == MAX_ANSWERS + 1
    commands.run("/x", CommandRequest(command_id="c0"), counter.act)
    assert counter.done == MAX_ANSWERS + 2


def test_a_command_older_than_its_validity_is_refused_with_both_numbers(
    commands: CommandLog, counter: Counter
) -> None:
    answer = commands.run("/x", CommandRequest(stamp=93.0, valid_for=5.0), counter.act)
    assert not answer.success
    assert answer.message == "The command is too old: given 7.0 s ago, valid for 5.0 s."
    assert counter.done == 0


@pytest.mark.parametrize(
    ("stamp", "shown"), [(102.0, "2.0"), (3700.0, "3600.0"), (1e300, "1e+300"), (math.inf, "inf")]
)
def test_a_command_from_the_future_is_refused(
    commands: CommandLog, counter: Counter, stamp: float, shown: str
) -> None:
    answer = commands.run("/x", CommandRequest(stamp=stamp), counter.act)
    assert not answer.success
    assert answer.message == (
        f"The command is not done: its clock is {shown} s ahead of the robot's; at most 1 s is allowed."
    )
    assert counter.done == 0


@pytest.mark.parametrize(("stamp", "valid_for"), [(95.0, 5.0), (101.0, 5.0), (math.nan, 0.0)])
def test_a_command_that_is_young_enough_or_tells_no_time_is_done(
    commands: CommandLog, counter: Counter, stamp: float, valid_for: float
) -> None:
    assert commands.run("/x", CommandRequest(stamp=stamp, valid_for=valid_for), counter.act).success


def test_a_command_older_than_anything_is_refused_in_a_short_sentence(
    commands: CommandLog, counter: Counter
) -> None:
    answer = commands.run("/x", CommandRequest(stamp=-1e308, valid_for=1e300), counter.act)
    assert answer.message == "The command is too old: given 1e+308 s ago, valid for 1e+300 s."


def test_a_validity_that_is_no_number_is_none(commands: CommandLog, counter: Counter) -> None:
    assert not commands.run("/x", CommandRequest(stamp=100.0, valid_for=math.nan), counter.act).success


def test_an_ageless_command_is_done_however_old_and_however_often(
    commands: CommandLog, counter: Counter
) -> None:
    request = CommandRequest(command_id="s1", stamp=0.0)
    for _ in range(3):
        assert commands.run("/stop", request, counter.act, ageless=True).success
    assert counter.done == 3
