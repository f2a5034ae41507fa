"""Android's recogniser and its voice, as Android's own classes would be called."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from app.inputs.voice.android import speech
from app.inputs.voice.android.speech import (
    ASKS,
    NO_PACK,
    NONE,
    REFUSED,
    TRIES,
    AndroidRecognizer,
    AndroidSpeaker,
)
from app.inputs.voice.interfaces.speech_recognizer import (
    Grammar,
    Level,
    Partial,
    Rejected,
    Result,
    State,
    VoiceTrouble,
)
from app.inputs.voice.recognition.phrases import PHRASES
from tests.app.device.java import Handle, install, java, played

ENGLISH = Grammar(PHRASES["en"])


class Intent:
    def __init__(self, action: str) -> None:
        self.action, self.extras = action, {}

    def putExtra(self, name: str, value: Any) -> None:
        self.extras[name] = value


class Service:
    """android.speech.SpeechRecognizer."""

    def __init__(self) -> None:
        self.listener, self.intents, self.stops, self.destroyed = None, [], 0, False

    def setRecognitionListener(self, listener: Any) -> None:
        self.listener = listener

    def startListening(self, intent: Intent) -> None:
        self.intents.append(intent)

    def stopListening(self) -> None:
        self.stops += 1

    def destroy(self) -> None:
        self.destroyed = True


class Voice:
    """android.speech.tts.TextToSpeech."""

    def __init__(self, _: Any, listener: Any) -> None:
        self.listener, self.said, self.rate, self.speaking, self.down = listener, [], 0.0, False, False

    def setLanguage(self, locale: str) -> None:
        self.locale = locale

    def setSpeechRate(self, rate: float) -> None:
        self.rate = rate

    def speak(self, words: str, *_: Any) -> None:
        self.said.append(words)
        self.speaking = True

    def isSpeaking(self) -> bool:
        return self.speaking

    def stop(self) -> None:
        self.speaking = False

    def shutdown(self) -> None:
        self.down = True


class Phone:
    """Has the module `jnius` of a phone; what is put into its main thread is done by `run`."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.t, self.posted, self.allowed, self.there = 50.0, [], True, True
        self.service, self.voices, self.asked, self.told = Service(), [], [], []
        self.intents: list[Intent] = []
        monkeypatch.setattr(speech, "_asked", set())
        activity = java(
            "android.app.Activity",
            checkSelfPermission=lambda _: 0 if self.allowed else -1,
            requestPermissions=lambda names, _: self.asked.extend(names),
        )
        extras = ("LANGUAGE_MODEL", "LANGUAGE", "PREFER_OFFLINE", "PARTIAL_RESULTS", "MAX_RESULTS")
        recogniser = "android.speech.SpeechRecognizer"
        handler = java(
            "android.os.Handler",
            postDelayed=lambda runnable, after: bool(self.posted.append((after, runnable))),
        )
        install(
            monkeypatch,
            java("org.kivy.android.PythonActivity", mActivity=activity),
            java("android.os.Looper", getMainLooper=None),
            java("android.os.Handler", new=lambda _: handler),
            java(
                recogniser,
                isRecognitionAvailable=lambda _: self.there,
                createSpeechRecognizer=lambda _: played(recogniser, self.service),
            ),
            java(
                "android.speech.RecognizerIntent",
                ACTION_RECOGNIZE_SPEECH="recognise",
                LANGUAGE_MODEL_FREE_FORM="free",
                **{f"EXTRA_{name}": name for name in extras},
            ),
            java("android.content.Intent", new=self._intent),
            java("android.speech.tts.TextToSpeech", new=self._voice),
            java("java.util.Locale", forLanguageTag=Handle),
            java("java.lang.String", new=Handle),
        )

    def _intent(self, action: str) -> Any:
        self.intents.append(Intent(action))
        return played("android.content.Intent", self.intents[-1])

    def _voice(self, *given: Any) -> Any:
        self.voices.append(Voice(*given))
        return played("android.speech.tts.TextToSpeech", self.voices[-1])

    def run(self) -> None:
        while self.posted:
            _, runnable = self.posted.pop(0)
            runnable.run()

    def listening(self, grammar: Grammar = ENGLISH) -> AndroidRecognizer:
        recogniser = AndroidRecognizer(lambda: self.t)
        recogniser.start(grammar, self.told.append)
        recogniser.listen(on=True)
        self.run()
        return recogniser

    def says(self, *texts: str, scores: list[float] | None = None, partial: bool = False) -> None:
        listener = self.service.listener
        found = SimpleNamespace(size=lambda: len(texts), get=texts.__getitem__)
        bundle = SimpleNamespace(getStringArrayList=lambda _: found, getFloatArray=lambda _: scores)
        (listener.onPartialResults if partial else listener.onResults)(bundle)
        self.run()

    def results(self) -> list[Any]:
        return [one for one in self.told if isinstance(one, Result | Rejected)]


