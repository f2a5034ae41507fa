"""What the app does about what is wanted, by the same session, screens and records that its buttons use."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

from app.intents.intents import INTENTS
from bridge.msgs.pilothouse_msgs import LightState, TaskOrder, TaskStatus
from widgets.core.task_words import TASKS, title

__all__ = ["STEP", "Acting"]

STEP = 0.2
"""Faster and slower change the greatest speed of the stick by this share of the robot's own."""
TO_TASK = {"hold": "hold", "surface": "surface", "take_off": "take_off", "land": "land"}
"""Intents that start a task of their own, instead of the one that runs."""
NO_ROBOT = "No robot is connected."
HELD = "STOP is pressed; release it first."
ALONE = ("stop", "theme", "help", "back", "screen.inputs", "yes", "no")
"""What needs no robot."""


class Acting:
    """Of one app. Everything in the UI thread."""

    def __init__(self, app: Any) -> None:
        """`app` is asked for its `session`, `shell`, `inputs`, `corner` and `records` when something is done."""
        self._app = app
        self.on_help: Callable[[], object] | None = None
        """Shows or hides what keys and buttons mean; None while nothing does."""
        self._why: dict[str, Callable[[], str]] = {
            "stop": self._why_not_stop,
            "pause": self._why_not_pause,
            "resume": self._why_not_resume,
            "start": lambda: self._why_not_order(self._chosen()),
            "patrol": lambda: self._why_not_order(TaskOrder(task="patrol")),
            "go_home": self._why_not_home,
            "end_task": lambda: self._asked_of() or ("" if self._runs() else "No task runs."),
            "faster": lambda: self._why_not_speed(1),
            "slower": lambda: self._why_not_speed(-1),
            "lights": self._why_not_lights,
            "snapshot": lambda: "" if self._app.records.frame is not None else "There is no picture to keep.",
            "camera": self._why_not_camera,
            "take_control": self._why_not_control,
            "yes": self._why_not_yes,
            "no": self._why_not_answer,
            "help": lambda: "" if self.on_help is not None else "There is no help here.",
            **{intent: partial(self._why_not_task, task) for intent, task in TO_TASK.items()},
        }

    def why_not(self, intent: str) -> str:
        """One sentence why it cannot be done now; empty where it can."""
        if intent not in ALONE and self._app.shell is None:
            return NO_ROBOT
        return self._why.get(intent, str)()

    def words(self, intent: str) -> str:
        """What it would do now."""
        if self._app.session is not None:
            if intent in ("start", "patrol"):
                return f"Start {_within(title(self._order(intent)))}"
            if intent == "lights":
                return "Switch the lights off" if self._lit else "Switch the lights on"
            if intent in ("faster", "slower"):
                return f"{INTENTS[intent].words}: {self._speed(1 if intent == 'faster' else -1):.2f} m/s"
            if intent == "record":
                return "Record" if self._app.records.recorder is None else "Stop recording"
            if intent == "end_task" and self._status is not None and self._status.task in TASKS:
                return f"End {TASKS[self._status.task].doing}"
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
            "theme": app.next_theme,
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
            "start": lambda: self._start(self._chosen()),
            "patrol": lambda: self._start(TaskOrder(task="patrol")),
            "go_home": partial(session.command, "home"),
            "end_task": partial(session.command, "cancel"),
            "faster": partial(self._change_speed, 1),
            "slower": partial(self._change_speed, -1),
            "lights": lambda: session.command("lights", brightness=0.0 if self._lit else 1.0),
            "snapshot": app.records.snapshot,
            "record": app.toggle_recording,
            "camera": session.cameras.choose_next,
            "take_control": session.take_control,
            **{f"screen.{name}": partial(app.show, name) for name in ("drive", "mission", "tasks")},
            **{intent: partial(self._do_task, task) for intent, task in TO_TASK.items()},
        }

    def answer(self, yes: bool) -> str:
        """Answer what the robot asks, or the app about it; one sentence of what was answered, empty where nothing asks."""
        asked = self._asked()
        return asked(yes) if asked is not None else ""

    # what there is

    @property
    def _session(self) -> Any:
        return self._app.session

    @property
    def _status(self) -> TaskStatus | None:
        status: TaskStatus | None = self._session.feeds.latest("/task/status")
        return status

    def _state(self) -> str:
        return self._status.state if self._status is not None else ""

    def _runs(self) -> bool:
        return bool(self._session.running)

    @property
    def _lit(self) -> bool:
        lights: LightState | None = self._session.feeds.latest("/lights")
        return lights is not None and math.isfinite(lights.brightness) and lights.brightness > 0

    def _asked_of(self) -> str:
        """Why the robot cannot be asked for anything from here; empty where it can."""
        session = self._session
        if not session.connected:
            return "There is no link to the robot."
        if session.control == "other":
            return f"{session.authority.status.driver or 'Somebody else'} has control; ask for it first."
        return "" if session.may_ask else "It is not known yet who has control."

    def _latched(self) -> str:
        return HELD if self._session.robot_stop.latched else ""

    # STOP

    def _why_not_stop(self) -> str:
        known = self._session is not None or bool(self._app.corner.button.robots)
        return "" if known else "No robot is known that could be stopped."

    # tasks

    def _why_not_pause(self) -> str:
        if why := self._asked_of():
            return why
        if not self._session.robot.offers("/task/pause"):
            return "This robot knows no pause."
        if not self._runs():
            return "No task runs that could be paused."
        return "It is paused already." if self._state() == "PAUSED" else ""

    def _why_not_resume(self) -> str:
        if why := self._asked_of():
            return why
        if self._state() not in ("PAUSED", "INTERRUPTED"):
            return "No task is paused."
        return self._latched()

    def _why_not_home(self) -> str:
        if why := self._asked_of() or self._latched():
            return why
        session = self._session
        if not (session.robot.knows("go_home") and session.robot.offers("/task/go_home")):
            return "This robot cannot go home by itself."
        return "It goes home already." if self._doing("go_home") else ""

    def _doing(self, task: str) -> bool:
        return self._runs() and self._status is not None and self._status.task == task

    def _why_not_task(self, task: str) -> str:
        session = self._session
        if why := self._asked_of() or self._latched():
            return why
        if not (session.robot.knows(task) and session.robot.offers("/task/start")):
            return f"This robot knows no such task: {TASKS[task].name}."
        return f"It is {TASKS[task].doing} already." if self._doing(task) else ""

    def _do_task(self, task: str) -> None:
        tasking = self._session.tasking
        (tasking.start_instead if self._runs() else tasking.start)(TaskOrder(task=task))

    def _chosen(self) -> TaskOrder:
        """The task that is chosen on the tasks screen; a patrol where none is chosen to the end."""
        pane = self._app.shell.screens["tasks"].pane
        if pane.scheduled is None and pane.form.complete and pane.form.task:
            order: TaskOrder = pane.order
            return order
        return TaskOrder(task="patrol")

    def _order(self, intent: str) -> TaskOrder:
        return (
            self._chosen() if intent == "start" and self._app.shell is not None else TaskOrder(task="patrol")
        )

    def _why_not_order(self, order: TaskOrder) -> str:
        session = self._session
        if why := self._asked_of() or self._latched():
            return why
        if not (session.robot.knows(order.task) and session.robot.offers("/task/start")):
            return f"This robot knows no such task: {TASKS[order.task].name}."
        if self._runs() and self._status is not None:
            return f"{title(TaskOrder(task=self._status.task))} runs; end it first."
        if order.task == "patrol" and not order.places and session.mission.state == "empty":
            return "There are no points on the map to patrol."
        refused: str = session.refusals.order(order, session.mission.draft)
        return refused

    def _start(self, order: TaskOrder) -> None:
        session = self._session
        unsent = order.task == "patrol" and not order.places and session.mission.state == "draft"
        session.tasking.start(order, send_first=unsent)

    # speed

    def _card(self) -> Any:
        return (
            getattr(self._app.shell.screens["drive"], "speed", None) if self._app.shell is not None else None
        )

    def _speed(self, way: int) -> float:
        """What the greatest speed of the stick would be after a step up (1) or down (-1) [m/s]; NaN where there is none."""
        card = self._card()
        if card is None:
            return math.nan
        fader = card.ids.fader
        return float(min(fader.maximum, max(fader.minimum, card.maximum_speed + way * STEP * fader.maximum)))

    def _why_not_speed(self, way: int) -> str:
        card = self._card()
        if card is None:
            return "This robot has no speed to choose."
        if abs(self._speed(way) - card.maximum_speed) > 1e-6:
            return ""
        return "It is as fast as it may be." if way > 0 else "It is as slow as it can be set."

    def _change_speed(self, way: int) -> None:
        card = self._card()
        card.ids.fader.value = card.maximum_speed = self._speed(way)

    # what it carries, and who steers

    def _why_not_lights(self) -> str:
        if why := self._asked_of():
            return why
        offered = self._session.robot.capabilities is not None and self._session.robot.offers("/lights/set")
        return "" if offered else "This robot has no lights to switch."

    def _why_not_camera(self) -> str:
        return "" if len(self._session.robot.info.cameras) > 1 else "This robot has no other camera."

    def _why_not_control(self) -> str:
        session = self._session
        if not session.connected:
            return "There is no link to the robot."
        if session.control == "none":
            return "This robot knows no control."
        return "You have control already." if session.control == "mine" else ""

    # questions

    def _asked(self) -> Callable[[bool], str] | None:
        """What answers the question on the glass; None while nothing asks that can be answered now."""
        shell = self._app.shell
        if shell is None:
            return None
        handover, reset, question = shell.cards.handover, shell.reset.card, shell.question
        if reset.parent is not None and reset.asked and not reset.sent and not reset.blocked:
            return self._answer_reset
        if (
            handover.parent is not None
            and handover.part == "asked"
            and not (handover.sent or handover.blocked)
        ):
            return self._answer_handover
        if question.parent is not None and question.open and not question.blocked:
            return self._answer_question
        return None

    def _why_not_answer(self) -> str:
        return "" if self._asked() is not None else "Nothing is asked just now."

    def _why_not_yes(self) -> str:
        """A task that was cut short is not resumed while STOP is pressed; that it be ended can be said."""
        if self._asked() == self._answer_question:
            card = self._app.shell.question
            if card.cut and card.held:
                return f"{card.question} Not yet: {HELD}"
        return self._why_not_answer()

    def _answer_reset(self, yes: bool) -> str:
        card = self._app.shell.reset.card
        (card.press if yes else card.close)()
        return f"Put {card.name} back: {'yes' if yes else 'no'}."

    def _answer_handover(self, yes: bool) -> str:
        self._app.shell.cards.handover.ask("grant" if yes else "object")
        return "Control is handed over." if yes else "Control is kept."

    def _answer_question(self, yes: bool) -> str:
        card = self._app.shell.question
        asked = card.question
        if card.cut:
            card.ask("resume" if yes else "cancel")
        elif yes:
            card.ask("confirm")
        else:
            return f"{asked} Not yet."
        return f"{asked} {'Yes' if yes else 'No'}."


def _within(words: str) -> str:
    """Words as they are written within a sentence."""
    return words[:1].lower() + words[1:]
