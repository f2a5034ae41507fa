"""The entry for intents: every method submits what it understood, and here is decided what comes of it.

verdict = app.intents.submit(Heard("go_home", "voice", confidence=0.8, began=12.1, ended=12.8, said="go home"))
if verdict.sentence: talk.say(verdict.sentence)

    Heard ─ allowed? ─ can it be done now? ─ risk ┬ at once ──────────────────── acts
                                                  ├ cancel: a bar for 2 s ────── acts, unless cancelled
                                                  └ confirm: a card for 5 s ──── acts after a yes, by whichever method

Fingers on the glass do not come this way: they press buttons, which do the same through the same session. Switches press
those buttons as well, because what they choose stands on the glass in words and is done there and then: they come by the
second entry, `choose`, which asks the study and the operator's permits as `submit` does (`barred`, for both) and tells the
same listeners; whether it can be done now the button knows, and nothing waits. Everything in the UI thread.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, Protocol

from app.core.command_origin import Origin, origins
from app.intents.method_permits import MethodPermits
from widgets.core.language import mark, tr

__all__ = [
    "CANCEL_TIME",
    "CONFIRM_TIME",
    "INTENTS",
    "LOCAL_INTENTS",
    "METHODS",
    "PRESSED",
    "IntentActions",
    "Heard",
    "Intent",
    "Intents",
    "Pending",
    "Verdict",
]

METHODS = ("button", "voice", "shake", "tilt", "switches", "gamepad", "keyboard", "map")
"""How a command may be given."""
PRESSED = ("button", "switches", "gamepad", "keyboard", "map")
"""Methods that do not guess: what is pressed was meant, so that nothing waits to be cancelled."""
SEEN = ("button", "switches", "map")
"""Of these what was chosen stood in words on the glass: nothing is asked again."""
CANCEL_TIME = 2.0
"""What was understood acts after this unless it is cancelled [s]."""
CONFIRM_TIME = 5.0
"""What asks waits so long for a yes [s]."""
MAX_FRAME = 0.1
"""Of what may be cancelled no frame takes more: while the glass stands still nobody sees it, and no finger cancels it [s]."""

Risk = Literal["at_once", "cancel", "confirm"]


@dataclass(frozen=True, slots=True)
class Intent:
    """One thing that can be wanted."""

    english: str
    """What it does, as on a button."""
    icon: str
    """Name of its icon."""
    risk: Risk
    """`at_once` acts, `cancel` acts after 2 s unless cancelled, `confirm` acts after a yes."""

    @property
    def words(self) -> str:
        """What it does, in the language of the glass."""
        return tr(self.english)


INTENTS: dict[str, Intent] = {
    "stop": Intent("STOP", "front_hand", "at_once"),
    "pause": Intent(mark("Pause"), "pause", "at_once"),
    "resume": Intent(mark("Resume"), "play_arrow", "cancel"),
    "start": Intent(mark("Start the task"), "play_circle", "confirm"),
    "patrol": Intent(mark("Patrol"), "route", "confirm"),
    "go_home": Intent(mark("Go home"), "home", "confirm"),
    "end_task": Intent(mark("End the task"), "cancel", "cancel"),
    "hold": Intent(mark("Hold"), "pause_circle", "cancel"),
    "surface": Intent(mark("Surface"), "water", "cancel"),
    "take_off": Intent(mark("Take off"), "arrow_upward", "confirm"),
    "land": Intent(mark("Land"), "arrow_downward", "cancel"),
    "faster": Intent(mark("Faster"), "fast_forward", "confirm"),
    "slower": Intent(mark("Slower"), "expand_more", "at_once"),
    "lights": Intent(mark("Lights"), "lightbulb", "at_once"),
    "lights_on": Intent(mark("Switch the lights on"), "lightbulb", "at_once"),
    "lights_off": Intent(mark("Switch the lights off"), "lightbulb", "at_once"),
    "dock": Intent(mark("Onto the charger"), "battery_charging_full", "confirm"),
    "tell_battery": Intent(mark("Battery"), "battery_charging_full", "at_once"),
    "tell_task": Intent(mark("Task"), "info", "at_once"),
    "snapshot": Intent(mark("Snapshot"), "photo_camera", "at_once"),
    "record": Intent(mark("Record"), "fiber_manual_record", "at_once"),
    "camera": Intent(mark("Next camera"), "videocam", "at_once"),
    "take_control": Intent(mark("Take control"), "person", "cancel"),
    "yes": Intent(mark("Yes"), "check", "at_once"),
    "no": Intent(mark("No"), "close", "at_once"),
    "screen.drive": Intent(mark("Drive screen"), "sports_esports", "at_once"),
    "screen.mission": Intent(mark("Mission screen"), "map", "at_once"),
    "screen.tasks": Intent(mark("Tasks screen"), "list", "at_once"),
    "screen.inputs": Intent(mark("Inputs screen"), "settings", "at_once"),
    "theme": Intent(mark("Next theme"), "light_mode", "at_once"),
    "help": Intent(mark("Help"), "help", "at_once"),
    "back": Intent(mark("Back"), "arrow_back", "at_once"),
}
"""Everything that can be wanted, by its name. `yes` and `no` mean something only while a question is open."""
LOCAL_INTENTS = (
    "faster", "slower", "record", "snapshot", "camera", "theme", "help", "back", "yes", "no", "tell_battery", "tell_task",
)  # fmt: skip
"""Intents that the handheld carries out itself: their effect is there at once."""


@dataclass(frozen=True, slots=True)
class Heard:
    """What a method understood. Instants are of our clock [s, monotonic]; NaN for what is not known."""

    intent: str
    """Key in `INTENTS`."""
    method: str
    """One of `METHODS`."""
    confidence: float = 1.0
    """0 to 1; NaN where it is not known."""
    began: float = math.nan
    """When gesture, word or press began."""
    ended: float = math.nan
    """When it ended; NaN for what acts before its end."""
    said: str = ""
    """What was understood, in words."""
    noise: float = math.nan
    """How loud it was round about [dB]."""
    snippet: Any = None
    """What goes into the log beside it, JSON-able, and only with the operator's consent; None for nothing."""


