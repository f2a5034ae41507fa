"""Rows of an order's form for numbers: how fast, how high, for how long."""

from __future__ import annotations

import math
from collections.abc import Callable

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout

from widgets.core.language import tr
from widgets.parts.stepper import Stepper
from widgets.tasks.order_draft import OrderDraft

__all__ = ["NUMBERS", "FormRow"]

DEFAULT_MAX_SPEED = 1.0
"""Greatest speed of a robot that does not report its own [m/s]."""
MAX_HEIGHT = 30.0
"""Height and depth that can be asked for [m]; what the robot itself allows it says."""

Builder.load_string("""
<FormRow>:
    size_hint_y: None
    height: max(theme.target, dp(46))
    spacing: dp(8)
    Text:
        text: root.title
        pos_hint: {'center_y': .5}
""")


class FormRow(BoxLayout):
    """A name with something to set behind it."""

    title = StringProperty("")


def _row(name: str, stepper: Stepper) -> FormRow:
    row = FormRow(title=name)
    stepper.pos_hint = {"center_y": 0.5}
    row.add_widget(stepper)
    return row


def _speed(draft: OrderDraft) -> FormRow:
    most = max(1, math.floor((draft.robot.max_speed or DEFAULT_MAX_SPEED) * 10 + 1e-6)) / 10
    value = 0.0 if math.isnan(draft.speed) else draft.speed
    speed = Stepper(value=value, step=0.1, maximum=most, kind="speed", zero="default")

    def changed(stepper: Stepper, value: float) -> None:
        stepper.value = round(value, 4)  # tenths have no exact binary form
        draft.set(speed=stepper.value or math.nan)

    speed.bind(on_change=changed)
    return _row(tr("Speed"), speed)


def _throttle(draft: OrderDraft) -> FormRow:
    share = 0 if math.isnan(draft.throttle) else round(draft.throttle * 100)
    throttle = Stepper(value=share, step=10, maximum=100, unit="%", zero="default")
    throttle.bind(on_change=lambda _, value: draft.set(throttle=value / 100 if value else math.nan))
    return _row(tr("Throttle"), throttle)


def _height(draft: OrderDraft) -> FormRow:
    deep = draft.robot.dives
    value = 0 if math.isnan(draft.at_height) else abs(draft.at_height)
    usual = "default" if draft.task == "take_off" else tr("as now")
    height = Stepper(value=value, step=0.5, maximum=MAX_HEIGHT, kind="height", zero=usual)
    sign = -1.0 if deep else 1.0
    height.bind(on_change=lambda _, value: draft.set(at_height=sign * value if value else math.nan))
    return _row(tr("Depth") if deep else tr("Height"), height)


def _duration(draft: OrderDraft) -> FormRow:
    minutes = 0 if math.isnan(draft.duration) else math.ceil(draft.duration / 60)
    span = Stepper(value=minutes, maximum=1440, unit="min", zero=tr("until stopped"))
    span.bind(on_change=lambda _, value: draft.set(duration=value * 60.0 if value else math.nan))
    return _row(tr("For how long"), span)


def _charge(draft: OrderDraft) -> FormRow:
    share = 0 if math.isnan(draft.charge_to) else round(draft.charge_to * 100)
    charge = Stepper(value=share, step=20, maximum=100, unit="%", zero=tr("as soon as it charges"))
    charge.bind(on_change=lambda _, value: draft.set(charge_to=value / 100 if value else math.nan))
    return _row(tr("Done at"), charge)


NUMBERS: dict[str, Callable[[OrderDraft], FormRow]] = {
    "speed": _speed,
    "throttle": _throttle,
    "height": _height,
    "duration": _duration,
    "charge": _charge,
}
"""Field of a task to what makes its row, which a finger changes the draft by."""
