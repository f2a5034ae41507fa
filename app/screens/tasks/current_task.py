"""The task under way, its buttons, and the queue below it."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

from app.session.session import Session
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets import OrderQueue, TaskCard
from widgets.core.language import tr

__all__ = ["CurrentTask"]

Builder.load_string("""
<CurrentTask>:
    orientation: 'vertical'
    spacing: dp(8)
    BoxLayout:
        id: top
        size_hint_y: None
        height: self.minimum_height
    BoxLayout:
        id: does
        size_hint_y: None
        height: theme.target
        spacing: dp(8)
        PushButton:
            id: main
            text: root.main_words
            meaning: root.main
            icon: 'play_arrow_fill' if root.main in ('resume', 'confirm') else 'pause'
            fill: 'accent' if root.main in ('resume', 'confirm') else 'raised'
            border: 'accent' if root.main in ('resume', 'confirm') else 'line'
            ink: 'ink_accent' if root.main in ('resume', 'confirm') else 'text'
            disabled: not root.may or not root.main or (root.held and root.main == 'resume')
            on_release: root.ask(root.main)
        QuietButton:
            id: stay
            text: tr('Stay')
            icon: 'pause'
            disabled: not root.may
            on_release: root.ask('pause')
        QuietButton:
            id: end
            text: tr('End task')
            icon: 'stop'
            disabled: not root.may or not root.active
            on_release: root.ask('cancel')
    BoxLayout:
        id: next
        size_hint_y: None
        height: max(dp(44), theme.least)
        SectionLabel:
            title: tr('Next')
            pos_hint: {'center_y': .5}
        IconButton:
            id: undo
            icon: 'undo'
            bare: True
            disabled: not root.may_undo
            size: max(dp(48), theme.least), max(dp(44), theme.least)
            pos_hint: {'center_y': .5}
            on_release: root.undo()
    BoxLayout:
        id: rest
""")


class CurrentTask(BoxLayout):
    """The running task and the queue behind it."""

    may = BooleanProperty(False)
    """The robot can be asked for something from here."""
    held = BooleanProperty(False)
    """STOP is pressed."""
    active = BooleanProperty(False)
    """There is a task to end."""
    main = StringProperty("")
    """`pause`, `resume`, `confirm` to send on what charges, or nothing."""
    main_words = StringProperty("")
    may_undo = BooleanProperty(False)
    brief = BooleanProperty(False)
    """Takes little room."""

    def __init__(self, session: Session, **kwargs: Any) -> None:
        self._session = session
        self.card, self.queue = TaskCard(), OrderQueue()
        super().__init__(**kwargs)
        self.ids.top.add_widget(self.card)
        self.ids.rest.add_widget(self.queue)
        self.queue.bind(on_command=lambda _, what, index, target: self._edit(what, index, target))
        editor = session.tasking.queue
        editor.on_change = self._show_queue
        self._stay = self.ids.stay.__self__
        self._stay.parent.remove_widget(self._stay)
        self._next, self._undo = self.ids.next.__self__, self.ids.undo.__self__
        self.bind(brief=self._lay)
        self._show_queue()

    def _lay(self, *_: object) -> None:
        """Where there is little room, the undo stands beside what is done and has no row of its own."""
        self.card.brief = self.brief
        self._undo.parent.remove_widget(self._undo)
        (self.ids.does if self.brief else self._next).add_widget(self._undo)
        if self.brief == (self._next.parent is self):
            (self.remove_widget(self._next) if self.brief else self.add_widget(self._next, index=1))

    def ask(self, name: str) -> None:
        """Ask the robot as a finger would."""
        self._session.command(name)

    def undo(self) -> None:
        """Take the last edit of the queue back."""
        self._session.tasking.queue.undo()

    def _edit(self, what: str, index: int, target: int) -> None:
        editor = self._session.tasking.queue
        editor.remove(index) if what == "remove" else editor.move(index, target)

    def _show_queue(self) -> None:
        editor = self._session.tasking.queue
        self.queue.orders, self.queue.waits = list(editor.orders), editor.waits
        self.may_undo = editor.can_undo
        self.queue.held = editor.told.held if editor.told is not None else ""

    def _offer_stay(self, charges: bool) -> None:
        """A robot that charges can be sent on now, or told to stay."""
        if charges and self._stay.parent is None:
            self.ids.does.add_widget(self._stay, index=len(self.ids.does.children) - 1)
        elif not charges and self._stay.parent is not None:
            self.ids.does.remove_widget(self._stay)

    def tick(self, may: bool) -> None:
        """Bring up to date what can be done; `may` when it can be asked for from here."""
        session = self._session
        status: TaskStatus = session.feeds.latest("/task/status") or TaskStatus()
        self.may, self.held = may, session.robot_stop.latched
        self.active = status.state in ("RUNNING", "PAUSED", "INTERRUPTED")
        count = len(session.tasking.queue.orders)
        waiting = count > 0 and not self.active
        charges = status.state == "RUNNING" and status.phase == "charging"
        running = "confirm" if charges else "pause"
        self.main = {"RUNNING": running, "PAUSED": "resume", "INTERRUPTED": "resume"}.get(
            status.state, "resume" if waiting else ""
        )
        these = tr("Go on") if self.brief else tr("Go on with this") if count == 1 else tr("Go on with these")
        self._offer_stay(charges)
        self.main_words = {"pause": tr("Pause"), "": tr("Pause"), "confirm": tr("Go on now")}.get(
            self.main, these if waiting else tr("Resume")
        )
        self.queue.state = "live" if may else "disabled"
