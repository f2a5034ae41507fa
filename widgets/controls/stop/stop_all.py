"""STOP ALL: the small button beside STOP, for every known robot; afterwards it counts how many are stopped.

stop_all = StopAll(robots=3)
stop_all.bind(on_command=lambda _: fleet.press(robots.entries()))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty
from kivy.uix.anchorlayout import AnchorLayout
from kivy.uix.widget import Widget

from widgets.controls.stop.robot_words import brief_robot_words, robot_words
from widgets.core.base import Control, fitting_size
from widgets.core.language import tr
from widgets.core.surfaces import Outlined

__all__ = ["StopAll"]

MIN_FONT_SIZE = 14.0
"""Smallest type that anything is written in [sp]; a note that would need a smaller one is left out."""
LINE_HEIGHT = 1.25
"""Height of a line of type in its size."""
MIN_ASPECT = 1.5
"""Narrower than so many heights its word goes on two lines."""

Builder.load_string("""
<StopAll>:
    rim: 'stop'
    ground: 'stop' if root.filled else 'raised'
    corner: theme.radius
    rim_width: dp(2)
    canvas.before:
        Rounded:
            rgba: theme.shade[:3] + [.22 if root.pressed else 0]
            pos: self.pos
            size: self.size
            radius: [theme.radius]
    BoxLayout:
        orientation: 'vertical'
        size_hint: None, None
        size: self.minimum_size
        Label:
            text: root.word
            font_name: theme.font
            font_size: root.word_size
            bold: True
            halign: 'center'
            line_height: .95
            color: theme.roles[root.ink]
            disabled_color: self.color
            size_hint: None, None
            size: self.texture_size
            pos_hint: {'center_x': .5}
        Label:
            text: root.note
            font_name: theme.font
            font_size: sp(14)
            color: theme.roles[root.ink if root.filled else 'text']
            disabled_color: self.color
            size_hint: None, None
            size: self.texture_size if root.note else (0, 0)
            pos_hint: {'center_x': .5}
""")


class StopAll(Outlined, Control, AnchorLayout):
    """Dispatches `on_command` the moment a finger comes down, however often."""

    veiled = False

    robots = NumericProperty(0)
    """So many are known."""
    lost = NumericProperty(0)
    """Of them were heard and are not now; STOP is sent to them all the same."""
    silent = NumericProperty(0)
    """Of them were not heard yet; STOP is sent to them all the same."""
    active = BooleanProperty(False)
    """It was pressed and not let go."""
    stopped = NumericProperty(0)
    """So many say that they are stopped and rest."""
    total = NumericProperty(0)
    """Of so many that it was meant for."""
    pressed = NumericProperty(0)
    """Fingers on it."""

    def _filled(self) -> bool:
        return self.active and self.stopped < self.total

    filled = AliasProperty(_filled, bind=["active", "stopped", "total"], cache=True)
    """Not all of them are stopped."""

    def _ink(self) -> str:
        return "ink_stop" if self.filled else "danger"

    ink = AliasProperty(_ink, bind=["filled"], cache=True)
    """Role of the word."""

    def _tight(self) -> bool:
        return self.width < self.height * MIN_ASPECT

    tight = AliasProperty(_tight, bind=["size"], cache=True)

    def _word(self) -> str:
        if self.active:
            return (
                f"{self.stopped}/{self.total}"
                if self.tight
                else tr("{done} of {total}").format(done=self.stopped, total=self.total)
            )
        return "STOP\nALL" if self.tight else "STOP ALL"

    word = AliasProperty(_word, bind=["active", "stopped", "total", "tight"], cache=True)

    def _note(self) -> str:
        lines = 2 if self.tight and not self.active else 1
        if self.height - lines * self.word_size * LINE_HEIGHT < sp(MIN_FONT_SIZE) * LINE_HEIGHT:
            return ""
        size, room = sp(MIN_FONT_SIZE), self.width - dp(14)
        return next((note for note in self._notes() if fitting_size([note], size, room) >= size), "")

    def _notes(self) -> list[str]:
        """What may be said below the word, the fullest first."""
        if self.active:
            return [tr("STOPPED")]
        known = int(self.robots), int(self.lost), int(self.silent)
        return [robot_words(*known), brief_robot_words(*known)]

    note = AliasProperty(_note, bind=["active", "robots", "lost", "silent", "size", "word_size"], cache=True)
    """Below the word, where there is room for it."""

    def _word_size(self) -> float:
        lines = 2 if self.tight and not self.active else 1
        most = max(min(self.height * (0.36 if lines == 1 else 0.24), sp(26)), sp(MIN_FONT_SIZE))
        return fitting_size(self.word.split("\n"), most, self.width - dp(8), bold=True)

    word_size = AliasProperty(_word_size, bind=["size", "word", "tight", "active"], cache=True)
    """Height of the type [px]."""

    def on_touch_down(self, touch: Any) -> bool:
        """Command at once."""
        if not self.collide_point(*touch.pos):
            return False
        touch.grab(self)
        self.pressed += 1
        self.dispatch("on_command")
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """Letting go changes nothing."""
        if touch.grab_current is not self:
            return False
        touch.ungrab(self)
        self.pressed = max(0, self.pressed - 1)
        return True


def samples() -> dict[str, Callable[[], Widget]]:
    """As it waits, while robots have not confirmed, and when all have; narrow, flat and as on the connect screen."""

    def make(width: str, height: str, **kwargs: Any) -> Callable[[], Widget]:
        return lambda: StopAll(size_hint=(None, None), size=(width, height), **kwargs)

    states: dict[str, dict[str, Any]] = {
        "ready": {"robots": 3},
        "one lost": {"robots": 3, "lost": 1},
        "waiting": {"robots": 3, "active": True, "stopped": 2, "total": 3},
        "stopped": {"robots": 3, "active": True, "stopped": 3, "total": 3},
    }
    shapes = {
        "": ("240dp", "64dp"),
        " narrow": ("72dp", "96dp"),
        " side": ("84dp", "76dp"),
        " flat": ("111dp", "54dp"),
    }
    found = {
        f"{state}{shape}": make(*size, **kwargs)
        for state, kwargs in states.items()
        for shape, size in shapes.items()
        if (state, shape) != ("one lost", " narrow")  # it has no room to say so, and looks like the others
    }
    return found | {"fifty": make("64dp", "76dp", robots=50, active=True, stopped=48, total=50)}
