"""Single figure of a robot: its name, the value big, the unit small.

speed = Readout(name="Speed", unit="m/s", path="twist.twist.linear.x")
robot.on("/odom", speed.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    DictProperty,
    NumericProperty,
    OptionProperty,
    StringProperty,
)
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from widgets.core.base import RobotWidget, age_text, fitting_size, line_height, text_texture
from widgets.core.field_paths import value_at
from widgets.core.language import DASH, figure
from widgets.core.quantities import SI_KINDS, digits_for, quantities, to_shown, unit_of
from widgets.core.theme import theme
from widgets.fields.field_kinds import ENUM, NUMBER, TEXT
from widgets.parts.labels import heading_fits, heading_look, spaced

__all__ = ["Readout", "ReadoutGrid", "clock_figure"]

DEGREE = "°"
LEAST_SHARE = 0.45
"""No smaller than in this part of its sizes a figure is written where it is low."""
MAX_WORDS = 40
"""Letters of a text that are shown."""

Builder.load_string("""
<Readout>:
    orientation: 'vertical'
    size_hint: None, None
    width: max(heading.texture_size[0], row.width) if self.fitted else self.width
    height: heading.height + row.height + dp(1)
    spacing: dp(1)
    SectionLabel:
        id: heading
        title: root.heading
        text_size: (None, None) if root.fitted else (self.width, None)
        width: self.texture_size[0] if root.fitted else self.width
        size_hint_x: None if root.fitted else 1
        role: 'danger' if root.state == 'alarm' else 'muted'
        look: root.headed[1:]
    BoxLayout:
        id: row
        size_hint: None, None
        size: self.minimum_size
        spacing: dp(5)
        ValueUnit:
            value: root.text
            unit: root.unit_after
            role: root.role
            font_size: root.font_size * root.lowered
            unit_size: max(sp(13), root.font_size * .56) * root.lowered
            room: 0 if root.fitted else max(root.width - aged.width - warning.width - 2 * row.spacing, dp(20))
        Label:
            id: aged
            text: root.aged
            font_name: theme.font
            font_size: sp(12)
            color: theme.muted
            disabled_color: self.color
            size_hint: None, None
            size: (self.texture_size if root.aged else (0, 0))
            pos_hint: {'center_y': .5}
        Icon:
            id: warning
            name: 'warning'
            role: 'danger'
            font_size: root.font_size * root.lowered * .8
            width: self.font_size if root.state == 'alarm' else 0
            opacity: 1 if root.state == 'alarm' else 0
            pos_hint: {'center_y': .5}
