"""Speech on the phone: Android's own recogniser as a `SpeechRecognizer`, and its own voice as a `Speaker`.

The recogniser hears one utterance at a time and ends with it, so that it is begun again after each while the ears are open. It gives
words and knows no grammar: `app.inputs.voice.recognition.matching` finds the command that they sound like. What belongs to the phone's main thread
is put there by a `Handler`.
"""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable, Collection
from typing import Any

from app.inputs.voice.interfaces.speech_recognizer import (
    Grammar,
    Hear,
    Level,
    Partial,
    Rejected,
    Result,
    State,
    VoiceTrouble,
)
from app.inputs.voice.recognition.matching import Match, interpret, said_within
from app.inputs.voice.recognition.phrases import PHRASES
from app.inputs.voice.recognition.sentences import SENTENCES as SAID
from app.inputs.voice.recognition.sentences import Meaning
from widgets.core.language import mark, tr

__all__ = ["AndroidSpeaker", "AndroidRecognizer"]

log = logging.getLogger(__name__)

RECORD_AUDIO = "android.permission.RECORD_AUDIO"
ASKS = mark("Android asks whether the microphone may be used: allow it, and voice begins.")
REFUSED = mark(
    "The microphone is not allowed. Allow it in Android's settings of this app, or command by touch."
)
NONE = mark(
    "This phone has no speech recogniser. Install one, as Google's, or command by touch, shake or switches."
)
NO_PACK = mark(
    "Android has no offline speech for this language and no network. Download the language in Android's settings."
)
NO_LANGUAGE = mark(
    "Android's speech recogniser does not know this language. Download it in Android's settings."
)
GIVES_UP = mark(
    "Android's speech recogniser does not answer (error {}). Switch voice off and on to try again."
)
NO_VOICE = mark("This phone has no voice to talk by. Install one in Android's settings.")
FORBIDDEN = mark("“{phrase}” is not to be done: nothing is done.")
MORE = mark("There was more than “{phrase}” in that: nothing is done. Say the command alone.")
QUIET = frozenset({6, 7})
"""Errors that only mean that nobody spoke, or nothing that it knows."""
SENTENCES = {1: NO_PACK, 2: NO_PACK, 9: REFUSED, 12: NO_LANGUAGE, 13: NO_LANGUAGE}
"""Errors that trying again does not mend."""
AGAIN_MS, BUSY_MS = 80, 400
"""Before the next utterance; and after an error, when it may still be busy [ms]."""
TRIES = 5
"""So many errors in a row, and it is given up."""
N_BEST = 20
LOUDNESS = (-50.0, 4.0)
"""Android tells loudness on a scale of its own, from about -2 to 10; so it becomes one of dB over full scale, roughly."""
POLL_MS = 150
"""So often the voice is asked whether it still speaks [ms]."""
TAGS = {"en": "en-US", "de": "de-DE", "es": "es-ES", "fr": "fr-FR"}

_asked: set[str] = set()
"""Permissions that were asked for since the app began: Android is not asked twice."""


def _activity() -> Any:
    from jnius import autoclass

    return autoclass("org.kivy.android.PythonActivity").mActivity


class _MainThread:
    """Android's main thread, where recogniser and voice want to be called."""

    def __init__(self) -> None:
        from jnius import autoclass

        self._handler = autoclass("android.os.Handler")(autoclass("android.os.Looper").getMainLooper())
        self._kept: list[Any] = []

    def post(self, do: Callable[[], None], after_ms: int = 0) -> None:
        """Have it done there."""
        runnable = _runnable(do, self._kept)
        self._kept.append(runnable)  # Java alone does not keep a Python object alive
        self._handler.postDelayed(runnable, after_ms)


def _guarded(do: Callable[..., object], *given: object) -> None:
    """An error that goes from here to Java ends the whole app."""
    try:
        do(*given)
    except Exception as problem:  # noqa: BLE001 - whatever a vendor's service answers, the app goes on
        log.warning("Android's speech: %s", problem)


def _runnable(do: Callable[[], None], kept: list[Any]) -> Any:
    from jnius import PythonJavaClass, java_method

    class Runnable(PythonJavaClass):  # type: ignore[misc]
        __javainterfaces__ = ("java/lang/Runnable",)

        @java_method("()V")  # type: ignore[untyped-decorator]
        def run(self) -> None:
            if self in kept:
                kept.remove(self)
            _guarded(do)

    return Runnable()


