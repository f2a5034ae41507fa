"""One order being made: what, with what, and a sentence that says what will happen; for the schedule also when."""

from __future__ import annotations

from typing import Any

import msgspec
from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, ObjectProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

from app.missions.mission_editor import Draft
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import RobotInfo, ScheduledTask, TaskOrder, TaskStatus
from widgets import OrderForm, TaskChooser, WhenPicker
from widgets.core.language import mark, tr
from widgets.core.task_words import TASKS, known, rhythm, title
from widgets.parts.kit import IconButton, ListRow, Roll, Segmented

__all__ = ["OrderPane", "why_not_now"]

MIN_WORDED_HEIGHT = 136
"""Lower than this it has room for a row of tiles alone [dp]."""
EVENING = ScheduledTask(at="22:00")
"""What a new scheduled task begins with."""
UNSENT = mark(" The points on the map are sent to the robot first.")

Builder.load_string("""
<OrderPane>:
    orientation: 'vertical'
    spacing: dp(8)
    BoxLayout:
        id: head
        size_hint_y: None
        height: max(dp(53), theme.least) if root.titled else 0
        opacity: 1 if root.titled else 0
        spacing: dp(6)
        Text:
            text: root.title
            bold: True
            font_size: theme.size_title
            pos_hint: {'center_y': .5}
    BoxLayout:
        id: body
        orientation: 'vertical'
        spacing: dp(10)
    BoxLayout:
        size_hint_y: None
        height: max(dp(34), said.height + dp(8)) if root.worded else 0
        opacity: 1 if root.worded else 0
        spacing: dp(10)
        Icon:
            name: 'block' if root.refused else 'hourglass_top' if root.held_up else 'info' if root.complete else 'help'
            role: 'danger' if root.refused else 'warn' if root.held_up else 'plan' if root.complete else 'muted'
            pos_hint: {'center_y': .5}
        Text:
            id: said
            text: root.sentence or tr("Choose a task.")
            font_size: sp(15)
            role: 'text' if root.complete else 'muted'
            pos_hint: {'center_y': .5}
""")


def why_not_now(session: Session, *, timed: bool = False) -> str:
    """Why a whole order cannot be given just now, as a sentence; empty when it can, and of a `timed` one sooner."""
    if not session.connected:
        return tr("Not now: there is no link to the robot.")
    if session.control == "other":
        return tr("Not now: {name} has control; ask for it first.").format(
            name=session.authority.status.driver
        )
    status: TaskStatus | None = session.feeds.latest("/task/status")
    if timed:
        return ""
    if session.robot_stop.latched:
        return tr("Not now: STOP is pressed; hold it to release.")
    if session.running and status is not None:
        name = title(TaskOrder(task=status.task, places=list(status.places)))
        if status.state == "PAUSED":
            return tr("Not now: {task} is paused; end it, or queue this.").format(task=name)
        return tr("Not now: {task} runs; end it, or queue this.").format(task=name)
    if status is not None and status.state == "INTERRUPTED":
        return tr("Start discards the task that was cut short.")
    return ""


