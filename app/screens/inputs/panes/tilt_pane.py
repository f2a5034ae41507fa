"""The pane of the tilt: a circle to try it on, what the sensor delivers, and neutral, dead zone and full command."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from kivy.lang import Builder
from kivy.properties import ObjectProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.inputs.motion.tilt import RANGES
from app.inputs.motion.tilt_input import TiltInput
from app.inputs.motion.tilt_sensor import MIN_RATE
from widgets import TiltCircle
from widgets.core.language import mark, tr
from widgets.parts.kit import Card, Column, ListRow, Remark, Roll, Stepper, Text, Toggle

__all__ = ["TiltPane"]


class Amount(NamedTuple):
    """One figure that may be set."""

    icon: str
    title: str
    detail: str
    step: float
    unit: str = "°"
    scale: float = 1.0
    """Shown is the value times this."""


AMOUNTS = {
    "full": Amount(
        "speed", mark("Full command"), mark("Tilted so far it drives as fast as the slider lets it."), 1
    ),
    "dead": Amount("pause_circle", mark("Dead zone, standing"), mark("Tilted less it does nothing."), 1),
    "walking_dead": Amount(
        "pause_circle", mark("Dead zone, walking"), mark("A walking hand sways by more."), 1
    ),
    "expo": Amount(
        "timeline", mark("Flat in the middle"), mark("More of it steers finer near neutral."), 10, "%", 100
    ),
}
SWITCHES = {
    "fixed": ("my_location", mark("Neutral as it is held now"), ""),
    "walking": (
        "route",
        mark("I walk while I steer"),
        mark("A larger dead zone, and neutral slowly follows the hand."),
    ),
    "invert_pitch": (
        "swap_vert",
        mark("Ahead is towards me"),
        mark("Tilting the upper edge up drives ahead."),
    ),
    "invert_roll": (
        "arrow_forward",
        mark("Left and right exchanged"),
        mark("Tilting the right side down goes to the left."),
    ),
    "others": (
        "sports_esports",
        mark("Offer it for every robot"),
        mark("A choice beside the stick where the robot has no tilt circle."),
    ),
    "simulate": (
        "computer",
        mark("Simulate a tablet"),
        mark("The arrow keys lean it while the circle is held."),
    ),
}
"""Name to icon, title and what it does while it is on."""
FREE = mark("Off: neutral is however it is held when the clutch closes.")
FIXED = mark("Neutral stays as it was set; it drives once it has been there.")

Builder.load_string("""
<TiltPane>:
    orientation: 'vertical'

<TrialCard>:
    orientation: 'horizontal'
    size_hint_y: None
    height: dp(232)
    padding: dp(12)
    spacing: dp(12)