class AndroidRecognizer:
    """A `SpeechRecognizer`, offline where the phone can."""

    name = mark("Android")
    languages = tuple(PHRASES)

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        """Opens nothing."""
        self._now = now
        self._main = _MainThread()
        self._grammar: Grammar | None = None
        self._hear: Hear = lambda _: None
        self._recogniser: Any = None
        self._listener: Any = None
        self._open, self._running = False, False
        self._heeded: frozenset[str] | None = None
        self._errors = 0
        self._began = self._ended = math.nan
        self._spotted = ""
        """What was found in this utterance before its end; empty for nothing."""

    def missing(self) -> str:
        """Why it cannot work here."""
        from jnius import autoclass

        there = autoclass("android.speech.SpeechRecognizer").isRecognitionAvailable(_activity())
        return "" if there else tr(NONE)

    def start(self, grammar: Grammar, hear: Hear) -> None:
        """Ask for the microphone once, and get ready; `VoiceTrouble` without the permission."""
        self.stop()
        activity = _activity()
        if activity.checkSelfPermission(RECORD_AUDIO) != 0:
            if RECORD_AUDIO in _asked:
                raise VoiceTrouble(tr(REFUSED))
            _asked.add(RECORD_AUDIO)
            activity.requestPermissions([RECORD_AUDIO], 1)
            raise VoiceTrouble(tr(ASKS))
        self._grammar, self._hear, self._errors = grammar, hear, 0
        self._main.post(self._make)

    def listen(self, *, on: bool) -> None:
        """Open the ears, or have it judge what it heard by now."""
        self._open = on
        self._main.post(self._begin if on else self._finish)

    def heed(self, commands: Collection[str] | None) -> None:
        """Count only these."""
        self._heeded = None if commands is None else frozenset(commands)

    def stop(self) -> None:
        """Let go of the service."""
        self._open, self._grammar = False, None
        self._hear = lambda _: None
        self._main.post(self._destroy)

    # in the main thread

    def _make(self) -> None:
        from jnius import autoclass

        if self._grammar is None:
            return
        self._recogniser = autoclass("android.speech.SpeechRecognizer").createSpeechRecognizer(_activity())
        self._listener = _listener(self)
        self._recogniser.setRecognitionListener(self._listener)
        self._hear(State("ready"))
        self._begin()

    def _begin(self) -> None:
        if self._recogniser is None or self._running or not self._open or self._grammar is None:
            return
        from jnius import autoclass

        names = autoclass("android.speech.RecognizerIntent")
        intent = autoclass("android.content.Intent")(names.ACTION_RECOGNIZE_SPEECH)
        intent.putExtra(names.EXTRA_LANGUAGE_MODEL, names.LANGUAGE_MODEL_FREE_FORM)
        intent.putExtra(names.EXTRA_LANGUAGE, TAGS.get(self._grammar.language, self._grammar.language))
        intent.putExtra(names.EXTRA_PREFER_OFFLINE, True)
        intent.putExtra(names.EXTRA_PARTIAL_RESULTS, True)
        intent.putExtra(names.EXTRA_MAX_RESULTS, N_BEST)
        self._running, self._spotted = True, ""
        self._began = self._ended = math.nan
        self._recogniser.startListening(intent)
        self._hear(State("listening"))

    def _finish(self) -> None:
        if self._recogniser is not None and self._running:
            self._recogniser.stopListening()
        if self._recogniser is not None:
            self._hear(State("ready"))

    def _destroy(self) -> None:
        recogniser, self._recogniser = self._recogniser, None
        self._running = False
        if recogniser is not None:
            recogniser.destroy()

    def _again(self, after_ms: int = AGAIN_MS) -> None:
        self._running = False
        if self._open:
            self._main.post(self._begin, after_ms)

    # what the listener tells

    def spoke(self, *, begins: bool) -> None:
        """Somebody begins to speak, or has ended."""
        if begins:
            self._began = self._now()
        else:
            self._ended = self._now()

    def loud(self, rms: float) -> None:
        """How loud it is, on Android's scale."""
        low, share = LOUDNESS
        speaking = not math.isnan(self._began) and math.isnan(self._ended)
        self._hear(Level(min(0.0, low + share * rms), math.nan, math.nan, speaking=speaking))

    def partial(self, texts: list[str]) -> None:
        """What it looks like so far: STOP is taken out of it."""
        grammar = self._grammar
        if grammar is None or not texts:
            return
        self._hear(Partial(texts[0]))
        for command in grammar.urgent:
            phrase = next(filter(None, (said_within(text, grammar, command) for text in texts)), "")
            if phrase and not self._spotted:
                self._spotted = command
                self._hear(Result(command, phrase, 0.8, self._began, self._now(), early=True))

    def result(self, texts: list[str], scores: list[float]) -> None:
        """The utterance is over: `texts` may have been said, with `scores`, -1 for unknown, the best first."""
        grammar, self._errors = self._grammar, 0
        if grammar is not None and texts:
            ended = self._now() if math.isnan(self._ended) else self._ended
            self.partial(texts[:1])
            if not self._spotted:
                found = interpret(texts, grammar)
                if isinstance(found, Meaning):
                    self._hear(Rejected(_refusal(found), found.command, ended=ended))
                else:
                    self._tell(found, grammar, scores, ended)
        self._again()

    def _tell(self, found: list[Match], grammar: Grammar, scores: list[float], ended: float) -> None:
        every = frozenset(grammar.phrases) | (SAID if grammar.language == "en" else {}).keys()
        heeded = (every - grammar.asked if self._heeded is None else self._heeded) | grammar.urgent
        if not found:
            self._hear(Rejected(tr("That was no command."), ended=ended))
            return
        best = found[0]
        score = scores[0] if scores and 0.0 < scores[0] <= 1.0 else 0.9
        confidence = max(0.5, min(1.0, best.alike * score)) if best.alike > 0 else 0.5
        if best.command not in heeded:
            asked = best.command in grammar.asked
            why = tr("counts only while a question is open") if asked else tr("does not count now")
            self._hear(Rejected(f"“{best.phrase}” {why}.", best.command, confidence, ended))
            return
        others = tuple((one.command, round(one.alike, 2)) for one in found[1:4])
        self._hear(
            Result(best.command, best.phrase, confidence, self._began, ended, others,
                   detail={"heard": best.heard})
        )  # fmt: skip

    def error(self, number: int) -> None:
        """The utterance ended without words."""
        if number in QUIET:
            if not math.isnan(self._began) and not self._spotted:
                self._hear(Rejected(tr("Nothing was understood."), ended=self._now()))
            self._errors = 0
            self._again()
            return
        self._errors += 1
        if number in SENTENCES or self._errors >= TRIES:
            self._running = self._open = False
            self._hear(State("failed", SENTENCES.get(number, tr(GIVES_UP).format(number))))
            return
        self._again(BUSY_MS)


