"""Notices over every screen: one sentence at a time that leaves by itself, and cards that stay until they are answered."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.layout.arrange import Rect
from app.screens.parts.placing import AWAY_X
from app.screens.parts.robot_screen import RobotScreen
from widgets.core.language import tr
from widgets.parts.kit import ActionToast, Banner, Toast

__all__ = ["BRIEF_DURATION", "LONG_DURATION", "Notices"]

BRIEF_DURATION, LONG_DURATION = 4.0, 10.0
"""How long a sentence stays over the screen, and one that is said once of a robot [s]."""
MAX_WIDTH = 560.0
"""Wider ones are hard to read [dp]."""

Builder.load_string("""
<Notices>:
    orientation: 'vertical'
    size_hint: None, None
    height: self.minimum_height
    spacing: dp(8)
""")


class Notices(BoxLayout):
    """Sentences and cards, the newest sentence lowest."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._said, self._sentence, self._count = "", ("", "", ""), 0
        self._toast: Toast | None = None
        """What was said last, counted while it stands there."""
        self.room = Rect(0, 0, 0, 0)
        """Where it would stand if nothing else were there; without height while nothing is said [px]."""
        self.above: Rect | None = None
        """What it keeps above of, where it can [px]."""
        self._cover: tuple[RobotScreen | None, Rect | None] = (None, None)

    def add_widget(self, widget: Widget, *args: Any, **kwargs: Any) -> None:
        """Add it off the glass: it comes with the next layout, and until then nobody sees it as wide as it happened to be, or touches it."""
        widget.pos, widget.width = (AWAY_X, 0), self.width
        super().add_widget(widget, *args, **kwargs)

    def place(self, screen: RobotScreen) -> None:
        """Stand in the room that `screen` leaves, and let it clear away what would be seen only in part."""
        room = screen.notice
        self.width = min(MAX_WIDTH * Metrics.density, room.width)
        # what is too much for its room goes up, never down over what can be touched
        low = max(room.y, min(room.top, screen.top) - self.height)
        x = room.x + (room.width - self.width) / 2
        self.room = Rect(x, low, self.width, self.height if self.children else 0.0)
        if self.above is not None and self.above.overlaps(self.room):
            low = max(low, min(self.above.top + 8 * Metrics.density, screen.top - self.height))
        self.pos = (x, low)
        said = Rect(self.x, low, self.width, self.height) if self.children else None
        # what only stands over pictures takes nothing away from lists that can be read beside it
        cover = _round(said, self.above) if screen.picture is not None else said
        if (screen, cover) != self._cover:
            self._cover = screen, cover
            screen.clear(cover)
        picture = screen.picture
        if picture is not None:
            seen = Rect(*picture.pos, *picture.size)
            picture.below = low if cover is not None and seen.overlaps(cover) else math.inf

    def say(self, text: str, level: str, about: str, stay: float) -> None:
        """One sentence for `stay` [s], in the place of the last one; `about` is what it tells of. The same again is counted."""
        before = self._toast
        again = before is not None and before.parent is self and self._sentence == (text, level, about)
        self.unsay(self._said)
        self._count = self._count + 1 if again else 1
        self._said, self._sentence = about, (text, level, about)
        told = tr("{sentence} ({count} times)").format(sentence=text, count=self._count) if again else text
        self._toast = Toast(text=told, level=level, stay=stay)
        self.add_widget(self._toast)

    def unsay(self, about: str) -> None:
        """Take the sentence away that was said about something: it is no longer true."""
        if about != self._said:
            return
        for child in list(self.children):
            if isinstance(child, Toast) and not isinstance(child, ActionToast):
                self.remove_widget(child)

    def hush(self) -> None:
        """Take the sentence away that is said now, whatever it tells of."""
        self.unsay(self._said)

    def offer(self, text: str, action: str, act: Callable[[], None], icon: str = "undo") -> None:
        """One sentence with something to do about it, `icon` on its button."""
        toast = ActionToast(text=text, action=action, action_icon=icon, stay=LONG_DURATION)
        toast.bind(on_act=lambda _: act())
        self.add_widget(toast)

    @property
    def asks(self) -> bool:
        """Something is there that waits for a finger."""
        return any(isinstance(child, ActionToast) or not isinstance(child, Banner) for child in self.children)

    def keep(self, card: Widget, *, shown: bool, first: bool = False, under: Widget | None = None) -> None:
        """Have a card here for as long as it is `shown`; `first` puts it above all others but the one it is `under`."""
        if shown == (card.parent is self):
            return
        if not shown:
            self.remove_widget(card)
            return
        top = self.children.index(under) if under in self.children else len(self.children)
        self.add_widget(card, index=top if first else 0)


def _round(one: Rect | None, other: Rect | None) -> Rect | None:
    """What holds both."""
    if one is None or other is None:
        return one or other
    x, y = min(one.x, other.x), min(one.y, other.y)
    return Rect(x, y, max(one.right, other.right) - x, max(one.top, other.top) - y)
