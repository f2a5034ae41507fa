"""What runs while voice is on."""

import threading

import numpy as np
import pytest

from app.inputs.voice.audio.sound_files import FileAudioSource
from app.inputs.voice.interfaces.speech_recognizer import Grammar, Result, State, VoiceTrouble
from app.inputs.voice.process.service import LINGER_TIME, MUTED, MUTED_TIMEOUT, Service
from tests.app.inputs.voice.recognition.test_hearing import GRAMMAR, Judge
from tests.app.inputs.voice.sounds import quiet, voice

SPOKEN = np.concatenate((quiet(1.0), voice(0.6)))


class Clock:
    """Goes on with what is heard."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        self.now += 0.05
        return self.now


class Deaf(FileAudioSource):
    """There is no microphone."""

    def start(self):
        raise VoiceTrouble("There is no microphone.")


def ran(*orders, ears=None, make=lambda grammar: Judge()):
    told = []
    ears = ears or FileAudioSource([SPOKEN])
    service = Service(GRAMMAR, ears, make, told.append, Clock())
    for order in orders:
        order(service)
    service.stop()
    service.run()
    return told, ears


def states(told):
    return [event.word for event in told if isinstance(event, State)]


def test_nothing_is_opened_before_it_is_asked_to_listen():
    told, ears = ran()
    assert (states(told), ears.open) == (["starting", "ready"], False)


def test_the_ears_are_closed_at_the_end():
    _, ears = ran(lambda service: service.listen(on=True))
    assert not ears.open


def test_a_judge_that_cannot_be_loaded_is_said():
    def make(grammar):
        raise VoiceTrouble("There is no hama.")

    told, _ = ran(make=make)
    assert (told[-1].word, told[-1].sentence) == ("failed", "There is no hama.")


def test_no_microphone_is_said_and_voice_stays_ready():
    told, _ = ran(lambda service: service.listen(on=True), ears=Deaf([]))
    assert (told[-1].word, told[-1].sentence) == ("ready", "There is no microphone.")


def test_what_is_said_while_the_button_is_down_is_understood_after_it_is_up():
    heard = threading.Event()
    told = []

    def tell(event):
        told.append(event)
        if isinstance(event, State) and event.word == "ready" and len(states(told)) > 2:
            heard.set()

    service = Service(
        Grammar({"pause": ("pause",)}), FileAudioSource([SPOKEN], gap=0.1), lambda grammar: Judge(), tell
    )
    thread = threading.Thread(target=service.run)
    thread.start()
    service.listen(on=True)
    service.listen(on=False)
    assert heard.wait(5 + LINGER_TIME)
    service.stop()
    thread.join(5)
    assert [event.command for event in told if isinstance(event, Result)] == ["pause"]
    assert states(told) == ["starting", "ready", "listening", "ready"]


class HeldKey(FileAudioSource):
    """Somebody holds the button until the recording is over, and switches voice off when the ears are closed."""

    service: Service

    def read(self, timeout):
        heard = super().read(timeout)
        if heard is None:
            self.service.listen(on=False)
        return heard

    def stop(self):
        super().stop()
        self.service.stop()


def turned(samples=(), ears=None):
    told, ears = [], ears or HeldKey([samples], gap=0.0)
    ears.service = Service(GRAMMAR, ears, lambda grammar: Judge(), told.append, Clock())
    ears.service.listen(on=True)
    ears.service.run()
    return [(event.word, event.sentence) for event in told if isinstance(event, State)]


def test_a_microphone_that_gave_no_sound_at_all_is_said_when_the_button_is_up():
    assert turned(np.zeros(16000, np.float32))[-1] == ("ready", MUTED)
    assert turned(np.full(16000, 0.2, np.float32))[-1] == ("ready", MUTED)
    assert turned(quiet(1.0, 1e-4))[-1] == ("ready", "")


def test_hands_free_it_is_said_once_while_the_ears_stay_open():
    silence = np.zeros(int((MUTED_TIMEOUT + 4) * 16000), np.float32)
    assert turned(silence)[-2:] == [("muted", MUTED), ("ready", MUTED)]
    assert turned(silence).count(("muted", MUTED)) == 1


def test_a_muted_microphone_that_is_heard_after_all_listens_again():
    samples = np.concatenate((np.zeros(int((MUTED_TIMEOUT + 1) * 16000), np.float32), voice(0.3)))
    assert turned(samples)[-3:] == [("muted", MUTED), ("listening", ""), ("ready", "")]


def test_a_microphone_that_was_heard_once_and_is_muted_at_the_next_press_is_said():
    class Twice(HeldKey):
        presses = 0

        def start(self):
            super().start()
            self.presses += 1
            self._left = voice(0.3) if self.presses == 1 else np.zeros(16000, np.float32)

        def stop(self):
            FileAudioSource.stop(self)
            if self.presses == 1:
                self.service.listen(on=True)
            else:
                self.service.stop()

    assert turned(ears=Twice([]))[2:] == [
        ("listening", ""),
        ("ready", ""),
        ("listening", ""),
        ("ready", MUTED),
    ]


def test_a_microphone_that_gives_nothing_between_the_words_is_not_muted():
    gated = np.concatenate((voice(0.3), np.zeros(5 * 16000, np.float32)))
    assert MUTED not in [sentence for _, sentence in turned(gated)]


@pytest.mark.parametrize("times", [1, 3])
def test_to_close_closed_ears_is_nothing(times):
    told, _ = ran(*[lambda service: service.listen(on=False)] * times)
    assert states(told) == ["starting", "ready"]


def test_run_again_after_a_fault_it_listens_and_heeds_as_it_was_told(monkeypatch):
    class Faulty(FileAudioSource):
        def read(self, seconds):
            raise ZeroDivisionError

    told, heeded = [], []
    monkeypatch.setattr(
        "app.inputs.voice.process.service.SpeechPipeline.heed", lambda _, commands: heeded.append(commands)
    )
    ears = Faulty([SPOKEN])
    service = Service(GRAMMAR, ears, lambda grammar: Judge(), told.append, Clock())
    service.heed(frozenset({"stop"}))
    service.listen(on=True)
    with pytest.raises(ZeroDivisionError):
        service.run()
    assert not ears.open
    service.stop()
    service.run()
    assert states(told) == ["starting", "ready", "listening"] * 2
    assert heeded == [None, {"stop"}, {"stop"}]


def test_it_answers_at_once_while_it_loads_and_between_two_orders_when_it_is_ready():
    answers, told = [], []

    def make(grammar):
        service.ask(lambda: answers.append(len(told)))
        return Judge()

    service = Service(GRAMMAR, FileAudioSource([]), make, told.append, Clock())
    service.stop()
    service.run()
    assert (answers, states(told)) == ([1], ["starting", "ready"])
    service.ask(lambda: answers.append("later"))
    assert answers == [1], "a loop that hangs gives no answer"
    service.stop()
    service.run()
    assert answers == [1, 3, "later"]