def _refusal(meaning: Meaning) -> str:
    """Why what was understood is not done."""
    sentence = FORBIDDEN if meaning.negated else MORE
    return tr(sentence).format(phrase=meaning.phrase)


def _texts(bundle: Any) -> list[str]:
    found = bundle.getStringArrayList("results_recognition") if bundle is not None else None
    return [str(found.get(n)) for n in range(min(N_BEST, found.size()))] if found is not None else []


def _scores(bundle: Any) -> list[float]:
    found = bundle.getFloatArray("confidence_scores") if bundle is not None else None
    return [float(score) for score in found] if found is not None else []


def _heedless() -> Any:
    """What a listener is told and does nothing about."""
    from jnius import PythonJavaClass, java_method

    class Heedless(PythonJavaClass):  # type: ignore[misc]
        @java_method("(Landroid/os/Bundle;)V")  # type: ignore[untyped-decorator]
        def onReadyForSpeech(self, bundle: Any) -> None:  # noqa: N802 - Android's name
            return

        @java_method("([B)V")  # type: ignore[untyped-decorator]
        def onBufferReceived(self, buffer: Any) -> None:  # noqa: N802 - Android's name
            return

        @java_method("(ILandroid/os/Bundle;)V")  # type: ignore[untyped-decorator]
        def onEvent(self, kind: int, bundle: Any) -> None:  # noqa: N802 - Android's name
            return

    return Heedless


