"""Things to set: one of several, a number, on or off, how much."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.animation import Animation
from kivy.clock import Clock
from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    ListProperty,
    NumericProperty,
    StringProperty,
)
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.label import Label
from kivy.uix.textinput import TextInput
from kivy.uix.widget import Widget

import widgets.buttons  # noqa: F401 - its rules draw the icons
from widgets.labels import Icon
from widgets.theme import theme

__all__ = ["Fader", "Progress", "Segmented", "Stepper", "Toggle", "TextField"]

REPEAT_AFTER, REPEAT_EVERY = 0.45, 0.12
"""A held plus or minus goes on counting [s]."""

Builder.load_string("""
<Segmented>:
    size_hint_y: None
    height: max(dp(46), theme.target * .86)
    padding: theme.outline
    canvas.before:
        Color:
            rgba: theme.line
        SmoothRoundedRectangle:
            pos: self.pos
            size: self.size
            radius: [theme.corner]
        Color:
            rgba: theme.raised
        SmoothRoundedRectangle:
            pos: self.x + theme.outline, self.y + theme.outline
            size: self.width - 2 * theme.outline, self.height - 2 * theme.outline
            radius: [theme.corner - theme.outline]

<Segment>:
    font_name: theme.font
    font_size: root.text_size_px
    bold: self.chosen
    color: theme.ink_accent if self.chosen else theme.text
    halign: 'center'
    valign: 'middle'
    text_size: self.width - dp(6), self.height
    canvas.before:
        Color:
            rgba: theme.accent if self.chosen else (theme.text[:3] + [.12 if self.state == 'down' else 0])
        SmoothRoundedRectangle:
            pos: self.pos
            size: self.size
            radius: self.radii
        Color:
            rgba: theme.line if not self.first else (0, 0, 0, 0)
        Rectangle:
            pos: self.x - theme.outline / 2, self.y
            size: theme.outline, self.height

<Stepper>:
    size_hint: None, None
    height: max(dp(40), theme.target * .78)
    width: self.height * 2 + max(figures.texture_size[0], dp(44))
    canvas.before:
        Color:
            rgba: theme.line
        SmoothRoundedRectangle:
            pos: self.pos
            size: self.size
            radius: [self.height / 2]
        Color:
            rgba: theme.raised
        SmoothRoundedRectangle:
            pos: self.x + theme.outline, self.y + theme.outline
            size: self.width - 2 * theme.outline, self.height - 2 * theme.outline
            radius: [self.height / 2 - theme.outline]
    StepperEnd:
        step: -1
        name: 'remove'
        size: root.height, root.height
        role: 'text' if root.value > root.minimum and not root.disabled else 'faint'
        on_count: root.count(-1)
    Label:
        id: figures
        text: root.figures
        font_name: theme.font
        font_size: theme.size_body
        color: theme.faint if root.disabled else theme.text
        disabled_color: self.color
    StepperEnd:
        step: 1
        name: 'add'
        size: root.height, root.height
        role: 'text' if root.value < root.maximum and not root.disabled else 'faint'
        on_count: root.count(1)

<StepperEnd>:
    font_size: sp(22)
    canvas.before:
        Color:
            rgba: theme.text[:3] + [.14 if self.state == 'down' else 0]
        SmoothEllipse:
            pos: self.pos
            size: self.size

<Toggle>:
    size_hint: None, None
    size: dp(54), theme.target
    canvas:
        Color:
            rgba: theme.accent if self.active else theme.muted
        SmoothRoundedRectangle:
            pos: self.track_pos
            size: dp(54), dp(31)
            radius: [dp(15.5)]
        Color:
            rgba: theme.accent if self.active else theme.raised
        SmoothRoundedRectangle:
            pos: self.track_pos[0] + dp(1.5), self.track_pos[1] + dp(1.5)
            size: dp(51), dp(28)
            radius: [dp(14)]
        Color:
            rgba: theme.knob if self.active else theme.muted
        SmoothEllipse:
            pos: self.track_pos[0] + dp(3.5) + dp(23) * self.travel, self.track_pos[1] + dp(3.5)
            size: dp(24), dp(24)
        Color:
            rgba: theme.surface[:3] + [.62 if root.disabled else 0]
        SmoothRoundedRectangle:
            pos: self.track_pos
            size: dp(54), dp(31)
            radius: [dp(15.5)]

