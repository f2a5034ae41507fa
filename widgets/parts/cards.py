"""Cards that hold other things, banners with one sentence, and the sheet for the thumb."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.animation import Animation
from kivy.clock import Clock
from kivy.lang import Builder
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.buttons  # noqa: F401 - its rules draw what can be done about a toast
from widgets.core.language import mark, tr
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme
from widgets.parts.labels import SectionLabel, Text, ValueUnit

__all__ = ["ActionToast", "Banner", "Card", "Sheet", "Toast"]

MOTION_DURATION = 0.15
"""Time of a movement on the screen [s]."""

LEVELS = {
    "info": ("info", "accent"),
    "ok": ("check_circle", "ok"),
    "warn": ("warning", "warn"),
    "danger": ("error", "danger"),
}
"""Level of a sentence to its icon and the role of its colour."""

Builder.load_string("""
<Card>:
    orientation: 'vertical'
    padding: theme.gap
    spacing: theme.gap * .75
    rim: 'glass' if root.floating else root.outline
    ground: '' if root.floating else root.role
    corner: theme.radius
    canvas.before:
        Outline:
            rgba: theme.roles[root.outline] if root.floating else (0, 0, 0, 0)
            rounded_rectangle: self.x + .5, self.y + .5, self.width - 1, self.height - 1, theme.radius
            width: theme.outline * .7

<Banner>:
    size_hint_y: None
    height: max(dp(48), sentence.texture_size[1] + dp(22), theme.least if root.closable else 0)
    padding: dp(14), 0, dp(14), 0
    spacing: dp(11)
    rim: root.role
    Icon:
        name: root.icon
        role: root.role
        pos_hint: {'center_y': .5}
    Text:
        id: sentence
        text: root.text
        font_size: sp(15)
        pos_hint: {'center_y': .5}

<ActionToast>:
    height: max(theme.target + dp(8), self.minimum_height)
    padding: dp(14), 0, dp(4), 0
    QuietButton:
        text: tr(root.action)
        icon: root.action_icon
        size_hint_x: None
        width: dp(112)
        pos_hint: {'center_y': .5}
        on_release: root.act()

<Sheet>:
    orientation: 'vertical'
    size_hint_y: None
    height: self.detents[0]
    padding: theme.gap, 0, theme.gap, theme.gap
    spacing: theme.gap * .9
    canvas.before:
        Rounded:
            rgba: theme.line
            pos: self.pos
            size: self.size
            radius: [theme.radius * 1.3, theme.radius * 1.3, 0, 0]
        Rounded:
            rgba: theme.surface
            pos: self.pos
            size: self.width, self.height - theme.outline
            radius: [theme.radius * 1.3 - theme.outline, theme.radius * 1.3 - theme.outline, 0, 0]
    SheetGrip:

<SheetGrip>:
    size_hint_y: None
    height: dp(22)
    canvas:
        Rounded:
            rgba: theme.line if theme.name != 'sunlight' else theme.muted
            pos: self.center_x - dp(22), self.center_y - dp(3)
            size: dp(44), dp(5)
            radius: [dp(2.5)]
""")


class Card(Outlined, BoxLayout):
    """A rounded ground for what belongs together."""

    role = StringProperty("surface")
    """Role of the ground."""
    outline = StringProperty("line")
    """Role of the border."""
    floating = BooleanProperty(False)
    """Lies over a picture: lets a little of it through."""


class Banner(Outlined, BoxLayout):
    """One plain sentence with an icon. With `closable` a tap takes it away and dispatches `on_close`."""

    __events__ = ("on_close",)

    text = StringProperty("")
    level = OptionProperty("info", options=list(LEVELS))
    """`info`, `ok`, `warn` or `danger`."""
    icon = StringProperty("info")
    """Name of the icon; follows `level`."""
    role = StringProperty("accent")
    """Role of the icon and the border; follows `level`."""
    closable = BooleanProperty(False)

    def on_level(self, *_: object) -> None:
        """Take the level's icon and role."""
        self.icon, self.role = LEVELS[self.level]

    def on_touch_up(self, touch: Any) -> bool:
        """Close at a tap."""
        if self.closable and self.collide_point(*touch.pos):
            self.close()
            return True
        return bool(super().on_touch_up(touch))

    def close(self) -> None:
        """Leave the screen."""
        if self.parent:
            self.parent.remove_widget(self)
        self.dispatch("on_close")

    def on_close(self) -> None:
        """It was taken away."""


