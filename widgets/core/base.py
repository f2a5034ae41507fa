"""Base of every robot widget: a state with an appearance of its own, an age, and the message types it takes or sends.

class Altimeter(RobotWidget):
    accepts = (Range,)
    def show(self, msg): self.value = msg.range
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, ClassVar

from kivy.core.text import Label as CoreLabel
from kivy.core.text import LabelBase
from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, OptionProperty
from kivy.uix.widget import Widget

from bridge.msgs import Msg
from widgets.core.icons import icon
from widgets.core.language import tr
from widgets.core.theme import theme

__all__ = [
    "STATES",
    "Control",
    "RobotWidget",
    "age_text",
    "fitting_size",
    "least_size",
    "line_height",
    "text_texture",
]

STATES = ("never", "live", "stale", "alarm", "disabled")
VEIL = {"stale": 0.55, "disabled": 0.62}
"""State to how much of a widget is hidden in it, 0 to 1; in the others nothing is."""

MIN_ROOMY_HEIGHT = 240.0
"""What is higher has room in itself for its age [dp]."""
MAX_LETTERS = 200
"""Of a word that is drawn on a canvas; what fills a glass has fewer."""
MAX_SHORTENED = 500
"""Letters of a label that is cut short with dots where it has no room: how much that costs grows with their square."""
MAX_LABEL, MAX_LABEL_LINES = 20_000, 400
"""Letters and lines of any other label: what is longer has no texture on a phone."""
MIN_LINE, MEASURED_SIZE = 1.28, 50.0
"""Height of a line of type, in times of its size, at least; and the size in which one is measured [px]."""
MIN_FONT_SIZE = 10.0
"""No type is made smaller than this to fit [sp]; where text is enlarged, not smaller than as many dp."""

Builder.load_string("""
<RobotWidget>:
    canvas.after:
        Rounded:
            rgba: root.veil
            pos: root.veil_box[:2]
            size: root.veil_box[2:]
            radius: [root.veil_radius]
        Rounded:
            rgba: theme.raised if root.badge else (0, 0, 0, 0)
            pos: root.badge_pos
            size: root.badge_size
            radius: [root.badge_size[1] / 2]
        Outline:
            rgba: theme.muted if root.badge else (0, 0, 0, 0)
            rounded_rectangle: root.badge_pos + root.badge_size + (root.badge_size[1] / 2,)
            width: theme.outline
        Tinted:
            rgba: theme.text if root.badge else (0, 0, 0, 0)
            pos: root.badge_text_pos
            size: root.badge_size[0] - dp(16), root.badge_size[1] - dp(6)  # kv does not see a texture's size change
            texture: root.badge_texture
        Outline:
            rgba: theme.danger if root.alarmed else (0, 0, 0, 0)
            rounded_rectangle: root.pos + root.size + [root.veil_radius]
            width: dp(1.5)
        Tinted:
            rgba: theme.danger if root.alarmed else (0, 0, 0, 0)
            pos: root.right - root.alarm_texture.width - dp(6), root.top - root.alarm_texture.height - dp(6)
            size: root.alarm_texture.size
            texture: root.alarm_texture
