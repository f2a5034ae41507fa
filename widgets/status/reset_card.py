"""Reset of a robot to where it started: offered when something has gone wrong, done after a second press.

card = ResetCard(name="Aqua-1")
card.notify("Aqua-1 has sunk.")
card.bind(on_command=lambda _, name: name == "reset" and robot.reset())
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import Event
from widgets.core.language import mark, tr
from widgets.status.notice_card import NoticeCard

__all__ = ["ResetCard"]

WHAT = mark("Its task ends, and it stands still where it started.")
WHAT_FLIES = mark("Its task ends, and it stands on the ground where it started, rotors off.")


class ResetCard(NoticeCard):
    """Dispatches `on_command("reset")` once it is confirmed, and `on_command("close")` when it is left as it is."""

    accepts = (Event,)

    name = StringProperty(mark("the robot"))
    """What the robot is called."""
    flies = BooleanProperty(False)
    """It is one that flies."""
    mishap = StringProperty("")
    """What has gone wrong with it, as a sentence; empty when nothing has."""
    asked = BooleanProperty(False)
    """It was pressed once: the next press does it."""
    sent = BooleanProperty(False)
    """It is under way."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(role="danger", icon="replay", **kwargs)
        self.leave, self.go = self.add_below(
            (tr("Leave it"), "close", False), (tr("Put back"), "replay", False)
        )
        self.leave.bind(on_release=lambda _: self.close())
        self.go.bind(on_release=lambda _: self.press())
        for name in ("name", "flies", "mishap", "asked", "sent", "blocked"):
            self.fbind(name, self._write)
        self._write()

    def show(self, msg: Event) -> None:
        """Tell of a mishap; of an event that is no alarm nothing."""
        if msg.level == "alarm":
            self.notify(msg.text)

    def notify(self, mishap: str) -> None:
        """Offer it, since something has gone wrong; what is being asked or done already is left as it stands."""
        busy = self.open and (self.asked or self.sent)
        self.mishap = mishap
        if not busy:
            self.asked, self.sent, self.open = False, False, True

    def ask(self) -> None:
        """Ask whether it shall be done."""
        self.mishap, self.asked, self.sent, self.open = "", True, False, True

    def press(self) -> None:
        """Press as a finger would: the first press asks, the second does it."""
        if not self.asked:
            self.asked = True
        elif not self.sent:
            self.sent = True
            self.dispatch("on_command", "reset")

    def close(self) -> None:
        """Leave the robot as it is."""
        self.open = False
        self.dispatch("on_command", "close")

    def answer(self, outcome: str) -> None:
        """What became of it: `sent`, `accepted`, `refused` or `no_reply`; after a refusal it can be pressed again."""
        self.sent = outcome == "sent"
        if outcome == "accepted":
            self.open = False

    def _write(self, *_: object) -> None:
        if self.asked:
            self.headline, self.said = (
                tr("Put {name} back to where it started?").format(name=self.name),
                tr(WHAT_FLIES) if self.flies else tr(WHAT),
            )
            self.go.text, self.leave.text = tr("Yes, put back"), tr("No")
        else:
            self.headline = self.mishap or self.name
            self.said = tr("It can be put back to where it started.")
            self.go.text, self.leave.text = tr("Put back"), tr("Leave it")
        self.go.text = tr("Putting back") if self.sent else self.go.text
        self.go.meaning = self.go.text
        grave = self.asked and not self.blocked
        self.go.fill, self.go.border = ("danger", "danger") if grave else ("raised", "line")
        self.go.ink = "ink_danger" if grave else "text"
        self.go.disabled = self.blocked or self.sent


def samples() -> dict[str, Callable[[], Widget]]:
    """After a mishap, asked, under way, while another steers, on a phone."""

    def make(width: str = "420dp", *, asks: bool = False, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            card = ResetCard(name="Aqua-1", size_hint_x=None, width=width)
            card.ask() if asks else card.notify("Aqua-1 has left tank.")
            for name, value in kwargs.items():
                setattr(card, name, value)
            return card

        return build

    return {
        "mishap": make(),
        "asked": make(asks=True),
        "under way": make(asks=True, sent=True),
        "another's": make(blocked=True),
        "phone": make("330dp", asks=True),
    }
