"""Actions that a layout offers: the state of each, and the effect of a press."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Protocol

from app.session.recordings import Recordings
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import LightState, TaskOrder, TaskStatus
from widgets.controls.action_column import Action
from widgets.core.language import mark, tr
from widgets.core.task_words import TASKS

__all__ = ["ACTIONS", "CARRIED", "LayoutActions", "Line"]

ACTIONS: dict[str, tuple[str, str]] = {
    "task.surface": (mark("Surface"), "water"),
    "task.hold": (mark("Hold"), "pause_circle"),
    "task.follow_heading": (mark("Follow heading"), "explore"),
    "task.take_off": (mark("Take off"), "arrow_upward"),
    "task.land": (mark("Land"), "arrow_downward"),
    "task.go_home": (mark("Go home"), "home"),
    "pause": (mark("Pause"), "pause"),
    "lights": (mark("Lights"), "lightbulb"),
    "record": (mark("Start recording"), "fiber_manual_record_fill"),
    "snapshot": (mark("Snapshot"), "photo_camera"),
    "camera": (mark("Camera"), "videocam"),
    "reset": (mark("Put back"), "replay"),
}
"""Every action that a layout may name, to its words and its icon where the layout gives none."""
CARRIED = ("lights", "camera")
"""Of what a robot may carry: wherever one does they are there, whether its layout names them or not."""


class Line(Protocol):
    """One line of a layout."""

    @property
    def what(self) -> str:
        """Key in `ACTIONS`."""

    @property
    def text(self) -> str:
        """Its words; empty for the usual ones."""

    @property
    def icon(self) -> str:
        """Its icon; empty for the usual one."""


class Confirmation(Protocol):
    """A card that asks before something is done."""

    def ask(self) -> object:
        """Put it on the glass."""


class Frame(Protocol):
    """The frame round the robot's screens, as far as actions need it."""

    @property
    def reset(self) -> Confirmation:
        """The card that confirms a reset."""


class Recording(Protocol):
    """The visit to the robot, as far as actions need it."""

    def toggle_recording(self) -> None:
        """Start recording, or finish the one that runs."""


class Host(Protocol):
    """The app, as far as actions need it."""

    records: Recordings

    @property
    def visit(self) -> Recording:
        """The visit to the robot."""

    @property
    def shell(self) -> Frame | None:
        """The frame round the robot's screens; None before it is made."""


