"""Which way runs the model."""

from __future__ import annotations

import numpy as np
import pytest

from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble
from app.inputs.voice.recognition import model as module
from app.inputs.voice.recognition.model import HamaModel
from tests.lacking import package

SIGNS = 2


def chosen(ours, theirs):
    return module.chosen(ours, theirs, SIGNS)


class Clock:
    """Time that only goes on where a way says that it takes time."""

    def __init__(self, monkeypatch):
        self.at = 0.0
        monkeypatch.setattr(module.time, "thread_time", lambda: self.at)

    def way(self, takes: float, probability: float = 0.5):
        def hear(wave):
            self.at += takes
            return np.log(np.full((3, SIGNS), probability, np.float32))

        return lambda: hear


@pytest.fixture
def clock(monkeypatch):
    return Clock(monkeypatch)


def fails(problem):
    def make():
        raise problem

    return make


def test_the_cheaper_of_two_that_say_the_same_is_taken(clock, caplog):
    cheap, dear = clock.way(1.0), clock.way(5.0)
    assert chosen(cheap, dear) is cheap()
    assert chosen(dear, cheap) is cheap()
    assert not caplog.messages


def test_what_the_first_time_costs_counts_for_neither(clock):
    costs = iter([9.0, 1.0])

    def warming(wave):
        clock.at += next(costs)
        return np.log(np.full((3, SIGNS), 0.5, np.float32))

    assert chosen(lambda: warming, clock.way(5.0)) is warming


def test_the_engine_is_taken_where_ours_says_something_else(clock, caplog):
    ours, engine = clock.way(1.0, 0.5), clock.way(5.0, 0.6)
    assert chosen(ours, engine) is engine()
    assert caplog.messages == [
        "The model is run by the engine of its package: by numpy it says something else"
    ]


@pytest.mark.parametrize(
    "problem",
    [
        ValueError("other weights"),
        OSError("no file"),
        ImportError("no numpy"),
        TypeError("another kind"),
        IndexError("one axis less"),
        MemoryError("no room"),
    ],
)
def test_the_engine_is_taken_where_ours_cannot_be_had(clock, problem, caplog):
    engine = clock.way(5.0)
    assert chosen(fails(problem), engine) is engine()
    assert caplog.messages == [f"The model is run by the engine of its package: {problem}"]


@pytest.mark.parametrize(
    "said",
    [np.zeros((3, SIGNS + 1)), np.full((3, SIGNS), np.nan), np.zeros(SIGNS)],
    ids=["other signs", "no numbers", "no frames"],
)
def test_a_way_that_says_nonsense_is_none(clock, said):
    engine = clock.way(5.0)
    assert chosen(lambda: lambda wave: said, engine) is engine()
    with pytest.raises(VoiceTrouble, match="a probability of each of 2 signs"):
        chosen(lambda: lambda wave: said, lambda: lambda wave: said)


def test_ours_is_taken_where_there_is_no_engine_for_this_machine(clock):
    ours = clock.way(9.0)
    assert chosen(ours, fails(RuntimeError("libhama not available"))) is ours()


def test_neither_is_said_in_one_sentence(clock):
    with pytest.raises(VoiceTrouble, match="cannot be loaded: libhama not available"):
        chosen(fails(ValueError("other weights")), fails(RuntimeError("libhama not available")))


def test_what_is_shorter_than_one_window_is_heard_as_well():
    package("hama")
    model = HamaModel()
    assert model.log_probs(np.zeros(10, np.float32)).shape == (2, len(model.tokens))


def test_the_model_is_run_on_one_core_by_samples_of_full_scale_at_most(monkeypatch):
    package("hama")
    told, heard = [], []
    monkeypatch.setattr(module, "one_core", lambda: told.append(len(heard)))
    monkeypatch.setattr(module, "chosen", lambda *_: lambda wave: heard.append(wave) or wave)
    model = HamaModel()
    assert told == [0]
    model.log_probs(np.linspace(-3.0, 3.0, 800))
    assert (heard[0].min(), heard[0].max(), heard[0].dtype) == (-1.0, 1.0, np.float32)


def test_numpy_is_told_to_use_one_thread(monkeypatch):
    told = []

    class Library:
        def __getattr__(self, name):
            if name != module.THREADS[1]:
                raise AttributeError(name)
            return lambda count: told.append(count.value)

    monkeypatch.setattr(module.ctypes, "CDLL", lambda path: Library())
    module.one_core()
    assert told == [1]


def test_a_numpy_that_cannot_be_told_goes_on_as_it_is(monkeypatch):
    asked = []
    monkeypatch.setattr(module.ctypes, "CDLL", lambda path: asked.append(path) or object())
    module.one_core()
    assert asked, "it was looked for"