What = Literal["acted", "waits", "asks", "not allowed", "not now", "cancelled", "lapsed", "practised"]


@dataclass(frozen=True, slots=True)
class Verdict:
    """What came of it."""

    what: What
    """`waits` to be cancelled and `asks` are followed by another one for the same `Heard`: `acted`, `cancelled`, `lapsed`
    (nobody answered) or `not now` (it could not be done any more)."""
    sentence: str = ""
    """The same for the operator, to show and to speak."""

    @property
    def done(self) -> bool:
        """Nothing more will come of it."""
        return self.what not in ("waits", "asks")


@dataclass(slots=True)
class Pending:
    """What waits on the glass."""

    heard: Heard
    question: bool
    """It waits for a yes; else it acts unless it is cancelled."""
    began: float
    """Since when it waits [s]."""
    until: float
    """Until when [s]; later, where frames were slow."""
    decided: float
    """When it was known what was meant [s]."""

    @property
    def intent(self) -> Intent:
        """What is wanted."""
        return INTENTS[self.heard.intent]


class IntentActions(Protocol):
    """What the app can do of what is wanted."""

    def why_not(self, intent: str) -> str:
        """One sentence why it cannot be done now; empty where it can."""

    def words(self, intent: str) -> str:
        """What it would do now, as in `Switch the lights off`."""

    def do(self, intent: str) -> None:
        """Do it."""

    def answer(self, yes: bool) -> str:
        """Answer whatever the robot or the app asks on the glass; one sentence of what was answered, empty where nothing asks."""


