"""From what was understood to what the robot did: one line for each command, whoever gave it and however it ends."""

from __future__ import annotations

import itertools
import math
from types import SimpleNamespace

import pytest

from app.core.command_origin import NOBODY, Origin
from app.intents.intents import Heard, Verdict
from app.link.commands import Outcome
from app.study.response_timing import MAX_EFFECT_TIME, MAX_TRACKS, MAX_UNDO_TIME, Asked, ResponseTracks, State

WALL = 1_700_000_000.0


class Followed:
    """Tracks with a clock that is moved by hand, beginning at 50 s."""

    def __init__(self) -> None:
        self.now, self.lines = 50.0, []
        numbers = itertools.count(1)
        self.tracks = ResponseTracks(
            self.lines.append,
            now=lambda: self.now,
            wall=lambda: WALL + self.now - 50.0,
            new_id=lambda: str(next(numbers)),
        )

    def hear(self, intent="pause", method="voice", what="acted", sentence="", began=49.2, **more):
        heard = Heard(intent, method, began=began, ended=began + 0.5, **more)
        self.tracks.on_command(heard, Verdict(what, sentence))
        return heard

    def answer(self, name="pause", *, origin=None, phases=("sent", "accepted"), reason="", id="c", **fields):
        origin = origin or Origin("voice", 0.9, 49.2, 49.7, 50.0, "pause", intent="pause")
        for phase in phases:
            outcome = Outcome(name, id, phase, reason, fields=fields, origin=origin, sent=self.now)
            self.tracks.outcome(outcome, self.now)
            self.now += 0.1

    def see(self, **state):
        self.tracks.see(State(**state), self.now)

    def end(self):
        self.tracks.close()
        return self.lines


@pytest.fixture
def followed():
    return Followed()


def test_a_command_is_followed_from_the_first_sound_to_what_the_robot_did(followed):
    followed.see(running="RUNNING", task="patrol")
    followed.hear(confidence=0.93, said="pause", noise=-41.0)
    followed.answer()
    followed.now += 0.3
    followed.see(running="PAUSED", task="patrol")
    (line,) = followed.end()
    assert (line.kind, line.method, line.recognised, line.said) == ("command", "voice", "pause", "pause")
    assert (line.verdict, line.outcome, line.rejected, line.undo) == ("acted", "accepted", "", False)
    assert (line.confidence, line.noise_db) == (0.93, -41.0)
    begin = line.t_input_start
    steps = (line.t_input_end, line.t_decided, line.t_sent, line.t_ack, line.t_effect)
    assert begin == pytest.approx(WALL - 0.8)
    assert [step - begin for step in steps] == pytest.approx([0.5, 0.8, 0.8, 0.9, 1.3])


def test_a_finger_on_a_button_is_followed_from_its_touch(followed):
    followed.answer(origin=Origin(began=49.9, ended=49.95))
    (line,) = followed.end()
    assert (line.method, line.recognised, line.verdict, line.outcome) == (
        "button",
        "pause",
        "acted",
        "accepted",
    )
    assert line.t_sent - line.t_input_start == pytest.approx(0.1)
    assert line.confidence is None


def test_three_commands_of_one_touch_are_three_lines(followed):
    touch = Origin(began=49.9)
    for id in ("1", "2", "3"):
        followed.answer("option", origin=touch, phases=("sent",), id=id)
    followed.answer("option", origin=touch, phases=("refused",), reason="Not now.", id="2")
    lines = {line.t_sent: line.outcome for line in followed.end()}
    assert [lines[at] for at in sorted(lines)] == ["", "refused", ""]


def test_a_task_that_takes_its_points_along_is_one_line(followed):
    wish = Origin("voice", 0.9, 49.2, intent="patrol")
    followed.answer("mission", origin=wish, id="1")
    followed.answer("start", origin=wish, id="2", order=SimpleNamespace(task="patrol"))
    (line,) = followed.end()
    assert (line.recognised, line.outcome) == ("patrol", "accepted")


@pytest.mark.parametrize(
    ("name", "fields", "intent"),
    [
        ("home", {}, "go_home"),
        ("cancel", {}, "end_task"),
        ("start", {"order": SimpleNamespace(task="patrol")}, "patrol"),
        ("start", {"order": SimpleNamespace(task="follow_heading")}, "start"),
        ("start", {}, "start"),
        ("place", {}, "place"),
    ],
)
def test_a_buttons_command_is_called_by_its_intent(followed, name, fields, intent):
    followed.answer(name, origin=Origin(began=49.9), **fields)
    assert [line.recognised for line in followed.end()] == [intent]


def test_what_the_app_does_by_itself_and_what_only_reads_is_no_response(followed):
    followed.answer("acquire", origin=NOBODY)
    followed.answer("history", origin=Origin())
    assert followed.end() == []


def test_what_waits_is_one_line_that_ends_as_it_ends(followed):
    heard = followed.hear("go_home", what="asks")
    followed.now += 2
    followed.tracks.update(followed.now + MAX_EFFECT_TIME * 3)
    followed.tracks.on_command(heard, Verdict("lapsed", "Not done, no yes came: Go home."))
    (line,) = followed.lines
    assert (line.verdict, line.rejected) == ("lapsed", "Not done, no yes came: Go home.")
    assert line.t_sent is None


