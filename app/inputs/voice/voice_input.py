"""Speaking as a way in: who listens and when, what counts just now, and what becomes of what was understood.

Push to talk unless hands-free is chosen: by the button on the glass, by a key, by a button of a gamepad. Nothing is loaded
and nothing listens while it is switched off. Everything in the UI thread, but for `hear`.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from typing import Any

from kivy.clock import Clock

from app.core.checked_settings import Kept, known, shown
from app.core.notifications import tell
from app.device import is_android
from app.inputs.base.toggleable_method import Switched
from app.inputs.voice.interfaces.speech_recognizer import (
    Event,
    Grammar,
    Level,
    Partial,
    Rejected,
    Result,
    State,
    VoiceRecognizer,
    VoiceTrouble,
)
from app.inputs.voice.recognition.phrases import PHRASES
from app.intents.intents import Heard

__all__ = ["KINDS", "Speaking"]

KINDS: dict[str, str] = {"phonemes": "By sounds", "sphinx": "By words", "android": "Android's own"}
"""What can understand, with its name for the operator; the first that is there is the usual one."""
TAPPED = 0.4
"""A press of the button to talk that is shorter than this is a tap: the ears stay open for one command [s]."""
TAP_LASTS = 6.0
"""So long at most after a tap [s]."""
LONGEST = 30.0
"""Something lies on the button: the ears close after so long [s]."""
KEPT = 64
"""Events that wait for the UI thread; one second of them at the most."""
ECHO = 0.3
"""What was heard up to so long after the app itself spoke was its own voice [s]."""
WHILE_ASKED = frozenset({"yes", "no", "pause"})
"""What counts while something waits for a yes; STOP always does."""
DEAF = "The app itself was speaking."
TRIES_AGAIN = 5.0
"""Where it is to listen all the time and the microphone gives nothing, it is opened anew so often [s]."""
DEAF_NOW = "STOP by voice is not heard now; the microphone is tried again by itself."
MUTED_NOW = "STOP by voice is not heard now."
HEARS = "The microphone works again."
CLIPS = "The microphone is overdriven: speak more softly, or farther away from it."
CLIPPED = 1.0
"""So long that is told after it was measured last [s]."""
EARLIER = "That was said before anything was asked."
NOTHING = "Nothing was understood."


def _usual() -> VoiceRecognizer:
    """The best recogniser that there is here; the first, which says what it lacks, where there is none."""
    if is_android():
        from app.device.speech import AndroidRecognizer

        return AndroidRecognizer()
    return (
        _made("phonemes") if not _made("phonemes").missing() or _made("sphinx").missing() else _made("sphinx")
    )


def _made(kind: str) -> VoiceRecognizer:
    from app.inputs.voice.process.worker import recognizer

    return recognizer(kind)


class Speaking(Switched):
    """The method `voice`."""

    name = "voice"

    def __init__(self, app: Any, make: Callable[[], VoiceRecognizer] = _usual) -> None:
        """`app` is asked for its `settings`, `intents`, `inputs`, `methods`, `talk`, `shell`, `connect` and `now`."""
        self._app, self._make = app, make
        self._voice: VoiceRecognizer | None = None
        """What understands; None while voice is off."""
        self._events: deque[Event] = deque(maxlen=KEPT)
        self._wake = Clock.create_trigger(lambda _: self._drain(), 0)
        self.level = Level(-math.inf, math.nan, math.nan)
        """How loud it was last."""
        self.last: Result | Rejected | None = None
        """What was understood last, or not; None before the first."""
        self.at = math.nan
        """When that was [s]."""
        self.said = ""
        """What came of it, as one sentence."""
        self.partial = ""
        """What it looks like so far; empty where nothing is being said."""
        self.loud = False
        """It is too loud here for voice."""
        self._state = State("off")
        self._again = self._clips_until = -math.inf
        """When the microphone that gave nothing is opened anew; until when it counts as overdriven [s]."""
        self._trying = False
        self._held: set[str] = set()
        """Who holds the button to talk: `glass`, `key`."""
        self._since = self._until = math.nan
        """Since when it is held; until when a tap keeps the ears open [s]."""
        self._listening = False
        self._heeded: frozenset[str] | None = None
        self._asked_since = math.nan
        """Since when a question is open [s]; NaN for none."""
        self.mistaken = ""
        """One sentence about settings that mean nothing; empty when all is well."""
        self._read()

    # what is kept

    def _read(self) -> None:
        kept = Kept(self._app.settings.get("voice"), "voice")
        self._on, self._hands_free = kept.flag("on", usual=False), kept.flag("hands_free", usual=False)
        self.mistaken = kept.sentence
        language = kept.values.get("language", "en")
        self._language: str = language if known(language, PHRASES) else "en"
        if language != self._language:
            self.mistaken = f"There are no commands in the language {shown(language)}; they are English."

    def _kept(self) -> dict[str, Any]:
        return {"on": self._on, "hands_free": self._hands_free, "language": self._language}

    @property
    def hands_free(self) -> bool:
        """It listens all the time, and not only while the button to talk is held."""
        return self._hands_free

    @hands_free.setter
    def hands_free(self, on: bool) -> None:
        self._hands_free = on
        self._keep()
        self._fit()

    @property
    def language(self) -> str:
        """ISO 639-1, of what may be said."""
        return self._language

    @language.setter
    def language(self, language: str) -> None:
        if language not in PHRASES:
            raise ValueError(f"There are no commands in {language!r}; there are {', '.join(PHRASES)}.")
        self._language = language
        self._keep()
        if self._voice is not None:
            self._end()
            self._begin()

    @property
    def languages(self) -> tuple[str, ...]:
        """Those that what understands here knows and that there are commands in."""
        known = (self._voice or self._make()).languages
        return tuple(language for language in PHRASES if language in known)

    # how it stands

    @property
    def listening(self) -> bool:
        """The ears are open, or opening."""
        return self._listening

    @property
    def ready(self) -> bool:
        """It would hear, or hears."""
        return self._voice is not None and self._state.word in ("ready", "listening", "too loud")

    @property
    def problem(self) -> str:
        """Why it does not work though it is on; empty when it is well."""
        clips = self._listening and self._app.now() < self._clips_until
        return self._fault or (CLIPS if clips else "")

    @property
    def _fault(self) -> str:
        """Why nothing is understood; what is overdriven is only understood badly."""
        if self._deaf_now:
            return f"{self._state.sentence} {MUTED_NOW if self._state.word == 'muted' else DEAF_NOW}"
        if self.loud and self._voice is not None:
            return self._state.sentence or "Too loud here for voice."
        wrong = self._state.word in ("failed", "ready") and self._state.sentence
        return self.mistaken or (self._state.sentence if wrong else "")

    @property
    def _deaf_now(self) -> bool:
        """The ears are open and the microphone is muted; or they are to be open all the time, and it is gone."""
        gone = self._hands_free and self._state.word == "ready" and bool(self._state.sentence)
        return gone or self._state.word == "muted"

    @property
    def standing(self) -> str:
        """How it stands, in a few words."""
        if not self._on:
            return "off"
        if self._deaf_now:
            return "deaf"
        if self.loud:
            return "too loud"
        if self._state.word == "listening":
            return "listening"
        return {"starting": "gets ready", "ready": "hold to talk"}.get(self._state.word, "does not work")

    @property
    def sign(self) -> str:
        """The same for the button to talk: `ready`, `listening`, `loud` or `wrong`; empty while it is off."""
        if not self._on:
            return ""
        if self.loud and not self._deaf_now:
            return "loud"
        return "wrong" if self._fault else "listening" if self._listening else "ready"

    # a method's life

    def start(self) -> None:
        """Get ready; nothing where it is."""
        if self.mistaken:
            self._say(self.mistaken)
            self.mistaken = ""
        if self._voice is None:
            self._begin()
        held = self._app.inputs.meanings.held["talk"]
        if self._hold not in held:
            held.append(self._hold)

    def stop(self) -> None:
        """Rest: the ears are closed and nothing is loaded."""
        held = self._app.inputs.meanings.held["talk"]
        if self._hold in held:
            held.remove(self._hold)
        self._trying = False
        self._end()

    def close(self) -> None:
        """For good."""
        self.stop()

    def _begin(self) -> None:
        voice = self._make()
        self._events.clear()
        self._state, self.loud, self._heeded, self._listening = State("starting"), False, None, False
        if (absent := voice.missing()) or self._language not in voice.languages:
            self._fail(absent or f"What understands here does not know the language {self._language}.")
            return
        try:
            voice.start(Grammar(PHRASES[self._language], self._language), self.hear)
        except VoiceTrouble as trouble:
            self._fail(str(trouble))
            return
        self._voice = voice
        self._fit()

    def _end(self) -> None:
        voice, self._voice = self._voice, None
        self._held.clear()
        self._until = math.nan
        self._listening, self.loud, self.partial = False, False, ""
        self._state = State("off")
        if voice is not None:
            voice.stop()
        self._events.clear()

    def _fail(self, sentence: str) -> None:
        self._end()
        self._state = State("failed", sentence)
        self._say(sentence)

    # the button to talk

    def press(self) -> None:
        """The button on the glass is down."""
        if self._state.word == "failed" and self._voice is None and self._on:
            self._begin()  # what was missing may have been plugged in
        self._until = math.nan
        self._grip("glass", down=True)

    def release(self) -> None:
        """It is up: what was held closes the ears, a tap leaves them open for one command."""
        tapped = "glass" in self._held and self._app.now() - self._since < TAPPED
        if tapped:
            self._until = self._app.now() + TAP_LASTS
        self._grip("glass", down=False)

    def rest(self) -> None:
        """No button is held any more, and no tap counts."""
        self._held.clear()
        self._until = math.nan
        self._fit()

    def _hold(self, down: bool) -> None:
        """A key, or a button of a gamepad, that means to talk."""
        self._grip("key", down=down)

    def _grip(self, who: str, *, down: bool) -> None:
        if down and not self._held:
            self._since = self._app.now()
        (self._held.add if down else self._held.discard)(who)
        self._fit()

    def try_out(self, *, on: bool) -> None:
        """Listen, and do nothing about what is understood but STOP: to see whether one is understood."""
        if on == self._trying:
            return
        if on and self._voice is None:
            self._begin()
        self._trying = on
        if not on and not self._on:
            self._end()
        self._fit()

    @property
    def trying(self) -> bool:
        """It is being tried out."""
        return self._trying

    @property
    def busy(self) -> bool:
        """Time has to be told to it though it is off: it is being tried out."""
        return self._trying

    def _fit(self) -> None:
        """The ears are open while somebody wants to be heard."""
        tapped = not math.isnan(self._until)
        wanted = self._voice is not None and (self._hands_free or self._trying or bool(self._held) or tapped)
        if wanted != self._listening and self._voice is not None:
            self._listening = wanted
            self._heed()
            self._voice.listen(on=wanted)

    # what time changes

    def look(self, now: float) -> None:
        """With each heartbeat."""
        self._drain()
        asking = self._app.intents.asking
        if asking != (not math.isnan(self._asked_since)):
            self._asked_since = now if asking else math.nan
        self._heed()
        if now >= self._until or (self._held and now - self._since > LONGEST):
            self.rest()
        if self._deaf_now and not self._listening and now >= self._again:
            self._again = now + TRIES_AGAIN
            self._fit()

    def _heed(self) -> None:
        """What counts: nothing but STOP while the app speaks, yes and no only while something asks."""
        wanted: frozenset[str] | None = None
        if self._talked()[0]:
            wanted = frozenset()
        elif self._app.intents.pending is not None:
            wanted = WHILE_ASKED
        elif self._app.intents.asking:
            wanted = frozenset(PHRASES[self._language])
        if self._voice is not None and wanted != self._heeded:
            self._heeded = wanted
            self._voice.heed(wanted)

    # what is heard

    def hear(self, event: Event) -> None:
        """From the recogniser, in whichever thread: STOP is taken in the next frame, all else with the heartbeat."""
        if isinstance(event, Level):
            self.level = event
            if event.clipped:
                self._clips_until = self._app.now() + CLIPPED
            return
        self._events.append(event)
        if isinstance(event, Result):
            self._wake()

    def _drain(self) -> None:
        while self._events:
            event = self._events.popleft()
            if isinstance(event, State):
                self._stand(event)
            elif isinstance(event, Partial):
                self.partial = event.text
            elif isinstance(event, Result):
                self._understood(event)
            elif isinstance(event, Rejected):
                self._rejected(event)

    def _stand(self, state: State) -> None:
        if state.word == "failed":
            self._fail(state.sentence)
            return
        before, told, deaf = self.loud, self._state.sentence, self._deaf_now
        self._state = state
        if state.word == "too loud":
            self.loud = True
        elif state.word == "listening" and state.sentence:  # told only where it had been too loud
            self.loud = False
        news = state.sentence not in ("", told)
        if deaf and state.word == "listening":
            self._say(HEARS, "info")
        elif self.loud != before or (news and (self._deaf_now or not (self.loud or before))):
            self._say(self._fault or state.sentence, "warn" if state.word != "listening" else "info")
        if state.word == "ready" and state.sentence:  # the microphone is gone: who wants it opens it anew
            self._listening = False
            self._held.clear()
            self._until = math.nan
            self._again = self._app.now() + TRIES_AGAIN

    def _understood(self, result: Result) -> None:
        self.partial = ""
        stop = result.command == "stop"
        if not stop and (why := self._deaf(result)):
            self._rejected(Rejected(why, result.command, result.confidence, result.ended))
            return
        self.last, self.at = result, self._app.now()
        if self._trying and not (stop and self._app.intents.possible("stop")):
            self.said = "Understood; while it is tried out nothing is done."
            return
        snippet = {"snr": _number(result.snr), "others": [list(one) for one in result.alternatives[:3]]}
        ended = math.nan if result.early else result.ended
        heard = Heard(
            result.command,
            self.name,
            result.confidence,
            result.began,
            ended,
            said=result.said,
            noise=self.level.noise,
            snippet=snippet | dict(result.detail),
        )
        self.said = self._app.intents.take(heard).sentence
        if not self._held:
            self._until = math.nan
            self._fit()

    def _talked(self) -> tuple[bool, float]:
        """Whether the app itself speaks, and when it did last [s]; one that cannot talk never did."""
        talk = getattr(self._app, "talk", None)
        return (talk.speaking, talk.spoke) if talk is not None else (False, -math.inf)

    def _deaf(self, result: Result) -> str:
        """Why it does not count; empty where it does."""
        speaks, spoke = self._talked()
        if speaks or result.began < spoke + ECHO:
            return DEAF
        if result.command in ("yes", "no") and result.began < self._asked_since:
            return EARLIER
        return ""

    def _rejected(self, rejected: Rejected) -> None:
        self.partial = ""
        self.last, self.at, self.said = rejected, self._app.now(), rejected.reason
        if self._trying:
            return
        asked_for = not self._hands_free
        log = self._app.methods.get("log")
        if log is not None and log.on and (asked_for or rejected.command):
            log.tracks.unheard(self.name, rejected.reason, noise=self.level.noise)
        if asked_for:
            self._say(rejected.reason)
        if not self._held and not math.isnan(self._until):
            self.rest()

    def _say(self, sentence: str, level: str = "warn") -> None:
        if sentence:
            tell(self._app, f"Voice: {sentence}", level, self.name)


def _number(value: float) -> float | None:
    return round(value, 1) if math.isfinite(value) else None