""")


def clock_figure(seconds: float) -> str:
    """A length of time [s] as minutes and seconds, from an hour on as hours and minutes; a dash for NaN."""
    if not math.isfinite(seconds):
        return DASH
    whole = max(0, round(seconds))
    return f"{whole // 60}:{whole % 60:02d}" if whole < 3600 else f"{whole // 3600}:{whole // 60 % 60:02d}"


class ReadoutGrid(GridLayout):
    """Figures in columns and rows; each is as high as its row, in smaller type where that is low."""

    def do_layout(self, *args: Any) -> None:
        """Tell each how high it may be."""
        rows = math.ceil(len(self.children) / (self.cols or 1)) or 1
        left = self.height - self.padding[1] - self.padding[3] - self.spacing[1] * (rows - 1)
        for child in self.children:
            child.high = max(left / rows, 1.0)
        super().do_layout(*args)


class Readout(RobotWidget, BoxLayout):
    """A name over a value with its unit. `path` says where in a message the value is."""

    accepts = (Msg,)
    shows_fields: ClassVar = (NUMBER, ENUM, TEXT)
    grid_size: ClassVar = (2, 2)
    veiled = False

    name = StringProperty("")
    brief_name = StringProperty("")
    """Its name where there is no room for the other one; empty for none."""
    value = NumericProperty(math.nan)
    """In `unit` after `scale`; NaN is drawn as a dash."""
    unit = StringProperty("")
    """What `value` is in. What is in m, m/s or another unit of `SI_KINDS` is shown in the unit that the operator chose."""
    decimals = NumericProperty(1)
    signed = BooleanProperty(False)
    """A plus before what is above 0."""
    plus = StringProperty("")
    """Said behind a value above 0 in the place of the unit, as in `28° port`; empty for a sign."""
    minus = StringProperty("")
    """The same of one below 0, which has no sign then."""
    kind = OptionProperty("number", options=["number", "clock"])
    """`clock` shows a `value` [s] as minutes and seconds."""
    words = StringProperty("")
    """Shown instead of `value` when not empty."""
    path = StringProperty("")
    """Field of the message, as in `twist.twist.linear.x` or `ranges[3]`; a number picks from a list, and several of a vector's letters, as in
    `twist.twist.linear.xy`, are how long it is in those directions."""
    scale = NumericProperty(1.0)
    """What the field is multiplied by, as in 57.2958 from radian to degree."""
    value_names: DictProperty[int, str] = DictProperty()
    """Of a field whose values have names: what is shown for each; a value without one is shown as a number."""
    font_size = NumericProperty("26sp")
    """Of the value [px]."""
    fitted = BooleanProperty(True)
    """As wide as its words; else the width is given, and the name is cut short where it must be."""
    high = NumericProperty(0.0)
    """How high it may be [px]: its type is smaller where it would be higher; 0 for any height."""
    system = StringProperty("metric")
    """The operator's units, as in `quantities.system`, which it follows."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        quantities.bind(system=self._follow_units)
        self._follow_units()

    def _text(self) -> str:
        if self.state == "never":
            return DASH
        if self.words:
            return self.words
        if self.kind == "clock":
            return clock_figure(self.value)
        value, decimals = self._told()
        text = figure(abs(value) if self.plus and self.minus else value, decimals, signed=self.signed)
        return text + DEGREE if self.unit == DEGREE and text != DASH else text

    text = AliasProperty(
        _text,
        bind=["state", "value", "words", "kind", "decimals", "signed", "unit", "plus", "minus", "system"],
        cache=True,
    )
    """The figure as written."""

    def _told(self) -> tuple[float, int]:
        """The value in the unit that is shown, and with how many decimals."""
        kind = SI_KINDS.get(self.unit, "")
        if not kind:
            return self.value, int(self.decimals)
        return to_shown(self.value, kind), digits_for(kind, int(self.decimals))

    def _follow_units(self, *_: object) -> None:
        self.system = quantities.system

    def _unit_after(self) -> str:
        unit = "" if self.unit == DEGREE else self.unit
        unit = unit_of(SI_KINDS[unit]) if unit in SI_KINDS else unit
        if not (self.plus and self.minus):
            return unit
        told = figure(*self._told()) if self.state != "never" else DASH
        some = any(digit in told for digit in "123456789")
        return f"{unit} {self.plus if self.value > 0 else self.minus}".strip() if some else unit

    unit_after = AliasProperty(
        _unit_after, bind=["unit", "plus", "minus", "value", "decimals", "state", "system"], cache=True
    )
    """The unit where it stands apart from the figure, and to which side; a degree sign belongs to the figure."""

    def _lowered(self) -> float:
        whole = (theme.size_label + self.font_size) * line_height() + self.spacing + dp(1)
        return max(LEAST_SHARE, min(1.0, self.high / whole)) if self.high else 1.0

    lowered = AliasProperty(_lowered, bind=["high", "font_size", "spacing"], cache=True)
    """Part of its sizes of type that it is written in, so that it is not too high, 0 to 1."""

    def _headed(self) -> tuple[str, float, bool]:
        old = age_text(self.age) if self.state == "stale" else ""
        if not old:
            return self._named()
        whole, brief = f"{self.name} · {old}", f"{self.name} {old.removesuffix(' old')}"
        if self.fitted or self._wide(whole) <= self.width:
            return whole, theme.size_label, False
        size = fitting_size([spaced(brief)], theme.size_label, self.width - dp(2))
        if self._wide(brief, size) <= self.width:
            return brief, size, False
        return self._named()

    def _named(self) -> tuple[str, float, bool]:
        if self.fitted:
            return self.name, theme.size_label, False
        room = self.width - dp(2)
        name = self.brief_name if self.brief_name and not heading_fits(self.name, room) else self.name
        return name, *heading_look(name, room, theme.size_label * self.lowered)

    def _wide(self, heading: str, size: float | None = None) -> float:
        return float(text_texture(spaced(heading), size or theme.size_label, theme.font).width)

    headed = AliasProperty(
        _headed, bind=["name", "state", "age", "fitted", "width", "lowered", "brief_name"], cache=True
    )
    """The name, and the age of the value where that must be shown and there is room for both; the size of its type [px], and whether its letters stand close."""

    def _heading(self) -> str:
        return self.headed[0]

    heading = AliasProperty(_heading, bind=["headed"], cache=True)
    """As in `headed`."""

    def _aged(self) -> str:
        return (
            age_text(self.age).removesuffix(" old")
            if self.state == "stale" and self.heading in (self.name, self.brief_name)
            else ""
        )

    aged = AliasProperty(_aged, bind=["state", "age", "heading", "name"], cache=True)
    """How old the value is where the name leaves no room for that: it stands behind the unit."""

    def _role(self) -> str:
        return {"live": "text", "alarm": "danger"}.get(self.state, "muted")

    role = AliasProperty(_role, bind=["state"], cache=True)
    """Role of the figure's colour."""

    def show(self, msg: Msg) -> None:
        """Take the field at `path`, a number or a text; AttributeError or IndexError when the message has no such field."""
        found = value_at(msg, self.path)
        if isinstance(found, str):
            self.words = found[:MAX_WORDS].strip() or DASH
            return
        if self.value_names:
            self.words = self.value_names.get(found, "")
        self.value = (math.nan if found is None else float(found)) * self.scale


def samples() -> dict[str, Callable[[], Widget]]:
    """Every state, and every way of writing a value."""

    def speed(**kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            readout = Readout(name="Speed", unit="m/s", decimals=2, path="linear.x", **kwargs)
            if readout.state != "never":
                readout.show(Twist.planar(0.624, 0.0))
            return readout

        return build

    return {
        "never": speed(),
        "live": speed(state="live"),
        "stale": speed(state="stale", age=3.2),
        "alarm": speed(state="alarm"),
        "disabled": speed(state="disabled"),
        "signed": lambda: Readout(name="Steer", unit="°", value=-12.0, decimals=0, state="live"),
        "to a side": lambda: Readout(
            name="Rudder", unit="°", value=-12.0, decimals=0, plus="port", minus="stbd", state="live"
        ),
        "clock": lambda: Readout(name="ETA", unit="min", value=190.0, kind="clock", state="live"),
        "words": lambda: Readout(name="Lap", words="2", unit="of 5", state="live"),
        "large": lambda: Readout(name="Next WP", value=7.4, unit="m", font_size="40sp", state="live"),
    }