""")


class TrialCard(Card):
    """The circle to try it on, and beside it how it stands."""


class TiltPane(BoxLayout):
    """Made by the inputs screen. The circle in it drives nothing."""

    app = ObjectProperty()

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.tilting: TiltInput = self.app.methods.get("tilt")
        """The method that is set up here."""
        self.circle = TiltCircle(title=tr("Tilt"), needs_hold=True, in_shares=True, state="disabled")
        self.circle.size_hint_x = None
        self.circle.bind(height=self.circle.setter("width"))
        self.lean = Text(bold=True, font_size="22sp")
        self.says, self.sensor = Remark(font_size="15sp"), Remark(font_size="13sp")
        self.steppers: dict[str, Stepper] = {}
        self.toggles: dict[str, Toggle] = {}
        self._rows: dict[str, ListRow] = {}
        self._column = Column(spacing="8dp")
        self._fill()
        roll = Roll()
        roll.add_widget(self._column)
        self.add_widget(roll)

    def _fill(self) -> None:
        trial, words = TrialCard(), Column(spacing="8dp", pos_hint={"center_y": 0.5})
        for widget in (self.lean, self.says, self.sensor):
            words.add_widget(widget)
        trial.add_widget(self.circle)
        trial.add_widget(words)
        self._column.add_widget(trial)
        for name in AMOUNTS:
            self._column.add_widget(self._amount(name))
        for name in SWITCHES:
            self._rows[name] = self._switch(name)
            self._column.add_widget(self._rows[name])

    def _amount(self, name: str) -> Widget:
        amount, (low, high) = AMOUNTS[name], RANGES[name]
        row = ListRow(icon=amount.icon, title=tr(amount.title), detail=tr(amount.detail), whole=True)
        stepper = self.steppers[name] = Stepper(
            minimum=low * amount.scale, maximum=high * amount.scale, step=amount.step, unit=amount.unit
        )
        stepper.pos_hint = {"center_y": 0.5}
        stepper.bind(on_change=lambda _, value: self._set(name, value / amount.scale))
        row.add_widget(stepper)
        return row

    def _switch(self, name: str) -> ListRow:
        icon, title, detail = SWITCHES[name]
        row = ListRow(icon=icon, title=tr(title), detail=tr(detail), whole=True)
        toggle = self.toggles[name] = Toggle(pos_hint={"center_y": 0.5})
        toggle.bind(on_change=lambda _, on: self._set(name, on))
        row.bind(on_release=lambda _: self._set(name, not toggle.active))
        row.add_widget(toggle)
        return row

    # what a finger asks for

    def _set(self, name: str, value: Any) -> None:
        if name == "others":
            self.tilting.change_others(value)
        elif name == "fixed":
            self.tilting.set_neutral(fixed=value)
        elif name == "simulate":
            self.tilting.simulate(on=value)
        else:
            self.tilting.change(**{name: value})
        self.tick()

    # what the screen calls

    def enter(self) -> None:
        """Come onto the glass: the tablet leads the circle here and nothing else."""
        self.tilting.lend(self.circle)
        self.tick()

    def leave(self) -> None:
        """Leave it: the tablet leads what drives again."""
        self.tilting.lend(None)

    def rest(self) -> None:
        """The finger lets go."""
        self.circle.rest()

    def tick(self) -> None:
        """Bring up to date how it stands."""
        tilting, settings = self.tilting, self.tilting.settings
        self.circle.missing = tilting.fault
        self.circle.state = "live" if tilting.on and not tilting.fault else "disabled"
        for name, amount in AMOUNTS.items():
            self.steppers[name].value = round(getattr(settings, name) * amount.scale, 3)
        values = settings.save() | {
            "others": tilting.others,
            "simulate": tilting.simulated,
            "fixed": tilting.tilt.neutral is not None,
        }
        for name, toggle in self.toggles.items():
            toggle.active = bool(values[name])
            self._rows[name].role = "accent" if toggle.active else "muted"
        self._offer_simulated(possible=tilting.can_simulate)
        self._tell_neutral()
        self._tell()

    def _offer_simulated(self, *, possible: bool) -> None:
        row = self._rows["simulate"]
        if possible != (row.parent is self._column):
            (self._column.add_widget if possible else self._column.remove_widget)(row)

    def _tell_neutral(self) -> None:
        tilt = self.tilting.tilt
        row, fixed = self._rows["fixed"], tilt.neutral is not None
        row.detail = tr(FIXED if fixed else FREE)
        row.disabled = self.toggles["fixed"].disabled = not fixed and tilt.up is None

    def _tell(self) -> None:
        tilting = self.tilting
        roll, pitch = tilting.tilt.tilt
        closed = tilting.tilt.closed
        ahead = tr("ahead") if pitch > 0 else tr("back", context="way")
        right = tr("right") if roll > 0 else tr("left")
        self.lean.text = f"{abs(pitch):.0f}° {ahead}\n{abs(roll):.0f}° {right}" if closed else tr("Not held")
        if not tilting.on:
            self.says.text = tr("Switch tilting on to try it here.")
        else:
            self.says.text = tilting.tilt.why or ("" if tilting.problem else self._how())
        self.says.role = "warn" if tilting.tilt.why else "muted"
        self.sensor.text, self.sensor.role = self._sensor(tilting)

    def _how(self) -> str:
        keys = self.app.inputs.mapped.keys.keys_of("hold.tilt")
        key = tr(", or the key {keys},").format(keys=keys[0].upper()) if keys else ""
        return tr("Hold the circle{key} and tilt. This one drives nothing.").format(key=key)

    def _sensor(self, tilting: TiltInput) -> tuple[str, str]:
        """What the sensor delivers, and the role of that."""
        if tilting.problem:
            return tilting.problem, "warn"
        sensing = self.app.sensing
        kind = "gravity" if sensing.has("gravity") else "acceleration"
        rate = sensing.health(kind, MIN_RATE).rate
        name = (
            "simulated"
            if tilting.simulated
            else tr("fused gravity")
            if kind == "gravity"
            else tr("accelerometer alone: it sways when you walk")
        )
        return ("" if math.isnan(rate) else tr("{rate:.0f} Hz, {name}").format(rate=rate, name=name)), "muted"