def test_what_is_cancelled_at_the_bar_was_taken_back(followed):
    heard = followed.hear("resume", what="waits")
    followed.tracks.on_command(heard, Verdict("cancelled", "Cancelled: Resume."))
    (line,) = followed.lines
    assert line.undo
    assert line.verdict == "cancelled"


def test_what_is_not_allowed_says_why(followed):
    followed.hear("take_off", what="not allowed", sentence="Voice may not do that.")
    (line,) = followed.lines
    assert (line.recognised, line.rejected) == ("take_off", "Voice may not do that.")


@pytest.mark.parametrize("phase", ["refused", "no_reply"])
def test_what_the_robot_refuses_or_never_answers_is_told_with_its_reason(followed, phase):
    followed.hear()
    followed.answer(phases=("sent", phase), reason="There is no task.")
    (line,) = followed.lines
    assert (line.outcome, line.rejected) == (phase, "There is no task.")
    assert line.t_ack is None


def test_a_state_that_was_there_before_is_no_effect(followed):
    followed.see(running="PAUSED")
    followed.hear()
    followed.answer()
    followed.see(running="PAUSED")
    assert followed.end()[0].t_effect is None


def test_the_opposite_command_soon_after_takes_it_back(followed):
    followed.hear()
    followed.now += MAX_UNDO_TIME - 1
    followed.hear("resume", began=53.0)
    first, second = followed.end()
    assert (first.undo, second.undo) == (True, False)


def test_the_opposite_command_later_is_a_command_of_its_own(followed):
    followed.hear()
    followed.now += MAX_UNDO_TIME + 1
    followed.hear("resume", began=55.0)
    assert [line.undo for line in followed.end()] == [False, False]


def test_a_line_is_put_when_nothing_more_can_come_of_it(followed):
    followed.hear()
    followed.answer()
    followed.tracks.update(followed.now + MAX_EFFECT_TIME - 1)
    assert followed.lines == []
    followed.tracks.update(followed.now + MAX_EFFECT_TIME)
    assert len(followed.lines) == 1


def test_what_is_done_on_the_handheld_has_its_effect_at_once(followed):
    followed.hear("slower")
    followed.tracks.update(followed.now + MAX_UNDO_TIME + 0.1)
    (line,) = followed.lines
    assert line.t_effect == line.t_decided


def test_snippets_are_kept_only_with_consent(followed):
    followed.hear(method="voice", snippet={"path": [1, 2]})
    followed.tracks.consent = True
    followed.hear(method="shake", snippet=[0.5], began=49.9)
    first, second = followed.end()
    assert first.snippet is None
    assert second.snippet == [0.5]


def test_an_answer_to_a_prompt_says_which_and_other_methods_do_not(followed):
    followed.tracks.asked = lambda: Asked("7", "walking", "voice", "7-1-1-1", "stop", 49.0)
    followed.hear("pause", "voice", what="practised", sentence="Pause.")
    followed.hear("pause", "button", began=49.9, what="practised")
    first, second = followed.lines
    assert (first.user, first.posture, first.prompt_id, first.intended) == ("7", "walking", "7-1-1-1", "stop")
    assert (first.rejected, first.t_prompt) == ("", pytest.approx(WALL - 1.0))
    assert (second.user, second.prompt_id, second.intended) == ("", "", "")


def test_a_prompt_that_nobody_answered_is_a_line_without_a_command(followed):
    followed.tracks.missed(Asked("7", "standing", "shake", "7-1-1-1", "stop", 42.0))
    (line,) = followed.lines
    assert (line.method, line.intended, line.recognised) == ("shake", "stop", "")
    assert line.rejected == "Nothing was understood."


def test_driving_choosing_and_listening_have_lines_of_their_own(followed):
    followed.tracks.drove("gamepad", 45.0, 49.5)
    followed.tracks.picked("Settings", 4, 48.0, 49.0)
    followed.tracks.listened("voice", 60.0)
    followed.tracks.unheard("voice", "That was none of the commands.", 49.0, -30.0)
    drive, choice, heard, unheard = followed.lines
    assert (drive.kind, drive.method, drive.seconds) == ("drive", "gamepad", 4.5)
    assert (choice.kind, choice.said, choice.presses) == ("selection", "Settings", 4)
    assert (heard.kind, heard.seconds) == ("armed", 60.0)
    assert (unheard.recognised, unheard.noise_db) == ("", -30.0)


def test_many_commands_at_once_are_bounded_and_none_is_lost(followed):
    for number in range(MAX_TRACKS + 10):
        followed.hear("lights", began=float(number))
    assert len(followed.lines) == 10
    assert len(followed.end()) == MAX_TRACKS + 10


def test_a_time_that_is_not_known_is_none(followed):
    followed.hear(began=math.nan)
    (line,) = followed.end()
    assert (line.t_input_start, line.t_input_end) == (None, None)
