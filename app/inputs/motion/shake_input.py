"""Shaking the handheld as a way in: the recogniser at the accelerometer while it is armed, and what each direction means.

Armed only while shaking is switched on and the app is on the glass; the sensor is off otherwise. Everything in the UI thread.
"""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

from app.core.checked_settings import CheckedSettings, known, shown
from app.device import rotation
from app.device.vibration import DONE, STOPS, vibrate
from app.inputs.base.toggleable_method import ToggleableMethod
from app.inputs.motion.motion_app import MotionApp
from app.inputs.motion.shake import (
    MIN_RATE,
    USUAL,
    WORDS,
    Axis,
    Lesson,
    PersonalAxis,
    Recogniser,
    Shake,
    fitted,
    own_from,
    own_to,
)
from app.inputs.motion.shake.gravity import Motion
from app.inputs.motion.tilt import turned
from app.intents.intents import Heard
from widgets.core.language import mark, tr, within

__all__ = ["CHOICES", "USUAL_MEANING", "ShakeInput"]

USUAL_MEANING: dict[Axis, str] = {"ud": "pause", "fb": "resume"}
"""A nod of the hand is what one tells somebody to slow down with, and a push forward to go on; neither begins anything new."""
CHOICES: dict[Axis, tuple[str, ...]] = {
    "ud": ("pause", "resume", "go_home", "end_task", "hold", "land", "surface", "lights", "snapshot", ""),
    "fb": ("resume", "pause", "go_home", "end_task", "hold", "land", "surface", "lights", "snapshot", ""),
}
"""What may be chosen; empty for nothing. Left-right is STOP, always."""
SNIPPET_TIME = 6.0
"""So much of what was measured goes into the log with the operator's consent [s]."""
NEEDED_RATE = MIN_RATE - 0.4
"""A sensor of 25 Hz is never quite that by its own times [Hz]."""
MIN_STOP_RATE = 15.0
"""A sensor that loses samples is said to be slow, and a STOP that was understood all the same is done [Hz]."""


