"""The panel beside the map: sending, motion, task, progress, events."""

from __future__ import annotations

import math
from typing import Any

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.layout.rects import Rect
from app.missions.pictured_log import PicturedLog
from app.screens.mission.no_mission_panel import Figures, NoMissionPanel
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import TaskOrder, TaskProgress, TaskStatus
from widgets import EventLog, MotionSelector, Readout, TaskButtons
from widgets.core.language import figure, mark, tr, trn
from widgets.core.task_words import phase_words
from widgets.instruments.readout import ReadoutGrid
from widgets.parts.column import Column
from widgets.parts.kit import Card
from widgets.status.event_log import ago, appearance
from widgets.tasks.height_row import HeightRow
from widgets.tasks.task_card import figures_words, is_lap_only

__all__ = ["MissionPanel"]

TASKS = {"stop": "cancel"}
"""Where a button of TaskButtons is another command of the app."""
STATES = {
    "empty": (mark("Choose Points, then tap the map."), "muted"),
    "draft": (mark("Draft: not on the robot yet."), "warn"),
    "sent": (mark("Sent, waiting for the robot …"), "muted"),
    "stored": (mark("Stored on the robot."), "ok"),
}
"""State of the draft to its sentence and the role of its colour."""
POINTLESS = ("go_home", "hold", "follow_heading")
"""Tasks without points to pass."""
NO_TASKS = mark("It offers no tasks.")
NO_MISSIONS = mark("It stores no missions.")

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
            spacing: dp(9) if root.form == 'wide' else dp(7) if root.form == 'short' else dp(10)
            padding: 0, dp(12) if root.form == 'tall' else 0, 0, 0

<SendRow>:
    spacing: dp(5)
    PushButton:
        id: send
        fill: 'plan' if root.calls else 'raised'
        border: 'plan' if root.calls else 'line'
        ink: 'ink_plan' if root.calls else 'text'
        icon: 'upload'
        text: root.words or tr('Send points')
        disabled: not root.may_send
    BoxLayout:
        size_hint_y: None
        height: note.height
        spacing: dp(7)
        Icon:
            name: root.icon
            role: root.role
            font_size: sp(17)
            pos_hint: {'top': 1}
        Text:
            id: note
            text: root.note
            role: root.role
            font_size: sp(14)
            shorten: root.lean and root.role != 'danger'
            shorten_from: 'right'

<ProgressRow>:
    spacing: dp(5)
    SectionLabel:
        title: tr('Progress')
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
            text: root.done
            role: 'muted'
            font_size: sp(14)
            halign: 'right'
            shorten: True
            size_hint_x: None
            width: sp(142) if root.of_lap else sp(54)

<LatestEvent>:
    size_hint_y: None
    height: dp(26)
    spacing: dp(8)
    Icon:
        name: root.icon
        role: root.role
        font_size: sp(20)
        pos_hint: {'center_y': .5}
    Text:
        text: root.text
        font_size: sp(14.5)
        shorten: True
        shorten_from: 'right'
        pos_hint: {'center_y': .5}
    Text:
        text: root.when
        role: 'muted'
        font_size: sp(13)
        halign: 'right'
        size_hint_x: None
        width: dp(38)
        pos_hint: {'center_y': .5}
