"""What became of STOP: one answer to one question, whoever asks it."""

from __future__ import annotations

import math

import pytest

from app.link.commands import STILL_SENDING, Outcome
from app.stop.stop_state import ANSWER_TIMEOUT, REST_TIMEOUT, StopFacts, StopState, Verdict, judge
from bridge.msgs.pilothouse_msgs import ControlStatus
from tests.bridge.wires import Clock

CUT = "STOP is pressed, but the robot cannot be reached: the connection was cut."
WHY = "No robot answers."


@pytest.mark.parametrize(
    ("known", "verdict"),
    [
        (StopFacts(), Verdict("ready")),
        (StopFacts(asked_at=99.5), Verdict("sent")),
        (
            StopFacts(asked_at=98.0),
            Verdict("no_answer", "It does not answer; STOP is sent again and again."),
        ),
        (StopFacts(asked_at=98.0, reached_at=99.5), Verdict("sent")),
        (StopFacts(asked_at=99.9, refusal=CUT), Verdict("no_answer", CUT)),
        (
            StopFacts(asked_at=98.0, taken_at=98.1, latched=False),
            Verdict("no_answer", "STOP received; the robot has not reported that it rests."),
        ),
        (StopFacts(latched=True, at_rest=True, by="Anna"), Verdict("stopped", "Pressed by Anna.")),
        (
            StopFacts(latched=True, moves_since=100.1 - REST_TIMEOUT),
            Verdict("sent", "STOP is pressed; it comes to rest."),
        ),
        (
            StopFacts(latched=True, moves_since=99.9 - REST_TIMEOUT),
            Verdict("moves", "STOP is pressed, and it does not come to rest."),
        ),
        (StopFacts(latched=True, moves_since=99.9, refusal=CUT), Verdict("no_answer", CUT)),
        (
            StopFacts(asked_at=90.0, latched=False, released=True),
            Verdict("released", "STOP was released."),
        ),
        (StopFacts(reached=False, why=WHY), Verdict("ready")),
        (StopFacts(reached=False, asked_at=99.5, why=WHY), Verdict("sent")),
        (StopFacts(reached=False, asked_at=98.0, why=WHY), Verdict("no_answer", WHY)),
        (StopFacts(reached=False, asked_at=99.9, why=WHY, hopeless=True), Verdict("no_answer", WHY)),
        (
            StopFacts(reached=False, lost_at=88.0, why=WHY),
            Verdict("lost", "STOPPED when it was last heard, 12 s ago. No robot answers."),
        ),
        (StopFacts(reached=False, lost_at=88.0, asked_at=99.5, why=WHY), Verdict("sent")),
        (
            StopFacts(reached=False, lost_at=88.0, asked_at=89.0, why=WHY),
            Verdict("no_answer", "STOPPED when it was last heard, 12 s ago. No robot answers."),
        ),
        (StopFacts(lost_at=88.0), Verdict("lost", "STOPPED when it was last heard, 12 s ago.")),
    ],
)
def test_what_is_known_decides(known: StopFacts, verdict: Verdict) -> None:
    assert judge(known, 100.0) == verdict


