"""Keeps the response log of the running app: hears what is understood, sent and answered, and leads the study.

Made and closed with the methods; while the log is switched off nothing is kept, and nothing listens.
"""

from __future__ import annotations

import time
import uuid
from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from app.core.checked_settings import Kept
from app.core.command_origin import origins
from app.core.notifications import tell
from app.inputs.input_snapshot import set_up
from app.intents.intents import INTENTS, METHODS, Heard, Verdict
from app.link.commands import Outcome
from app.link.feeds import Post
from app.link.link import OUTCOME
from app.study.questionnaires import Workload, Workloads
from app.study.response_log import Response, ResponseLog, read
from app.study.response_statistics import counts
from app.study.response_timing import Asked, State, Tracks
from app.study.study import Plan, Prompt, Trials, plan_of, saved
from app.study.study_export import SETTINGS, export
from bridge.msgs.pilothouse_msgs import ControlStatus, LightState, TaskStatus

__all__ = ["Responding"]

FOLDER = "responses"
SAVE_EVERY = 60.0
"""How long the methods were listening is put down so often [s]."""
DRIVE_GAP = 1.0
"""Driving that rests for so long has ended [s]."""
STATES = ("/task/status", "/control/status", "/lights")
"""Topics that show what became of a command."""


class Responding:
    """The log of one run of the app. Everything in the UI thread."""

    name = "log"

    def __init__(self, app: Any, wall: Callable[[], float] = time.time) -> None:
        """`wall` is the time of day [s since 1970]."""
        self._app, self._wall = app, wall
        self._session: Any = None
        """The session that is heard; None without one."""
        folder = Path(app.settings.path).parent
        self.folder, self.exports = folder / FOLDER, folder / "exports"
        self.log, self.workloads = ResponseLog(self.folder), Workloads(self.folder)
        self._given: Counter[str] = Counter()
        self._count = self.lines = 0
        """Commands, and lines of whatever kind, that were kept in this run."""
        self._drive: tuple[str, float, float] | None = None
        """Method, begin and last instant of the driving that goes on; None for none."""
        self.tracks = Tracks(self._put, now=app.now, wall=wall, new_id=lambda: uuid.uuid4().hex[:12])
        self.tracks.asked = self._asked
        self.trials: Trials | None = None
        """The study that is led just now, or was left in the middle; None for none."""
        self.due = ""
        """The task that is over and whose workload was not filled in; empty for none."""
        self._all: Outcome | None = None
        """STOP ALL that is under way; None for none."""
        self._task = ""
        self._listening: defaultdict[str, float] = defaultdict(float)
        self._looked = self._saved = app.now()
        self._running = False
        self.tracks.consent = self._setting("snippets", False)
        kept = Kept(app.settings.get("study"), "the study")
        for name, usual in (("log", True), ("snippets", False), ("remind", False)):
            kept.flag(name, usual=usual)
        found = plan_of(kept.values.get("plan"), METHODS, tuple(INTENTS))
        if found is None and kept.values.get("plan") is not None:
            kept.mistaken("plan", "what was saved of a study")
        self.mistaken = kept.sentence
        """One sentence about settings that mean nothing; empty when all is well."""
        if found is not None:
            self._lead(Trials(found[0], now=app.now, block=found[1], trial=found[2]))

    # settings

    def _values(self) -> dict[str, Any]:
        values = self._app.settings.get("study")
        return values if isinstance(values, dict) else {}

    def _setting(self, name: str, usual: bool) -> bool:
        value = self._values().get(name, usual)
        return value if isinstance(value, bool) else usual

    def keep(self, name: str, value: Any) -> None:
        """Remember a setting of the study."""
        self._app.settings.set("study", {**self._values(), name: value})

    @property
    def snippets(self) -> bool:
        """The user agrees that what was measured of a gesture or a word is kept beside it."""
        return self.tracks.consent

    @snippets.setter
    def snippets(self, agreed: bool) -> None:
        self.tracks.consent = agreed
        self.keep("snippets", agreed)

    @property
    def reminds(self) -> bool:
        """When a task is over, it is said that its workload can be filled in."""
        return self._setting("remind", False)

    def remind(self, on: bool) -> None:
        """Say so from now on, or no more."""
        self.keep("remind", on)

    @property
    def on(self) -> bool:
        """The operator wants a log."""
        return self._setting("log", True)

    @on.setter
    def on(self, on: bool) -> None:
        self.keep("log", on)

    def turn(self, on: bool) -> None:
        """Keep a log or keep none, from now on, as every method is switched."""
        self._app.methods.turn(self.name, on)

    # a method's life

    @property
    def standing(self) -> str:
        """In a word or two."""
        return f"{self._count} responses this time" if self.on else "off"

    @property
    def problem(self) -> str:
        """Why lines are lost, or how many were; empty when none are."""
        lost = self.log.dropped
        said = f"{lost} line{'s' * (lost != 1)} of the log could not be written and are lost." if lost else ""
        return self.log.problem or self.workloads.problem or said

    def start(self) -> None:
        """Listen."""
        if not self._running:
            self._running, self._looked = True, self._app.now()
            self._app.intents.on_taken.append(self._taken)
            self._app.intents.practise = self._practise
            self._app.corner.on_pressed.append(self._stop_all)

    def stop(self) -> None:
        """Rest: put down what is known, and wait in the study."""
        if not self._running:
            return
        self._running = False
        self._app.intents.on_taken.remove(self._taken)
        self._app.intents.practise = lambda _: ""
        self._app.corner.on_pressed.remove(self._stop_all)
        if self.trials is not None:
            self.trials.pause()
        self._end_drive()
        self._all = None
        self._follow(None)
        self.tracks.close()
        self._save_listening()

    def close(self) -> None:
        """Write what waits."""
        self.stop()
        self.log.close()

    def look(self, now: float) -> None:
        """With each heartbeat."""
        if self._app.session is not self._session:
            self._follow(self._app.session)
        since, self._looked = now - self._looked, now
        for name in self._app.methods.hearing if 0 < since < 1 else ():
            self._listening[name] += since
        if now - self._saved >= SAVE_EVERY:
            self._saved = now
            self._save_listening()
        self._watch_drive(now)
        self._watch_stop_all(now)
        self.tracks.look(now)
        if self.trials is not None:
            self.trials.look(now)

    def _stop_all(self) -> None:
        """STOP to all without one that is connected, whose link tells of its own; put down with the next heartbeat."""
        if self._app.session is None:
            origin = origins.current()
            self._all = Outcome(
                "stop", self.tracks.new_id(), "", sent=self._app.now(),
                origin=replace(origin, said=origin.said or "STOP ALL"),
            )  # fmt: skip

    def _watch_stop_all(self, now: float) -> None:
        """It is sent, and it is done when every robot says that it rests."""
        outcome = self._all
        if outcome is None:
            return
        fleet = self._app.fleet
        if not outcome.phase:
            self._all = outcome = replace(outcome, phase="sent")
            self.tracks.outcome(outcome, outcome.sent)
            self._stopped(outcome)
        if fleet.active and fleet.total and fleet.stopped == fleet.total:
            self.tracks.outcome(replace(outcome, phase="accepted"), now)
            self.tracks.done(outcome.command_id, now)
            self._all = None
        elif not fleet.active:
            self._all = None

    def _watch_drive(self, now: float) -> None:
        """Driving has a begin and an end; a stick that goes through its middle ends nothing."""
        link = None if self._session is None else self._session.link
        if link is not None and link.driving and link.driven_by.method:
            method = link.driven_by.method
            if self._drive is None or self._drive[0] != method:
                self._end_drive()
                self._drive = (method, now, now)
            self._drive = (method, self._drive[1], now)
        elif self._drive is not None and now - self._drive[2] > DRIVE_GAP:
            self._end_drive()

    def _end_drive(self) -> None:
        drive, self._drive = self._drive, None
        if drive is not None:
            self.tracks.drove(*drive)

    # what comes in

    def _follow(self, session: Any) -> None:
        if self._session is not None and self._hear in self._session.listeners:
            self._session.listeners.remove(self._hear)
        self._session = session
        self.tracks.robot = ""
        if session is not None:
            session.listeners.append(self._hear)

    def _hear(self, channel: str, post: Post) -> None:
        session = self._session
        if session is None:
            return
        if channel == OUTCOME:
            self.tracks.robot = session.robot.name
            self.tracks.outcome(post.value, post.received)
            self._stopped(post.value)
        elif channel in STATES:
            state = self._state(session)
            self._watch(state)
            self.tracks.see(state, post.received)

    def _stopped(self, outcome: Outcome) -> None:
        """STOP of a key, a gamepad or its own button goes to the robot at once: that answers a prompt as well."""
        if self.trials is not None and outcome.name == "stop" and outcome.phase == "sent":
            self.trials.heard("stop", outcome.origin.method)

    def _watch(self, state: State) -> None:
        """A task that is over leaves its workload to be filled in."""
        runs = state.running in ("RUNNING", "PAUSED")
        if self._task and not runs:
            self.due = self._task
            if self.reminds:
                over = "The task is over: its workload can be filled in, at Inputs, Log and study."
                tell(self._app, over, "info", self.name)
        self._task = state.task if runs else ""

    @staticmethod
    def _state(session: Any) -> State:
        task: TaskStatus | None = session.feeds.latest("/task/status")
        control: ControlStatus | None = session.feeds.latest("/control/status")
        light: LightState | None = session.feeds.latest("/lights")
        return State(
            stopped=control is not None and control.stopped,
            task="" if task is None else task.task,
            running="" if task is None else task.state,
            light=float("nan") if light is None else light.brightness,
            control=session.control,
        )

    def _taken(self, heard: Heard, verdict: Verdict) -> None:
        self.tracks.taken(heard, verdict)
        if self.trials is not None and verdict.what in ("practised", "acted", "waits", "asks", "not now"):
            self.trials.heard(heard.intent, heard.method)

    def _practise(self, heard: Heard) -> str:
        """While prompts are shown nothing is done but STOP, which reaches whatever can be stopped."""
        if self.trials is None or not self.trials.running or heard.intent in ("yes", "no"):
            return ""
        if heard.intent == "stop" and self._app.intents.possible("stop"):
            return ""
        return f"Understood: {INTENTS[heard.intent].words}. Nothing is done."

    def _asked(self) -> Asked:
        trials = self.trials
        if trials is None or not trials.running:
            return Asked()
        block, prompt = trials.now_block, trials.prompt
        if prompt is None:
            return Asked(trials.plan.user, block.posture, block.method)
        return _of(prompt)

    def _put(self, response: Response) -> None:
        if self.on:
            self.log.put(response)
            self.lines += 1
            self._count += response.kind == "command"
            self._given.update(counts([response]))

    def _save_listening(self) -> None:
        for name, seconds in self._listening.items():
            if seconds >= 1:
                self.tracks.listened(name, seconds)
        self._listening.clear()

    # the study

    def lead(self, plan: Plan) -> Trials:
        """Begin a study; the log is switched on for it."""
        if not self.on:
            self.turn(True)
        trials = self._lead(Trials(plan, now=self._app.now))
        self._keep_trials()
        return trials

    def _lead(self, trials: Trials) -> Trials:
        self.trials = trials
        trials.on_missed = lambda prompt: self.tracks.missed(_of(prompt))
        trials.on_moved = self._keep_trials
        return trials

    def end(self) -> None:
        """Leave the study; what was answered stays in the log."""
        self.trials = None
        self.keep("plan", None)

    def _keep_trials(self) -> None:
        done = self.trials is None or self.trials.stage == "done"
        self.keep("plan", None if done or self.trials is None else saved(self.trials))

    def fill(
        self, form: str, answers: dict[str, int], order: list[str], seconds: dict[str, float], task: str = ""
    ) -> float:
        """Keep a form about `task`, or about the study, and give its score; ValueError where it cannot be scored."""
        trials = self.trials
        about = {"task": task}
        if trials is not None and trials.stage in ("tlx", "sus"):
            block = trials.now_block
            about = {"user": trials.plan.user, "task": "prompts"}
            about |= {"method": block.method, "posture": block.posture} if trials.stage == "tlx" else {}
        made = Workload(
            form=form, answers=answers, order=order, seconds=seconds, at=round(self._wall(), 1),
            session=self.tracks.session, **about,
        )  # fmt: skip
        self.workloads.put(made)
        return made.score

    # what is looked at

    def read(self) -> list[Response]:
        """Everything that is kept, the oldest first; takes a while, for a thread of its own."""
        self.log.flush()
        return read(self.folder)[0]

    def usage(self) -> Counter[str]:
        """How often each command was given in this run."""
        return Counter(self._given)

    def export(self) -> Path:
        """Write everything into one zip; OSError when that fails. Takes a while, for a thread of its own."""
        self.log.flush()
        settings = {name: self._app.settings.get(name) for name in SETTINGS} | set_up(self._app)
        flags = {"log": True, "snippets": False, "remind": False}
        settings["study"] = self._values() | {
            name: self._setting(name, usual) for name, usual in flags.items()
        }
        return export(self.folder, self.exports, settings, self._wall())

    def zips(self) -> list[Path]:
        """What was exported and is still there, the oldest first."""
        return sorted(self.exports.glob("*.zip"))

    def discard(self) -> str:
        """Delete what was exported; one sentence. OSError when that fails."""
        zips = self.zips()
        for zip_ in zips:
            zip_.unlink(missing_ok=True)
        return "The zip was deleted." if len(zips) == 1 else f"{len(zips)} zips were deleted."

    def forget(self) -> None:
        """What is followed and counted just now is no part of the log any more, nor what is yet to be written of it."""
        self.tracks.forget()
        self._listening.clear()
        self._given.clear()
        self._count = 0

    def erase(self) -> str:
        """Delete all lines and forms; one sentence of what remains. OSError when that fails.

        After `forget`. Takes a while, for a thread of its own.
        """
        self.log.erase()
        self.workloads.erase()
        if self.workloads.problem:
            raise OSError(self.workloads.problem)
        left = len(self.zips())
        remain = "1 zip that was exported remains" if left == 1 else f"{left} zips that were exported remain"
        return f"Everything was erased. {remain} in {self.exports}." if left else "Everything was erased."


def _of(prompt: Prompt) -> Asked:
    return Asked(prompt.user, prompt.posture, prompt.method, prompt.id, prompt.intent, prompt.at)
