"""From samples to events."""

import numpy as np
import pytest

from app.inputs.voice.audio.noise import RATE, decibels
from app.inputs.voice.audio.sound_files import chunks
from app.inputs.voice.interfaces.speech_recognizer import Grammar, Level, Rejected, Result, State
from app.inputs.voice.recognition.ctc import Found, Scorer
from app.inputs.voice.recognition.hearing import RECENT, Phonemes, SpeechPipeline
from app.inputs.voice.recognition.lexicon import COMMANDS
from app.inputs.voice.recognition.spotter import Spotted
from tests.app.inputs.voice.sounds import Written, opinion, quiet, voice

GRAMMAR = Grammar(COMMANDS)


class Judge:
    """Understands what it was told to."""

    def __init__(self, command="pause", confidence=0.9, spots=""):
        self.found = Found(command, command, confidence, (("hold", 0.2),), -0.1, "paws")
        self.spots = spots

    def judge(self, samples, heeded):
        return self.found

    def spot(self, segment, now):
        heard = self.spots and now > segment.began + 0.3
        return Spotted(self.spots, self.spots, -0.1, segment.began + 0.3) if heard else None

    def running(self, recent, now):
        return None


def said(judge, *, samples=None, heed=False, finish=False):
    told = []
    hearing = SpeechPipeline(GRAMMAR, judge, told.append)
    if heed is not False:
        hearing.heed(heed)
    at = 0.0
    for part, at in chunks(
        np.concatenate((quiet(1.0), voice(0.6), quiet(1.0))) if samples is None else samples
    ):
        hearing.feed(part, at)
    if finish:
        hearing.finish(at)
    return told


def words(told):
    return [event for event in told if isinstance(event, Result | Rejected)]


def test_a_command_is_told_with_when_it_was_said_and_how_clearly():
    (result,) = words(said(Judge()))
    assert (result.command, result.confidence, result.alternatives) == ("pause", 0.9, (("hold", 0.2),))
    assert (result.began, result.ended) == (pytest.approx(1.0, abs=0.1), pytest.approx(1.6, abs=0.1))
    assert result.snr > 20


def test_what_is_not_sure_enough_is_rejected_with_what_it_was_like():
    (rejected,) = words(said(Judge(confidence=0.4)))
    assert (rejected.command, rejected.reason) == ("pause", "That was no command.")


@pytest.mark.parametrize("answer", ["yes", "no"])
def test_yes_and_no_count_only_while_a_question_is_open(answer):
    (rejected,) = words(said(Judge(answer)))
    assert "No question is open" in rejected.reason
    (result,) = words(said(Judge(answer), heed={"yes", "no"}))
    assert result.command == answer


def test_while_a_question_is_open_nothing_else_counts_but_stop():
    assert isinstance(words(said(Judge("pause"), heed={"yes", "no"}))[0], Rejected)
    assert words(said(Judge("stop"), heed={"yes", "no"}))[0].command == "stop"


def test_stop_is_told_before_its_end_and_once():
    (result,) = words(said(Judge("stop", spots="stop")))
    assert (result.command, result.early) == ("stop", True)
    assert result.ended < 1.5


def test_another_command_after_stop_is_heard_too():
    samples = np.concatenate((quiet(1.0), voice(0.6), quiet(1.0), voice(0.6), quiet(1.0)))
    assert [event.command for event in words(said(Judge("stop", spots="stop"), samples=samples))] == [
        "stop",
        "stop",
    ]


class Running(Judge):
    """Hears STOP end at these times, in whatever is heard."""

    def __init__(self, *ends):
        super().__init__("pause", confidence=0.1)
        self.ends, self.lengths = ends, []

    def running(self, recent, now):
        self.lengths.append(len(recent) / RATE)
        heard = [end for end in self.ends if end <= now < end + 0.5]
        return Spotted("stop", "stop", -0.1, heard[-1]) if heard else None


def stops(told):
    return [event.ended for event in told if isinstance(event, Result) and event.command == "stop"]


def test_stop_is_heard_at_every_moment_of_talk_that_does_not_end():
    ends = tuple(np.arange(1.5, 14.0, 1.0))
    talk = np.concatenate((quiet(1.0), voice(14.0), quiet(1.0)))
    assert stops(said(Running(*ends), samples=talk)) == list(ends)


def test_stop_is_heard_in_a_motor_that_hides_where_words_begin():
    assert stops(said(Running(7.0), samples=quiet(9.0, 0.1))) == [7.0]


def test_as_much_of_all_that_is_heard_is_kept_as_the_word_needs_and_no_more():
    judge = Running()
    said(judge, samples=voice(5.0))
    assert max(judge.lengths) == RECENT


class Deaf(Written):
    """Hears STOP in the sounds, and not in the word."""

    def stop_ends(self, samples):
        return np.full(80, -9.0, np.float32)


