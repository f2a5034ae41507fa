"""The bench of STOP in running sound counts what it says it counts."""

from __future__ import annotations

import wave
from pathlib import Path

import numpy as np
import pytest

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.recognition.spotter import Spotted
from bench.stop_word import Said, false, heard, wilson


class Told:
    """Hears STOP wherever it was loud `late` seconds ago; or at all times of its own."""

    def __init__(self, late: float = 0.1) -> None:
        self.late = int(late * RATE)

    def judge(self, samples, heeded):
        return None

    def spot(self, segment, now):
        return None

    def running(self, recent, now):
        then = recent[: len(recent) - self.late]
        over = len(then) > 1600 and np.abs(then[-800:]).max() < 0.1 < np.abs(then[-1600:-800]).max()
        return Spotted("stop", "stop", -0.1, now - self.late / RATE) if over else None


def word() -> np.ndarray:
    at = np.arange(RATE // 2) / RATE
    return (0.4 * np.sin(2 * np.pi * 200 * at)).astype(np.float32)


@pytest.mark.parametrize(("late", "share"), [(0.1, 1.0), (0.6, 0.0)])
def test_stop_counts_only_where_it_is_heard_in_time(late, share):
    figures = heard(Told(late), [Said("one", True, word())], np.full(9 * RATE, 1e-3, np.float32))
    assert (figures["heard_alone"], figures["people_talk"], figures["voices"]) == (share, share, 1.0)


def test_false_stops_are_counted_an_hour_and_close_ones_once(tmp_path: Path):
    quiet = np.zeros(4 * RATE, np.float32)
    sound = np.concatenate((quiet, word(), quiet[: RATE // 2], word(), quiet, word(), quiet))
    with wave.open(str(tmp_path / "talk.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes((sound * 32767).astype("<i2").tobytes())
    figures = false(Told(), [tmp_path / "talk.wav"])
    assert figures["false"] * figures["hours"] == pytest.approx(2.0)
    assert false(Told(), []) == {}


def test_an_interval_is_wider_of_fewer_trials():
    assert wilson(9, 10) == pytest.approx(0.596, abs=0.001)
    assert wilson(90, 100) == pytest.approx(0.826, abs=0.001)
