"""Picture of a gamepad as it is now: sticks, triggers, pressed buttons, and the width of its dead zone.

picture = PadPicture()
picture.update(left=(0.5, 0.0), triggers=(0.0, 1.0), down={"a"}, dead_zone=0.12)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import ListProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.core.base import Control
from widgets.core.canvas_ink import Drawing, Ink, Word, Words, tint
from widgets.core.language import mark, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["PadPicture"]

WIDTH, HEIGHT, FOOT = 100.0, 62.0, 5.0
"""Of the picture and of the room for words below it, in parts that all places below are in, from its lower left corner."""
STICKS = {"left": (34.0, 18.0), "right": (66.0, 18.0)}
FOUR = {"a": (86.0, 27.0), "b": (93.0, 34.0), "x": (79.0, 34.0), "y": (86.0, 41.0)}
CROSS = {"dpup": (14.0, 41.0), "dpdown": (14.0, 27.0), "dpleft": (7.0, 34.0), "dpright": (21.0, 34.0)}
MIDDLE = {"back": (40.0, 38.0), "guide": (50.0, 38.0), "start": (60.0, 38.0)}
SHOULDERS = {"leftshoulder": (14.0, 50.0), "rightshoulder": (86.0, 50.0)}
TRIGGERS = {"lefttrigger": (33.0, 50.0), "righttrigger": (67.0, 50.0)}
PRESSED = {"leftstick": "left", "rightstick": "right"}
STICK, BUTTON, SMALL, KNOB = 13.0, 4.4, 3.2, 5.0
"""Radii."""
BAR, THICK = 9.0, 5.4
"""Half the length and the width of a shoulder's bar."""
LETTERS = {"a": "A", "b": "B", "x": "X", "y": "Y"}