class Intents:
    """Takes what was understood, lets what is risky wait, and acts."""

    def __init__(self, acts: IntentActions, permits: MethodPermits, now: Callable[[], float]) -> None:
        """`now` is our clock [s]."""
        self._acts, self.table, self._now = acts, permits, now
        self.pending: Pending | None = None
        """What waits to be cancelled or confirmed; None for nothing. One at a time: the newest wish counts."""
        self._looked = -math.inf
        """When time was last told [s]."""
        self.on_taken: list[Callable[[Heard, Verdict], object]] = []
        """Called with each verdict, where something waits twice: when it begins to wait and when that ends."""
        self.practise: Callable[[Heard], str] = lambda _: ""
        """Where the study takes what was heard as an answer and nothing shall be done: a sentence; empty where it acts."""

    def allowed(self, method: str, intent: str) -> bool:
        """The operator lets that method trigger that; STOP always."""
        return self.table.allowed(method, intent)

    def words(self, intent: str) -> str:
        """What it would do now, as in `Switch the lights off`."""
        return self._acts.words(intent)

    @property
    def asking(self) -> bool:
        """A yes or a no would be understood now."""
        return self.pending is not None or not (self._acts.why_not("yes") and self._acts.why_not("no"))

    def possible(self, intent: str) -> bool:
        """It could be done now, whoever asks for it."""
        return not self._acts.why_not(intent)

    def submit(self, heard: Heard) -> Verdict:
        """Take what was understood; KeyError for an intent that there is not."""
        intent, now = INTENTS[heard.intent], self._now()
        verdict = self.barred(heard) or self._refusal(heard)
        if verdict is None and heard.intent in ("yes", "no"):
            return self._told(heard, self._answered(heard, now))
        if verdict is None:
            risk, waited = self._risk(intent, heard), self.pending
            # STOP before anything is told of what it takes the place of
            verdict = self._act(heard, now) if risk == "at_once" else self._wait(heard, risk, now)
            if self.pending is waited:
                self.pending = None
            if waited is not None:
                self._told(waited.heard, Verdict("cancelled", tr("Something else was requested.")))
        return self._told(heard, verdict)

    def choose(self, heard: Heard, act: Callable[[], object]) -> Verdict:
        """Do what was chosen on the glass, by `act`, unless it is barred; an empty intent is of a control that has none."""
        verdict = self.barred(heard) if heard.intent else None
        if verdict is None:
            with origins.during(self._origin(heard, self._now())):
                act()
            verdict = Verdict("acted", f"{heard.said}.")
        # a yes or a no that is chosen presses what takes it, and is told there
        told = heard.intent and (verdict.what != "acted" or heard.intent not in ("yes", "no"))
        return self._told(heard, verdict) if told else verdict

    def barred(self, heard: Heard) -> Verdict | None:
        """For both entries: the study takes it as an answer, or the operator does not let that method do that; None for neither."""
        if practised := self.practise(heard):
            return Verdict("practised", practised)
        if self.allowed(heard.method, heard.intent):
            return None
        name, words = heard.method.capitalize(), INTENTS[heard.intent].words
        return Verdict(
            "not allowed",
            tr("{name} may not do that: {words}. It can be allowed in Inputs.").format(
                name=name, words=words
            ),
        )

    def answer(self, yes: bool, method: str = "button") -> Verdict:
        """Yes or no to what waits, or to what the robot asks: a yes does it, a no cancels it."""
        return self.submit(Heard("yes" if yes else "no", method, began=self._now(), ended=self._now()))

    def update(self, now: float) -> None:
        """With each frame: what has waited long enough acts, or lapses where nobody said yes."""
        pending, looked, self._looked = self.pending, self._looked, now
        if pending is not None and not pending.question:
            pending.until += max(0.0, now - max(looked, pending.began) - MAX_FRAME)
        if pending is None or now < pending.until:
            return
        self.pending = None
        if pending.question:
            words = self._acts.words(pending.heard.intent)
            self._told(
                pending.heard, Verdict("lapsed", tr("Not done, no yes came: {words}.").format(words=words))
            )
        else:
            self._told(pending.heard, self._act(pending.heard, pending.decided))

    def rest(self) -> None:
        """What waits is forgotten: the glass is taken away, or the robot is left."""
        pending, self.pending = self.pending, None
        if pending is not None:
            self._told(pending.heard, Verdict("cancelled", tr("Left.")))

    # how it is decided

    def _refusal(self, heard: Heard) -> Verdict | None:
        """Why it cannot be done now; None where it can."""
        if heard.intent in ("yes", "no") and self.pending is not None:
            return None
        why = self._acts.why_not(heard.intent)
        return Verdict("not now", why) if why else None

    def _risk(self, intent: Intent, heard: Heard) -> Risk:
        if heard.method in SEEN or (intent.risk == "cancel" and heard.method in PRESSED):
            return "at_once"
        return intent.risk

    def _wait(self, heard: Heard, risk: Risk, now: float) -> Verdict:
        question = risk == "confirm"
        until = now + (CONFIRM_TIME if question else CANCEL_TIME)
        self.pending = Pending(heard, question, now, until, now)
        words = self._acts.words(heard.intent)
        return (
            Verdict("asks", f"{words}?")
            if question
            else Verdict("waits", tr("{words}, unless cancelled.").format(words=words))
        )

    def _act(self, heard: Heard, decided: float) -> Verdict:
        why = self._acts.why_not(heard.intent)
        if why:
            return Verdict("not now", why)
        words = self._acts.words(heard.intent)
        with origins.during(self._origin(heard, decided)):
            self._acts.do(heard.intent)
        return Verdict("acted", f"{words}.")

    def _answered(self, heard: Heard, now: float) -> Verdict:
        """What a yes or a no comes to: what waits here goes before what the robot asks."""
        yes, pending = heard.intent == "yes", self.pending
        if pending is None:
            with origins.during(self._origin(heard, now)):
                said = self._acts.answer(yes)
            return Verdict("acted", said) if said else Verdict("not now", tr("Nothing is asked just now."))
        self.pending = None
        words = self._acts.words(pending.heard.intent)
        if not yes:
            self._told(pending.heard, Verdict("cancelled", tr("Cancelled: {words}.").format(words=words)))
            return Verdict("acted", tr("Cancelled: {words}.").format(words=words))
        return self._told(pending.heard, self._act(pending.heard, now))

    def _origin(self, heard: Heard, decided: float) -> Origin:
        return Origin(
            heard.method,
            heard.confidence,
            heard.began,
            heard.ended,
            decided,
            heard.said,
            heard.noise,
            heard.intent,
        )

    def _told(self, heard: Heard, verdict: Verdict) -> Verdict:
        for listener in list(self.on_taken):
            listener(heard, verdict)
        return verdict