class LayoutActions:
    """The actions of one layout on one robot. Everything here happens in the UI thread."""

    def __init__(self, lines: Iterable[Line], session: Session, app: Host) -> None:
        """`lines` are the actions that the layout names."""
        self._session, self._app = session, app
        self._words = {
            line.what: (tr(line.text) or tr(ACTIONS[line.what][0]), line.icon or ACTIONS[line.what][1])
            for line in lines
        }
        self._besides = [what for what in CARRIED if what not in self._words]
        """What no line names."""
        self._words |= {what: (tr(ACTIONS[what][0]), ACTIONS[what][1]) for what in self._besides}
        self._looks: dict[str, Callable[[str, str], Action | None]] = {
            "pause": self._pause,
            "lights": self._lights,
            "record": self._record,
            "snapshot": self._snapshot,
            "camera": self._camera,
            "reset": self._reset,
        }
        self._acts: dict[str, Callable[[], object]] = {
            "pause": lambda: session.command("resume" if self._paused else "pause"),
            "lights": self._switch_lights,
            "record": app.visit.toggle_recording,
            "snapshot": app.records.snapshot,
            "camera": session.cameras.choose_next,
            "reset": self._ask_to_reset,
        }

    def current(self) -> list[Action]:
        """Each as it stands now; those are left out that this robot has nothing for."""
        looks = (
            self._task(what, text, icon) if what.startswith("task.") else self._looks[what](text, icon)
            for what, (text, icon) in self._words.items()
            if what not in self._besides or self._carries(what)
        )
        return [action for action in looks if action is not None]

    def slides(self) -> list[Action]:
        """Each as a slide has it, which never ends what it began: a task that is paused goes on by it, one that runs needs none."""
        return [self._slide(action) if action.meaning == "end" else action for action in self.current()]

    def _slide(self, action: Action) -> Action:
        task = action.name.removeprefix("task.")
        if not self._paused:
            return replace(action, text=self._words[action.name][0], able=False, meaning="")
        able = action.able and not self._session.robot_stop.latched
        return replace(
            action, text=tr("Resume {doing}").format(doing=TASKS[task].doing), able=able, meaning="resume"
        )

    def confirm(self, what: str) -> str:
        """Do what a slide to its end means now; the command that is asked for, empty for none."""
        action = next((one for one in self.slides() if one.name == what and one.able), None)
        if action is None:
            return ""
        if action.meaning == "resume":
            self._session.command("resume")
            return "resume"
        self.act(what)
        return "home" if what == "task.go_home" else "start"

    def _carries(self, what: str) -> bool:
        """The robot says that it has that."""
        info = self._session.robot.info
        return "lights" in info.payloads if what == "lights" else len(info.cameras) > 1

    def act(self, what: str) -> None:
        """Do what a press on it means now; nothing where `look` says that it cannot be asked for."""
        if not any(action.name == what and action.able for action in self.current()):
            return
        if what.startswith("task."):
            self._ask_for(what.removeprefix("task."))
        else:
            self._acts[what]()

    # tasks

    @property
    def _status(self) -> TaskStatus | None:
        status: TaskStatus | None = self._session.feeds.latest("/task/status")
        return status

    @property
    def _paused(self) -> bool:
        return self._status is not None and self._status.state == "PAUSED"

    def _runs(self, task: str) -> bool:
        return self._session.running and self._status is not None and self._status.task == task

    def _task(self, what: str, text: str, icon: str) -> Action | None:
        session, task = self._session, what.removeprefix("task.")
        service = "/task/go_home" if task == "go_home" else "/task/start"
        if not session.robot.knows(task) or not session.robot.offers(service):
            return None
        if self._runs(task):
            return Action(
                what,
                tr("End {doing}").format(doing=TASKS[task].doing),
                "stop",
                session.may_ask,
                meaning="end",
            )
        able = session.may_ask and not session.robot_stop.latched
        return Action(what, text, icon, able, meaning="start")

    def _ask_for(self, task: str) -> None:
        session = self._session
        if self._runs(task):
            session.command("cancel")
        elif task == "go_home":  # which the robot does whatever it is doing
            session.command("home")
        elif session.running:
            session.tasking.start_instead(TaskOrder(task=task))
        else:
            session.tasking.start(TaskOrder(task=task))

    def _pause(self, text: str, icon: str) -> Action | None:
        session = self._session
        if not session.robot.offers("/task/pause"):
            return None
        able = session.may_ask and session.running and not (session.robot_stop.latched and self._paused)
        return (
            Action("pause", tr("Resume"), "play_arrow", able)
            if self._paused
            else Action("pause", text, icon, able)
        )

    # what it carries

    @property
    def _lit(self) -> bool:
        lights: LightState | None = self._session.feeds.latest("/lights")
        return lights is not None and math.isfinite(lights.brightness) and lights.brightness > 0

    def _lights(self, text: str, icon: str) -> Action | None:
        session = self._session
        if session.robot.capabilities is None or not session.robot.offers("/lights/set"):
            return None
        known = session.feeds.latest("/lights") is not None
        said = ("on" if self._lit else "off") if known else ""
        shown = f"{icon}_fill" if self._lit and icon == "lightbulb" else icon
        return Action("lights", text, shown, session.may_ask, said, said or "on")

    def _switch_lights(self) -> None:
        self._session.command("lights", brightness=0.0 if self._lit else 1.0)

    def _camera(self, text: str, icon: str) -> Action | None:
        cameras = self._session.robot.info.cameras
        if len(cameras) < 2:
            return None
        return Action("camera", text, icon, said=self._session.cameras.wanted(None) or "", meaning="next")

    def _reset(self, text: str, icon: str) -> Action | None:
        session = self._session
        return Action("reset", text, icon, session.may_ask) if session.robot.offers("/robot/reset") else None

    def _ask_to_reset(self) -> None:
        shell = self._app.shell
        if shell is not None:
            shell.reset.ask()

    # what is kept

    def _record(self, text: str, icon: str) -> Action:
        records = self._app.records
        if records.recorder is None:
            return Action("record", text, icon, meaning="start")
        return Action("record", tr("Stop recording"), "stop", said=records.clock, meaning="stop")

    def _snapshot(self, text: str, icon: str) -> Action:
        return Action("snapshot", text, icon, self._app.records.frame is not None)