def _listener(to: AndroidRecognizer) -> Any:
    """An `android.speech.RecognitionListener`; the class is made here because its base is only on a phone."""
    from jnius import java_method

    class Listener(_heedless()):  # type: ignore[misc]
        __javainterfaces__ = ("android/speech/RecognitionListener",)

        @java_method("()V")  # type: ignore[untyped-decorator]
        def onBeginningOfSpeech(self) -> None:  # noqa: N802 - Android's name
            to.spoke(begins=True)

        @java_method("(F)V")  # type: ignore[untyped-decorator]
        def onRmsChanged(self, rms: float) -> None:  # noqa: N802 - Android's name
            _guarded(to.loud, rms)

        @java_method("()V")  # type: ignore[untyped-decorator]
        def onEndOfSpeech(self) -> None:  # noqa: N802 - Android's name
            to.spoke(begins=False)

        @java_method("(I)V")  # type: ignore[untyped-decorator]
        def onError(self, number: int) -> None:  # noqa: N802 - Android's name
            _guarded(to.error, number)

        @java_method("(Landroid/os/Bundle;)V")  # type: ignore[untyped-decorator]
        def onResults(self, bundle: Any) -> None:  # noqa: N802 - Android's name
            _guarded(lambda: to.result(_texts(bundle), _scores(bundle)))

        @java_method("(Landroid/os/Bundle;)V")  # type: ignore[untyped-decorator]
        def onPartialResults(self, bundle: Any) -> None:  # noqa: N802 - Android's name
            _guarded(lambda: to.partial(_texts(bundle)))

    return Listener()


class AndroidSpeaker:
    """A `Speaker`: the voice that is chosen in Android's settings, in English as the app's sentences are."""

    def __init__(self) -> None:
        """Opens nothing."""
        self._main = _MainThread()
        self._tell: Callable[[str, str], object] = lambda *_: None
        self._voice: Any = None
        self._listener: Any = None
        self._ready = False
        self._waiting: tuple[str, float] | None = None
        self._saying = ""

    def missing(self) -> str:
        """Nothing is known against it before it was tried."""
        return ""

    def start(self, tell: Callable[[str, str], object]) -> None:
        """Reach for the voice, which takes a moment."""
        self._tell = tell
        self._main.post(self._make)

    def say(self, words: str, rate: float) -> None:
        """Say it, as soon as the voice is there."""
        self._waiting = words, rate
        self._main.post(self._speak)

    def hush(self) -> None:
        """Break off."""
        self._waiting, self._saying = None, ""
        self._main.post(lambda: self._voice.stop() if self._voice is not None else None)

    def stop(self) -> None:
        """Let go of the voice."""
        self._tell = lambda *_: None
        self._waiting, self._saying, self._ready = None, "", False
        self._main.post(self._shut_down)

    def _make(self) -> None:
        from jnius import autoclass

        self._listener = _on_init(self._begun)
        self._voice = autoclass("android.speech.tts.TextToSpeech")(_activity(), self._listener)

    def _begun(self, status: int) -> None:
        if status != 0:
            self._tell("failed", tr(NO_VOICE))
            return
        from jnius import autoclass

        if self._voice is not None:
            self._voice.setLanguage(autoclass("java.util.Locale").forLanguageTag(TAGS["en"]))
            self._ready = True
            self._main.post(self._speak)

    def _speak(self) -> None:
        if not self._ready or self._voice is None or self._waiting is None:
            return
        from jnius import autoclass, cast

        (words, rate), self._waiting = self._waiting, None
        self._voice.setSpeechRate(rate)
        self._saying = words
        self._tell("began", words)
        spoken = cast("java.lang.CharSequence", autoclass("java.lang.String")(words))
        self._voice.speak(spoken, 0, None, "pilothouse")
        self._main.post(self._poll, 2 * POLL_MS)

    def _poll(self) -> None:
        if self._voice is None or not self._saying:
            return
        if self._voice.isSpeaking():
            self._main.post(self._poll, POLL_MS)
            return
        said, self._saying = self._saying, ""
        self._tell("ended", said)

    def _shut_down(self) -> None:
        voice, self._voice = self._voice, None
        if voice is not None:
            voice.stop()
            voice.shutdown()


def _on_init(begun: Callable[[int], None]) -> Any:
    from jnius import PythonJavaClass, java_method

    class OnInit(PythonJavaClass):  # type: ignore[misc]
        __javainterfaces__ = ("android/speech/tts/TextToSpeech$OnInitListener",)

        @java_method("(I)V")  # type: ignore[untyped-decorator]
        def onInit(self, status: int) -> None:  # noqa: N802 - Android's name
            _guarded(begun, status)

    return OnInit()
