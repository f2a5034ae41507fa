"""Speed that the link's latency leaves to the driver, and the switch for that limit.

cap = SpeedCap()
robot.on("/control/status", cap.show)
cap.bind(on_command=lambda _, value: robot.set_option("follow_link", value))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.core.language import tr
from widgets.status.notice_card import NoticeCard

__all__ = ["SLOW_RTT", "SpeedCap"]

SLOW_RTT = 0.2
"""From this round trip on the robot goes slower [s]."""
MAX_SHOWN_CAP = 0.99
"""A cap above this share is not noticeable, and would be shown as `100 %`."""
CRAWL_RTT, CRAWL_SHARE = 0.4, 0.15
"""From this round trip on it goes no slower [s], at this share of its speed; as docs/bridge.md has it."""


class SpeedCap(NoticeCard):
    """Open while the speed is capped, or would not be on a slow link. Dispatches `on_command("on" or "off")`."""

    accepts = (ControlStatus,)

    share = NumericProperty(1.0)
    """Of the full speed, 0 to 1."""
    follows = BooleanProperty(True)
    """The speed follows the link."""
    rtt = NumericProperty(math.nan)
    """Round trip of this handheld's link [s]; NaN while it is not known."""
    driver = StringProperty("")
    """Name of the driver where that is another operator: it is their link then; empty for this handheld."""
    sent = BooleanProperty(False)
    """The switch is under way."""

    def _why(self) -> str:
        if self.driver:
            return tr("Slow link of {driver}").format(driver=self.driver)
        if math.isnan(self.rtt):
            return tr("Slow link")
        figure = f"{self.rtt * 1000:.0f} ms"
        return (
            tr("Slow link, {figure}").format(figure=figure)
            if self.rtt >= SLOW_RTT
            else tr("The robot measured {measured} a moment ago").format(measured=self.measured)
        )

    why = AliasProperty(_why, bind=["rtt", "driver", "share"], cache=True)
    """As in `Slow link, 320 ms`, without a figure before there is one; where it is fast here, what the robot measured, which judges."""

    @property
    def measured(self) -> str:
        """The round trip that such a share comes from, as in `320 ms`."""
        part = 1.0 - (self.share - CRAWL_SHARE) / (1.0 - CRAWL_SHARE)
        figure = f"{(SLOW_RTT + min(1.0, max(0.0, part)) * (CRAWL_RTT - SLOW_RTT)) * 1000:.0f} ms"
        return tr("{figure} or more").format(figure=figure) if part >= 1.0 else figure

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(icon="speed", role="warn", **kwargs)
        self.switch = self.add_beside(tr("Full speed"), "link_off")
        self.switch.bind(on_release=lambda _: self.press())
        for name in ("share", "follows", "why", "blocked", "sent"):
            self.fbind(name, self._write)
        self._write()

    def show(self, msg: ControlStatus) -> None:
        """Take over how fast the link lets it go."""
        if msg.follows_link != self.follows:
            self.sent = False
        self.share, self.follows = msg.speed_cap, msg.follows_link
        self.open = self.share < MAX_SHOWN_CAP or not self.follows

    def press(self) -> None:
        """Switch it as a finger would; shown as switched when the robot says so."""
        self.sent = True
        self.dispatch("on_command", "off" if self.follows else "on")

    def answer(self, outcome: str) -> None:
        """What became of the switch: `sent`, `accepted`, `refused` or `no_reply`; all but the first end the wait."""
        self.sent = outcome == "sent"

    def _write(self, *_: object) -> None:
        if self.follows and self.share >= MAX_SHOWN_CAP:
            return  # it is about to go, and goes as it was
        if self.follows:
            self.headline, self.said = (
                tr("{share:.0f} % speed").format(share=self.share * 100),
                f"{self.why}.",
            )
        else:
            self.headline = tr("Full speed always")
            self.said = (
                f"{self.why}." if self.rtt >= SLOW_RTT and not self.driver else tr("On a slow link as well.")
            )
        self.relabel(*((tr("Full speed"), "link_off") if self.follows else (tr("Follow link"), "link")))
        self.switch.meaning = self.switch.text
        self.switch.disabled = self.blocked or self.sent


def samples() -> dict[str, Callable[[], Widget]]:
    """A slow link of ours and of another's, switched off, under way."""

    def make(status: ControlStatus, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            cap = SpeedCap(size_hint_x=None, width="420dp", **kwargs)
            cap.show(status)
            return cap

        return build

    slow, off = ControlStatus(speed_cap=0.4), ControlStatus(follows_link=False)
    return {
        "slow": make(slow, rtt=0.32),
        "slow for the robot": make(slow, rtt=0.063),
        "another's": make(slow, driver="Anna", blocked=True),
        "off": make(off, rtt=0.012),
        "off and slow": make(off, rtt=0.32),
        "under way": make(slow, rtt=0.32, sent=True),
    }
