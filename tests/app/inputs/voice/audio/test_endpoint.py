"""Where words begin and end."""

import numpy as np
import pytest

from app.inputs.voice.audio.endpoint import MAX_WORDS, PAUSE_TIME, Endpointer
from app.inputs.voice.audio.sound_files import chunks
from tests.app.inputs.voice.sounds import quiet, voice


def words(samples, points=None):
    points = points or Endpointer()
    return [segment for part, at in chunks(samples) for segment in points.feed(part, at)]


def test_words_between_silences_are_found_where_they_are():
    found = words(np.concatenate((quiet(1.0), voice(0.6), quiet(1.0))))
    assert [(s.began, s.ended) for s in found] == [
        (pytest.approx(1.0, abs=0.08), pytest.approx(1.6, abs=0.06))
    ]


def test_a_little_of_what_was_before_is_kept():
    (segment,) = words(np.concatenate((quiet(1.0), voice(0.6), quiet(1.0))))
    assert len(segment.samples) / 16000 > 0.6 + 0.15


def test_the_gap_of_a_closed_mouth_does_not_end_a_word():
    assert (
        len(words(np.concatenate((quiet(1.0), voice(0.3), quiet(PAUSE_TIME - 0.15), voice(0.3), quiet(1.0)))))
        == 1
    )


def test_a_longer_one_does():
    assert (
        len(words(np.concatenate((quiet(1.0), voice(0.3), quiet(PAUSE_TIME + 0.2), voice(0.3), quiet(1.0)))))
        == 2
    )


def test_a_click_is_no_word():
    assert not words(np.concatenate((quiet(1.0), voice(0.05), quiet(1.0))))


def test_silence_and_faint_noise_are_no_words():
    assert not words(np.zeros(32000, np.float32))
    assert not words(quiet(3.0))


def test_talk_that_does_not_end_is_cut_once():
    found = words(np.concatenate((quiet(1.0), voice(MAX_WORDS + 3.0), quiet(1.0))))
    assert [segment.whole for segment in found] == [False]


def test_what_was_begun_when_the_ears_close_is_over():
    points = Endpointer()
    assert not words(np.concatenate((quiet(1.0), voice(0.5))), points)
    assert points.finish().ended == pytest.approx(1.5, abs=0.05)
    assert points.finish() is None


def test_noise_that_began_is_silence_after_a_while():
    points = Endpointer()
    words(np.concatenate((quiet(1.0), quiet(14.0, 0.05))), points)
    assert not points.speaking


def test_a_motor_that_starts_is_known_for_one_and_a_word_over_it_is_found():
    points = Endpointer()
    sound = np.concatenate((quiet(1.0), quiet(6.0, 0.05)))
    sound[5 * 16000 : 5 * 16000 + 8000] += voice(0.5, 0.4)
    found = words(sound, points)
    assert [(s.began, s.ended, s.whole) for s in found] == [
        (pytest.approx(5.0, abs=0.15), pytest.approx(5.5, abs=0.1), True)
    ]


def test_a_motor_that_runs_when_the_ears_open_is_known_for_one_too():
    sound = quiet(4.0, 0.05)
    sound[2 * 16000 : 2 * 16000 + 8000] += voice(0.5, 0.4)
    assert [s.began for s in words(sound)] == [pytest.approx(2.0, abs=0.15)]


def test_words_before_a_noise_that_starts_are_not_lost_in_it():
    (said,) = words(np.concatenate((quiet(1.0), voice(0.6), quiet(3.0, 0.05))))
    assert (said.began, said.ended) == (pytest.approx(1.0, abs=0.1), pytest.approx(1.6, abs=0.1))
    assert len(said.samples) / 16000 < 1.2
