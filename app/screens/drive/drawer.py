"""The drawer of a phone on its side: what is not needed while driving lies in it, above the thumbs, until a finger pulls it out."""

from __future__ import annotations

from typing import Any

from kivy.input.motionevent import MotionEvent
from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from widgets.core.language import mark
from widgets.core.surfaces import Pressable
from widgets.parts.cards import Card

__all__ = ["DrawerGround", "DrawerHandle"]

MIN_PULL = 14
"""A finger that went less far up or down has tapped [dp]."""
PILL = 64, 26
"""Width and height of what is seen of the handle [dp]."""

Builder.load_string("""
<DrawerHandle>:
    size_hint: None, None
    rim: ''
    ground: ''
    press_share: 0
    canvas.before:
        Rounded:
            rgba: theme.glass
            pos: root.pill[:2]
            size: root.pill[2:]
            radius: [root.pill[3] / 2]
        Rounded:
            rgba: theme.roles['text'][:3] + [.16 if root.state == 'down' else 0]
            pos: root.pill[:2]
            size: root.pill[2:]
            radius: [root.pill[3] / 2]
    Icon:
        name: 'expand_less' if root.pulled else 'expand_more'
        role: 'text'
        font_size: sp(24)
        size_hint: None, None
        size: self.font_size, root.pill[3]
        pos: root.pill[0] + (root.pill[2] - self.width) / 2, root.pill[1]
""")


class DrawerGround(Card):
    """Below what lies in the drawer; a finger on it reaches nothing behind it."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"floating": True, "size_hint": (None, None), **kwargs})

    def on_touch_down(self, touch: MotionEvent) -> bool:
        """Keep the finger."""
        return bool(super().on_touch_down(touch) or self.collide_point(*touch.pos))


class DrawerHandle(Pressable, BoxLayout):
    """Dispatches `on_pull(out)` when a finger pulls it down or pushes it up, or taps it."""

    __events__ = ("on_pull",)

    scan_words = mark("Instruments")
    pulled = BooleanProperty(False)
    """The drawer is out."""

    def _pill(self) -> list[float]:
        width, height = dp(PILL[0]), dp(PILL[1])
        return [self.center_x - width / 2, self.top - height, width, height]

    pill = AliasProperty(_pill, bind=["pos", "size"], cache=True)
    """Left, low, width and height of what is seen of it [px]; a finger reaches all of it."""

    def do_layout(self, *_: object) -> None:
        """Its sign is placed by rule."""

    @property
    def hides(self) -> list[tuple[float, float, float, float]]:
        """What of a picture behind it cannot be seen [px]."""
        left, low, width, height = self.pill
        return [(left, low, width, height)]

    def on_touch_up(self, touch: MotionEvent) -> bool:
        """A pull says which way; a tap turns it."""
        if touch.grab_current is self and abs(way := touch.y - touch.oy) >= dp(MIN_PULL):
            touch.ungrab(self)
            self._do_release()
            self.dispatch("on_pull", way < 0)
            return True
        return bool(super().on_touch_up(touch))

    def on_release(self) -> None:
        """A tap."""
        self.dispatch("on_pull", not self.pulled)

    def on_pull(self, out: bool) -> None:
        """It is to be pulled out, or pushed back."""