class OrderPane(BoxLayout):
    """What the operator is about to ask for. The buttons that give the order are elsewhere."""

    compact = BooleanProperty(False)
    """Once a task is chosen the others are away, and what and when are on two pages."""
    closable = BooleanProperty(False)
    """Has an arrow that goes back to the lists."""

    @property
    def chooses(self) -> bool:
        """No task is chosen yet: its tiles are shown."""
        return not self.form.task

    def _worded(self) -> bool:
        return bool(self.height >= dp(MIN_WORDED_HEIGHT) or not self.chooses)

    worded = AliasProperty(_worded, bind=["height", "sentence"], cache=True)
    """Says below what will happen; where it is that low it is the tiles that are needed."""

    titled = BooleanProperty(True)
    """Has its title over it."""
    scheduled = ObjectProperty(None, allownone=True)
    """The `ScheduledTask` that is being made; None for an order of now."""
    page = StringProperty("what")
    """`what` or `when`, where they are on two pages."""
    title = StringProperty("")
    sentence = StringProperty("")
    complete = BooleanProperty(False)
    refused = BooleanProperty(False)
    """The sentence says why the robot would not take it; it can be asked all the same."""
    held_up = BooleanProperty(False)
    """The sentence says what it has to wait for."""

    __events__ = ("on_close",)

    def _order(self) -> TaskOrder:
        return self.form.order

    order = AliasProperty(_order)
    """What is asked for so far."""

    def __init__(self, session: Session, **kwargs: Any) -> None:
        self._session = session
        self._shown: Draft | None = None
        self.chooser, self.form, self.when = TaskChooser(), OrderForm(), WhenPicker()
        self._chosen = ListRow(aside=tr("Change"))
        self._roll, self._tiles = Roll(), Roll()
        self._pages = Segmented(options=[("what", tr("What")), ("when", tr("When"))], value="what")
        self._back = IconButton(icon="arrow_back", bare=True, pos_hint={"center_y": 0.5})
        super().__init__(**kwargs)
        self._back.bind(on_release=lambda _: self.form.back() or self.dispatch("on_close"))
        self.chooser.bind(on_command=lambda _, task: self.begin(task))
        self._chosen.bind(on_release=lambda _: self.begin(""))
        self._pages.bind(on_choose=lambda _, page: setattr(self, "page", page))
        self.when.bind(on_command=lambda _, task: self._timed(task))
        self.form.bind(
            on_command=lambda *_: self.update_sentence(),
            on_react=lambda _, reaction: session.mission.set_motion(on_intruder=reaction),
            picking=self._lay,
        )
        self.bind(compact=self._lay, closable=self._lay, page=self._lay)
        self._lay()

    # what is being made

    def begin(self, task: str, places: tuple[str, ...] = ()) -> None:
        """Start anew with a task, or with none."""
        self.form.begin(task, places)
        self.chooser.chosen = task
        self.page = "what"
        self._lay()
        self.update_sentence()

    def now(self) -> None:
        """An order of now."""
        if self.scheduled is not None:
            self.scheduled = None
            self.begin("")
        self.title = tr("New task")

    def schedule(self, task: ScheduledTask | None = None) -> None:
        """Make a scheduled task, or change one."""
        self.scheduled = task or EVENING
        self.title = tr("On the schedule") if self.scheduled.id else tr("New on the schedule")
        self.when.show(self.scheduled)
        self.begin(self.scheduled.order.task)
        self.form.show(self.scheduled.order)
        self.update_sentence()

    def made(self) -> ScheduledTask:
        """The scheduled task as it stands, switched on."""
        return msgspec.structs.replace(self.when.task, order=self.order, enabled=True)

    def _timed(self, task: ScheduledTask) -> None:
        self.scheduled = task
        self.update_sentence()

    @property
    def unsent(self) -> bool:
        """It goes round the points on the map, and the robot does not have them yet."""
        order = self.order
        patrols = order.task == "patrol" and not order.places
        return patrols and self._session.mission.state == "draft"

    def back(self) -> bool:
        """One step back within the order; False when there is none."""
        if self.form.back():
            return True
        if self.compact and self.form.task:
            self.begin("")
            return True
        return False

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        self.form.dial.rest()

    # what is shown

    def meet(self, info: RobotInfo) -> None:
        """Offer what this robot knows, and ask for what it can do."""
        self.form.robot = info
        tasks = known(info)
        if list(self.chooser.tasks) != tasks:
            self.chooser.tasks = tasks

    def refresh(self) -> None:
        """Take over the mission when it was edited; call it often."""
        draft = self._session.mission.draft
        if draft is not self._shown:
            self._shown = draft
            self.form.show(draft.message())
        self.update_sentence()

    def update_sentence(self) -> None:
        """Say what will happen."""
        self.form.follows = self._session.feeds.latest("/following") is not None
        sentence, complete = self.form.sentence, self.form.complete
        if self.scheduled is not None and complete:
            days = not self.when.task.at or any(self.when.task.days)
            when = rhythm(self.when.task)
            sentence = f"{when[0].upper()}{when[1:]}: {sentence}" if days else tr("Choose at least one day.")
            complete = days
        if complete and self.unsent:
            sentence += tr(UNSENT)
        refused = self._session.refusals.order(self.order, self._session.mission.draft) if complete else ""
        why = why_not_now(self._session, timed=self.scheduled is not None) if complete else ""
        self.refused, self.held_up = bool(refused), bool(why)
        self.sentence, self.complete = f"{refused or sentence} {why}".strip(), complete

    def _lay(self, *_: object) -> None:
        head, body = self.ids.head.__self__, self.ids.body
        if self.closable != (self._back.parent is head):
            if self.closable:
                head.add_widget(self._back, index=len(head.children))
            else:
                head.remove_widget(self._back)
        body.clear_widgets()
        for widget in self._parts():
            body.add_widget(widget)

    def _parts(self) -> list[Any]:
        task, two = self.form.task, self.scheduled is not None
        words = TASKS.get(task)
        if words:
            self._chosen.icon, self._chosen.title, self._chosen.role = words.icon, words.name, "plan"
        self.chooser.told = not self.compact and not words
        if self.form.picking:
            return [self.form]
        if not self.compact:
            self._roll.clear_widgets()
            self._tiles.clear_widgets()
            return [self.chooser, self.form, *([self.when] if two else [])]
        if not words:  # what is said over the screen may leave room for a row of them alone
            if self.chooser.parent is not self._tiles:
                self._tiles.add_widget(self.chooser)
            return [self._tiles]
        if not two:
            return [self._chosen, self.form]
        self._pages.value = self.page
        if self.page == "when":
            if self._roll.children[:1] != [self.when]:
                if self.when.parent is not None:
                    self.when.parent.remove_widget(self.when)
                self._roll.add_widget(self.when)
            return [self._pages, self._roll]
        self._roll.clear_widgets()
        return [self._pages, self._chosen, self.form]

    def on_close(self) -> None:
        """A finger asked to go back to the lists."""
