"""Which command explains the sounds."""

import itertools
import math

import numpy as np
import pytest

from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition import ctc
from app.inputs.voice.recognition.ctc import Scorer, Sequences, frames_of
from app.inputs.voice.recognition.lexicon import COMMANDS, PHONES, pronunciations
from tests.app.inputs.voice.sounds import TOKENS, opinion

EVERY = frozenset(COMMANDS)


@pytest.fixture(scope="module")
def scorer():
    return Scorer(Grammar(COMMANDS), TOKENS)


@pytest.mark.parametrize("phrase", sorted({p for phrases in COMMANDS.values() for p in phrases}))
def test_each_phrase_that_is_heard_clearly_is_its_command(scorer, phrase):
    for sounds in pronunciations(phrase):
        found = scorer.judge([opinion(" ".join(sounds))], EVERY)
        assert (found.accepted, phrase in COMMANDS[found.command]) == (True, True)


@pytest.mark.parametrize(
    "ipa", ["ʃ ɑ p", "h aʊ s", "p ɛ t ɹ ə l", "s ɛ v ə n", "w ɛ ð ɝ ɪ z n aɪ s", "d aʊ n", "n ɑ t"]
)
def test_other_words_are_no_command(scorer, ipa):
    assert not scorer.judge([opinion(ipa)], EVERY).accepted


def test_silence_is_no_command(scorer):
    assert not scorer.judge([opinion("")], EVERY).accepted


def test_too_short_to_be_anything_is_nothing(scorer):
    assert scorer.judge([opinion("s t ɑ p")[:3]], EVERY) is None


def test_nothing_is_found_where_nothing_is_heeded(scorer):
    assert scorer.judge([opinion("s t ɑ p")], frozenset()) is None


def test_only_what_is_heeded_is_found(scorer):
    assert scorer.judge([opinion("j ɛ s")], EVERY - {"yes"}).command != "yes"


def test_a_background_word_beats_a_command_of_two_sounds_that_is_a_little_like_it(scorer):
    assert scorer.judge([opinion("ɡ oʊ")], EVERY).accepted
    assert not scorer.judge([opinion("ɡ oʊ l")], EVERY).accepted


@pytest.mark.parametrize("ipa", ["s t ɑ ɹ", "f æ s t", "k æ s ə l", "s t ɑ m p", "s t æ b"])
def test_a_neighbour_that_is_clearly_heard_is_no_command_however_long_that_is(scorer, ipa):
    assert not scorer.judge([opinion(ipa)], EVERY).accepted


def test_stop_counts_with_its_end_swallowed(scorer):
    found = scorer.judge([opinion("s t ɑ")], EVERY)
    assert (found.command, found.accepted) == ("stop", True)


def test_a_neighbour_that_explains_little_itself_weighs_less(scorer):
    clear, blurred = (
        scorer.judge([opinion(ipa, sure=0.6, frames_each=1)], EVERY) for ipa in ("k æ s ə l", "k æ s ə l ʒ")
    )
    assert clear.rival == blurred.rival == "castle"
    assert clear.confidence < 0.3 < 0.5 < blurred.confidence


def test_a_command_that_explains_little_must_stand_out_more(scorer, monkeypatch):
    blurred = [opinion("k æ s ə l ʒ", frames_each=1)]
    asked = scorer.judge(blurred, EVERY).confidence
    monkeypatch.setattr(ctc, "WEIGHS", 0.0)
    assert asked < scorer.judge(blurred, EVERY).confidence - 0.05


def test_stop_is_taken_where_another_command_would_be_asked_again(scorer):
    mumbled = opinion("s t ɑ", sure=0.5)
    sure = scorer.judge([mumbled], EVERY)
    harmless = Scorer(Grammar(COMMANDS, urgent=frozenset()), TOKENS).judge([mumbled], EVERY)
    assert sure.confidence > harmless.confidence or sure.command != harmless.command


def test_stop_counts_with_its_beginning_lost_where_another_command_would_not():
    mumbled = [opinion("t ɑ p", sure=0.7)]
    (as_stop, as_any) = (
        Scorer(Grammar({"stop": ("stop",)}, urgent=urgent), TOKENS).judge(mumbled, {"stop"})
        for urgent in (frozenset({"stop"}), frozenset())
    )
    assert (as_stop.accepted, as_any.accepted) == (True, False)


def test_where_stop_and_another_command_are_nearly_alike_stop_is_meant():
    """The sounds say start by a little."""
    words = {"stop": ("stop",), "start": ("start",)}
    heard = [opinion("s t ɑ p"), opinion("s t ɑ t")]
    meant, said = (
        Scorer(Grammar(words, urgent=urgent), TOKENS).judge(heard, set(words)).command
        for urgent in (frozenset({"stop"}), frozenset())
    )
    assert (meant, said) == ("stop", "start")


def test_confidence_falls_with_how_sure_the_model_is(scorer):
    clear, faint = (scorer.judge([opinion("p ɔ z", sure=sure)], EVERY).confidence for sure in (0.9, 0.15))
    assert clear > faint


def test_several_views_are_taken_together(scorer):
    good, bad = opinion("l æ n d"), opinion("l æ n k")
    alone, both = (scorer.judge(views, EVERY).explains for views in ([good], [good, bad]))
    assert both < alone


@pytest.mark.parametrize("word", [("s", "t"), ("s", "s"), ("t", "s", "s"), ("s", "t", "s")], ids="-".join)
def test_the_forward_algorithm_adds_up_every_path(word):
    """Against all paths through five frames, written out; a sound that comes twice has silence in between."""
    rng = np.random.default_rng(5)
    frames = rng.uniform(0.1, 1.0, (5, len(PHONES) + 1))
    names = {phone: number + 1 for number, phone in enumerate(PHONES)}
    wanted = [names[sound] for sound in word]
    total = 0.0
    for path in itertools.product([0, *dict.fromkeys(wanted)], repeat=5):
        collapsed = [label for label, _ in itertools.groupby(path) if label]
        if collapsed == wanted:
            total += math.prod(frames[number, label] for number, label in enumerate(path))
    assert Sequences([word]).whole(frames)[0] == pytest.approx(math.log(total))


def test_a_long_talk_does_not_underflow():
    frames = frames_of(opinion("s t ɑ p " * 60), TOKENS)
    found = Sequences([("j", "ɛ", "s"), ("s", "t", "ɑ", "p")]).whole(frames)
    assert np.isfinite(found).all()
