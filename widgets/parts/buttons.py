"""Buttons: one main button on a card, quiet ones beside it, icons, the entries of a navigation rail."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.anchorlayout import AnchorLayout
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the icons
from widgets.core.base import MIN_FONT_SIZE, text_texture
from widgets.core.finger_stay import FingerStay
from widgets.core.surfaces import Pressable, within_reach
from widgets.core.theme import theme

__all__ = ["IconButton", "NavButton", "PrimaryButton", "PushButton", "QuietButton"]

SETTLE_DURATION = 0.5
"""A button whose meaning has changed takes no finger for so long [s]: that finger meant what it did before."""

Builder.load_string("""
#:import line_height widgets.core.base.line_height
<PushButton>:
    size_hint_y: None
    height: theme.target
    padding: dp(10), 0
    rim: 'faint' if root.disabled else root.border
    ground: 'surface' if root.disabled else root.fill
    press_role: root.ink
    press_share: .16
    BoxLayout:
        orientation: root.flow
        size_hint: None, None
        size: self.minimum_size
        spacing: (dp(8) if root.flow == 'horizontal' else dp(2)) if root.signed and root.text else 0
        Icon:
            id: sign
            name: root.icon or 'check'
            role: 'faint' if root.disabled else root.ink_icon or root.ink
            font_size: min(theme.size_icon, max(dp(24), root.height * .42)) if root.flow == 'vertical' and root.text else theme.size_icon
            size: (self.font_size, self.font_size) if root.signed else (0, 0)
            opacity: 1 if root.signed else 0
            pos_hint: {'center_x': .5, 'center_y': .5}
        FittedLabel:
            id: words
            text: root.text
            largest: min(root.type_size or (theme.size_body if root.flow == 'horizontal' else sp(14)), max(dp(8), root.height - (sign.height + dp(2) if root.flow == 'vertical' and root.signed else 0)) / line_height())
            room: max(root.words_room, 1)
            lines: 2 if root.height >= sp(34) + (theme.size_icon + dp(2) if root.flow == 'vertical' and root.icon else 0) else 1
            bold: True
            color: theme.faint if root.disabled else theme.roles[root.ink]
            size_hint: None, None
            size: self.texture_size
            pos_hint: {'center_x': .5, 'center_y': .5}

<PrimaryButton>:
    fill: self.role
    border: self.role
    ink: 'ink_' + self.role

<QuietButton>:
    fill: 'raised'
    border: 'line'
    ink: 'text'

<IconButton>:
    size_hint: None, None
    size: [min(theme.target, max(dp(53), theme.least)) if root.bare else theme.target] * 2
    rim: 'line' if not root.bare else ''
    ground: 'raised' if not root.bare else ''
    press_share: .16
    Icon:
        name: root.icon
        role: root.role
        font_size: sp(26)
        opacity: .4 if root.disabled else 1

<NavButton>:
    orientation: 'vertical'
    padding: 0, dp(10), 0, dp(9)
    spacing: dp(3)
    size_hint: None, None
    size: dp(64), max(dp(64), theme.target)
    canvas.before:
        Rounded:
            rgba: theme.raised if root.active and root.framed else (0, 0, 0, 0)
            pos: self.pos
            size: self.size
            radius: [theme.corner]
        Rounded:
            rgba: theme.text[:3] + [.12 if root.state == 'down' else 0]
            pos: self.pos
            size: self.size
            radius: [theme.corner]
    canvas.after:
        Rounded:
            rgba: (theme.danger if root.urgent else theme.warn)[:3] + [1 if root.count else 0]
            pos: root.badge_pos
            size: root.badge_size
            radius: [root.badge_size[1] / 2]
        Color:
            rgb: theme.ink_danger[:3]
            a: 1 if root.count else 0
        Rectangle:
            pos: root.badge_text_pos
            size: root.badge_texture.size
            texture: root.badge_texture
    Icon:
        id: sign
        name: root.icon
        role: root.tint or ('accent' if root.active else 'muted')
        font_size: min(theme.size_icon, max(dp(24), root.inner * .55))
        pos_hint: {'center_x': .5}
    FittedLabel:
        text: root.text
        largest: root.type_size or min(sp(12.5), max(dp(12.5), (root.inner - sign.height) / line_height()))
        room: max(root.width - dp(6), 1)
        lines: 1
        color: theme.roles[root.tint or ('text' if root.active else 'muted')]
