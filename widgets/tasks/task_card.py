"""Task that runs now: its name, phase, reason, progress and time left.

card = TaskCard()
robot.on("/task/status", card.show), robot.on("/task/progress", card.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

from kivy.lang import Builder
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.widget import Widget

import widgets.parts.labels
import widgets.parts.sliders  # noqa: F401 - its rules draw what is used here
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import TaskOrder, TaskProgress, TaskStatus
from widgets.core.base import RobotWidget
from widgets.core.language import figure, tr
from widgets.core.surfaces import Outlined
from widgets.core.task_words import TASKS, distance_words, outcome_words, span_words, title
from widgets.parts.column import Column

__all__ = ["TaskCard", "figures_words", "is_lap_only"]

Builder.load_string("""
<TaskCard>:
    padding: dp(14), dp(8) if root.brief else dp(12)
    spacing: dp(5) if root.brief else dp(8)
    corner: theme.radius
    BoxLayout:
        size_hint_y: None
        height: max(phase.height, name.height)
        spacing: dp(10)
        Icon:
            name: root.icon
            role: 'plan' if root.active else 'muted'
            pos_hint: {'center_y': .5}
        Text:
            id: name
            text: root.title
            bold: True
            font_size: sp(17)
            shorten: root.brief
            shorten_from: 'right'
            pos_hint: {'center_y': .5}
        Chip:
            id: phase
            icon: root.state_icon
            role: root.state_role
            text: root.phase_words
            outlined: True
            pos_hint: {'center_y': .5}
    Remark:
        text: root.reason
        role: 'text'
        font_size: sp(14.5)
        shorten: root.brief
        shorten_from: 'right'
    Progress:
        value: root.progress
        height: dp(10) if root.active else 0
        opacity: 1 if root.active else 0
    Remark:
        text: '' if root.brief else root.figures
        font_size: sp(14)