""")


def age_text(age: float) -> str:
    """An age [s] in words, as in `3 s old`; empty for NaN."""
    if math.isnan(age):
        return ""
    if age < 60:
        return tr("{age:.0f} s old").format(age=age) if age >= 1 else tr("< 1 s old")
    if age < 3600:
        return tr("{age:.0f} min old").format(age=age / 60)
    return tr("{age:.0f} h old").format(age=age / 3600)


_textures: dict[tuple[str, str, float, bool], Texture] = {}


def text_texture(text: str, size: float, font: str = "", *, bold: bool = False) -> Texture:
    """`text` in white at `size` [px], to be tinted by a Color before it; drawn once and kept. `font` is the theme's where it is empty.

    Of a text longer than `MAX_LETTERS` its beginning: robots name things, and a texture of their whole length would be no texture.
    """
    font = font or theme.font
    if len(text) > MAX_LETTERS:
        text = f"{text[:MAX_LETTERS]}…"
    key = (text, font, size, bold)
    if key not in _textures:
        if len(_textures) > 2000:
            _textures.clear()
        label = CoreLabel(text=text or " ", font_size=size, font_name=font, bold=bold, color=(1, 1, 1, 1))
        label.refresh()
        _textures[key] = label.texture
    return _textures[key]


def bounded(text: str, most: int, lines: int) -> str:
    """So many letters and lines of it at most, with dots for the rest."""
    if len(text) > most:
        text = f"{text[:most]}…"
    parts = text.split("\n", lines)
    return "\n".join([*parts[:lines], "…"]) if len(parts) > lines else text


def _bound_labels() -> None:
    """Have Kivy draw no more of a text than fits any glass: a robot's word of some 100 kB would hold up fingers, and STOP, for minutes."""
    refresh = CoreLabel.refresh

    def within(label: Any) -> None:
        short = label.options.get("shorten")
        label._text = bounded(label._text, MAX_SHORTENED if short else MAX_LABEL, MAX_LABEL_LINES)  # noqa: SLF001
        refresh(label)

    within.bounded = True  # type: ignore[attr-defined]
    if not hasattr(refresh, "bounded"):
        LabelBase.refresh = within  # type: ignore[method-assign,assignment]


_bound_labels()


def line_height() -> float:
    """Height of a line of the theme's type, in times of its size: that of Chinese is higher than that of Latin letters."""
    return max(MIN_LINE, text_texture("Åg", MEASURED_SIZE).height / MEASURED_SIZE)


def least_size() -> float:
    """Least size of type [px]: enlarged text gives way down to what it would be at its usual size, before a word is cut."""
    return float(min(sp(MIN_FONT_SIZE), dp(MIN_FONT_SIZE)))


def fitting_size(texts: Iterable[str], size: float, room: float, *, bold: bool = False) -> float:
    """Size of type [px] at which the widest of `texts` fits into `room` [px]: `size`, or as much less as it takes."""
    widest = max((text_texture(text, size, theme.font, bold=bold).width for text in texts), default=0)
    return size if widest <= room else max(math.floor(size * room / widest * 2) / 2, least_size())


