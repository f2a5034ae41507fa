"""Follows each command from what was understood to what the robot did about it, and makes a `Response` of that.

    taken(heard, verdict) ── outcome(sent) ── outcome(accepted) ── see(the robot's state) ── put(response)

A finger on a button is not heard; its line begins with what was sent. A line is put when nothing more can come of it: refused,
not allowed, done and no longer taken back. No Kivy in here, and one clock. Everything in the UI thread.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from app.core.command_origin import ITSELF, Origin
from app.intents.intents import INTENTS, LOCAL_INTENTS, Heard, Verdict
from app.link.commands import Outcome
from app.study.response_log import Response

__all__ = ["MAX_EFFECT_TIME", "MAX_UNDO_TIME", "Asked", "State", "ResponseTracks"]

MAX_EFFECT_TIME = 10.0
"""A change of the robot's state later than this after the command is not its effect [s]."""
MAX_UNDO_TIME = 5.0
"""The opposite command so soon after is taken for taking it back [s]."""
MAX_TRACKS = 64
"""Commands that are followed at a time; the oldest is put as it stands."""

INTENT_OF = {"home": "go_home", "cancel": "end_task", "acquire": "take_control", "request": "take_control"}
"""Name of a command to the intent that it is, where they are called differently."""
UNASKED = ("history", "missions", "object", "confirm", "stop_hold")
"""Commands that read, or answer a question of the robot's: no action of its own."""
UNDOES = {
    "pause": ("resume",),
    "resume": ("pause", "end_task"),
    "stop": ("stop_release",),
    "lights": ("lights",),
    "faster": ("slower",),
    "slower": ("faster",),
    "record": ("record",),
    "camera": (),
    "take_off": ("land", "end_task"),
    "land": ("take_off", "end_task"),
    "take_control": ("release",),
    **dict.fromkeys(("start", "patrol", "go_home", "hold", "surface"), ("end_task", "stop")),
}
"""Intent to those that take it back."""


@dataclass(frozen=True, slots=True)
class State:
    """Of the robot, as far as commands change it."""

    stopped: bool = False
    task: str = ""
    running: str = ""
    """`RUNNING`, `PAUSED` or what else the task is in."""
    light: float = math.nan
    control: str = "unknown"
    """As of `Authority.who`."""


@dataclass(frozen=True, slots=True)
class Asked:
    """The study, as it is just now; all empty outside of it."""

    user: str = ""
    posture: str = ""
    method: str = ""
    """By which is answered."""
    prompt_id: str = ""
    intended: str = ""
    at: float = math.nan
    """When the prompt was shown [s]."""


def _runs(task: str, _: State, now: State) -> bool:
    return now.running == "RUNNING" and now.task == task


_EFFECTS: dict[str, Callable[[State, State], bool]] = {
    "stop": lambda _, now: now.stopped,
    "stop_release": lambda _, now: not now.stopped,
    "pause": lambda _, now: now.running == "PAUSED",
    "resume": lambda _, now: now.running == "RUNNING",
    "end_task": lambda _, now: now.running not in ("RUNNING", "PAUSED"),
    "lights": lambda before, now: now.light != before.light,
    "take_control": lambda _, now: now.control == "mine",
    "release": lambda _, now: now.control != "mine",
    **dict.fromkeys(("start", "patrol"), lambda _, now: now.running == "RUNNING"),
    **{name: partial(_runs, name) for name in ("go_home", "hold", "surface", "take_off", "land")},
}
"""Intent to whether the robot's state, before and now, shows that it was done."""


@dataclass(slots=True)
class _Track:
    response: Response
    before: State
    since: float
    """When it was understood, or sent [s]."""
    waits: bool = False
    """It waits to be cancelled or confirmed."""
    effect: bool = False
    sent: dict[str, str] = field(default_factory=dict)
    """Id of each command that it was sent as, to its name: a task may take its points along."""


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None


