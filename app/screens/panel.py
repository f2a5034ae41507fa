"""What the mission screen offers beside its map: sending, motion, task, progress, events."""

from __future__ import annotations

import math
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.gridlayout import GridLayout

from app.dashboard import Dashboard
from app.session import Session
from bridge.msgs.pilothouse_msgs import TaskProgress, TaskStatus
from widgets import EventLog, MotionSelector, Readout, TaskButtons
from widgets.kit import Card

__all__ = ["MissionPanel"]

TASKS = {"stop": "cancel"}
"""Where a button of TaskButtons is another command of the app."""
STATES = {
    "empty": ("No points yet: choose Points and tap the map.", "muted"),
    "draft": ("Draft: the robot does not have it yet.", "warn"),
    "sent": ("Sent, waiting for the robot …", "muted"),
    "stored": ("Stored on the robot.", "ok"),
}
"""State of the draft to its sentence and the role of its colour."""

Builder.load_string("""
<MissionPanel>:
    orientation: 'vertical'
    ScrollView:
        id: scroll
        do_scroll_x: False
        bar_width: dp(3)
        BoxLayout:
            id: column
            orientation: 'vertical'
            size_hint_y: None
            height: max(self.minimum_height, scroll.height)
            spacing: dp(9) if root.form == 'wide' else dp(10)
            padding: 0, dp(12) if root.form == 'tall' else 0, 0, 0

<SendRow>:
    orientation: 'vertical'
    size_hint_y: None
    height: self.minimum_height
    spacing: dp(5)
    PrimaryButton:
        id: send
        role: 'plan'
        icon: 'upload'
        text: root.words
        disabled: not root.may_send
    BoxLayout:
        size_hint_y: None
        height: note.height
        spacing: dp(7)
        Icon:
            name: root.icon
            role: root.role
            font_size: sp(17)
            pos_hint: {'center_y': .5}
        Text:
            id: note
            text: root.note
            role: root.role
            font_size: sp(14)
            max_lines: 2
            shorten: len(self.text) > 90

<ProgressRow>:
    orientation: 'vertical'
    size_hint_y: None
    height: self.minimum_height
    spacing: dp(5)
    SectionLabel:
        title: 'Progress'
        height: self.texture_size[1] if root.titled else 0
        opacity: 1 if root.titled else 0
    Progress:
        value: root.value
    BoxLayout:
        size_hint_y: None
        height: where.height
        Text:
            id: where
            text: root.where
            role: 'muted'
            font_size: sp(14)
            shorten: True
            shorten_from: 'right'
        Text:
            text: '' if root.value != root.value else '%.0f %%' % (root.value * 100)
            role: 'muted'
            font_size: sp(14)
            halign: 'right'
            size_hint_x: None
            width: dp(54)

<LatestEvent>:
    size_hint_y: None
    height: dp(26)
""")


class SendRow(BoxLayout):
    """The button that sends the draft, and under it what became of it."""

    words = StringProperty("Send points")
    note = StringProperty("")
    role = StringProperty("muted")
    icon = StringProperty("info")
    may_send = NumericProperty(0)


class ProgressRow(BoxLayout):
    """How far the task is."""

    value = NumericProperty(math.nan)
    """0 to 1; NaN while nothing runs."""
    where = StringProperty("")
    titled = BooleanProperty(True)
    """Has its name over it."""


