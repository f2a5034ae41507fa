"""Talk-back: says aloud what was asked for by voice or shake, what the robot made of it, and alarms; and whatever `say` is given.

app.talk.say("Map layers")                     # what is marked: the newest only
app.talk.say("Go home?", "answer")             # one after the other
app.talk.say("Battery low.", "alarm")          # at once, the newest first

Off until it is switched on, since everything stands on the glass as well and others would listen along; a label
is spoken wherever whoever sets the labels wants it. Of what a robot is asked for only what it confirmed is told as done.
Nothing is loaded before the first word, nor after a minute of silence. Everything in the UI thread, but for `_tell`.
"""

from __future__ import annotations

import math
import re
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, Protocol

from app.core.checked_settings import CheckedSettings
from app.core.notifications import notify
from app.device import is_android
from app.inputs.base.method_app import MethodApp
from app.inputs.base.toggleable_method import ToggleableMethod
from app.inputs.voice.interfaces.speaker import Speaker
from app.inputs.voice.speech.tts import VOICES, choose_voice, speaker_of
from app.intents.intents import LOCAL_INTENTS, Heard, Verdict
from app.link.channels import EVENT, OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Post
from widgets.core.language import mark, tr

__all__ = ["RATES", "Talkback", "aloud"]

Kind = Literal["answer", "alarm", "label"]
RATES = (0.7, 1.6)
"""How fast it may talk, 1 is usual."""
MAX_WAITING = 4
"""So many sentences wait at most; the oldest that is no alarm is left out."""
MAX_AGE = 6.0
"""An answer or a label that waited longer is not said any more [s]."""
SLEEP_TIMEOUT = 60.0
"""After so long a silence the voice is put away [s]."""
SENTENCE_TIMEOUT = 15.0
"""A voice that does not end a sentence within so long is taken to have lost it [s]."""
EYES_OFF = ("voice", "shake")
"""Methods that are answered aloud: whoever uses them may not look at the glass."""
MAX_LETTERS = 200
"""Letters of a sentence that are spoken."""
BRAKE = {
    "stop": "brake", "stops": "brakes", "stopped": "braked", "stopping": "braking",
    "halt": "brake", "halts": "brakes", "halted": "braked", "halting": "braking",
    "abort": "end", "aborts": "ends", "aborted": "ended", "aborting": "ending", "freeze": "rest", "freezes": "rests",
}  # fmt: skip
"""It never says STOP in any of its words, which the microphone would take for the operator's."""
_STOPS = re.compile(rf"\b({'|'.join(BRAKE)})\b", re.IGNORECASE)


def aloud(words: str) -> str:
    """The words as they are spoken: no quotation marks, no line breaks, and never STOP."""
    plain = re.sub(r"[“”\"…·\s\u00a0]+", " ", words).strip()[:MAX_LETTERS]
    return _STOPS.sub(lambda found: BRAKE[found[0].lower()], plain)


@dataclass(frozen=True, slots=True)
class _Line:
    words: str
    kind: Kind
    at: float


def _android_or(voice: str) -> Speaker:
    if is_android():
        from app.inputs.voice.android.speech import AndroidSpeaker

        return AndroidSpeaker()
    return speaker_of(voice)


class TalkingApp(MethodApp, Protocol):
    """An app that can talk."""

    talk: Talkback
    """What talks."""