class ShakeInput(ToggleableMethod):
    """The method `shake`."""

    name = "shake"
    _app: MotionApp

    def __init__(
        self,
        app: MotionApp,
        now: Callable[[], float] = time.monotonic,
        quarters: Callable[[], int] = rotation,
    ) -> None:
        """`app` is asked for its `settings`, `sensing`, `intents` and `session`; `quarters` says how the screen is, in quarters."""
        self._app, self._now, self._turned = app, now, quarters
        self._quarters = 0
        self._forget: Callable[[], None] | None = None
        self._recent: deque[tuple[float, Motion]] = deque(maxlen=1024)
        self.lesson: Lesson | None = None
        """What is being measured; None outside of a lesson. While there is one nothing is understood."""
        self._trying = False
        self.last: Shake | None = None
        """What was understood last."""
        self.said = ""
        """What came of it, as one sentence; empty before the first."""
        self.at = math.nan
        """When that was [s]."""
        self.mistaken = ""
        """One sentence about settings that mean nothing; empty when all is well."""
        self._read()
        self._recogniser = self._made()

    # what is kept

    def _read(self) -> None:
        read = CheckedSettings(self._app.settings.get("shake"), mark("shaking", "settings"))
        kept, self._on, self._any = read.values, read.flag("on", usual=False), read.flag("any", usual=False)
        self.mistaken = read.sentence
        self.meaning: dict[Axis, str] = dict(USUAL_MEANING)
        """What up-down and forward-back mean: an intent, or nothing."""
        for axis, allowed in CHOICES.items():
            intent = kept.get(axis, USUAL_MEANING[axis])
            if known(intent, allowed):
                self.meaning[axis] = intent
            else:
                self.mistaken = (
                    f"{tr(WORDS[axis])} cannot mean {shown(intent)}; it means {USUAL_MEANING[axis]}."
                )
        try:
            self.own: dict[Axis, PersonalAxis] = own_from(kept.get("own", {}))
        except ValueError as problem:
            self.own, self.mistaken = (
                {},
                tr("{problem} The lesson has to be done again.").format(problem=problem),
            )

    def _kept(self) -> dict[str, Any]:
        meaning = {str(axis): intent for axis, intent in self.meaning.items()}
        return {"on": self._on, "any": self._any, **meaning, "own": own_to(self.own)}

    @property
    def set_to(self) -> dict[str, Any]:
        """Everything that it goes by, thresholds included, as JSON."""
        return self._kept() | {"tuning": asdict(fitted(USUAL, self.own))}

    @property
    def any_stops(self) -> bool:
        """Any strong shake is STOP while the robot moves."""
        return self._any

    @any_stops.setter
    def any_stops(self, on: bool) -> None:
        self._any = on
        self._keep()

    def mean(self, axis: Axis, intent: str) -> None:
        """Have a direction mean that intent, or nothing where it is empty; ValueError for what it cannot."""
        if intent not in CHOICES.get(axis, ()):
            raise ValueError(
                tr("{words} cannot mean {intent!r}.").format(words=tr(WORDS[axis]), intent=intent)
            )
        self.meaning[axis] = intent
        self._keep()

    # how it stands

    @property
    def listening(self) -> bool:
        """The sensor is on for it."""
        return self._forget is not None

    @property
    def problem(self) -> str:
        """Why it does not work though it is on, as one sentence; empty when it is well."""
        if not self._on and not self.busy:
            return self.mistaken
        health = self._app.sensing.health("acceleration", least=NEEDED_RATE)
        return self.mistaken if health.fault in ("", "waiting") else str(health.sentence)

    @property
    def standing(self) -> str:
        """In a word or two."""
        if not self._on:
            return tr("off")
        health = self._app.sensing.health("acceleration", least=NEEDED_RATE)
        words = {
            "": tr("listening"),
            "slow": tr("{rate:.0f} Hz: too slow").format(rate=health.rate),
            "absent": tr("no sensor"),
        }
        return str(words.get(health.fault, health.fault))

    # when it listens

    def start(self) -> None:
        """Begin; nothing where it has begun."""
        if self._forget is None:
            self._recogniser = self._made()
            self._quarters = self._turned() % 4
            self._forget = self._app.sensing.listen("acceleration", self.feed)

    def stop(self) -> None:
        """Rest, and leave a lesson or a try that was begun."""
        self.lesson, self._trying = None, False
        self._rest()

    def close(self) -> None:
        """For good."""
        self.stop()

    def update(self, now: float) -> None:
        """With each heartbeat: whether the screen was turned, so that left and right are those of the glass."""
        self._quarters = self._turned() % 4

    def _rest(self) -> None:
        forget, self._forget = self._forget, None
        self._recent.clear()
        if forget is not None:
            forget()

    def _made(self) -> Recogniser:
        return Recogniser(fitted(USUAL, self.own))

    # the lesson

    def teach(self) -> None:
        """Begin the lesson; the sensor runs for it even where shaking is switched off."""
        self.lesson = Lesson()
        self.start()

    def unlearn(self) -> None:
        """Back to what is usual for anybody."""
        self.own, self.mistaken = {}, ""
        self._keep()
        self._recogniser = self._made()

    def end_lesson(self) -> None:
        """Leave it; what it measured is kept only where it is over."""
        lesson, self.lesson = self.lesson, None
        if lesson is not None and lesson.over:
            self.own, self.mistaken = dict(lesson.own), ""
            self._keep()
        self._recogniser = self._made()
        if not self._on:
            self._rest()

    # the try

    def try_out(self, *, on: bool) -> None:
        """Try what is understood, until it is told to end: nothing is done but STOP, and the sensor runs though it is switched off."""
        self._trying = on
        if on:
            self.start()
        elif not self._on:
            self._rest()

    @property
    def trying(self) -> bool:
        """It is being tried out."""
        return self._trying

    @property
    def busy(self) -> bool:
        """The sensor runs for it though it may be off: for the lesson, or to be tried out."""
        return self._trying or self.lesson is not None

    # what comes of a sample

    def feed(self, t: float, axes: Motion) -> None:
        """One sample of the accelerometer [s, m/s²]."""
        axes = turned(axes, self._quarters)
        if self.lesson is not None:
            before = self.lesson.axis
            self.lesson.feed(t, axes)
            if self.lesson.axis != before:
                vibrate(DONE)
            return
        self._recent.append((t, axes))
        self._recogniser.any_shake = self._any and self._moves()
        shake = self._recogniser.feed(t, axes)
        if shake is not None:
            least = NEEDED_RATE if shake.ended else MIN_STOP_RATE
            if self._app.sensing.health("acceleration", least=least).fault != "slow":
                self.understood(shake)

    def understood(self, shake: Shake) -> None:
        """Have it done, felt and said."""
        stops = shake.axis == "lr" or (self._any and not shake.ended)
        intent = "stop" if stops else self.meaning[shake.axis]
        self.last, self.at = shake, self._now()
        if not intent:
            self.said = tr("{words} means nothing.").format(words=tr(WORDS[shake.axis]))
            return
        vibrate(STOPS if stops else DONE)
        if self._trying and not (stops and self._app.intents.possible("stop")):
            self.said = tr("Understood; while it is tried out nothing is done.")
            return
        ended = shake.told if shake.ended else math.nan
        verdict = self._app.intents.submit(
            Heard(
                intent,
                self.name,
                shake.confidence,
                shake.began,
                ended,
                said=within(tr(WORDS[shake.axis])) if not stops or shake.axis == "lr" else tr("strong shake"),
                snippet=self._snippet(shake),
            )
        )
        self.said = verdict.sentence

    def _moves(self) -> bool:
        """The robot does, as it says; one that says nothing of it may."""
        session = self._app.session
        if session is None:
            return False
        status = session.feeds.latest("/control/status")
        return status is None or not status.at_rest

    def _snippet(self, shake: Shake) -> dict[str, Any]:
        since = max(shake.began - 1.0, shake.told - SNIPPET_TIME)
        samples = [(t, axes) for t, axes in self._recent if t >= since]
        return {
            "axis": shake.axis,
            "peak": round(shake.peak, 2),
            "acceleration": [
                [round(t - since, 3), *(round(value, 2) for value in axes)] for t, axes in samples
            ],
        }