class RobotWidget(Widget):
    """A widget that shows messages. The dashboard sets `state` and `age`; `show(msg)` is the only other way in."""

    accepts: ClassVar[tuple[type[Msg], ...]] = ()
    """Types that `show` takes."""
    shown_beside: ClassVar[tuple[type[Msg], ...]] = ()
    """Of `accepts`, those that it only shows beside others: it is no picture of one of them alone."""
    draws: ClassVar[tuple[type[Msg], ...]] = ()
    """Types of pictures that it draws once somebody has decoded them."""
    shows_fields: ClassVar[tuple[str, ...]] = ()
    """Kinds of fields, as in `widgets.fields.field_kinds`, of which it shows one; empty for one that shows whole messages."""
    over_time: ClassVar[bool] = False
    """It shows a field over time."""
    specificity: ClassVar[float | None] = None
    """How much it is made for what it accepts, 0 to 1; None for the more, the fewer types that are."""
    grid_size: ClassVar[tuple[int, int]] = (3, 4)
    """Columns and rows that become it on a grid of 12 x 12 that fills a tablet."""

    veiled: ClassVar[bool] = True
    """The states are drawn here: a veil with the age on it, an outline. False for a widget that draws its own."""

    veils: ClassVar[Mapping[str, float]] = VEIL
    """State to how much the veil hides, 0 to 1; nothing in one that it does not name."""

    state = OptionProperty("never", options=STATES)
    """Never heard, live, stale, alarm or disabled: each has its own appearance."""
    age = NumericProperty(math.nan)
    """Of what is shown [s]; NaN before the first message."""
    says_age = BooleanProperty(True)
    """Shows its age; False where a widget beside it shows it for both."""
    veil_radius = NumericProperty("12dp")
    """Corners of the veil and of the alarm's outline [px]; half the width for a round widget."""

    def _veil_box(self) -> tuple[float, float, float, float]:
        rim = theme.outline  # half of an outline lies outside, and would show as a jagged line
        return self.x - rim, self.y - rim, self.width + 2 * rim, self.height + 2 * rim

    veil_box = AliasProperty(_veil_box, bind=["pos", "size"], cache=True)
    """Left, low, width and height of what the veil covers [px]."""

    def _veil(self) -> list[float]:
        return [*theme.surface[:3], self.veils.get(self.state, 0.0) if self.veiled else 0.0]

    veil = AliasProperty(_veil, bind=["state"])
    """Colour over what is stale or disabled."""

    def _alarmed(self) -> bool:
        return self.veiled and self.state == "alarm"

    alarmed = AliasProperty(_alarmed, bind=["state"], cache=True)
    """Has the outline of an alarm."""

    def _badge(self) -> str:
        return age_text(self.age) if self.veiled and self.says_age and self.state == "stale" else ""

    badge = AliasProperty(_badge, bind=["state", "age", "says_age"], cache=True)
    """Its age, where that must be shown; else empty."""

    def _badge_texture(self) -> Texture:
        return text_texture(self.badge, sp(12), theme.font)

    badge_texture = AliasProperty(_badge_texture, bind=["badge"], cache=True)

    def _badge_size(self) -> tuple[float, float]:
        width, height = self.badge_texture.size
        return width + dp(16), height + dp(6)

    badge_size = AliasProperty(_badge_size, bind=["badge_texture"], cache=True)

    def _badge_pos(self) -> tuple[float, float]:
        width, height = self.badge_size
        low = self.y + dp(8) if self.height > dp(MIN_ROOMY_HEIGHT) else self.y - height / 2
        return self.center_x - width / 2, low

    badge_pos = AliasProperty(_badge_pos, bind=["badge_size", "pos", "size"], cache=True)
    """Low in what is big, else on the lower edge and half outside, where it lies over no figure."""

    def _badge_text_pos(self) -> tuple[float, float]:
        return self.badge_pos[0] + dp(8), self.badge_pos[1] + dp(3)

    badge_text_pos = AliasProperty(_badge_text_pos, bind=["badge_pos"], cache=True)

    def _alarm_texture(self) -> Texture:
        return text_texture(icon("warning"), sp(18), theme.icons)

    alarm_texture = AliasProperty(_alarm_texture, cache=True)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.fbind("state", self._follow_state)
        if self.state == "disabled":
            self.disabled = True
        theme.bind(surface=self._follow_theme)

    def _follow_theme(self, *_: object) -> None:
        self.property("veil").dispatch(self)

    def _follow_state(self, *_: object) -> None:
        self.disabled = self.state == "disabled"

    def show(self, msg: Any) -> None:
        """Take over what the message says. Each widget says which types: `accepts`."""
        raise TypeError(f"{type(self).__name__} shows nothing, not even {msg.MSGTYPE}")


class Control(RobotWidget):
    """A widget that a finger commands with. It never publishes: it dispatches `on_command`."""

    sends: ClassVar[tuple[type[Msg], ...]] = ()
    """Types that `on_command` carries."""
    to_topic: ClassVar[bool] = False
    """What `on_command` carries is for a topic of the robot as it is; whoever binds the event may publish it."""

    __events__: tuple[str, ...] = ("on_command",)

    def __init__(self, **kwargs: Any) -> None:
        kwargs.setdefault("state", "live")
        super().__init__(**kwargs)
        self.fbind("disabled", self._rest_when_disabled)

    def _rest_when_disabled(self, _: object, disabled: bool) -> None:
        if disabled:
            self.rest()

    def on_command(self, *args: Any) -> None:
        """The finger asked for something; each control defines its `args`."""

    def rest(self) -> None:
        """Let go, as if the finger had: what moves is commanded to stand still."""