class Toast(Banner):
    """A banner that leaves by itself."""

    stay = NumericProperty(4.0)
    """How long it can be read [s]."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"closable": True, **kwargs})
        self._leaving = Clock.create_trigger(lambda _: self.close(), self.stay)

    def on_parent(self, _: object, parent: Widget | None) -> None:
        """Start the time that it stays; stop it when it was taken away otherwise."""
        if parent:
            self._leaving()
        else:
            self._leaving.cancel()


class ActionToast(Toast):
    """A toast with one thing to do about it, as to undo; dispatches `on_act` and leaves."""

    __events__ = ("on_act",)

    action = StringProperty(mark("Undo"))
    action_icon = StringProperty("undo")
    kept = BooleanProperty(False)
    """An operator may need longer to reach it than it stays; afterwards it stays as long again."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"closable": False, **kwargs})

    def on_kept(self, *_: object) -> None:
        """Stay, or leave later."""
        self._leaving.cancel()
        if not self.kept and self.parent is not None:
            self._leaving()

    def act(self) -> None:
        """Do it as a finger would."""
        self.dispatch("on_act")
        self.close()

    def on_act(self) -> None:
        """A finger asked for it."""


class SheetGrip(Widget):
    """The bar that says a sheet can be pulled."""


class Sheet(BoxLayout):
    """The card at the bottom of a phone: pull it by its upper edge; it comes to rest at one of `detents`."""

    detents: ListProperty[float] = ListProperty([120.0, 348.0])
    """Heights that it rests at [px], least first."""
    detent = NumericProperty(0)
    """Index of the height that it rests at or moves to."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._finger: Any = None
        self.bind(detents=self._settle_at_once, detent=self._settle)
        self._settle_at_once()

    def _settle_at_once(self, *_: object) -> None:
        Animation.cancel_all(self, "height")
        self.height = self.detents[min(int(self.detent), len(self.detents) - 1)]

    def _settle(self, *_: object) -> None:
        Animation.cancel_all(self, "height")
        Animation(height=self.detents[int(self.detent)], d=MOTION_DURATION, t="out_cubic").start(self)

    def on_touch_down(self, touch: Any) -> bool:
        """Take the finger that comes down on the upper edge; nothing under the sheet gets any."""
        if not self.collide_point(*touch.pos):
            return bool(super().on_touch_down(touch))
        if touch.y > self.top - theme.target * 0.6 and self._finger is None:
            touch.grab(self)
            self._finger = (touch.uid, touch.y, self.height)
        else:
            super().on_touch_down(touch)
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """Follow the finger between the lowest and the highest rest."""
        if touch.grab_current is not self:
            return bool(super().on_touch_move(touch))
        _, start, height = self._finger
        self.height = max(self.detents[0], min(self.detents[-1], height + touch.y - start))
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """Come to rest at the nearest height; a mere tap goes on to the next one."""
        if touch.grab_current is not self:
            return bool(super().on_touch_up(touch))
        touch.ungrab(self)
        _, start, _ = self._finger
        self._finger = None
        if abs(touch.y - start) < theme.gap:
            nearest = (int(self.detent) + 1) % len(self.detents)
        else:
            nearest = min(range(len(self.detents)), key=lambda i: abs(self.detents[i] - self.height))
        self.detent = nearest
        self._settle()
        return True


def _card(**kwargs: Any) -> Card:
    card = Card(size_hint=(None, None), size=("240dp", "120dp"), **kwargs)
    card.add_widget(SectionLabel(title="Speed"))
    card.add_widget(ValueUnit(value="0.62", unit="m/s"))
    card.add_widget(Text(text=tr("by the wheels"), role="muted"))
    return card


def _sheet() -> Sheet:
    sheet = Sheet(size_hint_x=None, width="400dp", detents=[160.0, 240.0])
    sheet.add_widget(Text(text=tr("Pull me up by the upper edge.")))
    sheet.add_widget(Widget())
    return sheet


def samples() -> dict[str, Callable[[], Widget]]:
    """Cards on and over things, sentences of each level, a sheet."""
    sentences = {
        "info": "The robot has stored 6 points.",
        "ok": "Accepted: start patrol (18 ms)",
        "warn": "Paused: tablet-B took the stick.",
        "danger": "No robot answers at 10.0.0.3:9090 (connection refused).",
    }

    def banner(level: str) -> Callable[[], Widget]:
        return lambda: Banner(text=sentences[level], level=level, size_hint_x=None, width="400dp")

    return {
        "card": _card,
        "floating": lambda: _card(floating=True),
        "alarmed": lambda: _card(outline="danger"),
        **{f"banner {level}": banner(level) for level in sentences},
        "undo": lambda: ActionToast(text="Deleted: Office 12.", size_hint_x=None, width="400dp"),
        "sheet": _sheet,
    }
