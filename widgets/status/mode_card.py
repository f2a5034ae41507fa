"""Choice of who steers: a person or the robot's task. Two large buttons; the active one is marked.

card = ModeCard()
robot.on("/control/status", card.show)
card.bind(on_command=lambda _, mode: robot.set_mode(mode))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.core.language import tr
from widgets.status.notice_card import NoticeCard

__all__ = ["ModeCard"]


class ModeCard(NoticeCard):
    """Dispatches `on_command("MANUAL" or "AUTO")`, or `on_command("close")`."""

    accepts = (ControlStatus,)

    mode = StringProperty("MANUAL")
    """As the robot says it: MANUAL, AUTO, PAUSED or STOPPED."""
    who = StringProperty("you")
    """Who has control: `you`, a name, or empty for nobody."""
    task = StringProperty("")
    """What it does in AUTO, as in `patrol`; empty while it has no task."""
    why_not = StringProperty("")
    """Why it cannot be changed now, as one sentence; empty when it can."""
    sent = StringProperty("")
    """The mode that was asked for and not yet answered; empty for none."""
    ready = BooleanProperty(False)
    """There is a task to go on with."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(icon="sports_esports", **kwargs)
        self.cross = self.add_close()
        self.manual, self.auto = self.add_below(
            (tr("MANUAL"), "sports_esports", False), (tr("AUTO"), "autorenew", False)
        )
        self.manual.bind(on_release=lambda _: self.choose("MANUAL"))
        self.auto.bind(on_release=lambda _: self.choose("AUTO"))
        for name in ("mode", "who", "task", "why_not", "sent", "ready", "tiny"):
            self.fbind(name, self._write)
        self._write()

    def show(self, msg: ControlStatus) -> None:
        """Take over the mode."""
        self.mode = msg.mode

    def choose(self, mode: str) -> None:
        """Ask for a mode as a finger would; it is marked when the robot says so. The one in force needs no asking."""
        if (mode == "AUTO") == (self.mode == "AUTO"):
            self.dispatch("on_command", "close")
            return
        self.sent = mode
        self.dispatch("on_command", mode)

    def answer(self, outcome: str, reason: str = "") -> None:
        """What became of it: `sent`, `accepted`, `refused` or `no_reply`, and the robot's sentence."""
        if outcome == "accepted":
            self.open = False
        if outcome != "sent":
            self.sent = ""

    def _write(self, *_: object) -> None:
        automatic = self.mode == "AUTO"
        self.role = "plan" if automatic else "accent"
        self.icon = "autorenew" if automatic else "sports_esports"
        sentence = self._sentence()
        self.headline, self.said = (sentence, "") if self.tiny else (tr("Who steers?"), sentence)
        driven = not automatic and bool(self.who)
        for button, chosen in ((self.manual, driven), (self.auto, automatic)):
            button.fill, button.border = (self.role, self.role) if chosen else ("raised", "line")
            button.ink = f"ink_{self.role}" if chosen else "text"
            button.disabled = not chosen and bool(self.why_not or self.sent)
        self.manual.disabled = self.manual.disabled or not (automatic or driven)
        self.auto.disabled = self.auto.disabled or not (automatic or self.ready)
        self.manual.meaning = self.auto.meaning = self.mode

    def _sentence(self) -> str:
        if self.sent:
            return tr("Requesting {sent} …").format(sent=self.sent)
        if self.why_not:
            return self.why_not
        if self.mode == "AUTO":
            return (
                tr("MANUAL pauses: {task}.").format(task=self.task) if self.task else tr("MANUAL pauses it.")
            )
        driver = {"you": tr("You are driving."), "": tr("Nobody drives.")}.get(
            self.who, tr("{name} is driving.").format(name=self.who)
        )
        if self.ready:
            if not self.task:
                return tr("{driver} AUTO continues the task.").format(driver=driver)
            return tr("{driver} AUTO continues: {task}.").format(driver=driver, task=self.task)
        return tr("{driver} Start a task to switch to AUTO.").format(driver=driver)


def samples() -> dict[str, Callable[[], Widget]]:
    """Driven by hand with and without a task that waits, by nobody, on a task, asked for, not to be changed."""

    def make(mode: str, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            card = ModeCard(size_hint_x=None, width="420dp", **kwargs)
            card.show(ControlStatus(mode=mode))
            return card

        return build

    return {
        "manual": make("MANUAL"),
        "nobody drives": make("MANUAL", who=""),
        "paused": make("PAUSED", task="patrol", ready=True),
        "auto": make("AUTO", task="patrol", ready=True),
        "asked for": make("PAUSED", task="patrol", ready=True, sent="AUTO"),
        "blocked": make("AUTO", task="patrol", ready=True, why_not="Anna has control."),
    }
