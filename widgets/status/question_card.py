"""Question of the robot, large: one tap answers it; or a task that a restart cut short.

card = QuestionCard()
robot.on("/task/status", card.show)
card.bind(on_command=lambda _, name: commands.ask(name))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import AliasProperty, BooleanProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.buttons
import widgets.parts.column
import widgets.parts.labels  # noqa: F401 - their rules draw what is used here
from bridge.msgs.pilothouse_msgs import TaskOrder, TaskStatus
from widgets.core.base import Control
from widgets.core.language import tr
from widgets.core.surfaces import Outlined
from widgets.core.task_words import title

__all__ = ["QuestionCard"]

Builder.load_string("""
<QuestionCard>:
    orientation: 'vertical'
    size_hint_y: None
    height: self.minimum_height if root.open else 0
    padding: dp(16), dp(8) if root.tight else dp(14)
    spacing: dp(8) if root.tight else dp(12)
    rim: root.role
    ground: 'surface'
    corner: theme.radius
    rim_width: dp(2.5)
    BoxLayout:
        size_hint_y: None
        height: max(words.height, dp(34))
        spacing: dp(12)
        Icon:
            name: root.icon
            role: root.role
            font_size: sp(32)
            pos_hint: {'center_y': .5}
        Column:
            id: words
            spacing: dp(3)
            pos_hint: {'center_y': .5}
            Text:
                text: root.question
                bold: True
                role: 'muted' if root.old else 'text'
                font_size: sp(18) if root.tight else theme.size_title
            Remark:
                text: root.said
                role: root.said_role
                font_size: sp(14.5)
    BoxLayout:
        # not across the card: STOP is the largest thing to press
        size_hint: None, None
        width: min(root.width - dp(32), dp(180 if root.tight else 260) * (1.4 if root.cut else 1))
        pos_hint: {'center_x': .5}
        height: theme.target if root.tight else max(theme.target * 1.15, dp(60))
        spacing: dp(10) if root.cut else 0
        QuietButton:
            id: discard
            text: tr('Discard')
            icon: 'delete'
            height: self.parent.height
            size_hint_x: .8 if root.cut else None
            width: dp(120) if root.cut else 0
            opacity: 1 if root.cut else 0
            disabled: root.blocked or not root.cut
            on_release: root.ask('cancel')
        PrimaryButton:
            id: answer
            text: tr('Resume') if root.cut else tr('Yes, done')
            icon: 'play_arrow_fill' if root.cut else 'check'
            meaning: root.question
            height: self.parent.height
            disabled: root.blocked or (root.cut and root.held)
            on_release: root.ask('resume' if root.cut else 'confirm')
""")


class QuestionCard(Outlined, Control, BoxLayout):
    """Dispatches `on_command(name)`: `confirm`, or for a task that was cut short `resume` or `cancel`."""

    accepts = (TaskStatus,)
    veiled = False

    question = StringProperty("")
    """What is asked; empty while nothing is."""
    reason = StringProperty("")
    """What the robot says about it."""
    cut = BooleanProperty(False)
    """A task was cut short and is offered."""
    blocked = BooleanProperty(False)
    """An answer is not permitted here now, as while another drives or the link is down."""
    held = BooleanProperty(False)
    """STOP is pressed: nothing can be resumed."""
    why = StringProperty("")
    """What became of the answer, where it was not accepted, or why none can be given; empty for nothing."""

    tight = BooleanProperty(False)
    """There is little room."""
    old = StringProperty("")
    """How old it is, as in `8 s old`, where nothing is heard any more; empty while it is what the robot asks now."""

    def _open(self) -> bool:
        return bool(self.question)

    open = AliasProperty(_open, bind=["question"], cache=True)
    """There is something to answer."""

    def _role(self) -> str:
        return "muted" if self.old else "warn" if self.cut else "accent"

    role = AliasProperty(_role, bind=["cut", "old"], cache=True)

    def _icon(self) -> str:
        return "warning" if self.cut else "help"

    icon = AliasProperty(_icon, bind=["cut"], cache=True)

    def _sentence(self) -> str:
        if self.old:
            return tr("Asked before the link was lost; {age}.").format(age=self.old)
        return self.why or self.reason

    said = AliasProperty(_sentence, bind=["why", "reason", "old"], cache=True)

    def _said_role(self) -> str:
        return "danger" if self.why and not self.old else "muted"

    said_role = AliasProperty(_said_role, bind=["why", "old"], cache=True)

    def show(self, msg: TaskStatus) -> None:
        """Take over what the robot asks or offers; a new question forgets what became of the last answer."""
        cut = msg.state == "INTERRUPTED"
        what = title(TaskOrder(task=msg.task, places=list(msg.places)))
        question = tr("Continue? {what}").format(what=what) if cut else msg.asks
        if question != self.question:
            self.why = ""
        self.cut, self.reason, self.question = cut, msg.reason if question else "", question

    def ask(self, name: str) -> None:
        """Answer as a finger would."""
        self.why = ""
        self.dispatch("on_command", name)

    def answer(self, name: str, outcome: str, why: str = "") -> None:
        """Say what became of an answer: `sent`, `accepted`, `refused` (and why) or `no_reply`."""
        if outcome in ("refused", "no_reply"):
            self.why = why or tr("No reply to {name}.").format(name=name)


def samples() -> dict[str, Callable[[], Widget]]:
    """A question, one that was refused, a task that was cut short, one that cannot be answered here."""
    asks = TaskStatus(
        task="deliver",
        state="RUNNING",
        asks="Has it been picked up at Office 12?",
        reason="Waiting at Office 12: The parcel for Ms. Weber.",
    )
    cut = TaskStatus(
        task="deliver",
        state="INTERRUPTED",
        places=["Office 12", "Lab"],
        reason="The robot's computer restarted in the middle of a delivery; choose Resume to go on, or Discard.",
    )

    def make(status: TaskStatus, why: str = "", **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            card = QuestionCard(size_hint_x=None, width="420dp", **kwargs)
            card.show(status)
            card.why = why
            return card

        return build

    return {
        "asks": make(asks),
        "refused": make(asks, "The robot asks nothing just now."),
        "cut short": make(cut),
        "held": make(cut, held=True),
        "blocked": make(asks, blocked=True),
        "old": make(asks, blocked=True, old="8 s old"),
        "tight": make(asks, tight=True),
    }
