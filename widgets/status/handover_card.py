"""Request for control: the driver hands over or keeps it; who asks sees the time left and can withdraw.

card = HandoverCard(me=client_id)
robot.on("/control/status", card.show)
card.bind(on_command=lambda _, name: commands.ask(name))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.properties import AliasProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.core.language import tr
from widgets.status.notice_card import NoticeCard

__all__ = ["HandoverCard"]


class HandoverCard(NoticeCard):
    """Dispatches `on_command(name)`: `grant` or `object` from the driver, `take_back` from who asks."""

    accepts = (ControlStatus,)

    me = StringProperty("")
    """The `client_id` of this handheld."""
    asker = StringProperty("")
    """Name of the operator who asks; empty for none."""
    driver = StringProperty("")
    """Name of who is asked."""
    part = StringProperty("")
    """What this handheld has to do with it: `asked`, `asking`, or empty for nothing."""
    left = NumericProperty(math.nan)
    """Until control goes over [s]; NaN while that is not known."""
    sent = StringProperty("")
    """The answer that is under way, as dispatched; empty for none."""

    def _countdown(self) -> str:
        return f" · {math.ceil(self.left)}\u00a0s" if math.isfinite(self.left) else ""

    countdown = AliasProperty(_countdown, bind=["left"], cache=True)
    """As in ` · 8 s`; empty while it is not known."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(icon="person", role="warn", **kwargs)
        self.keep, self.hand_over = self.add_below(
            (tr("Keep control"), "lock", False), (tr("Hand over"), "arrow_forward", True)
        )
        (self.take_back,) = self.add_below((tr("Withdraw"), "close", False))
        self._rows = {"asked": self.keep.parent, "asking": self.take_back.parent}
        for button, name in ((self.keep, "object"), (self.hand_over, "grant"), (self.take_back, "take_back")):
            button.bind(on_release=lambda _, name=name: self.ask(name))
        for name in ("part", "asker", "driver", "countdown", "sent", "blocked", "tiny"):
            self.fbind(name, self._write)
        self._write()

    def show(self, msg: ControlStatus) -> None:
        """Take over who asks whom."""
        mine, asks = msg.driver_id == self.me, msg.requested_by_id == self.me
        part = "" if not msg.requested_by else "asked" if mine else "asking" if asks else ""
        if (part, msg.requested_by) != (self.part, self.asker):
            self.sent = ""
        self.part, self.asker, self.driver = part, msg.requested_by, msg.driver
        self.open = bool(part)

    def ask(self, name: str) -> None:
        """Answer as a finger would."""
        self.sent = name
        self.dispatch("on_command", name)

    def answer(self, outcome: str) -> None:
        """What became of the answer: `sent`, `accepted`, `refused` or `no_reply`; a failed one can be given again."""
        if outcome in ("refused", "no_reply"):
            self.sent = ""

    def _write(self, *_: object) -> None:
        if self.part == "asking":
            self.headline = tr("You asked {driver}{countdown}").format(
                driver=self.driver, countdown=self.countdown
            )
            self.said = tr("You get control unless {driver} keeps it.").format(driver=self.driver)
        else:
            self.headline = tr("{asker} asks for control{countdown}").format(
                asker=self.asker, countdown=self.countdown
            )
            self.said = tr("Without an answer, control is handed over.")
        if self.sent:
            self.said = tr("Sent …")
        elif self.tiny and self.part == "asking":
            self.said = ""
        for part, row in self._rows.items():
            if (part == self.part) != (row.parent is self):
                (self.add_widget if part == self.part else self.remove_widget)(row)
            for button in row.children:
                button.disabled = self.blocked or bool(self.sent)
                button.meaning = self.asker


def samples() -> dict[str, Callable[[], Widget]]:
    """The driver who is asked, with an answer under way, and who asks."""
    asks = ControlStatus(driver="Bob", driver_id="b", requested_by="Anna", requested_by_id="a")

    def make(me: str, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            card = HandoverCard(me=me, size_hint_x=None, width="420dp")
            card.show(asks)
            for name, value in kwargs.items():
                setattr(card, name, value)
            return card

        return build

    return {
        "asked": make("b", left=7.4),
        "answered": make("b", left=6.9, sent="grant"),
        "asking": make("a", left=7.4),
        "clock unknown": make("a"),
    }