<Progress>:
    size_hint_y: None
    height: dp(10)
    canvas:
        Color:
            rgba: theme.line
        SmoothRoundedRectangle:
            pos: self.pos
            size: self.size
            radius: [self.height / 2]
        Color:
            rgba: theme.raised
        SmoothRoundedRectangle:
            pos: self.x + theme.outline, self.y + theme.outline
            size: self.width - 2 * theme.outline, self.height - 2 * theme.outline
            radius: [self.height / 2 - theme.outline]
        Color:
            rgba: theme.roles[root.role] if self.filled else (0, 0, 0, 0)
        SmoothRoundedRectangle:
            pos: self.pos
            size: max(self.filled, self.height), self.height
            radius: [self.height / 2]

<Fader>:
    size_hint_x: None
    width: max(dp(88), theme.target)
    canvas:
        Color:
            rgba: theme.line
        SmoothRoundedRectangle:
            pos: self.center_x - dp(6), self.low
            size: dp(12), self.high - self.low
            radius: [dp(6)]
        Color:
            rgba: theme.accent
        SmoothRoundedRectangle:
            pos: self.center_x - dp(6), self.low
            size: dp(12), max(self.knob_y - self.low, dp(12))
            radius: [dp(6)]
        SmoothEllipse:
            pos: self.center_x - dp(20), self.knob_y - dp(20)
            size: dp(40), dp(40)
        Color:
            rgba: theme.knob
        SmoothEllipse:
            pos: self.center_x - dp(17), self.knob_y - dp(17)
            size: dp(34), dp(34)

<-TextField>:
    multiline: False
    size_hint_y: None
    height: theme.target
    font_name: theme.font
    font_size: theme.size_body
    padding: dp(14), (self.height - self.line_height) / 2
    foreground_color: theme.text
    hint_text_color: theme.muted
    cursor_color: theme.accent
    cursor_width: dp(2)
    selection_color: theme.accent[:3] + [.35]
    canvas.before:
        Color:
            rgba: theme.danger if root.wrong else theme.accent if root.focus else theme.line
        SmoothRoundedRectangle:
            pos: self.pos
            size: self.size
            radius: [theme.corner]
        Color:
            rgba: theme.raised
        SmoothRoundedRectangle:
            pos: self.x + dp(1.5), self.y + dp(1.5)
            size: self.width - dp(3), self.height - dp(3)
            radius: [theme.corner - dp(1.5)]
        Color:
            rgba: self.cursor_color if self.focus and not self._cursor_blink else (0, 0, 0, 0)
        Rectangle:
            pos: self._cursor_visual_pos
            size: root.cursor_width, -self._cursor_visual_height
        Color:
            rgba: self.foreground_color if self.text else self.hint_text_color