""")


class SendRow(Column):
    """The button that sends the draft, and under it what became of it."""

    words = StringProperty("")
    """On the button; empty for the usual ones."""
    note = StringProperty("")
    role = StringProperty("muted")
    icon = StringProperty("info")
    may_send = NumericProperty(0)
    lean = BooleanProperty(False)
    """Has one line for what became of it, but all that a refusal says."""
    calls = BooleanProperty(False)
    """Nothing else sends these points: the robot goes round others just now."""


class ProgressRow(Column):
    """How far the task is."""

    value = NumericProperty(math.nan)
    """0 to 1; NaN while nothing runs."""
    of_lap = BooleanProperty(False)
    """How far this lap is: the task goes on until it is stopped."""

    def _done(self) -> str:
        if math.isnan(self.value):
            return ""
        done = f"{figure(self.value * 100)} %"
        return tr("{done} of this lap").format(done=done) if self.of_lap else done

    done = AliasProperty(_done, bind=["value", "of_lap"], cache=True)
    """The same in words; empty while nothing runs."""
    where = StringProperty("")
    titled = BooleanProperty(True)
    """Has its name over it."""


class LatestEvent(BoxLayout):
    """What happened last, in one line."""

    icon = StringProperty("info")
    role = StringProperty("muted")
    text = StringProperty("")
    when = StringProperty("")

    def show(self, log: EventLog) -> None:
        """Take it from the log; empty while nothing happened."""
        event = log.events[0] if log.events else None
        self.opacity = 1 if event else 0
        if event:
            self.icon, self.role = appearance(event)
            self.text, self.when = event.text, ago(log.now - event.stamp.seconds)


class MissionPanel(BoxLayout):
    """Everything to do with the mission that is not on the map."""

    sheet_open = BooleanProperty(False)
    """The sheet of a phone is drawn up, so that there is room for more."""
    form = OptionProperty("", options=["", "wide", "short", "tall"])
    refused = StringProperty("")
    """What the robot would refuse of the draft, as one short sentence; empty for nothing."""

    def __init__(self, session: Session, dashboard: Dashboard, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session = session
        self._send, self._progress, self._latest = SendRow(), ProgressRow(), LatestEvent()
        self.motion, self.tasks, self.events = MotionSelector(), TaskButtons(), PicturedLog(session.pictures)
        self.heights = HeightRow(session.mission.set_height)
        self.speed = Readout(name=tr("Speed"), unit="m/s", decimals=2, path="twist.twist.linear.x")
        self.next = Readout(name=tr("Next point"), unit="m", decimals=1)
        self.next.brief_name = tr("Next", context="point")
        self.lap = Readout(name=tr("Lap"))
        self.left = Readout(name=tr("Time left"), kind="clock", unit="min")
        self.lacking, self.plain = NoMissionPanel(), Figures(dashboard)
        self._rest = Widget()
        self._fill = Widget(size_hint_y=None, height=0)
        self._above: list[Widget] = []
        self._shown: tuple[object, ...] = ()
        self.readouts = Card(floating=True, padding=("14dp", "10dp"))
        self.figures = ReadoutGrid(cols=2, spacing=("12dp", "6dp"))
        for readout in (self.speed, self.next, self.lap, self.left):
            readout.fitted, readout.size_hint_x = False, 1
            self.figures.add_widget(readout)
        self._send.ids.send.bind(on_release=lambda _: session.send_mission())
        self.motion.bind(on_command=lambda _, choice: session.mission.set_motion(**choice))
        self.tasks.bind(on_command=lambda _, name: self._command(name))
        self.ids["send"] = self._send.ids.send
        self._bind(dashboard)
        self._fold_soon = Clock.create_trigger(self._fold, -1)
        self.ids.scroll.bind(height=self._fold_soon)
        self.bind(sheet_open=self._fold_soon)
        for widget in (self._send, self._progress, self.tasks, self.figures, self.motion, self.heights):
            widget.bind(height=self._fold_soon)

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
        tall, wide = form == "tall", form == "wide"
        self.figures.cols = 4 if tall else 2
        for figures in (self.figures, self.plain):
            figures.size_hint_y = 1 if wide else None
            figures.height = "58dp" if tall and figures is self.figures else "96dp"
        for readout in (self.speed, self.next, self.lap, self.left):
            readout.font_size = "26sp" if wide else "22sp"
        self.tasks.brief = self.motion.brief = not wide
        self.tasks.low = self._send.lean = form == "short"
        self.next.name = tr("Next", context="point") if tall else tr("Next point")
        self._progress.titled = wide
        self.events.size_hint_y = 1
        self.events.size_hint_min_y = None if wide else "190dp"
        self._shown = ()
        self._reorder()

    def _order(self) -> tuple[list[Widget], list[Widget]]:
        """What is in sight at rest, and what a phone has to be scrolled or its sheet drawn up for."""
        if self._session.robot.lacks_tasks:
            return [self.lacking, *([self.plain] if self.form == "short" else []), self._rest], []
        route: list[Widget] = [self.motion, self.heights] if self.heights.levels else [self.motion]
        if self.form == "wide":
            return [self._send, *route, self.tasks, self._progress, self.events], []
        first = [] if self.form == "tall" else [self.tasks]
        if not self._session.running:
            return [*first, self._send], [*route, self.events]
        if self._session.mission.state in ("draft", "sent"):
            return [*first, self._send, self.figures], [self._progress, *route, self.events]
        latest = [self._latest] if self.form == "tall" else []
        return [*first, self._progress, self.figures, *latest], [self._send, *route, self.events]

    def _reorder(self) -> None:
        above, below = self._order()
        if self._shown == (self.form, *above, *below):
            return
        self._shown, self._above = (self.form, *above, *below), above
        column = self.ids.column
        column.clear_widgets()
        self.readouts.clear_widgets()
        if self.form == "wide":
            figures = self.plain if self._session.robot.lacks_tasks else self.figures
            if figures.parent is not None:
                figures.parent.remove_widget(figures)
            self.readouts.add_widget(figures)
        for widget in [*above, *([self._fill] if below else []), *below]:
            if widget.parent is not None:
                widget.parent.remove_widget(widget)
            column.add_widget(widget)
        self.ids.scroll.scroll_y = 1
        self._fold_soon()

    def _fold(self, *_: object) -> None:
        """No row is cut through at rest: what does not fit begins below the lower edge."""
        column = self.ids.column
        spare = self.ids.scroll.height - column.padding[1] - sum(widget.height for widget in self._above)
        spare -= len(self._above) * column.spacing
        if not self._session.running:
            spare -= column.spacing + self.motion.choice_height
        self._fill.height = 0 if self.sheet_open else max(0, spare)

    def _command(self, name: str) -> None:
        home = self._session.mission.home_to_send if name == "home" else None
        if name == "start":
            self._start()
        elif home is not None:  # the home that is drawn, not one that the robot may have from before
            self._session.tasking.start(TaskOrder(task="go_home"), mission=home)
        else:
            self._session.command(TASKS.get(name, name))

    def _start(self) -> None:
        """Start the patrol of the points that are drawn: what the robot does not have of them yet goes ahead."""
        session = self._session
        if session.mission.dirty:
            session.tasking.start(TaskOrder(task="patrol"), send_first=True)
        else:
            session.command("start")

    def put_tasks(self, screen: Widget, beside: Rect | None) -> None:
        """Put the task's buttons, or the figures of a robot that has no tasks, `beside` STOP on `screen`; None keeps them in the panel."""
        lone = self.plain if self._session.robot.lacks_tasks else self.tasks
        if beside is None:
            self.tasks.size_hint = (1, None)
        for widget in (self.tasks, self.plain):
            if widget.parent is screen and (beside is None or widget is not lone):
                screen.remove_widget(widget)
        if beside is not None:
            if lone.parent is not screen:
                if lone.parent is not None:
                    lone.parent.remove_widget(lone)
                screen.add_widget(lone)
            lone.size_hint = (None, None)
            lone.width, lone.pos = beside.width, (beside.x, beside.y)

    # what is shown

    def show_draft(self) -> None:
        """Take over the draft and how it stands to what the robot has."""
        mission = self._session.mission
        count, state = len(mission.draft.points), mission.state
        points = trn("{count} point", "{count} points", count)
        self._send.words = (
            tr("Change the patrol: {points}").format(points=points)
            if self._patrols
            else tr("Send {points}").format(points=points)
            if count
            else tr("Remove its points")
            if self._removes
            else tr("Send points")
        )
        self._send.calls = self._patrols
        note, role = tr(STATES[state][0]), STATES[state][1]
        if state == "draft" and not count and not self._removes:
            note, role = tr(STATES["empty"][0]), "muted"
            if mission.draft.home is not None:
                note = tr("Home is drawn, not on the robot yet. Choose Points, then tap the map.")
        if state == "draft" and mission.failed:
            note, role = mission.outcome, "danger"
        elif state != "empty" and self.refused:
            note, role = self.refused, "danger"
        self._send.note, self._send.role = note, role
        icons = {"stored": "check_circle", "sent": "schedule", "empty": "info"}
        self._send.icon = "block" if self.refused and note == self.refused else icons.get(state, "edit")
        self.motion.show(mission.draft.message())

    @property
    def _removes(self) -> bool:
        """The robot has points and none are drawn: they can be taken from it, and nothing else be sent."""
        mission = self._session.mission
        return bool(not mission.draft.points and mission.stored is not None and mission.stored.points)

    @property
    def _patrols(self) -> bool:
        """The robot goes round points just now, and takes over others at the next one."""
        status: TaskStatus | None = self._session.feeds.latest("/task/status")
        mission = self._session.mission.draft
        return (
            bool(mission.points) and self._session.running and status is not None and status.task == "patrol"
        )

    def _show_status(self, status: TaskStatus) -> None:
        self.show_draft()
        if not self._session.running:
            self._progress.value = math.nan
            self.next.value = self.left.value = math.nan
        lap = status.lap if status.task == "patrol" else 0  # the way home has neither laps nor points
        self.lap.words = f"{lap}" if lap else ""
        self.lap.unit = tr("of {laps}").format(laps=status.laps) if status.laps and lap else ""
        of_lap = self._progress.of_lap = is_lap_only(status) and self._session.running
        self.left.name = tr("Lap ends in") if of_lap else tr("Time left")
        # the robot's own sentence stands under the buttons
        going = [figures_words(status, None), phase_words(status.phase) if self._session.running else ""]
        self._progress.where = " · ".join(filter(None, going)) or status.reason or tr("No task runs.")

    def _show_progress(self, progress: TaskProgress) -> None:
        if self._session.running:
            self._progress.value = progress.progress
            status = self._session.feeds.latest("/task/status")
            points = status is not None and status.task not in POINTLESS
            self.next.value = progress.distance_to_next if points else math.nan
            self.left.value = progress.time_left

    def tick(self) -> None:
        """Bring up to date what time changes."""
        session = self._session
        self._reorder()
        if not session.connected:
            self._progress.where = tr("What runs is not known without a link.")
        mine = session.may_ask
        tasks, missions = session.robot.offers("/task/start"), session.robot.offers("/mission/set")
        self.tasks.state = "live" if mine and tasks else "disabled"
        if not tasks:
            self.tasks.reason = tr(NO_TASKS)
        self.tasks.empty = not session.mission.draft.points
        self.tasks.ready = not (self.tasks.empty or self.refused)
        self.tasks.held = session.robot_stop.latched
        something = bool(session.mission.draft.points) or self._removes
        self._send.may_send = int(mine and missions and something and session.mission.state == "draft")
        if not missions:
            self._send.note = tr(NO_MISSIONS)
            self._send.role, self._send.icon = "muted", "block"
        state = session.feeds.state("/task/status")
        for readout in (self.next, self.lap, self.left):
            readout.state = state
            readout.age = session.feeds.age("/task/status")
        now = session.link.robot_time()
        if math.isfinite(now) and not abs(now - self.events.now) < 1.0:
            self.events.now = now
        self.events.state = "live" if session.connected else "stale"
        self._latest.show(self.events)
