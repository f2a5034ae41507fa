"""Execution of intents: each is done by the same session, screens and records that its buttons use."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, cast

from app.intents.executor_app import ExecutorApp
from app.intents.intents import INTENTS
from app.intents.open_question import OpenQuestion
from app.intents.speed_steps import SpeedSteps
from app.intents.task_intents import TaskIntents
from app.intents.told_state import ToldState
from bridge.msgs.pilothouse_msgs import LightState, TaskOrder
from widgets.core.language import mark, tr, within
from widgets.core.quantities import said
from widgets.core.task_words import TASKS, title

if TYPE_CHECKING:
    from app.session.session import Session

__all__ = ["IntentExecutor"]

TO_TASK = {"dock": "dock", "hold": "hold", "surface": "surface", "take_off": "take_off", "land": "land"}
"""Intents that start a task of their own, instead of the one that runs."""
NO_ROBOT = mark("No robot is connected.")
ALONE = ("stop", "theme", "help", "back", "screen.inputs", "yes", "no")
"""What needs no robot."""


class IntentExecutor:
    """Of one app. Everything in the UI thread."""

    def __init__(self, app: ExecutorApp) -> None:
        """`app` is asked for its `session`, `shell`, `inputs`, `corner` and `records` when something is done."""
        self._app = app
        self._tasks, self._speed, self._question = TaskIntents(app), SpeedSteps(app), OpenQuestion(app)
        self._told = ToldState(app)
        self.on_help: Callable[[], object] | None = None
        """Shows or hides what keys and buttons mean; None while nothing does."""
        self._why: dict[str, Callable[[], str]] = {
            "stop": self._why_not_stop,
            "pause": self._tasks.why_not_pause,
            "resume": self._tasks.why_not_resume,
            "start": lambda: self._tasks.why_not_order(self._tasks.chosen()),
            "patrol": lambda: self._tasks.why_not_order(TaskOrder(task="patrol")),
            "go_home": self._tasks.why_not_home,
            "end_task": self._tasks.why_not_end,
            "faster": lambda: self._speed.why_not(1),
            "slower": lambda: self._speed.why_not(-1),
            **dict.fromkeys(("lights", "lights_on", "lights_off"), self._why_not_lights),
            "tell_battery": self._told.why_not_battery,
            "tell_task": self._told.why_not_task,
            "snapshot": lambda: (
                "" if self._app.records.frame is not None else tr("There is no picture to keep.")
            ),
            "camera": self._why_not_camera,
            "take_control": self._why_not_control,
            "yes": self._question.why_not_yes,
            "no": self._question.why_not_answer,
            "help": lambda: "" if self.on_help is not None else tr("There is no help here."),
            **{intent: partial(self._tasks.why_not_task, task) for intent, task in TO_TASK.items()},
        }

    def why_not(self, intent: str) -> str:
        """One sentence why it cannot be done now; empty where it can."""
        if intent not in ALONE and self._app.shell is None:
            return tr(NO_ROBOT)
        return self._why.get(intent, str)()

    def words(self, intent: str) -> str:
        """What it would do now."""
        if self._app.session is not None:
            if intent in ("start", "patrol"):
                return tr("Start {within}").format(within=within(title(self._tasks.order_of(intent))))
            if intent == "lights":
                return tr("Switch the lights off") if self._lit else tr("Switch the lights on")
            if intent in ("faster", "slower"):
                speed = self._speed.after(1 if intent == "faster" else -1)
                return f"{INTENTS[intent].words}: {' '.join(said(speed, 'speed', 2))}"
            if intent in ("tell_battery", "tell_task"):
                return self._told.battery() if intent == "tell_battery" else self._told.task()
            if intent == "record":
                return tr("Record") if self._app.records.recorder is None else tr("Stop recording")
            status = self._tasks.status
            if intent == "end_task" and status is not None and status.task in TASKS:
                return tr("End {doing}").format(doing=TASKS[status.task].doing)
        return INTENTS[intent].words

    def do(self, intent: str) -> None:
        """Do it; KeyError for what is answered instead."""
        deeds = self._alone()
        (deeds if intent in deeds else self._asked_for())[intent]()

    def _alone(self) -> dict[str, Callable[[], object]]:
        """What needs no robot."""
        app = self._app
        return {
            "stop": app.inputs.stop,
            "theme": app.themes.choose_next,
            "help": self.on_help or str,
            "back": app.back,
            "screen.inputs": app.show_inputs,
        }

    def _asked_for(self) -> dict[str, Callable[[], object]]:
        """What is asked of the robot that is connected."""
        app, session = self._app, self._session
        return {
            "pause": partial(session.command, "pause"),
            "resume": partial(session.command, "resume"),
            "start": lambda: self._tasks.start(self._tasks.chosen()),
            "patrol": lambda: self._tasks.start(TaskOrder(task="patrol")),
            "go_home": partial(session.command, "home"),
            "end_task": partial(session.command, "cancel"),
            "faster": partial(self._speed.change, 1),
            "slower": partial(self._speed.change, -1),
            "lights": lambda: session.command("lights", brightness=0.0 if self._lit else 1.0),
            "lights_on": partial(session.command, "lights", brightness=1.0),
            "lights_off": partial(session.command, "lights", brightness=0.0),
            **dict.fromkeys(("tell_battery", "tell_task"), str),
            "snapshot": app.records.snapshot,
            "record": app.visit.toggle_recording,
            "camera": session.cameras.choose_next,
            "take_control": session.take_control,
            **{f"screen.{name}": partial(app.show, name) for name in ("drive", "mission", "tasks")},
            **{intent: partial(self._tasks.start_task, task) for intent, task in TO_TASK.items()},
        }

    def answer(self, yes: bool) -> str:
        """Answer what the robot asks, or the app about it; one sentence of what was answered, empty where nothing asks."""
        return self._question.answer(yes)

    # what there is

    @property
    def _session(self) -> Session:
        return cast("Session", self._app.session)

    @property
    def _lit(self) -> bool:
        lights: LightState | None = self._session.feeds.latest("/lights")
        return lights is not None and math.isfinite(lights.brightness) and lights.brightness > 0

    # STOP

    def _why_not_stop(self) -> str:
        known = self._app.session is not None or bool(self._app.corner.button.robots)
        return "" if known else tr("No robot is known that could be stopped.")

    # what it carries, and who steers

    def _why_not_lights(self) -> str:
        if why := self._tasks.why_not_asked():
            return why
        offered = self._session.robot.capabilities is not None and self._session.robot.offers("/lights/set")
        return "" if offered else tr("This robot has no lights to switch.")

    def _why_not_camera(self) -> str:
        return "" if len(self._session.robot.info.cameras) > 1 else tr("This robot has no other camera.")

    def _why_not_control(self) -> str:
        session = self._session
        if not session.connected:
            return tr("There is no link to the robot.")
        if session.control == "none":
            return tr("This robot knows no control.")
        return tr("You have control already.") if session.control == "mine" else ""