class MissionPanel(BoxLayout):
    """Everything to do with the mission that is not on the map."""

    form = OptionProperty("", options=["", "wide", "short", "tall"])

    def __init__(self, session: Session, dashboard: Dashboard, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session = session
        self._send, self._progress = SendRow(), ProgressRow()
        self.motion, self.tasks, self.events = MotionSelector(), TaskButtons(), EventLog(size_hint_y=1)
        self.speed = Readout(name="Speed", unit="m/s", decimals=2, path="twist.twist.linear.x")
        self.next = Readout(name="Next point", unit="m", decimals=1)
        self.lap = Readout(name="Lap")
        self.left = Readout(name="Time left", kind="clock", unit="min")
        self.readouts = Card(floating=True, padding=("14dp", "10dp"))
        self.figures = GridLayout(cols=2, spacing=("12dp", "6dp"))
        for figure in (self.speed, self.next, self.lap, self.left):
            figure.fitted, figure.size_hint_x = False, 1
            self.figures.add_widget(figure)
        self._send.ids.send.bind(on_release=lambda _: session.send_mission())
        self.motion.bind(on_command=lambda _, choice: session.mission.set_motion(**choice))
        self.tasks.bind(on_command=lambda _, name: session.command(TASKS.get(name, name)))
        self.ids["send"] = self._send.ids.send
        self._bind(dashboard)

    def _bind(self, dashboard: Dashboard) -> None:
        dashboard.bind(self.speed, "/odom")
        dashboard.bind(self.tasks, "/task/status", fresh=False)
        dashboard.bind(self._progress, "/task/status", self._show_status, fresh=False)
        dashboard.bind(self._progress, "/task/progress", self._show_progress, fresh=False)

    # where things are

    def take_form(self, form: str) -> None:
        """Order what is there for the window's shape: a phone begins with the figures."""
        if form == self.form:
            return
        self.form = form
        column = self.ids.column
        column.clear_widgets()
        for _holder in (self.readouts, self):
            if self.figures.parent is not None:
                self.figures.parent.remove_widget(self.figures)
        tall = form == "tall"
        self.figures.cols = 2 if form == "wide" else 4 if tall else 2
        self.figures.size_hint_y = 1 if form == "wide" else None
        self.figures.height = "58dp" if tall else "116dp"
        for figure in (self.speed, self.next, self.lap, self.left):
            figure.font_size = "22sp" if tall else "26sp"
        self.tasks.brief = form != "wide"
        self.next.name = "Next" if tall else "Next point"
        self._progress.titled = not tall
        self.events.size_hint_y = 1 if form == "wide" else None
        self.events.height = "190dp"
        if form == "wide":
            self.readouts.add_widget(self.figures)
            order = [self._send, self.motion, self.tasks, self._progress, self.events]
        elif tall:
            order = [self.figures, self._send, self.motion, self.events]
        else:
            order = [self.tasks, self._send, self._progress, self.figures, self.motion, self.events]
        for widget in order:
            if widget.parent is not None:
                widget.parent.remove_widget(widget)
            column.add_widget(widget)

    def _show_where(self) -> None:
        """A phone has room for the progress only while there is some."""
        if self.form != "tall":
            return
        column, shown = self.ids.column, self._progress.parent is not None
        if self._session.running and not shown:
            column.add_widget(self._progress, index=len(column.children) - 1)
        elif shown and not self._session.running:
            column.remove_widget(self._progress)

    def keep_tasks(self, here: bool) -> None:
        """Have the task's buttons in the panel, or free them for another place."""
        column = self.ids.column
        if here and self.tasks.parent is not column:
            if self.tasks.parent is not None:
                self.tasks.parent.remove_widget(self.tasks)
            self.tasks.size_hint_x = 1
            column.add_widget(self.tasks, index=len(column.children) - (2 if self.form == "wide" else 0))
        elif not here and self.tasks.parent is column:
            column.remove_widget(self.tasks)
        if here:
            self.tasks.size_hint = (1, None)

    # what is shown

    def show_draft(self) -> None:
        """Take over the draft and how it stands to what the robot has."""
        mission = self._session.mission
        count, state = len(mission.draft.points), mission.state
        self._send.words = (
            "Send to the robot" if not count else f"Send {count} point{'' if count == 1 else 's'}"
        )
        note, role = STATES[state]
        if state == "draft" and mission.outcome and not mission.outcome.startswith("Accepted"):
            note, role = mission.outcome, "danger"
        self._send.note, self._send.role = note, role
        self._send.icon = {"stored": "check_circle", "sent": "schedule", "empty": "info"}.get(state, "edit")
        self.motion.show(mission.draft.message())

    def _show_status(self, status: TaskStatus) -> None:
        if not self._session.running:
            self._progress.value = math.nan
            self.next.value = self.left.value = math.nan
        self.lap.words = f"{status.lap}" if status.lap else ""
        self.lap.unit = f"of {status.laps}" if status.laps and status.lap else ""
        # the robot's own sentence stands under the buttons
        going = f"Point {status.waypoint} of {status.waypoints}" if status.waypoint else ""
        self._progress.where = going or status.reason or "No task runs."

    def _show_progress(self, progress: TaskProgress) -> None:
        if self._session.running:
            self._progress.value = progress.progress
            self.next.value, self.left.value = progress.distance_to_next, progress.time_left

    def tick(self) -> None:
        """Bring up to date what time changes."""
        session = self._session
        self._show_where()
        mine = session.connected and session.control != "other"
        self.tasks.state = "live" if mine else "disabled"
        self._send.may_send = int(mine and session.mission.state == "draft")
        state = session.feeds.state("/task/status")
        for figure in (self.next, self.lap, self.left):
            figure.state = state
            figure.age = session.feeds.age("/task/status")
        now = session.link.robot_time()
        if math.isfinite(now) and not abs(now - self.events.now) < 1.0:
            self.events.now = now
        self.events.state = "live" if session.connected else "stale"
