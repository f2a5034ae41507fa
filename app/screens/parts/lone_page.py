"""A screen where there is no robot: reached from the connect screen, and left to it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import ObjectProperty
from kivy.uix.floatlayout import FloatLayout

from app.core.hand import hand
from app.layout import arrange
from app.layout.arrange import Body, Rect
from app.screens.parts.safe_area import safe_area
from widgets.core.surfaces import EdgedBox  # noqa: F401 - its rule draws the bar
from widgets.core.theme import theme
from widgets.parts.kit import IconButton, Text

__all__ = ["LonePage"]

BAR = 56.0
"""Height of the bar [dp], as on the connect screen."""

Builder.load_string("""
<LonePage>:
    EdgedBox:
        size_hint: None, None
        pos: root.room.x, root.room.top - max(dp(56), theme.least)
        size: root.room.width, max(dp(56), theme.least)
""")


class LonePage(FloatLayout):
    """A bar with a way back, and the screen below it."""

    app = ObjectProperty()
    room: ObjectProperty[Rect] = ObjectProperty(Rect(0, 0, 1, 1))
    """What of the window no edge of a phone takes [px]."""

    def __init__(self, title: str, make: Callable[[], Any], **kwargs: Any) -> None:
        """`make` gives the screen, which has `spread`, `enter`, `leave`, `tick` and `back`."""
        super().__init__(**kwargs)
        self._make = make
        self._screen: Any = None
        self.leave_button = IconButton(icon="arrow_back", role="muted", bare=True, size_hint=(None, None))
        self.leave_button.bind(on_release=lambda _: self.back())
        self._title = Text(text=title, bold=True, size_hint=(None, None))
        self.add_widget(self.leave_button)
        self.add_widget(self._title)
        self._title.bind(height=self._arrange)
        self.bind(size=self._arrange, pos=self._arrange)
        safe_area.bind(insets=self._arrange)

    @property
    def screen(self) -> Any:
        """What is below the bar, made when it is first looked at."""
        if self._screen is None:
            self._screen = self._make()
            self.add_widget(self._screen)
        return self._screen

    def enter(self) -> None:
        """Come onto the glass."""
        self.screen.enter()
        self._arrange()

    def tick(self) -> None:
        """Bring up to date what time changes; once it is left, leave what was on it."""
        if self._screen is None:
            return
        if self.parent is None:
            self._screen.leave()
        else:
            self._screen.tick()

    def back(self) -> bool:
        """Back within the page, then to the connect screen; False where it is not on the glass."""
        if self.parent is None:
            return False
        if not self.screen.back():
            self._leave()
        return True

    def end(self) -> None:
        """Let go of what the screen holds, for good."""
        if self._screen is not None:
            self._screen.leave()
            self._screen.end()

    def _leave(self) -> None:
        self.screen.leave()
        self.app.root.show_page(self.app.connect)
        self.app.corner.tick()

    def _arrange(self, *_: object) -> None:
        if self._screen is None:
            return
        dp = Metrics.density
        bar = max(BAR * dp, theme.least)
        room = self.room = safe_area.within(self.width, self.height)
        self.leave_button.pos = (room.x + 6 * dp, room.top - bar + (bar - self.leave_button.height) / 2)
        self._title.pos = (self.leave_button.right + 8 * dp, room.top - bar + (bar - self._title.height) / 2)
        self._title.width = room.right - self.leave_button.right - 16 * dp
        shared = bool(self.app.corner.button.robots)
        body = Body(room.x, room.y, room.width, room.height - bar, shared, hand.left)
        self._screen.spread(body, arrange.form(self.width, self.height, dp), dp)