""")


class Segment(ButtonBehavior, Label):
    """One of the choices of a `Segmented`."""

    chosen = BooleanProperty(False)
    first = BooleanProperty(False)
    """Has no line before it."""
    radii = ListProperty([0, 0, 0, 0])
    """Of its corners [px]: only the ends of the row are round."""
    text_size_px = NumericProperty("16sp")


class Segmented(BoxLayout):
    """One of a few choices, all in sight. `options` are `(value, words)` or just words."""

    __events__ = ("on_choose",)

    options = ListProperty()
    value = StringProperty("")
    """The chosen one; empty or unknown when none is."""
    font_size = NumericProperty("16sp")
    """Of the words [px]."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.bind(options=self._rebuild, value=self._mark, font_size=self._rebuild)
        theme.bind(corner=self._rebuild)
        self._rebuild()

    def _rebuild(self, *_: object) -> None:
        self.clear_widgets()
        pairs = [option if isinstance(option, list | tuple) else (option, option) for option in self.options]
        self._values = [value for value, _ in pairs]
        for index, (value, words) in enumerate(pairs):
            segment = Segment(text=words, first=index == 0, text_size_px=self.font_size)
            segment.radii = self._corners(index, len(pairs))
            segment.bind(on_release=lambda _, value=value: self.choose(value))
            self.add_widget(segment)
        self._mark()

    def _corners(self, index: int, count: int) -> list[float]:
        left = theme.corner - 1 if index == 0 else 0
        right = theme.corner - 1 if index == count - 1 else 0
        return [left, right, right, left]

    def _mark(self, *_: object) -> None:
        for value, segment in zip(self._values, reversed(self.children), strict=True):
            segment.chosen = value == self.value

    def choose(self, value: str) -> None:
        """Take `value` as a finger would, and say so when it was another one."""
        if value != self.value:
            self.value = value
            self.dispatch("on_choose", value)

    def on_choose(self, value: str) -> None:
        """A finger chose `value`."""


class StepperEnd(ButtonBehavior, Icon):
    """The plus or the minus of a stepper: counts when pressed, and on while held."""

    __events__ = ("on_count",)

    step = NumericProperty(1)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._repeat = Clock.create_trigger(self._again, REPEAT_EVERY, interval=True)
        self._held = Clock.create_trigger(lambda _: self._repeat(), REPEAT_AFTER)

    def _again(self, _: float) -> None:
        self.dispatch("on_count")

    def on_press(self) -> None:
        """Count once, and wait whether the finger stays."""
        self.dispatch("on_count")
        self._held()

    def on_state(self, _: object, state: str) -> None:
        """Stop counting when the finger has left."""
        if state == "normal":
            self._held.cancel()
            self._repeat.cancel()

    def on_count(self) -> None:
        """Once more."""


class Stepper(BoxLayout):
    """A number between two ends, changed step by step; dispatches `on_change`."""

    __events__ = ("on_change",)

    value = NumericProperty(0)
    minimum = NumericProperty(0)
    maximum = NumericProperty(99)
    step = NumericProperty(1)
    unit = StringProperty("")
    zero = StringProperty("")
    """What to say instead of 0, as in `until stopped`; empty says 0."""

    def _figures(self) -> str:
        if self.zero and self.value == 0:
            return self.zero
        return f"{self.value:g} {self.unit}".rstrip()

    figures = AliasProperty(_figures, bind=["value", "unit", "zero"], cache=True)

    def count(self, steps: int) -> None:
        """Go so many steps up or, below 0, down; stays between the ends."""
        wanted = max(self.minimum, min(self.maximum, self.value + steps * self.step))
        if wanted != self.value:
            self.value = wanted
            self.dispatch("on_change", wanted)

    def on_change(self, value: float) -> None:
        """A finger set `value`."""


