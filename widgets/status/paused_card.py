"""Task that a hand on the stick paused, and Resume: letting go of the stick does not resume it.

card = PausedCard(name="tablet-A")
robot.on("/task/status", card.show)
card.bind(on_command=lambda _, name: commands.ask(name))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import TaskOrder, TaskStatus
from widgets.core.task_words import title
from widgets.status.notice_card import NoticeCard

__all__ = ["PausedCard"]


class PausedCard(NoticeCard):
    """Open while the task is paused, until it is closed. Dispatches `on_command("resume" or "close")`."""

    accepts = (TaskStatus,)

    name = StringProperty("")
    """What the robot calls this handheld in its sentences; empty while that is not known."""
    held = BooleanProperty(False)
    """The stick is pushed: nothing can be resumed under it."""

    def __init__(self, **kwargs: Any) -> None:
        self._why = ""
        super().__init__(icon="pause_fill", role="warn", **kwargs)
        self.fbind("name", self._update)
        self.resume = self.add_beside("Resume", "play_arrow")
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
        self.headline = f"{title(TaskOrder(task=msg.task, places=list(msg.places)))} is paused"
        self._why = msg.reason.removeprefix("Paused: ")
        self._update()
        self.resume.meaning = self.headline

    def _update(self, *_: object) -> None:
        mine = {
            f"{self.name} took the stick.": "You took the stick.",
            f"Stopped by {self.name}.": "You pressed STOP.",
        }
        self.said = mine.get(self._why, self._why) if self.name else self._why

    def _block(self, *_: object) -> None:
        self.resume.disabled = self.held or self.blocked


def samples() -> dict[str, Callable[[], Widget]]:
    """Paused by us, with the stick still pushed, and by another."""
    paused = TaskStatus(task="patrol", state="PAUSED", reason="Paused: tablet-A took the stick.")

    def make(**kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            card = PausedCard(size_hint_x=None, width="420dp", **kwargs)
            card.show(paused)
            return card

        return build

    return {
        "by us": make(name="tablet-A"),
        "stick pushed": make(name="tablet-A", held=True),
        "by another": make(blocked=True),
    }