class ResponseTracks:
    """The commands that are under way."""

    def __init__(
        self,
        put: Callable[[Response], object],
        *,
        now: Callable[[], float],
        wall: Callable[[], float],
        new_id: Callable[[], str],
    ) -> None:
        """`now` is our clock that nobody sets [s], `wall` the time of day [s since 1970]."""
        self._put, self._now, self.new_id = put, now, new_id
        self._offset, self.session = wall() - now(), new_id()
        self.robot = ""
        """Name of the robot; empty without one."""
        self.consent = False
        """Snippets may be kept."""
        self.asked: Callable[[], Asked] = Asked
        """What the study asks for."""
        self._tracks: dict[str, _Track] = {}
        self._state = State()

    # what comes in

    def on_command(self, heard: Heard, verdict: Verdict) -> Response:
        """Something was understood, and that came of it; told again when what waited has ended."""
        key = _key(heard.method, heard.intent, heard.began)
        track = self._tracks.get(key)
        if track is None or not track.waits:
            track = self._open(key, heard.intent, heard.method)
            self._hear(track.response, heard)
        track.response.verdict, track.waits = verdict.what, not verdict.done
        if verdict.what == "cancelled":
            track.response.undo = True
        if verdict.what in ("not allowed", "not now", "lapsed", "cancelled", "practised"):
            if verdict.what != "practised":
                track.response.rejected = verdict.sentence
            self._close(key)
        elif verdict.what == "acted":
            track.since = self._now()
            if heard.intent in LOCAL_INTENTS or heard.intent.startswith("screen."):
                track.response.t_effect = self._at(track.since)
                track.effect = True
        return track.response

    def outcome(self, outcome: Outcome, received: float) -> None:
        """What became of a command, told at `received` [s]."""
        origin = outcome.origin
        if origin.method == ITSELF or outcome.name in UNASKED:
            return
        key, track = self._sent_as(outcome, received)
        if track is None:
            return
        response = track.response
        if outcome.phase == "sent":
            response.t_sent = response.t_sent or self._at(
                outcome.sent if math.isfinite(outcome.sent) else received
            )
            track.since = received
            return
        response.outcome = outcome.phase
        if outcome.phase == "accepted":
            response.t_ack = self._at(received)
        else:
            response.rejected = outcome.reason or outcome.phase
            self._close(key)

    def _sent_as(self, outcome: Outcome, received: float) -> tuple[str, _Track | None]:
        """The line of a command, begun where it was not heard before; None for one that was put already."""
        number, origin = outcome.command_id, outcome.origin
        if outcome.phase != "sent":
            return next(((key, one) for key, one in self._tracks.items() if number in one.sent), ("", None))
        intent = origin.intent or _intent(outcome)
        key = _key(origin.method, intent, origin.began)
        track = self._tracks.get(key)
        if track is not None and number not in track.sent and outcome.name in track.sent.values():
            key, track = f"{key} {number}", None  # one more of the same touch
        if track is None:
            track = self._open(key, intent, origin.method)
            self._describe(track.response, origin)
            track.response.verdict = "acted"
            track.response.t_decided = self._at(origin.decided if math.isfinite(origin.decided) else received)
        track.sent[number] = outcome.name
        return key, track

    def done(self, command_id: str, at: float) -> None:
        """What was asked for is seen to be done, at `at` [s]."""
        for track in self._tracks.values():
            if command_id in track.sent and not track.effect:
                track.response.t_effect, track.effect = self._at(at), True

    def see(self, state: State, received: float) -> None:
        """The robot's state is that now: the effect of what changed it."""
        for track in self._tracks.values():
            shown = _EFFECTS.get(track.response.recognised)
            if track.effect or track.waits or track.response.t_sent is None or shown is None:
                continue
            if state != track.before and shown(track.before, state):
                track.response.t_effect, track.effect = self._at(received), True
        self._state = state

    def missed(self, asked: Asked) -> None:
        """Nobody answered a prompt, or not so that it was understood."""
        response = self._new(asked.method)
        self._ask(response, asked)
        response.rejected = "Nothing was understood."
        self._put(response)

    def unheard(self, method: str, why: str, began: float = math.nan, noise: float = math.nan) -> None:
        """A method heard something and understood nothing; `why` is one sentence. No answer to a prompt: one may try again."""
        response = self._new(method)
        response.rejected, response.t_input_start = why, self._at(began)
        response.noise_db = _known(noise)
        self._put(response)

    def drove(self, method: str, began: float, ended: float) -> None:
        """Somebody drove from `began` to `ended` [s]."""
        response = self._new(method, "drive")
        response.recognised, response.t_input_start, response.t_input_end = (
            "drive",
            self._at(began),
            self._at(ended),
        )
        response.seconds = round(ended - began, 3)
        self._put(response)

    def picked(self, what: str, presses: int, began: float, ended: float) -> None:
        """Something on the glass was chosen by switches, with so many presses, from `began` to `ended` [s]."""
        response = self._new("switches", "selection")
        response.said, response.presses = what, presses
        response.t_input_start, response.t_input_end = self._at(began), self._at(ended)
        self._put(response)

    def listened(self, method: str, seconds: float) -> None:
        """A method was listening for so long [s]."""
        response = self._new(method, "armed")
        response.seconds = round(seconds, 3)
        self._put(response)

    def update(self, now: float) -> None:
        """Put those of which nothing more will come."""
        for key, track in list(self._tracks.items()):
            over = MAX_UNDO_TIME if track.effect else MAX_EFFECT_TIME
            if not track.waits and now - track.since > over:
                self._close(key)

    def close(self) -> None:
        """Put all as they stand."""
        for key in list(self._tracks):
            self._close(key)

    def forget(self) -> None:
        """Put none of them."""
        self._tracks.clear()

    # lines

    def _at(self, instant: float) -> float | None:
        """An instant of our clock as seconds since 1970; None for NaN."""
        return round(instant + self._offset, 4) if math.isfinite(instant) else None

    def _new(self, method: str, kind: str = "command") -> Response:
        return Response(kind=kind, id=self.new_id(), session=self.session, robot=self.robot, method=method)

    def _open(self, key: str, intent: str, method: str) -> _Track:
        now = self._now()
        for other in self._tracks.values():
            recent = now - other.since <= MAX_UNDO_TIME and not other.waits
            if recent and intent in UNDOES.get(other.response.recognised, ()):
                other.response.undo = True
        if key in self._tracks:
            self._close(key)
        while len(self._tracks) >= MAX_TRACKS:
            self._close(next(iter(self._tracks)))
        response = self._new(method)
        response.recognised = intent
        self._ask(response, self.asked())
        track = self._tracks[key] = _Track(response, self._state, now)
        return track

    def _ask(self, response: Response, asked: Asked) -> None:
        """Say of the study what is about this method; another one's commands are no part of it."""
        if asked.method != response.method:
            return
        response.user, response.posture = asked.user, asked.posture
        response.prompt_id, response.intended = asked.prompt_id, asked.intended
        response.t_prompt = self._at(asked.at)

    def _describe(self, response: Response, origin: Origin) -> None:
        response.confidence, response.said = _known(origin.confidence), origin.said
        response.t_input_start, response.t_input_end = self._at(origin.began), self._at(origin.ended)
        response.noise_db = _known(origin.noise)

    def _hear(self, response: Response, heard: Heard) -> None:
        self._describe(
            response,
            Origin(
                heard.method, heard.confidence, heard.began, heard.ended, said=heard.said, noise=heard.noise
            ),
        )
        response.t_decided = self._at(self._now())
        response.snippet = heard.snippet if self.consent else None

    def _close(self, key: str) -> None:
        self._put(self._tracks.pop(key).response)


def _key(method: str, intent: str, began: float) -> str:
    """Of one command: NaN is like NaN."""
    return f"{method} {intent} {began!r}"


def _intent(outcome: Outcome) -> str:
    """What a command that has no intent of its own is called in the log."""
    if outcome.name != "start":
        return INTENT_OF.get(outcome.name, outcome.name)
    task: Any = getattr(outcome.fields.get("order"), "task", "")
    return task if task in INTENTS else "start"