class Toggle(ButtonBehavior, Widget):
    """On or off; dispatches `on_change`."""

    __events__ = ("on_change",)

    active = BooleanProperty(False)
    travel = NumericProperty(0.0)
    """Of the knob, 0 off to 1 on."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.travel = float(self.active)
        self.bind(active=self._move)

    def _track_pos(self) -> tuple[float, float]:
        return self.center_x - self.width / 2, self.center_y - dp(31) / 2

    track_pos = AliasProperty(_track_pos, bind=["pos", "size"])

    def _move(self, *_: object) -> None:
        Animation.cancel_all(self, "travel")
        Animation(travel=float(self.active), d=0.12, t="out_quad").start(self)

    def on_release(self) -> None:
        """Change over."""
        self.active = not self.active
        self.dispatch("on_change", self.active)

    def on_change(self, active: bool) -> None:
        """A finger switched it."""


class Progress(Widget):
    """How far something is."""

    value = NumericProperty(math.nan)
    """0 to 1; NaN when it is not known, drawn as an empty bar."""
    role = StringProperty("plan")
    """Role of the filled part."""

    def _filled(self) -> float:
        return 0.0 if math.isnan(self.value) else max(0.0, min(1.0, self.value)) * self.width

    filled = AliasProperty(_filled, bind=["value", "width"], cache=True)
    """Length of the filled part [px]."""


class Fader(Widget):
    """An upright slide for how much, such as the greatest speed; dispatches `on_change`."""

    __events__ = ("on_change",)

    value = NumericProperty(0.0)
    minimum = NumericProperty(0.0)
    maximum = NumericProperty(1.0)
    step = NumericProperty(0.0)
    """`value` is a multiple of this from `minimum`; 0 for any."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._finger: Any = None

    def _low(self) -> float:
        return self.y + dp(20)

    low = AliasProperty(_low, bind=["pos"], cache=True)
    """Where `minimum` lies [px]."""

    def _high(self) -> float:
        return self.top - dp(20)

    high = AliasProperty(_high, bind=["pos", "size"], cache=True)
    """Where `maximum` lies [px]."""

    def _normalized(self) -> float:
        span = self.maximum - self.minimum
        return max(0.0, min(1.0, (self.value - self.minimum) / span)) if span > 0 else 0.0

    value_normalized = AliasProperty(_normalized, bind=["value", "minimum", "maximum"], cache=True)
    """`value` from 0 (`minimum`) to 1 (`maximum`)."""

    def _knob_y(self) -> float:
        return self.low + self.value_normalized * (self.high - self.low)

    knob_y = AliasProperty(_knob_y, bind=["value_normalized", "low", "high"], cache=True)

    def _take(self, y: float) -> None:
        share = max(0.0, min(1.0, (y - self.low) / max(1.0, self.high - self.low)))
        value = self.minimum + share * (self.maximum - self.minimum)
        if self.step:
            value = min(self.maximum, self.minimum + round((value - self.minimum) / self.step) * self.step)
        if value != self.value:
            self.value = value
            self.dispatch("on_change", value)

    def on_touch_down(self, touch: Any) -> bool:
        """The knob comes to the finger."""
        if self.disabled or self._finger is not None or not self.collide_point(*touch.pos):
            return bool(super().on_touch_down(touch))
        touch.grab(self)
        self._finger = touch
        self._take(touch.y)
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """And follows it."""
        if touch.grab_current is self:
            self._take(touch.y)
            return True
        return bool(super().on_touch_move(touch))

    def on_touch_up(self, touch: Any) -> bool:
        """It stays where it was left."""
        if touch.grab_current is self:
            touch.ungrab(self)
            self._finger = None
            return True
        return bool(super().on_touch_up(touch))

    def on_change(self, value: float) -> None:
        """A finger set `value`."""


class TextField(TextInput):
    """A line to type into; `wrong` while what it says cannot be used."""

    wrong = BooleanProperty(False)


def samples() -> dict[str, Callable[[], Widget]]:
    """Each control in the states that it knows."""
    motions = [("loop", "Loop"), ("random", "Random"), ("intermittent", "Intermittent")]
    wide = {"size_hint_x": None, "width": "330dp"}
    return {
        "segmented": lambda: Segmented(options=motions, value="loop", **wide),
        "segmented last": lambda: Segmented(options=motions, value="intermittent", **wide),
        "stepper": lambda: Stepper(value=5, unit="s"),
        "stepper at its end": lambda: Stepper(value=0, unit="laps", zero="until stopped"),
        "switch on": lambda: Toggle(active=True),
        "switch off": Toggle,
        "switch disabled": lambda: Toggle(active=True, disabled=True),
        "progress": lambda: Progress(value=0.38, **wide),
        "progress unknown": lambda: Progress(**wide),
        "fader": lambda: Fader(value=0.6, size_hint_y=None, height="180dp"),
        "text field": lambda: TextField(hint_text="Address, as in 192.168.1.7", **wide),
        "text field wrong": lambda: TextField(text="10.0.0.300", wrong=True, **wide),
    }
