"""Battery: charge, time left, and whether that is enough.

battery = Battery()
robot.on("/battery_state", battery.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from bridge.msgs.sensor_msgs import BatteryState
from widgets.core.base import RobotWidget, age_text
from widgets.core.language import mark, tr
from widgets.core.theme import theme
from widgets.parts.labels import Chip

__all__ = ["Battery", "BatteryChip", "charge_role", "time_left_text"]

LOW, EMPTY = 0.4, 0.2
"""Shares of the charge below which the colour warns, and is danger."""

CHARGING, DEAD, FULL = 1, 3, 4
"""In BatteryState.power_supply_status: it takes charge, it is at a charger that gives none, it is full at the charger."""
AT_CHARGER = {CHARGING: mark("charging"), DEAD: mark("at the charger, no current"), FULL: mark("full")}
"""What that is in words."""

Builder.load_string("""
<Battery>:
    orientation: 'vertical'
    spacing: dp(4) if root.drawn else 0
    padding: dp(8) if root.drawn else 0
    Widget:
    BatteryCell:
        share: root.share
        role: root.role
        pos_hint: {'center_x': .5}
        size: (dp(74), dp(38)) if root.drawn else (0, 0)
        opacity: 1 if root.drawn else 0
    FittedLabel:
        text: root.text
        largest: min(theme.size_value, root.height / (1.25 if not root.worded else 2.2))
        room: max(root.width - dp(4), 1)
        lines: 1
        bold: True
        color: theme.roles['danger' if root.role == 'danger' else 'text']
        disabled_color: self.color
        size_hint_y: None
        height: self.texture_size[1]
    FittedLabel:
        text: root.sentence
        largest: sp(14)
        room: max(root.width - dp(4), 1)
        lines: 1
        color: theme.muted
        size_hint_y: None
        height: self.texture_size[1] if root.worded else 0
        opacity: 1 if root.worded else 0
    Widget:

<BatteryCell>:
    size_hint: None, None
    size: dp(74), dp(38)
    canvas:
        Rounded:
            rgba: theme.roles[root.role]
            pos: self.right - dp(5), self.center_y - dp(7)
            size: dp(5), dp(14)
            radius: [dp(2.5)]
        Rounded:
            rgba: theme.roles[root.role]
            pos: self.pos
            size: self.width - dp(7), self.height
            radius: [dp(7)]
        Rounded:
            rgba: theme.surface
            pos: self.x + dp(2.5), self.y + dp(2.5)
            size: self.width - dp(12), self.height - dp(5)
            radius: [dp(5)]
        Rounded:
            rgba: theme.roles[root.role] if root.filled else (0, 0, 0, 0)
            pos: self.x + dp(5), self.y + dp(5)
            size: root.filled, self.height - dp(10)
            radius: [dp(3)]