class Watch:
    """What is heard of one robot."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.stopping = StopState(self.clock, "me")

    def told(self, *, stopped: bool = True, at_rest: bool = True) -> None:
        self.stopping.on_status(ControlStatus(stopped=stopped, at_rest=at_rest), self.clock.time)

    def outcome(self, phase: str, reason: str = "", *, silent: bool = False, id: str = "1") -> None:
        self.stopping.on_outcome(Outcome("stop", id, phase, reason, silent=silent))

    @property
    def phase(self) -> str:
        return self.stopping.verdict.phase


@pytest.fixture
def watch() -> Watch:
    return Watch()


def test_a_robot_that_is_slow_to_rest_is_not_obeyed_only_after_its_time(watch: Watch) -> None:
    watch.told(at_rest=False)
    watch.clock.time += REST_TIMEOUT - 0.1
    watch.told(at_rest=False)
    assert watch.phase == "sent"
    watch.clock.time += 0.2
    assert watch.phase == "moves"
    watch.told()
    assert watch.phase == "stopped"


@pytest.mark.parametrize(
    ("client_id", "said"),
    [
        ("me", ""),
        ("another of the same name", "Pressed by tablet."),
        ("", "Pressed by tablet."),
    ],
)
def test_who_pressed_it_is_known_by_the_id_and_not_by_the_name(
    watch: Watch, client_id: str, said: str
) -> None:
    watch.stopping.on_status(ControlStatus(stopped=True, stopped_by="tablet", stopped_by_id=client_id), 100.0)
    assert watch.stopping.verdict == Verdict("stopped", said)


def test_a_handheld_without_an_id_takes_nobodys_stop_for_its_own() -> None:
    stopping = StopState(Clock(), "")
    stopping.on_status(ControlStatus(stopped=True, stopped_by="a browser"), 100.0)
    assert stopping.verdict.sentence == "Pressed by a browser."


def test_pressing_again_while_it_is_sent_puts_no_doubt_off(watch: Watch) -> None:
    for _ in range(4):
        watch.stopping.press()
        watch.outcome("sent")
        watch.clock.time += ANSWER_TIMEOUT / 3
    assert watch.phase == "no_answer"


def test_that_there_is_no_answer_is_no_reason(watch: Watch) -> None:
    watch.stopping.press()
    watch.clock.time += ANSWER_TIMEOUT
    watch.outcome("no_reply", STILL_SENDING, silent=True)
    assert watch.stopping.verdict.sentence == "It does not answer; STOP is sent again and again."


def test_what_was_done_and_is_pressed_no_longer_was_released_and_can_be_pressed_anew(watch: Watch) -> None:
    watch.stopping.press()
    watch.told()
    watch.outcome("accepted")
    watch.told(stopped=False)
    assert watch.phase == "released"
    watch.stopping.press()
    assert watch.phase == "sent"


def test_what_was_stopped_is_not_when_the_link_is_gone_nor_before_it_speaks_again(watch: Watch) -> None:
    watch.told()
    watch.stopping.reach(False, WHY)
    watch.clock.time += 5.0
    assert watch.phase == "lost"
    assert watch.stopping.lost_for == 5.0
    watch.stopping.reach(True)
    assert watch.phase == "lost"
    watch.stopping.reach(False, WHY)
    assert watch.phase == "lost", "it said nothing in between"
    watch.stopping.reach(True)
    watch.told(stopped=False)
    assert (watch.phase, math.isnan(watch.stopping.lost_for)) == ("ready", True)


def test_a_word_that_is_delivered_after_the_link_was_lost_is_the_last_word_and_no_news(watch: Watch) -> None:
    watch.stopping.press()
    watch.stopping.reach(False, WHY)
    watch.told()
    watch.clock.time += 3.0
    assert (watch.phase, watch.stopping.lost_for) == ("lost", 3.0)


def test_a_word_that_comes_over_a_new_connection_counts_from_when_that_stands(watch: Watch) -> None:
    watch.told()
    watch.stopping.reach(False, WHY)
    watch.clock.time += 3.0
    watch.told()
    assert (watch.phase, watch.stopping.lost_for) == ("lost", 3.0)
    watch.stopping.reach(True)
    assert watch.phase == "stopped"


def test_a_word_of_the_old_connection_does_not_count_over_the_new_one(watch: Watch) -> None:
    watch.told()
    watch.clock.time += 1.0
    watch.stopping.reach(False, WHY, at=watch.clock.time)
    watch.clock.time += 3.0
    watch.stopping.on_status(ControlStatus(stopped=True), watch.clock.time - 3.5)
    watch.stopping.reach(True)
    assert watch.phase == "lost"


def test_a_word_of_a_connection_that_did_not_come_to_stand_is_forgotten(watch: Watch) -> None:
    watch.told()
    watch.stopping.reach(False, WHY)
    watch.clock.time += 3.0
    watch.told()
    watch.stopping.reach(False, WHY)
    watch.stopping.reach(True)
    assert watch.phase == "lost"


def test_what_moved_when_the_link_went_is_not_said_to_have_been_stopped(watch: Watch) -> None:
    watch.told(at_rest=False)
    watch.stopping.reach(False, WHY)
    assert watch.phase == "ready"


def test_stop_pressed_without_a_link_is_said_to_be_unanswered(watch: Watch) -> None:
    watch.told()
    watch.stopping.reach(False, WHY)
    watch.clock.time += 1.0
    watch.stopping.press()
    assert watch.phase == "sent"
    watch.clock.time += ANSWER_TIMEOUT
    assert watch.phase == "no_answer"


def test_what_is_let_go_is_asked_for_no_longer(watch: Watch) -> None:
    watch.outcome("no_reply", CUT)
    assert watch.phase == "no_answer"
    watch.stopping.forget()
    assert watch.phase == "ready"


def test_a_release_is_seen_however_it_was_known_that_stop_was_done(watch: Watch) -> None:
    """By the robot's answer and that it is pressed, in either order, or by its word that it rests."""
    answered_first = [lambda: watch.outcome("accepted"), lambda: watch.told(at_rest=False)]
    for said in (answered_first, answered_first[::-1], [watch.told]):
        watch.stopping.press()
        assert watch.phase == "sent"
        for each in said:
            each()
        watch.told(stopped=False)
        assert watch.phase == "released"


def test_a_robot_that_says_it_is_not_stopped_before_it_took_stop_has_released_nothing(watch: Watch) -> None:
    watch.told(stopped=False)
    watch.stopping.press()
    watch.told(stopped=False)
    assert watch.phase == "sent"
    watch.told(at_rest=False)  # another one pressed it, and ours is not answered
    watch.told(stopped=False)
    assert watch.phase == "sent"


def test_a_stop_after_a_release_is_no_release(watch: Watch) -> None:
    watch.stopping.press()
    watch.told()
    watch.told(stopped=False)
    watch.told()
    assert watch.phase == "stopped"
    watch.told(stopped=False)
    assert watch.phase == "released"


@pytest.mark.parametrize(("phase", "reason"), [("accepted", ""), ("no_reply", CUT), ("refused", CUT)])
def test_what_was_on_its_way_when_it_was_let_go_does_not_press_it_again(
    watch: Watch, phase: str, reason: str
) -> None:
    watch.stopping.press()
    watch.outcome("sent")
    watch.stopping.forget()
    watch.outcome(phase, reason)
    watch.clock.time += ANSWER_TIMEOUT
    assert watch.phase == "ready"
    watch.outcome("sent", id="2")
    assert watch.phase == "sent", "the next STOP counts"
    watch.outcome(phase, CUT)
    assert watch.phase == "sent", "and what comes to the one before says nothing of it"
    watch.outcome("no_reply", CUT, id="2")
    assert watch.phase == "no_answer"
