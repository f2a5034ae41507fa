"""Link to the robot in one chip: round trip, lost answers, and a word when it is down.

link = LinkQuality()
link.rtt, link.lost, link.state = client.rtt, client.lost, "live"
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from widgets.core.base import RobotWidget
from widgets.core.language import figure, tr, trn
from widgets.parts.labels import Chip

__all__ = ["LinkQuality", "quality"]

SLOW, BAD = 0.1, 0.3
"""Round trips from which on driving by sight is hard, and is no longer safe [s]."""

LOSSY, BROKEN = 2, 6
"""Lost answers of the last 20 that mean the same."""

LOOKS = {
    "good": ("signal_wifi_4_bar", "ok"),
    "fair": ("network_wifi_2_bar", "warn"),
    "bad": ("network_wifi_1_bar", "danger"),
    "silent": ("network_wifi_1_bar", "warn"),
    "lost": ("signal_disconnected", "danger"),
    "unknown": ("signal_wifi_0_bar", "muted"),
}
"""Quality to icon and role."""


def quality(rtt: float, lost: int) -> str:
    """`good`, `fair`, `bad` or, for a round trip of NaN, `unknown`; `rtt` [s], `lost` of the last 20 answers."""
    if math.isnan(rtt):
        return "unknown"
    if rtt >= BAD or lost >= BROKEN:
        return "bad"
    return "fair" if rtt >= SLOW or lost >= LOSSY else "good"


def _with_lost(milliseconds: str, lost: int) -> str:
    """The round trip, and how many answers were lost."""
    return f"{milliseconds} · {trn('{count} lost', '{count} lost', lost)}"


def _usual(*, brief: bool) -> str:
    return "288 ms" if brief else _with_lost("288 ms", 0)


def _edge(*, tight: bool) -> float:
    return float(dp(7) if tight else dp(13))


class LinkQuality(RobotWidget, BoxLayout):
    """A chip with the state of the link. It has no topic: the app assigns what its client measures."""

    veiled = False

    rtt = NumericProperty(math.nan)
    """Round trip [s]; NaN until measured."""
    lost = NumericProperty(0)
    """Unanswered of the last 20 pings."""
    silence = NumericProperty(0.0)
    """How long nothing has come at all, where that is longer than usual [s]; else 0."""
    sentence = StringProperty("")
    """Said instead of figures while there is no link, as in `no heartbeat for 6 s`."""
    brief = BooleanProperty(False)
    """Leaves the lost ones away where there is no room."""

    tight = BooleanProperty(False)
    """Its words stand close to its ends."""
    largest = NumericProperty("15sp")
    """Size of its type where it is high enough [px]."""

    def _quality(self) -> str:
        if self.state == "never":
            return "unknown"
        if self.sentence:
            return "lost"
        return "silent" if self.silence else quality(self.rtt, int(self.lost))

    quality = AliasProperty(_quality, bind=["rtt", "lost", "silence", "sentence", "state"], cache=True)
    """`good`, `fair`, `bad`, `silent`, `lost` or `unknown`."""

    def _text(self) -> str:
        return self._said(brief=self.brief)

    def _said(self, *, brief: bool) -> str:
        if self.sentence:
            return self.sentence
        if self.quality == "unknown":
            return "—"
        if self.quality == "silent":
            return tr("silent {silence} s").format(silence=figure(self.silence, 1))
        milliseconds = f"{self.rtt * 1000:.0f} ms" if self.rtt < 1 else f"{figure(self.rtt, 1)} s"
        return milliseconds if brief else _with_lost(milliseconds, int(self.lost))

    text = AliasProperty(_text, bind=["quality", "rtt", "lost", "silence", "sentence", "brief"], cache=True)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(size_hint=(None, None), height=dp(34), **kwargs)
        self._chip = Chip()
        self._chip.bind(width=self.setter("width"))
        self.add_widget(self._chip)
        self.bind(quality=self._write, text=self._write, brief=self._write, tight=self._write)
        self.bind(largest=self._write)
        self._write()

    def width_as(self, *, brief: bool, tight: bool, high: float, largest: float) -> float:
        """How wide it would be [px] if it were so, `high` and in type of `largest` [px]."""
        words, usual, edge = self._said(brief=brief), _usual(brief=brief), _edge(tight=tight)
        return self._chip.width_with(words, usual, edge=edge, high=high, largest=largest)

    def _write(self, *_: object) -> None:
        self._chip.icon, self._chip.role = LOOKS[self.quality]
        self._chip.text = self.text
        self._chip.edge, self._chip.usual = _edge(tight=self.tight), _usual(brief=self.brief)
        self._chip.largest = self.largest
        self._chip.outlined = self.quality == "lost"
        self.width = self._chip.width


def samples() -> dict[str, Callable[[], Widget]]:
    """Each quality, brief, and without a link."""

    def make(**kwargs: Any) -> Callable[[], Widget]:
        return lambda: LinkQuality(**{"state": "live", **kwargs})

    return {
        "never": make(state="never"),
        "good": make(rtt=0.012),
        "fair": make(rtt=0.15, lost=1),
        "bad": make(rtt=0.42, lost=7),
        "silent": make(rtt=0.028, silence=1.5),
        "lost": make(rtt=0.012, sentence="no heartbeat for 6 s", state="alarm"),
        "brief": make(rtt=0.012, brief=True),
    }