class PadPicture(Control, Drawing):
    """Shows and asks for nothing. A stick is as it is before its dead zone, up and left positive."""

    drawn_from: ClassVar[tuple[str, ...]] = (
        "left",
        "right",
        "triggers",
        "down",
        "dead_zone",
        "stops",
        "nothing",
    )

    left_stick: ListProperty[float] = ListProperty([0.0, 0.0])
    """How far the left stick is pushed ahead and to the left, each -1 to 1."""
    right_stick: ListProperty[float] = ListProperty([0.0, 0.0])
    """The same of the right one."""
    triggers: ListProperty[float] = ListProperty([0.0, 0.0])
    """How far the left and the right one are pressed, each 0 to 1."""
    down: ListProperty[str] = ListProperty()
    """Names of the buttons that are down, as SDL has them."""
    stops: ListProperty[str] = ListProperty(["b"])
    """Names of those that are STOP."""
    dead_zone = NumericProperty(0.12)
    """Of the way of a stick, round its middle."""
    nothing = StringProperty(mark("No gamepad is plugged in."))
    """What to say where there is none."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        super().__init__(**{"state": "never", **kwargs})
        self.canvas.add(self._ink)
        self.canvas.add(self._words.canvas)

    def update(
        self,
        *,
        left: tuple[float, float] = (0.0, 0.0),
        right: tuple[float, float] = (0.0, 0.0),
        triggers: tuple[float, float] = (0.0, 0.0),
        down: Collection[str] = (),
        dead_zone: float = 0.12,
        stops: Collection[str] = ("b",),
    ) -> None:
        """Show it like this."""
        self.left_stick, self.right_stick, self.triggers = [*left], [*right], [*triggers]
        self.down, self.stops, self.dead_zone = sorted(down), sorted(stops), dead_zone
        self.state = "live"

    def clear(self) -> None:
        """There is none any more."""
        self.update()
        self.state = "never"

    # drawing

    @property
    def _scale(self) -> float:
        return float(min(self.width / WIDTH, self.height / HEIGHT))

    def _at(self, place: tuple[float, float]) -> tuple[float, float]:
        scale = self._scale
        x, y = self.center_x - WIDTH / 2 * scale, self.center_y - (HEIGHT / 2 - FOOT) * scale
        return x + place[0] * scale, y + place[1] * scale

    def draw(self) -> None:
        """Everything anew: it is small, and looked at only while it is set up."""
        shapes, words = Shapes(), []
        for side, place in STICKS.items():
            self._stick(shapes, side, place)
        for places, radius in ((FOUR, BUTTON), (CROSS, SMALL), (MIDDLE, SMALL)):
            for name, place in places.items():
                words += self._button(shapes, name, place, radius)
        for name, place in SHOULDERS.items():
            self._bar(shapes, place, 1.0 if name in self.down else 0.0, self._role(name))
        for (name, place), share in zip(TRIGGERS.items(), self.triggers, strict=True):
            self._bar(shapes, place, share, self._role(name))
        extra = [name.rpartition(" ")[2] for name in self.down if name.startswith("button ")]
        if self.state == "never":
            words.append(self._word(tr(self.nothing), (WIDTH / 2, -0.5), 4.6, theme.muted))
        elif extra:
            words.append(
                self._word(
                    tr("Button {extra}").format(extra=", ".join(extra)), (WIDTH / 2, -0.5), 4.6, theme.accent
                )
            )
        self._ink.fill(shapes)
        self._words.write(words, 1.0)

    def _role(self, name: str) -> Any:
        return theme.danger if name in self.stops else theme.accent

    def _word(
        self, text: str, place: tuple[float, float], size: float, colour: Any, *, bold: bool = False
    ) -> Word:
        x, y = self._at(place)
        return Word(text, x, y, max(sp(12), size * self._scale), colour, bold=bold)

    def _stick(self, shapes: Shapes, side: str, place: tuple[float, float]) -> None:
        (x, y), scale = self._at(place), self._scale
        ahead, left = self.left_stick if side == "left" else self.right_stick
        length = math.hypot(ahead, left)
        share = 1.0 / max(1.0, length)
        reach = (STICK - KNOB) * scale
        pressed = any(PRESSED[name] == side for name in self.down if name in PRESSED)
        lit = pressed or length > self.dead_zone
        shapes.disc(x, y, STICK * scale, theme.raised)
        shapes.ring(x, y, STICK * scale, dp(1.5), theme.line)
        shapes.disc(x, y, self.dead_zone * reach + KNOB * scale, tint(theme.muted, 0.3))
        knob = x - left * share * reach, y + ahead * share * reach
        shapes.disc(*knob, KNOB * scale, theme.accent if lit else theme.muted)
        if pressed:
            shapes.ring(*knob, KNOB * scale + dp(3), dp(2.5), theme.accent)

    def _button(self, shapes: Shapes, name: str, place: tuple[float, float], radius: float) -> list[Word]:
        (x, y), scale, pressed = self._at(place), self._scale, name in self.down
        role = self._role(name)
        shapes.disc(x, y, radius * scale, role if pressed else theme.raised)
        shapes.ring(
            x,
            y,
            radius * scale,
            dp(2.5) if name in self.stops else dp(1.5),
            role if name in self.stops else theme.line,
        )
        if name not in LETTERS:
            return []
        ink = (theme.ink_danger if name in self.stops else theme.ink_accent) if pressed else theme.text
        return [self._word(LETTERS[name], place, radius * 1.15, ink, bold=True)]

    def _bar(self, shapes: Shapes, place: tuple[float, float], share: float, colour: Any) -> None:
        """It fills from the left as far as it is pressed."""
        (x, y), scale = self._at(place), self._scale
        ends = np.array([[x - BAR * scale, y], [x + BAR * scale, y]])
        shapes.line(ends, THICK * scale + 2 * dp(1.5), theme.line)
        shapes.line(ends, THICK * scale, theme.raised)
        if share > 0.02:
            ends[1, 0] = x + (2.0 * min(1.0, share) - 1.0) * BAR * scale
            shapes.line(ends, THICK * scale, colour)


def samples() -> dict[str, Callable[[], Widget]]:
    """None, at rest, pushed, STOP, and one with unknown buttons."""

    def make(**kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            picture = PadPicture(size_hint=(None, None), size=("360dp", "210dp"))
            if kwargs:
                picture.update(**kwargs)
            return picture

        return build

    return {
        "none": make(),
        "at rest": make(dead_zone=0.12),
        "pushed": make(
            left=(0.9, 0.4), right=(0.0, -0.7), triggers=(0.3, 1.0), down={"a", "dpleft", "leftshoulder"}
        ),
        "STOP": make(down={"b", "rightstick"}, dead_zone=0.3),
        "unknown": make(down={"button 7", "button 9"}),
    }