def test_what_sounds_like_stop_and_is_not_the_word_is_not_accepted():
    found = Phonemes(GRAMMAR, Deaf("s t ɑ p")).judge(voice(0.6), frozenset(COMMANDS))
    assert (found.command, found.accepted) == ("stop", False)
    assert Phonemes(GRAMMAR, Written("s t ɑ p")).judge(voice(0.6), frozenset(COMMANDS)).accepted


def test_what_was_begun_when_the_ears_close_is_judged():
    samples = np.concatenate((quiet(1.0), voice(0.6)))
    assert not words(said(Judge(), samples=samples))
    assert words(said(Judge(), samples=samples, finish=True))[0].command == "pause"


def test_a_speech_is_no_command():
    (rejected,) = words(said(Judge(), samples=np.concatenate((quiet(1.0), voice(6.0), quiet(1.0)))))
    assert rejected.reason == "That was too long for a command."


def test_the_level_is_told_ten_times_a_second():
    levels = [event for event in said(Judge(), samples=quiet(2.0)) if isinstance(event, Level)]
    assert 18 <= len(levels) <= 21


def test_where_it_is_too_loud_voice_says_so_and_comes_back():
    first = np.concatenate((quiet(1.0), voice(0.6)))
    states = [
        e
        for e in said(Judge(), samples=np.concatenate((first, quiet(9.0, 0.2), quiet(9.0))))
        if isinstance(e, State)
    ]
    assert [state.word for state in states] == ["too loud", "listening"]
    assert "dB over the noise" in states[0].sentence


def in_noise(ratio):
    """A word that stands over an even noise by so many decibels."""
    sound = quiet(8.0, 0.05)
    sound[5 * 16000 : 5 * 16000 + 9600] += voice(0.6, 0.3 * 10 ** ((ratio - 12.5) / 20))
    return sound


def test_the_first_words_count_where_they_stand_clear_of_the_noise_however_loud_that_is():
    (result,) = words(said(Judge("pause"), samples=in_noise(12.0)))
    assert isinstance(result, Result)


def test_words_that_hardly_stand_over_the_noise_are_not_sure_enough_but_for_stop():
    faint = quiet(5.0, 0.05)
    faint[3 * 16000 : 3 * 16000 + 9600] += voice(0.6, np.where(np.arange(9600) < 3200, 0.22, 0.06))
    (rejected,) = words(said(Judge("pause"), samples=faint))
    assert rejected.reason == "It is too loud here to be sure."
    (result,) = words(said(Judge("stop"), samples=faint))
    assert result.command == "stop"


def test_a_close_call_is_looked_at_four_times_and_a_clear_one_once():
    clear, close = Written("p ɔ z"), Written("k æ s ə l")
    Phonemes(GRAMMAR, clear).judge(voice(0.6), frozenset(COMMANDS))
    Phonemes(GRAMMAR, close).judge(voice(0.6), frozenset(COMMANDS))
    assert clear.asked == 1
    assert close.asked == 4


@pytest.mark.parametrize(("sure", "confidence", "looks"), [(0.15, 0.69, 4), (0.3, 0.94, 1)])
def test_what_would_be_accepted_is_a_close_call_too_where_it_is_not_nearly_certain(sure, confidence, looks):
    model = Written("p ɔ z", sure)
    first = Scorer(GRAMMAR, model.tokens).judge([model.table], COMMANDS)
    assert (first.command, first.confidence) == ("pause", pytest.approx(confidence, abs=0.02))
    Phonemes(GRAMMAR, model).judge(voice(0.6), COMMANDS)
    assert model.asked == looks


class Minded(Written):
    """Hears something else with each look."""

    def __init__(self, *looks):
        super().__init__(looks[0])
        self.tables = [opinion(look) for look in looks]

    def log_probs(self, samples):
        super().log_probs(samples)
        return self.tables[self.asked - 1]


@pytest.mark.parametrize("look", [1, 2, 3])
def test_stop_in_any_look_is_stop_though_all_of_them_together_are_not(look):
    sounds = ["k æ s ə l"] * 4
    sounds[look] = "s t ɑ p"
    model = Minded(*sounds)
    together = Scorer(GRAMMAR, model.tokens).judge(model.tables, COMMANDS)
    assert not (together.accepted and together.command == "stop")
    found = Phonemes(GRAMMAR, model).judge(voice(0.6), COMMANDS)
    assert (found.command, found.accepted) == ("stop", True)
    assert model.asked == look + 1, "and no further look is waited for"


def test_the_second_look_is_at_words_with_less_noise_in_them():
    heard = []

    class Noting(Written):
        def log_probs(self, samples):
            heard.append(samples)
            return super().log_probs(samples)

    samples = quiet(1.2, 0.02)
    samples[5000:14000] += voice(0.5625)
    Phonemes(GRAMMAR, Noting("k æ s ə l")).judge(samples, frozenset(COMMANDS))
    first, second, *others = heard
    assert first is samples
    assert decibels(second[:4000]) < decibels(first[:4000]) - 10.0
    assert [len(other) / len(first) for other in others] == pytest.approx([0.926, 1.075], abs=0.01)