""")


def is_lap_only(status: TaskStatus) -> bool:
    """Progress and time left are those of the lap under way: the patrol goes on until it is stopped."""
    return status.task == "patrol" and not status.laps and status.waypoints > 1


def figures_words(status: TaskStatus, progress: TaskProgress | None) -> str:
    """How far and how long still, as in `Point 2 of 6 · lap 1 of 3 · 38 % · 3 min left`; empty when nothing is known.

    Of a patrol without an end: `Point 2 of 6 · lap 3 · 38 % of this lap · 3 min to its end`.
    """
    parts, of_lap = [], is_lap_only(status)
    if status.waypoint:
        parts.append(
            (tr("Point {at} of {all}") if status.task == "patrol" else tr("Place {at} of {all}")).format(
                at=status.waypoint, all=status.waypoints
            )
        )
    if status.lap and status.task == "patrol":
        words = tr("lap {lap} of {laps}") if status.laps else tr("lap {lap}")
        parts.append(words.format(lap=status.lap, laps=status.laps))
    if progress is not None:
        if math.isfinite(progress.progress):
            done = f"{figure(progress.progress * 100)} %"
            parts.append(tr("{done} of this lap").format(done=done) if of_lap else done)
        if math.isfinite(progress.distance_to_next) and progress.distance_to_next > 0:
            parts.append(
                tr("{distance_to_next} to go").format(
                    distance_to_next=distance_words(progress.distance_to_next)
                )
            )
        if math.isfinite(progress.time_left):
            words = tr("{span} to its end") if of_lap else tr("{span} left")
            parts.append(words.format(span=span_words(progress.time_left)))
    return " · ".join(parts)


class TaskCard(Outlined, RobotWidget, Column):
    """One task. Progress counts only for the task that the status is about."""

    accepts = (TaskStatus, TaskProgress)
    shown_beside: ClassVar = (TaskProgress,)
    grid_size: ClassVar = (4, 3)

    brief = BooleanProperty(False)
    """Takes little room: the reason on one line, no figures."""
    status: ObjectProperty[TaskStatus] = ObjectProperty(TaskStatus())
    """The newest TaskStatus."""
    task_progress: ObjectProperty[TaskProgress | None] = ObjectProperty(None, allownone=True)
    """The newest TaskProgress of that task; None before the first."""

    def _active(self) -> bool:
        return self.status.state in ("RUNNING", "PAUSED", "INTERRUPTED")

    active = AliasProperty(_active, bind=["status"], cache=True)
    """There is a task that has not ended."""

    def _title(self) -> str:
        if not self.status.task:
            return tr("No task")
        places = list(self.status.places)
        if self.brief and len(places) > 1:
            return f"{places[0]} → {places[-1]}"  # the icon says what, the end is the goal
        return title(TaskOrder(task=self.status.task, places=places, heading=math.nan))

    title = AliasProperty(_title, bind=["status", "brief"], cache=True)

    def _icon(self) -> str:
        words = TASKS.get(self.status.task)
        return words.icon if words else "smart_toy"

    icon = AliasProperty(_icon, bind=["status"], cache=True)

    def _appearance(self) -> tuple[str, str, str]:
        return outcome_words(self.status.state, self.status.code)

    def _state_icon(self) -> str:
        return self._appearance()[0]

    state_icon = AliasProperty(_state_icon, bind=["status"], cache=True)

    def _state_role(self) -> str:
        return self._appearance()[1]

    state_role = AliasProperty(_state_role, bind=["status"], cache=True)

    def _phase_words(self) -> str:
        return self.status.phase or tr(self._appearance()[2])

    phase_words = AliasProperty(_phase_words, bind=["status"], cache=True)
    """What it does just now in one word: the phase, else the state."""

    def _reason(self) -> str:
        return self.status.reason

    reason = AliasProperty(_reason, bind=["status"], cache=True)
    progress = NumericProperty(math.nan)
    """0 to 1; NaN while it is not known."""
    figures = StringProperty("")

    def show(self, msg: Msg) -> None:
        """Take over a status or the progress of its task."""
        if isinstance(msg, TaskStatus):
            if msg.task_id != self.status.task_id or msg.state == "INTERRUPTED":
                self.task_progress = None  # what was cut short drives a part of it once more
            self.status = msg
        elif isinstance(msg, TaskProgress):
            counts = msg.task_id == self.status.task_id and self.status.state != "INTERRUPTED"
            self.task_progress = msg if counts else self.task_progress
        else:
            super().show(msg)
        self.progress = (
            self.task_progress.progress if self.active and self.task_progress is not None else math.nan
        )
        self.figures = figures_words(self.status, self.task_progress) if self.active else ""


def samples() -> dict[str, Callable[[], Widget]]:
    """Each state of a task."""
    runs = TaskStatus(
        task_id=4,
        task="deliver",
        state="RUNNING",
        phase="driving",
        reason="Driving to Office 12 to fetch it.",
        place="Office 12",
        places=["Office 12", "Lab"],
        waypoint=1,
        waypoints=2,
    )
    patrol: dict[str, Any] = {"task": "patrol", "waypoint": 3, "waypoints": 6, "lap": 1, "laps": 3}
    told = TaskProgress(task_id=4, progress=0.38, distance_to_next=7.4, time_left=190.0, distance_driven=21.0)
    why = "Canceled by tablet-B."
    cut = "The robot's computer restarted in the middle of a patrol; choose Resume to go on, or Discard."

    def make(status: TaskStatus, *progress: TaskProgress, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            card = TaskCard(size_hint_x=None, width="388dp", **{"state": "live", **kwargs})
            for message in (status, *progress):
                card.show(message)
            return card

        return build

    return {
        "runs": make(runs, told),
        "patrol": make(TaskStatus(task_id=4, state="RUNNING", reason="Driving to point 3.", **patrol), told),
        "brief": make(runs, told, brief=True),
        "paused": make(TaskStatus(task_id=4, state="PAUSED", reason="Paused by tablet-B.", **patrol), told),
        "cut short": make(TaskStatus(task_id=4, state="INTERRUPTED", reason=cut, **patrol), told),
        "canceled": make(TaskStatus(task_id=4, task="guide", state="CANCELED", reason=why)),
        "none": make(TaskStatus()),
        "stale": make(runs, told, state="stale", age=8.0),
    }