@pytest.fixture
def phone(monkeypatch: pytest.MonkeyPatch) -> Phone:
    return Phone(monkeypatch)


def test_it_asks_for_offline_recognition_with_partial_results_and_many_guesses(phone: Phone) -> None:
    phone.listening()
    (intent,) = phone.intents
    assert intent.extras == {
        "LANGUAGE_MODEL": "free",
        "LANGUAGE": "en-US",
        "PREFER_OFFLINE": True,
        "PARTIAL_RESULTS": True,
        "MAX_RESULTS": 20,
    }


def test_the_permission_is_asked_for_once_and_a_refusal_is_said(phone: Phone) -> None:
    phone.allowed = False
    recogniser = AndroidRecognizer()
    for sentence in (ASKS, REFUSED):
        with pytest.raises(VoiceTrouble, match=sentence.split(".", maxsplit=1)[0]):
            recogniser.start(ENGLISH, phone.told.append)
    assert phone.asked == ["android.permission.RECORD_AUDIO"]


def test_a_phone_without_a_recogniser_says_so(phone: Phone) -> None:
    phone.there = False
    assert AndroidRecognizer().missing() == NONE


def test_words_become_the_command_that_they_sound_like_with_their_times(phone: Phone) -> None:
    phone.listening()
    phone.service.listener.onBeginningOfSpeech()
    phone.t = 51.0
    phone.service.listener.onEndOfSpeech()
    phone.t = 51.5
    phone.says("go hum", "goat home", scores=[0.8, 0.1])
    (result,) = phone.results()
    assert (result.command, result.said, result.began, result.ended) == ("go_home", "go home", 50.0, 51.0)
    assert 0.5 <= result.confidence < 0.8


def test_the_guess_that_is_a_command_counts_wherever_it_stands(phone: Phone) -> None:
    phone.listening()
    phone.says("paws", "boss", "pause", scores=[-1.0, -1.0, -1.0])
    assert [one.command for one in phone.results()] == ["pause"]


def test_what_is_no_command_is_rejected(phone: Phone) -> None:
    phone.listening()
    phone.says("he stepped off the bus", "shop")
    assert [type(one) for one in phone.results()] == [Rejected]


def test_a_command_that_is_denied_is_rejected_by_name_and_says_so(phone: Phone) -> None:
    phone.listening()
    phone.says("don't go home")
    (result,) = phone.results()
    assert isinstance(result, Rejected)
    assert (result.command, result.reason) == ("go_home", "“go home” is not to be done: nothing is done.")


def test_a_command_amid_other_words_is_asked_for_alone(phone: Phone) -> None:
    phone.listening()
    phone.says("go home Dave")
    (result,) = phone.results()
    assert isinstance(result, Rejected)
    assert result.reason.startswith("There was more than “go home” in that")


def test_a_question_that_is_no_phrase_of_the_list_is_a_command_all_the_same(phone: Phone) -> None:
    phone.listening()
    phone.says("how much battery is left")
    assert [(type(one), one.command) for one in phone.results()] == [(Result, "tell_battery")]


def test_halt_is_stop_before_the_sentence_ends(phone: Phone) -> None:
    phone.listening()
    phone.says("robot halt", partial=True)
    (result,) = phone.results()
    assert (result.command, result.said, result.early) == ("stop", "halt", True)