class Talkback(ToggleableMethod):
    """`app.talk`, and an entry of `app.inputs.methods` that is no way in."""

    name = "talk"

    def __init__(self, app: TalkingApp, make: Callable[[str], Speaker] = _android_or) -> None:
        """`app` is asked for its `settings`, `intents`, `session`, `shell`, `connect` and `now`; it gets `app.talk`."""
        app.talk = self
        self._app, self._make = app, make
        self._speaker: Speaker | None = None
        self._lines: deque[_Line] = deque()
        self._told: deque[tuple[str, str]] = deque(maxlen=32)
        """What the voice told, from its own thread."""
        self._now_said: _Line | None = None
        self._began = math.nan
        self.spoke = -math.inf
        """When it ended its last sentence [s]; infinitely long ago before the first."""
        self._used = -math.inf
        self._instead = ""
        """Why another voice talks than the one that is chosen, as it was said last; empty where it is that one."""
        self.problem = ""
        """Why it is silent though it was asked to talk; empty when it is well."""
        self._session: Any = None
        self._stopped = False
        self._running = False
        self._read()

    # what is kept

    def _read(self) -> None:
        kept = CheckedSettings(self._app.settings.get("talk"), mark("talking", "settings"))
        self._on, self._rate = kept.flag("on", usual=False), kept.number("rate", *RATES, usual=1.0)
        self._voice = kept.word("voice", VOICES, next(iter(VOICES)))
        self.mistaken = kept.sentence
        """One sentence about settings that mean nothing; empty when all is well."""

    def _kept(self) -> dict[str, Any]:
        return {"on": self._on, "voice": self._voice, "rate": self._rate}

    @property
    def voice(self) -> str:
        """The voice, of `VOICES`; a phone has one of its own."""
        return self._voice

    @voice.setter
    def voice(self, voice: str) -> None:
        if voice not in VOICES:
            raise ValueError(f"There is no voice {voice!r}; there are {', '.join(VOICES)}.")
        self._voice, self.problem = voice, ""
        self._keep()
        self._put_away()

    @property
    def rate(self) -> float:
        """How fast it talks, within `RATES`; 1 is usual."""
        return self._rate

    @rate.setter
    def rate(self, rate: float) -> None:
        if not RATES[0] <= rate <= RATES[1]:
            raise ValueError(f"It cannot talk {rate} times as fast; {RATES[0]} to {RATES[1]}.")
        self._rate = rate
        self._keep()

    @property
    def standing(self) -> str:
        """In a word or two."""
        return (
            tr("off") if not self._on else tr("talks") if not self.problem else tr("silent", context="voice")
        )

    # a method's life

    def start(self) -> None:
        """Tell what happens."""
        if not self._running:
            self._running, self.problem = True, ""
            self._app.intents.on_taken.append(self._taken)

    def stop(self) -> None:
        """Say nothing more, and put the voice away."""
        if self._running:
            self._running = False
            self._app.intents.on_taken.remove(self._taken)
        self._follow(None)
        self._put_away()

    def close(self) -> None:
        """For good."""
        self.stop()

    def update(self, now: float) -> None:
        """With each heartbeat."""
        if self._running:
            if self._app.session is not self._session:
                self._follow(self._app.session)
            self._watch_stop()
        self._turn(now)

    @property
    def busy(self) -> bool:
        """Time has to be told to it though it is off: it says a label."""
        return self._speaker is not None

    # what is said

    @property
    def speaking(self) -> bool:
        """It says something just now."""
        return self._now_said is not None

    def say(self, words: str, kind: Kind = "label") -> None:
        """Say it; nothing for no words."""
        spoken = aloud(words)
        if not spoken or self.problem:
            return
        line = _Line(spoken, kind, self._app.now())
        if kind == "label":
            self._lines = deque(one for one in self._lines if one.kind != "label")
        if kind == "alarm":
            self._lines.appendleft(line)
        else:
            self._lines.append(line)
        while len(self._lines) > MAX_WAITING:
            mild = [one for one in self._lines if one.kind != "alarm"]
            self._lines.remove(mild[0] if mild else self._lines[-1])
        said = self._now_said
        if said is not None and (said.kind == "label" or (kind == "alarm" and said.kind != "alarm")):
            self._next()
        self._turn(self._app.now())

    def hush(self) -> None:
        """Break off, and forget what waits."""
        self._lines.clear()
        if self._speaker is not None and self._now_said is not None:
            self._speaker.hush()
            self._ended(self._app.now())

    def _turn(self, now: float) -> None:
        while self._told:
            self._on_speech(*self._told.popleft(), now)
        if self._now_said is not None and now - self._began > SENTENCE_TIMEOUT:
            self._ended(now)
        if self._now_said is None and self._lines:
            self._next()
        if self._speaker is not None and self._now_said is None and now - self._used > SLEEP_TIMEOUT:
            self._put_away()

    def _next(self) -> None:
        """The next line that is not stale, instead of what is being said."""
        now = self._app.now()
        while self._lines:
            line = self._lines.popleft()
            if line.kind == "alarm" or now - line.at <= MAX_AGE:
                break
        else:
            return
        if self._speaker is None and not self._open():
            return
        self._now_said, self._began, self._used = line, now, now
        if self._speaker is not None:
            self._speaker.say(line.words, self._rate)

    def _open(self) -> bool:
        speaker, instead = choose_voice(self._voice, self._make)
        self.problem = speaker.missing()
        if not self.problem:
            try:
                speaker.start(lambda word, sentence: self._told.append((word, sentence)))
            except OSError as problem:
                self.problem = tr("The voice cannot be started: {problem}.").format(problem=problem)
        if self.problem:
            self._fail(self.problem)
            return False
        self._speaker = speaker
        if instead and instead != self._instead:
            notify(self._app, tr("Talk-back: {instead}").format(instead=instead), "info", about=self.name)
        self._instead = instead
        return True

    def _on_speech(self, word: str, sentence: str, now: float) -> None:
        said = self._now_said
        if word == "ended" and said is not None and sentence == said.words:
            self._ended(now)
        elif word == "failed":
            self._fail(sentence)

    def _ended(self, now: float) -> None:
        self._now_said, self.spoke, self._used = None, now, now

    def _fail(self, sentence: str) -> None:
        self._put_away()
        self.problem = sentence
        notify(self._app, tr("Talk-back: {sentence}").format(sentence=sentence), about=self.name)

    def _put_away(self) -> None:
        speaker, self._speaker = self._speaker, None
        self._lines.clear()
        if self._now_said is not None:
            self._ended(self._app.now())
        if speaker is not None:
            speaker.stop()
        self._told.clear()

    # what is told

    def _follow(self, session: Any) -> None:
        if self._session is not None and self._hear in self._session.listeners:
            self._session.listeners.remove(self._hear)
        self._session, self._stopped = session, False
        if session is not None:
            session.listeners.append(self._hear)

    def _hear(self, channel: str, post: Post) -> None:
        if self._session is None:
            return
        if channel == OUTCOME:
            self._answer(post.value)
        elif channel == EVENT and post.value.level == "alarm":
            session = self._session
            if session.logbook.is_news(post.value, session.link.robot_time()):
                self.say(post.value.text, "alarm")

    def _answer(self, outcome: Outcome) -> None:
        """What the robot says to what it was asked for without looking."""
        if (
            outcome.origin.method not in EYES_OFF
            or outcome.phase == "sent"
            or outcome.name in ("stop", "stop_hold")
        ):
            return
        label = outcome.label[:1].upper() + outcome.label[1:]
        if outcome.phase == "accepted":
            self.say(tr("{label}: the robot has accepted it.").format(label=label), "answer")
        else:
            why = "refused" if outcome.phase == "refused" else "no reply"
            self.say(f"{label}: {why}. {outcome.reason}", "alarm")

    def _watch_stop(self) -> None:
        stopped = self._session is not None and self._session.robot_stop.phase == "stopped"
        if stopped and not self._stopped:
            self.say(tr("Halted: the robot confirms it."), "alarm")
        self._stopped = stopped

    def _taken(self, heard: Heard, verdict: Verdict) -> None:
        if heard.method not in EYES_OFF or not verdict.sentence or verdict.what == "cancelled":
            return
        if verdict.what == "acted" and heard.intent not in LOCAL_INTENTS:
            return  # told when the robot has confirmed it
        self.say(verdict.sentence, "answer")
