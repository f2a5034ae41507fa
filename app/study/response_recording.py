"""Recording of responses: what is understood, sent and answered goes into the log, and a study can be led.

Made and closed with the methods; while the log is switched off nothing is kept, and nothing listens.
"""

from __future__ import annotations

import time
import uuid
from collections import Counter, defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import Any

from app.core.notifications import notify
from app.inputs.input_snapshot import set_up
from app.intents.intents import Heard, Verdict
from app.link.channels import OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Post
from app.study.drive_spans import DriveSpans
from app.study.questionnaires import Workload
from app.study.response_archive import ResponseArchive
from app.study.response_log import Response
from app.study.response_statistics import counts
from app.study.response_timing import ResponseTracks, State
from app.study.stop_all_track import StopAllTrack
from app.study.study import Plan, Trials
from app.study.study_app import StudyApp
from app.study.study_export import SETTINGS
from app.study.study_run import StudyRun
from app.study.study_settings import StudySettings
from bridge.msgs.pilothouse_msgs import ControlStatus, LightState, TaskStatus
from widgets.core.language import tr, trn

__all__ = ["ResponseRecording"]

SAVE_EVERY = 60.0
"""How long the methods were listening is put down so often [s]."""
STATES = ("/task/status", "/control/status", "/lights")
"""Topics that show what became of a command."""


class ResponseRecording:
    """The log of one run of the app. Everything in the UI thread."""

    name = "log"

    def __init__(self, app: StudyApp, wall: Callable[[], float] = time.time) -> None:
        """`wall` is the time of day [s since 1970]."""
        self._app, self._wall, self._settings = app, wall, StudySettings(app)
        self._session: Any = None
        """The session that is heard; None without one."""
        self.archive = ResponseArchive(Path(app.settings.path).parent)
        """What is kept, exported and erased."""
        self._given: Counter[str] = Counter()
        self._count = self.lines = 0
        """Commands, and lines of whatever kind, that were kept in this run."""
        self.tracks = ResponseTracks(self._put, now=app.now, wall=wall, new_id=lambda: uuid.uuid4().hex[:12])
        self._study = StudyRun(self.tracks, self._settings, app.now)
        self.tracks.asked = self._study.asked
        self._drives, self._stops = DriveSpans(self.tracks), StopAllTrack(self.tracks, self._stopped)
        self.due = ""
        """The task that is over and whose workload was not filled in; empty for none."""
        self._task = ""
        self._listening: defaultdict[str, float] = defaultdict(float)
        self._looked = self._saved = app.now()
        self._running = False
        self.tracks.consent = self._settings.flag("snippets")
        self.mistaken = self._settings.mistaken
        """One sentence about settings that mean nothing; empty when all is well."""

    # settings

    @property
    def snippets(self) -> bool:
        """The user agrees that what was measured of a gesture or a word is kept beside it."""
        return self.tracks.consent

    @snippets.setter
    def snippets(self, agreed: bool) -> None:
        self.tracks.consent = agreed
        self._settings.keep("snippets", agreed)

    @property
    def reminds(self) -> bool:
        """When a task is over, it is said that its workload can be filled in."""
        return self._settings.flag("remind")

    def remind(self, on: bool) -> None:
        """Say so from now on, or no more."""
        self._settings.keep("remind", on)

    @property
    def on(self) -> bool:
        """The operator wants a log."""
        return self._settings.flag("log")

    @on.setter
    def on(self, on: bool) -> None:
        self._settings.keep("log", on)

    def turn(self, on: bool) -> None:
        """Keep a log or keep none, from now on, as every method is switched."""
        self._app.methods.turn(self.name, on)

    # a method's life

    @property
    def standing(self) -> str:
        """In a word or two."""
        return (
            trn("{count} response this time", "{count} responses this time", self._count)
            if self.on
            else tr("off")
        )

    @property
    def problem(self) -> str:
        """Why lines are lost, or how many were; empty when none are."""
        return self.archive.problem

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
        self._study.pause()
        self._drives.end()
        self._stops.clear()
        self._follow(None)
        self.tracks.close()
        self._save_listening()

    def close(self) -> None:
        """Write what waits."""
        self.stop()
        self.archive.log.close()

    def update(self, now: float) -> None:
        """With each heartbeat."""
        if self._app.session is not self._session:
            self._follow(self._app.session)
        since, self._looked = now - self._looked, now
        for name in self._app.methods.hearing if 0 < since < 1 else ():
            self._listening[name] += since
        if now - self._saved >= SAVE_EVERY:
            self._saved = now
            self._save_listening()
        self._drives.update(None if self._session is None else self._session.link, now)
        self._stops.update(self._app, now)
        self.tracks.update(now)
        self._study.update(now)

    def _stop_all(self) -> None:
        """STOP to all; of one that is connected its link tells."""
        if self._app.session is None:
            self._stops.press(self._app.now())

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
        if outcome.name == "stop" and outcome.phase == "sent":
            self._study.on_command("stop", outcome.origin.method)

    def _watch(self, state: State) -> None:
        """A task that is over leaves its workload to be filled in."""
        runs = state.running in ("RUNNING", "PAUSED")
        if self._task and not runs:
            self.due = self._task
            if self.reminds:
                over = "The task is over: its workload can be filled in, at Inputs, Log and study."
                notify(self._app, over, "info", self.name)
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
        self.tracks.on_command(heard, verdict)
        if verdict.what in ("practised", "acted", "waits", "asks", "not now"):
            self._study.on_command(heard.intent, heard.method)

    def _practise(self, heard: Heard) -> str:
        return self._study.practise(heard, can_stop=self._app.intents.possible("stop"))

    def _put(self, response: Response) -> None:
        if self.on:
            self.archive.log.put(response)
            self.lines += 1
            self._count += response.kind == "command"
            self._given.update(counts([response]))

    def _save_listening(self) -> None:
        for name, seconds in self._listening.items():
            if seconds >= 1:
                self.tracks.listened(name, seconds)
        self._listening.clear()

    # the study

    @property
    def trials(self) -> Trials | None:
        """The study that is led just now, or was left in the middle; None for none."""
        return self._study.trials

    def lead(self, plan: Plan) -> Trials:
        """Begin a study; the log is switched on for it."""
        if not self.on:
            self.turn(True)
        return self._study.lead(plan)

    def end(self) -> None:
        """Leave the study; what was answered stays in the log."""
        self._study.end()

    def fill(
        self, form: str, answers: dict[str, int], order: list[str], seconds: dict[str, float], task: str = ""
    ) -> float:
        """Keep a form about `task`, or about the study, and give its score; ValueError where it cannot be scored."""
        made = Workload(
            form=form, answers=answers, order=order, seconds=seconds, at=round(self._wall(), 1),
            session=self.tracks.session, **self._study.about(task),
        )  # fmt: skip
        self.archive.workloads.put(made)
        return made.score

    # what is looked at

    def usage(self) -> Counter[str]:
        """How often each command was given in this run."""
        return Counter(self._given)

    def export(self) -> Path:
        """Write everything that is kept into one zip; OSError when that fails. Takes a while, for a thread of its own."""
        settings = {name: self._app.settings.get(name) for name in SETTINGS} | set_up(self._app)
        return self.archive.export(settings | {"study": self._settings.save()}, self._wall())

    def forget(self) -> None:
        """What is followed and counted just now is no part of the log any more, nor what is yet to be written of it."""
        self.tracks.forget()
        self._listening.clear()
        self._given.clear()
        self._count = 0