""")


class PushButton(Pressable, AnchorLayout):
    """A button with an icon, words or both; what the named ones below have in common."""

    text = StringProperty("")
    icon = StringProperty("")
    """Name of the icon; empty for none."""
    fill = StringProperty("raised")
    """Role of its ground."""
    border = StringProperty("line")
    """Role of its border."""
    ink = StringProperty("text")
    """Role of its words."""
    ink_icon = StringProperty("")
    """Role of the icon; that of the words when empty."""
    flow = OptionProperty("horizontal", options=["horizontal", "vertical"])
    """Icon before the words, or above them."""
    type_size = NumericProperty(0)
    """Of its words where they have room [px], so that neighbours are alike; 0 for the usual."""
    meaning = StringProperty("")
    """What a press does, where that changes; half a second after a change no finger is taken."""

    def __init__(self, **kwargs: Any) -> None:
        self._meant = ""
        self._settling = FingerStay(lambda: None, SETTLE_DURATION)
        super().__init__(**kwargs)

    def on_meaning(self, *_: object) -> None:
        """Let go of a finger that is down, and take none for a while."""
        if self._meant:
            if self.state == "down" and self.last_touch is not None:
                self.last_touch.ungrab(self)
                self.state = "normal"
            self._settling.end()
            self._settling.begin()
        self._meant = self.meaning

    def on_touch_down(self, touch: Any) -> bool:
        """Take the finger, if only to keep it from what lies below."""
        return bool(
            (self._settling.waiting and self.collide_point(*touch.pos)) or super().on_touch_down(touch)
        )

    def _signed(self) -> bool:
        if not self.icon or not self.text or self.flow == "vertical":
            return bool(self.icon)
        room = self.width - self.padding[0] - self.padding[2] - theme.size_icon - dp(8)
        return bool(text_texture(self.text, sp(MIN_FONT_SIZE), bold=True).width <= room)

    signed = AliasProperty(_signed, bind=["icon", "text", "flow", "width", "padding"], cache=True)
    """Its icon is drawn: it gives way where the words have no room beside it even when they are small."""

    def _words_room(self) -> float:
        beside = self.signed and self.flow == "horizontal"
        return self.width - self.padding[0] - self.padding[2] - (theme.size_icon + dp(8) if beside else 0)

    words_room = AliasProperty(_words_room, bind=["signed", "flow", "width", "padding"], cache=True)
    """How wide the words may be [px]."""

    @property
    def words_size(self) -> float:
        """Height of the words' type [px]: as always, or less where they would touch the border."""
        return float(self.ids.words.font_size)


class PrimaryButton(PushButton):
    """What the card is there for: one on each."""

    role = OptionProperty("accent", options=["accent", "plan", "danger", "stop"])
    """Role of its ground; its words take the ink that belongs to it."""


class QuietButton(PushButton):
    """Everything else that can be done here."""


class IconButton(Pressable, AnchorLayout):
    """An icon to press, as large as a finger needs; `bare` without a ground, for bars."""

    icon = StringProperty("close")
    role = StringProperty("text")
    """Role of the icon's colour."""
    bare = BooleanProperty(False)

    def collide_point(self, x: float, y: float) -> bool:
        """One without a ground is hit within the least target round it."""
        return within_reach(self, x, y) if self.bare else bool(super().collide_point(x, y))


