"""Task that a hand on the stick paused, and Resume: letting go of the stick does not resume it.

card = PausedCard(client_id="a1b2")
robot.on("/task/status", card.show)
card.bind(on_command=lambda _, name: commands.ask(name))
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import TaskOrder, TaskStatus
from widgets.core.language import mark, tr
from widgets.core.task_words import title
from widgets.status.notice_card import NoticeCard

__all__ = ["PausedCard"]


OWN_WORDS: Mapping[str, str] = {
    Code.TASK_TAKEN_OVER: mark("You took the stick."),
    Code.TASK_STOPPED: mark("You pressed STOP."),
    Code.TASK_PAUSED: mark("You paused."),
    Code.TASK_STAYS: mark("You told it to stay. Resume lets it go on."),
}
"""Codes of what this handheld did, to what the card says."""
WORDS: Mapping[str, str] = {
    Code.TASK_TAKEN_OVER: mark("{name} took the stick."),
    Code.TASK_STAYS: mark("{name} told it to stay. Resume lets it go on."),
    Code.TASK_LINK_LOST: mark("The link to {name} was lost."),
    Code.TASK_BUMPED: mark("The bumper touched something."),
    Code.TASK_HELD_FAST: mark("The wheels turn, but something holds the robot."),
    Code.TASK_INTRUDER: mark("Intruder {id} was found."),
    Code.TASK_OVERTURNED: mark("{robot} has turned over."),
}
"""Codes of what others did or what happened; of any other code the card says the robot's own reason."""


class PausedCard(NoticeCard):
    """Open while the task is paused, until it is closed. Dispatches `on_command("resume" or "close")`."""

    accepts = (TaskStatus,)

    client_id = StringProperty("")
    """Of this handheld, by which the robot knows it."""
    held = BooleanProperty(False)
    """The stick is pushed: nothing can be resumed under it."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(icon="pause_fill", role="warn", **kwargs)
        self.resume = self.add_beside(tr("Resume"), "play_arrow")
        self.resume.bind(on_release=lambda _: self.dispatch("on_command", "resume"))
        self.cross = self.add_close()
        for name in ("held", "blocked"):
            self.fbind(name, self._block)
        self._block()

    def show(self, msg: TaskStatus) -> None:
        """Take over whether it is paused, and why."""
        self.open = msg.state == "PAUSED"
        if not self.open:
            return
        order = TaskOrder(task=msg.task, places=list(msg.places))
        self.headline = tr("{title} is paused").format(title=title(order))
        if msg.code == Code.TASK_STAYS and msg.place:
            self.headline = tr("Stays at {place}, charging").format(place=msg.place)
        self.said = self._words(msg)
        self.resume.meaning = self.headline

    def _words(self, msg: TaskStatus) -> str:
        """Why it is paused, shorter than the robot says it: that it is paused stands above."""
        mine = self.client_id and msg.actor_id == self.client_id
        words = tr((OWN_WORDS if mine else WORDS).get(msg.code, ""))
        try:
            return (
                words.format_map({pair.key: pair.value for pair in msg.parameters}) if words else msg.reason
            )
        except KeyError:  # another program's robot leaves out what its code should name
            return msg.reason

    def _block(self, *_: object) -> None:
        self.resume.disabled = self.held or self.blocked


def samples() -> dict[str, Callable[[], Widget]]:
    """Paused by us, with the stick still pushed, by another, and told to stay where it charges."""
    paused = TaskStatus(
        task="patrol",
        state="PAUSED",
        reason="Paused: tablet-A took the stick.",
        code=Code.TASK_TAKEN_OVER.value,
        actor_id="a",
        parameters=[KeyValue("name", "tablet-A")],
    )

    staying = TaskStatus(
        task="patrol", state="PAUSED", code=Code.TASK_STAYS.value, actor_id="a", place="Charging dock"
    )

    def make(status: TaskStatus = paused, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            card = PausedCard(size_hint_x=None, width="420dp", **kwargs)
            card.show(status)
            return card

        return build

    return {
        "by us": make(client_id="a"),
        "stick pushed": make(client_id="a", held=True),
        "by another": make(blocked=True),
        "stays and charges": make(staying, client_id="a"),
    }