def test_stop_is_taken_out_of_what_is_not_yet_said_to_its_end_and_only_once(phone: Phone) -> None:
    phone.listening()
    phone.says("please", partial=True)
    phone.says("please stop", partial=True)
    phone.says("please stop now", partial=True)
    phone.says("please stop now")
    (result,) = phone.results()
    assert (result.command, result.early) == ("stop", True)
    assert sum(isinstance(one, Partial) for one in phone.told) == 4


def test_yes_counts_only_while_it_is_heeded(phone: Phone) -> None:
    recogniser = phone.listening()
    phone.says("yes")
    recogniser.heed({"yes", "no"})
    phone.says("yes")
    phone.says("stop")
    assert [type(one) for one in phone.results()] == [Rejected, Result, Result]


def test_it_is_begun_again_after_each_utterance_and_after_silence(phone: Phone) -> None:
    recogniser = phone.listening()
    phone.says("pause")
    phone.service.listener.onError(7)
    phone.run()
    phone.service.listener.onError(6)
    phone.run()
    assert len(phone.service.intents) == 4
    recogniser.listen(on=False)
    phone.run()
    phone.service.listener.onError(7)
    phone.run()
    assert (phone.service.stops, len(phone.service.intents)) == (1, 4), "closed ears stay closed"


def test_an_error_is_tried_again_a_few_times_and_then_said(phone: Phone) -> None:
    phone.listening()
    for _ in range(TRIES):
        phone.service.listener.onError(8)
        phone.run()
    assert len(phone.service.intents) == TRIES
    state = phone.told[-1]
    assert (state.word, "error 8" in state.sentence) == ("failed", True)


@pytest.mark.parametrize(("number", "sentence"), [(2, NO_PACK), (9, REFUSED)])
def test_an_error_that_does_not_mend_is_said_at_once(phone: Phone, number: int, sentence: str) -> None:
    phone.listening()
    phone.service.listener.onError(number)
    assert phone.told[-1] == State("failed", sentence)


def test_another_language_is_asked_for_and_its_words_count(phone: Phone) -> None:
    phone.listening(Grammar(PHRASES["de"], "de"))
    assert phone.intents[0].extras["LANGUAGE"] == "de-DE"
    phone.says("nach Hause")
    assert phone.results()[0].command == "go_home"


def test_loudness_is_told_and_the_noise_is_not_known(phone: Phone) -> None:
    phone.listening()
    phone.service.listener.onRmsChanged(5.0)
    level = next(one for one in phone.told if isinstance(one, Level))
    assert -60 < level.level < 0
    assert math.isnan(level.noise)


def test_a_failure_never_reaches_java(phone: Phone) -> None:
    phone.listening()
    phone.service.listener.onResults(SimpleNamespace())
    assert phone.results() == []
    phone.says("go home")
    assert [one.command for one in phone.results()] == ["go_home"], "it listens on"


def test_stopped_it_lets_go_of_the_service_and_tells_nothing(phone: Phone) -> None:
    recogniser = phone.listening()
    recogniser.stop()
    phone.run()
    told = len(phone.told)
    phone.service.listener.onRmsChanged(5.0)
    assert phone.service.destroyed
    assert len(phone.told) == told


def spoken(phone: Phone, status: int = 0) -> tuple[AndroidSpeaker, list[tuple[str, str]]]:
    mouth, told = AndroidSpeaker(), []
    mouth.start(lambda *words: told.append(words))
    mouth.say("Go home?", 1.2)
    phone.run()
    phone.voices[0].listener.onInit(status)
    return mouth, told


def test_the_voice_says_it_when_it_is_there_and_tells_when_it_has_ended(phone: Phone) -> None:
    mouth, told = spoken(phone)
    while not phone.voices[0].said:
        phone.posted.pop(0)[1].run()
    assert (phone.voices[0].said, phone.voices[0].rate) == (["Go home?"], 1.2)
    assert told == [("began", "Go home?")]
    phone.voices[0].speaking = False
    phone.run()
    assert told[-1] == ("ended", "Go home?")
    mouth.stop()
    phone.run()
    assert phone.voices[0].down


def test_a_phone_without_a_voice_says_so(phone: Phone) -> None:
    _, told = spoken(phone, status=-1)
    assert told[0][0] == "failed"