class NavButton(ButtonBehavior, BoxLayout):
    """One entry of a navigation rail or bar."""

    icon = StringProperty("map")
    text = StringProperty("")
    active = BooleanProperty(False)
    """Its screen is the visible one."""
    tint = StringProperty("")
    """Role of the icon and the words while what it stands for goes on, as a recording; empty for none."""
    type_size = NumericProperty(0)
    """Of its word [px], so that neighbours are alike; 0 for as large as it has room."""
    framed = BooleanProperty(True)
    """Has a ground while active, as in a rail."""
    count = NumericProperty(0)
    """Things behind it that need attention: counted in a mark on its icon, from 100 on as `99+`; 0 for none."""
    urgent = BooleanProperty(True)
    """One of them cannot wait: the mark has the colour of danger, else that of a warning."""

    def _inner(self) -> float:
        return float(self.height - self.padding[1] - self.padding[3] - self.spacing)

    inner = AliasProperty(_inner, bind=["height", "padding", "spacing"], cache=True)
    """How high its icon and its words may be together [px]."""

    def _badge_texture(self) -> Texture:
        words = f"{self.count:.0f}" if self.count < 100 else "99+"
        return text_texture(words, sp(12), theme.font, bold=True)

    badge_texture = AliasProperty(_badge_texture, bind=["count"], cache=True)

    def _badge_size(self) -> tuple[float, float]:
        width, height = self.badge_texture.size
        return max(width + dp(6), height + dp(3)), height + dp(3)

    badge_size = AliasProperty(_badge_size, bind=["badge_texture"], cache=True)

    def _badge_pos(self) -> tuple[float, float]:
        width, height = self.badge_size
        return min(self.center_x + dp(9), self.right - width), self.top - dp(4) - height

    badge_pos = AliasProperty(_badge_pos, bind=["badge_size", "pos", "size"], cache=True)

    def _badge_text_pos(self) -> tuple[float, float]:
        (x, y), (width, height), texture = self.badge_pos, self.badge_size, self.badge_texture
        return x + (width - texture.width) / 2, y + (height - texture.height) / 2

    def collide_point(self, x: float, y: float) -> bool:
        """It is hit within the least target round it."""
        return within_reach(self, x, y)

    badge_text_pos = AliasProperty(_badge_text_pos, bind=["badge_pos", "badge_size"], cache=True)


def _button(kind: type[PushButton], **kwargs: Any) -> Callable[[], Widget]:
    return lambda: kind(size_hint_x=None, **{"width": "200dp", **kwargs})


def samples() -> dict[str, Callable[[], Widget]]:
    """Each kind of button, at rest, pressed and disabled."""
    return {
        "primary": _button(PrimaryButton, text="Connect"),
        "primary pressed": _button(PrimaryButton, text="Connect", state="down"),
        "primary disabled": _button(PrimaryButton, text="Connect", disabled=True),
        "plan": _button(PrimaryButton, text="Send 6 points", icon="upload", role="plan"),
        "quiet": _button(QuietButton, text="Pause", icon="pause"),
        "quiet pressed": _button(QuietButton, text="Pause", icon="pause", state="down"),
        "quiet disabled": _button(QuietButton, text="Go home", icon="home", disabled=True),
        "icon above": _button(
            QuietButton, text="Home", icon="home", flow="vertical", width="104dp", height="64dp"
        ),
        "narrow": _button(PrimaryButton, text="Resume", icon="play_arrow_fill", width="112dp"),
        "icon": lambda: IconButton(icon="my_location"),
        "icon bare": lambda: IconButton(icon="arrow_back", bare=True, role="muted"),
        "nav": lambda: NavButton(icon="sports_esports", text="Drive"),
        "nav going on": lambda: NavButton(icon="fiber_manual_record_fill", text="REC 0:12", tint="danger"),
        "nav with alarms": lambda: NavButton(icon="list", text="Tasks", count=2),
        "nav with warnings": lambda: NavButton(icon="list", text="Tasks", count=2, urgent=False),
        "nav with many": lambda: NavButton(icon="list", text="Tasks", count=140, active=True),
        "nav active": lambda: NavButton(icon="map", text="Mission", active=True),
    }
