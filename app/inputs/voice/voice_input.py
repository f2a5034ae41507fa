"""Voice input: when the microphone is open, and what becomes of each command that was understood.

Push to talk unless hands-free is chosen: by the button in the window, by a key, by a button of a gamepad. Nothing is loaded
and nothing listens while it is switched off. Everything in the UI thread.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from kivy.clock import Clock

from app.core.notifications import notify
from app.inputs.base.method_app import MethodApp
from app.inputs.voice.command_gate import CommandGate
from app.inputs.voice.interfaces.speech_recognizer import (
    Level,
    Rejected,
    Result,
    SpeechRecognizer,
    State,
)
from app.inputs.voice.recognition.phrases import PHRASES
from app.inputs.voice.recognizer_session import RecognizerSession
from app.inputs.voice.recognizers import choose
from app.inputs.voice.talk_button import TalkButton
from app.inputs.voice.voice_settings import VoiceOptions
from app.inputs.voice.voice_status import CLIPS, VoiceStatus
from app.intents.intents import Heard
from widgets.core.language import mark, tr

__all__ = ["VoiceInput"]

RETRY_PERIOD = 5.0
"""Where it is to listen all the time and the microphone gives nothing, it is opened anew so often [s]."""
HEARS = mark("The microphone works again.")
TRIED = "Understood; while it is tried out nothing is done."


class VoiceInput(VoiceOptions):
    """The method `voice`."""

    name = "voice"

    def __init__(self, app: MethodApp, make: Callable[[], SpeechRecognizer] | None = None) -> None:
        """`app` is asked for its `settings`, `intents`, `inputs`, `methods`, `talk`, `shell`, `connect` and `now`.

        `make` makes what understands, in place of the one that is chosen.
        """
        super().__init__(app)
        self._make, self._instead = make or self._chosen, ""
        """`_instead` says why what understands is not the one that is wanted; empty where it is."""
        self._status = VoiceStatus(app.now, lambda: self._settings)
        self._button, self._gate = TalkButton(app.now), CommandGate(app)
        self._session = RecognizerSession(
            self._status.measure, Clock.create_trigger(lambda _: self._drain(), 0)
        )
        self.last: Result | Rejected | None = None
        """What was understood last, or not; None before the first."""
        self.said = ""
        """What came of it, as one sentence."""
        self._retry_at = -math.inf
        """When the microphone that gave nothing is opened anew [s]."""
        self.trying = False
        """It is being tried out."""

    @property
    def languages(self) -> tuple[str, ...]:
        """Those that what understands here knows and that there are commands in."""
        known = (self._session.recognizer or self._make()).languages
        return tuple(language for language in PHRASES if language in known)

    # how it stands

    @property
    def level(self) -> Level:
        """How loud it was last."""
        return self._status.level

    @property
    def loud(self) -> bool:
        """It is too loud here for voice."""
        return self._status.loud

    @property
    def listening(self) -> bool:
        """The microphone is open, or opening."""
        return self._session.listening

    @property
    def ready(self) -> bool:
        """It would hear, or hears."""
        return self._session.recognizer is not None and self._status.is_ready

    @property
    def problem(self) -> str:
        """Why it does not work though it is on; empty when it is well. What is overdriven is only understood badly."""
        return self._status.fault(self.mistaken) or (
            tr(CLIPS) if self.listening and self._status.is_clipping else ""
        )

    @property
    def standing(self) -> str:
        """How it stands, in a few words."""
        return self._status.standing

    @property
    def sign(self) -> str:
        """The same for the button to talk: `ready`, `listening`, `loud` or `wrong`; empty while it is off."""
        return self._status.sign(self.mistaken, listening=self.listening)

    # a method's life

    def start(self) -> None:
        """Get ready; nothing where it is."""
        if self.mistaken:
            self._say(self.mistaken)
            self.mistaken = ""
        if self._session.recognizer is None:
            self._begin()
        held = self._app.inputs.meanings.held["talk"]
        if self._hold not in held:
            held.append(self._hold)

    def stop(self) -> None:
        """Rest: the microphone is closed and nothing is loaded."""
        held = self._app.inputs.meanings.held["talk"]
        if self._hold in held:
            held.remove(self._hold)
        self.trying = False
        self._end()

    def close(self) -> None:
        """For good."""
        self.stop()

    def _chosen(self) -> SpeechRecognizer:
        chosen, self._instead = choose(self.recognizer, self.model)
        return chosen

    def _begin(self) -> None:
        self._status.reset("starting")
        if fault := self._session.start(self._make(), self.language):
            self._fail(fault)
        else:
            self._say(self._instead, "info")
            self._fit()

    def _end(self) -> None:
        self._session.stop()
        self._button.clear()
        self._status.reset("off")

    def _restart(self) -> None:
        """With other settings; nothing where it has not begun, and nothing was missing."""
        failed = self._status.state.word == "failed" and (self.on or self.trying)
        if self._session.recognizer is not None or failed:
            self._end()
            self._begin()

    def _fail(self, sentence: str) -> None:
        self._end()
        self._status.reset("failed", sentence)
        self._say(sentence)

    # the button to talk

    def press(self) -> None:
        """The button in the window is down."""
        if self._status.state.word == "failed" and self._session.recognizer is None and self.on:
            self._begin()  # what was missing may have been plugged in
        self._button.press()
        self._fit()

    def release(self) -> None:
        """It is up: what was held closes the microphone, a tap leaves it open for one command."""
        self._button.release()
        self._fit()

    def rest(self) -> None:
        """No button is held any more, and no tap counts."""
        self._button.clear()
        self._fit()

    def _hold(self, down: bool) -> None:
        """A key, or a button of a gamepad, that means to talk."""
        self._button.hold("key", down=down)
        self._fit()

    def try_out(self, *, on: bool) -> None:
        """Listen, and do nothing about what is understood but STOP: to see whether one is understood."""
        if on == self.trying:
            return
        if on and self._session.recognizer is None:
            self._begin()
        self.trying = on
        if not on and not self.on:
            self._end()
        self._fit()

    @property
    def busy(self) -> bool:
        """Time has to be told to it though it is off: it is being tried out."""
        return self.trying

    def _fit(self) -> None:
        """The microphone is open while somebody wants to be heard."""
        button = self._button
        wants = self.hands_free or self.trying or button.is_held or button.is_tapped
        if self._session.recognizer is not None and wants != self.listening:
            self._heed()
            self._session.listen(on=wants)

    # what time changes

    def update(self, now: float) -> None:
        """With each heartbeat."""
        self._drain()
        self._gate.update(now)
        self._heed()
        if self._button.is_over(now):
            self.rest()
        if self._status.is_deaf and not self.listening and now >= self._retry_at:
            self._retry_at = now + RETRY_PERIOD
            self._fit()

    def _heed(self) -> None:
        """Have the recogniser count what counts now."""
        self._session.heed(self._gate.counting(PHRASES[self.language]))

    # what is heard

    def _drain(self) -> None:
        for event in self._session.drain():
            if isinstance(event, State):
                self._on_state(event)
            elif isinstance(event, Result):
                self._on_result(event)
            elif isinstance(event, Rejected):
                self._on_rejected(event)

    def _on_state(self, state: State) -> None:
        if state.word == "failed":
            self._fail(state.sentence)
            return
        news = self._status.change(state)
        if news == "hears":
            self._say(tr(HEARS), "info")
        elif news:
            self._say(
                self._status.fault(self.mistaken) or state.sentence,
                "warn" if state.word != "listening" else "info",
            )
        if self._status.has_lost_microphone:  # whoever wants it opens it anew
            self._session.listening = False
            self._button.clear()
            self._retry_at = self._app.now() + RETRY_PERIOD

    def _on_result(self, result: Result) -> None:
        stop = result.command == "stop"
        if not stop and (why := self._gate.why_not(result)):
            self._on_rejected(Rejected(why, result.command, result.confidence, result.ended))
            return
        self.last = result
        if self.trying and not (stop and self._app.intents.possible("stop")):
            self.said = TRIED
            return
        self.said = self._app.intents.submit(_heard(result, self.level.noise)).sentence
        if not self._button.is_held:
            self._button.end_tap()
            self._fit()

    def _on_rejected(self, rejected: Rejected) -> None:
        self.last, self.said = rejected, rejected.reason
        if self.trying:
            return
        asked_for = not self.hands_free
        log = self._app.methods.get("log")
        if log is not None and log.on and (asked_for or rejected.command):
            log.tracks.unheard(self.name, rejected.reason, noise=self.level.noise)
        if asked_for:
            self._say(rejected.reason)
            _say_aloud(self._app, rejected)
        if not self._button.is_held and self._button.is_tapped:
            self.rest()

    def _say(self, sentence: str, level: str = "warn") -> None:
        if sentence:
            notify(self._app, tr("Voice: {sentence}").format(sentence=sentence), level, self.name)


def _say_aloud(app: MethodApp, rejected: Rejected) -> None:
    """A command that was heard and is not done: whoever speaks may not look at the glass."""
    talk = getattr(app, "talk", None)
    if rejected.command and talk is not None and talk.on:
        talk.say(rejected.reason, "answer")


def _heard(result: Result, noise: float) -> Heard:
    """The intent of `result`, with what the response log may keep of it."""
    others = [list(one) for one in result.alternatives[:3]]
    snr = round(result.snr, 1) if math.isfinite(result.snr) else None
    ended = math.nan if result.early else result.ended  # its end was not heard yet
    return Heard(
        result.command,
        VoiceInput.name,
        result.confidence,
        result.began,
        ended,
        said=result.said,
        noise=noise,
        snippet={"snr": snr, "others": others} | dict(result.detail),
    )