""")


def charge_role(share: float) -> str:
    """Role of a charge of `share`, 0 to 1: ok, warn below 0.4, danger below 0.2, muted for NaN."""
    if math.isnan(share):
        return "muted"
    return "danger" if share < EMPTY else "warn" if share < LOW else "ok"


def time_left_text(hours: float) -> str:
    """How long it still lasts [h], in words; empty for NaN."""
    if not math.isfinite(hours) or hours < 0:
        return ""
    minutes = round(hours * 60)
    if minutes < 60:
        return tr("about {minutes} min left").format(minutes=minutes)
    return tr("about {hours} h {minutes} min left").format(hours=minutes // 60, minutes=minutes % 60)


class BatteryCell(Widget):
    """The drawing of a cell that is `share` full."""

    share = NumericProperty(math.nan)
    """0 to 1; NaN is drawn empty."""
    role = StringProperty("muted")

    def _filled(self) -> float:
        share = 0.0 if math.isnan(self.share) else max(0.0, min(1.0, self.share))
        return max(share * (self.width - dp(17)), dp(6)) if share else 0.0

    filled = AliasProperty(_filled, bind=["share", "size"], cache=True)
    """Length of the filling [px]."""


class _Charge(RobotWidget):
    """What both drawings of the battery know."""

    accepts: ClassVar = (BatteryState,)
    grid_size: ClassVar = (2, 3)

    share = NumericProperty(math.nan)
    """0 empty to 1 full; NaN unknown."""
    hours_left = NumericProperty(math.nan)
    """At the present current [h]; NaN when charging or not measured."""
    charging = BooleanProperty(False)
    """It takes charge, or is full at the charger."""
    power = NumericProperty(0)
    """As BatteryState.power_supply_status has it; 0 unknown."""

    def _text(self) -> str:
        known = self.state != "never" and math.isfinite(self.share)
        return f"{max(0.0, min(1.0, self.share)) * 100:.0f} %" if known else "—"

    text = AliasProperty(_text, bind=["share", "state"], cache=True)

    def _role(self) -> str:
        return "muted" if self.state in {"never", "stale"} else charge_role(self.share)

    role = AliasProperty(_role, bind=["share", "state"], cache=True)
    """Role of its colour."""

    def _sentence(self) -> str:
        if self.state in {"never", "stale"}:
            return tr("no data yet") if self.state == "never" else ""
        words = AT_CHARGER.get(int(self.power), "")
        return tr(words) if words else time_left_text(self.hours_left) or tr("battery")

    sentence = AliasProperty(_sentence, bind=["state", "power", "hours_left"], cache=True)

    def show(self, msg: BatteryState) -> None:
        """Take over charge, current and whether it is being charged."""
        self.share = msg.percentage
        self.power = msg.power_supply_status
        self.charging = self.power in (CHARGING, FULL)
        draining = math.isfinite(msg.current) and msg.current < 0
        self.hours_left = msg.charge / -msg.current if draining and not self.charging else math.nan


class Battery(_Charge, BoxLayout):
    """The battery as a card of a dashboard; a low one leaves out the drawing, a lower one the words too."""

    def _worded(self) -> bool:
        return bool(self.height >= theme.size_value * 1.3 + sp(14) * 1.3)

    worded = AliasProperty(_worded, bind=["height"], cache=True)
    """It has room for words below the figure."""

    def _drawn(self) -> bool:
        return bool(self.height >= theme.size_value * 1.3 + sp(14) * 1.3 + dp(38 + 2 * 8 + 2 * 4))

    drawn = AliasProperty(_drawn, bind=["height"], cache=True)
    """It has room for the drawing, too."""


def _room_of(*, brief: bool) -> tuple[str, float]:
    """Words that a chip has room for, and how far they are from its ends [px]."""
    return ("288 ms", dp(7)) if brief else ("100 %", dp(13))


class BatteryChip(_Charge, BoxLayout):
    """The battery as a chip for a bar. With `brief` it is as narrow as can be."""

    veiled = False
    brief = BooleanProperty(False)
    largest = NumericProperty("15sp")
    """Size of its type where it is high enough [px]."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(size_hint=(None, None), height=dp(34), **kwargs)
        self._chip = Chip()
        self._chip.bind(width=self.setter("width"))
        self.add_widget(self._chip)
        for name in ("text", "role", "charging", "brief", "state", "age", "largest"):
            self.fbind(name, self._write)
        self._write()

    def width_as(self, *, brief: bool, high: float, largest: float) -> float:
        """How wide it would be [px] if it were so, `high` and in type of `largest` [px]."""
        usual, edge = _room_of(brief=brief)
        return self._chip.width_with(self._said(brief=brief), usual, edge=edge, high=high, largest=largest)

    def _said(self, *, brief: bool) -> str:
        old = age_text(self.age) if self.state == "stale" and not brief else ""
        return f"{self.text} · {old}" if old else self.text

    def _write(self, *_: object) -> None:
        self._chip.text, self._chip.largest = self._said(brief=self.brief), self.largest
        self._chip.tinted = self.state == "stale"
        self._chip.usual, self._chip.edge = _room_of(brief=self.brief)
        self._chip.role = self.role
        alarming = self.role == "danger" and not self.charging
        self._chip.icon = (
            "battery_charging_full" if self.charging else "battery_alert" if alarming else "battery_full"
        )
        self.width = self._chip.width


def samples() -> dict[str, Callable[[], Widget]]:
    """Every state, and a battery that is full, low, nearly empty and charging."""

    def make(
        share: float, kind: type[_Charge] = Battery, status: int = 2, **kwargs: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            box = {"size_hint": (None, None), "size": ("230dp", "150dp")} if kind is Battery else {}
            widget = kind(**{"state": "live", **box, **kwargs})
            if widget.state != "never":
                widget.show(
                    BatteryState(
                        percentage=share, charge=share * 3.0, current=-1.2, power_supply_status=status
                    )
                )
            return widget

        return build

    return {
        "never": make(math.nan, state="never"),
        "live": make(0.87),
        "stale": make(0.87, state="stale", age=12.0),
        "alarm": make(0.08, state="alarm"),
        "disabled": make(0.87, state="disabled"),
        "low": make(0.34),
        "charging": make(0.55, status=CHARGING),
        "full": make(1.0, status=FULL),
        "dead charger": make(0.2, status=DEAD),
        "chip charging": make(0.55, BatteryChip, status=CHARGING),
        "chip": make(0.87, BatteryChip),
        "chip brief": make(0.87, BatteryChip, brief=True),
        "chip low": make(0.34, BatteryChip),
        "chip empty": make(0.12, BatteryChip),
        "chip stale": make(0.87, BatteryChip, state="stale", age=12.0),
        "chip never": make(math.nan, BatteryChip, state="never"),
    }
