"""Pictures of a robot's messages as a beginner draws them with Kivy: the canvas is cleared and filled anew at every message.

They show what ours show, with a label made for each text and an instruction for each mark.
"""

from __future__ import annotations

import math
from typing import Any

from kivy.core.text import Label as CoreLabel
from kivy.graphics import Color, Ellipse, Line, Rectangle
from kivy.uix.widget import Widget

__all__ = ["Compass", "Horizon", "Laser", "Plot", "Scales", "Tape"]


class Naive(Widget):
    """Draws itself at every message."""

    def show(self, msg: Any) -> None:
        """Clear the canvas and draw what the message says."""
        self.canvas.clear()
        with self.canvas:
            self.paint(msg)

    def paint(self, msg: Any) -> None:
        """Draw."""
        raise NotImplementedError

    def word(self, text: str, x: float, y: float) -> None:
        """A text with its middle at (x, y)."""
        label = CoreLabel(text=text, font_size=14)
        label.refresh()
        width, height = label.texture.size
        Rectangle(texture=label.texture, size=label.texture.size, pos=(x - width / 2, y - height / 2))


class Laser(Naive):
    """An ellipse for each return."""

    def paint(self, msg: Any) -> None:
        """Rings, returns, distances."""
        scale = min(self.size) / 12
        x, y = self.center_x, self.y + 20
        Color(0.5, 0.5, 0.5)
        for ring in (2, 4, 6):
            Line(circle=(x, y, ring * scale), width=1.2)
            self.word(f"{ring} m", x, y + ring * scale)
        for number, distance in enumerate(msg.ranges):
            angle = msg.angle_min + number * msg.angle_increment
            Color(*((1, 0.3, 0.3) if distance < 0.6 else (0.3, 0.8, 1)))
            Ellipse(
                pos=(x - math.sin(angle) * distance * scale, y + math.cos(angle) * distance * scale),
                size=(4, 4),
            )


def _yaw(msg: Any) -> float:
    return math.degrees(float(msg.orientation.yaw))


class Compass(Naive):
    """A line for each tick, a label for each direction."""

    def paint(self, msg: Any) -> None:
        """Dial and figure."""
        heading, radius, (x, y) = _yaw(msg), min(self.size) / 2, self.center
        Color(1, 1, 1)
        Line(circle=(x, y, radius), width=1.5)
        for tick in range(0, 360, 10):
            angle = math.radians(tick - heading)
            points = [
                (x + math.sin(angle) * radius * part, y + math.cos(angle) * radius * part)
                for part in (0.9, 1)
            ]
            Line(points=[each for point in points for each in point], width=1.2)
            if tick % 30 == 0:
                self.word(str(tick), x + math.sin(angle) * radius * 0.75, y + math.cos(angle) * radius * 0.75)
        self.word(f"{heading % 360:03.0f}°", x, y)


class Horizon(Naive):
    """Two halves, a ladder, a scale."""

    def paint(self, msg: Any) -> None:
        """Sky, ground and lines."""
        roll, radius, (x, y) = float(msg.orientation.roll), min(self.size) / 2, self.center
        for start, colour in ((-90, (0.2, 0.5, 0.8)), (90, (0.4, 0.3, 0.2))):
            Color(*colour)
            turn = start + math.degrees(roll)
            Ellipse(
                pos=(x - radius, y - radius),
                size=(2 * radius, 2 * radius),
                angle_start=turn,
                angle_end=turn + 180,
            )
        Color(1, 1, 1)
        for rung in (-20, -10, 10, 20):
            height = rung / 40 * radius
            Line(points=[x - 30, y + height, x + 30, y + height], width=1.2)
            self.word(str(abs(rung)), x + 45, y + height)
        for bank in (-60, -45, -30, -20, -10, 0, 10, 20, 30, 45, 60):
            angle = math.radians(bank) + roll
            Line(
                points=[
                    *(x + math.sin(angle) * radius * 0.9, y + math.cos(angle) * radius * 0.9),
                    *(x + math.sin(angle) * radius, y + math.cos(angle) * radius),
                ],
                width=1.5,
            )


class Tape(Naive):
    """A line for each tick, a label for each direction."""

    def paint(self, msg: Any) -> None:
        """The strip."""
        heading, per_degree = _yaw(msg), self.width / 75
        Color(1, 1, 1)
        first = math.ceil((heading - 37) / 5) * 5
        for tick in range(first, math.floor(heading + 37) + 1, 5):
            x = self.center_x + (tick - heading) * per_degree
            Line(points=[x, self.top - 8, x, self.top - 20], width=1.2)
            if tick % 15 == 0:
                self.word(str(tick % 360), x, self.y + 16)


class Scales(Naive):
    """Three scales with ticks, a pointer and two labels each."""

    def paint(self, msg: Any) -> None:
        """Turn, bank, pitch."""
        values = (msg.angular_velocity.z, msg.orientation.roll, msg.orientation.pitch)
        for number, (name, value) in enumerate(zip(("TURN", "BANK", "PITCH"), values, strict=True)):
            y = self.top - (number + 0.5) * self.height / 3
            Color(1, 1, 1)
            self.word(name, self.x + 30, y + 12)
            self.word(f"{math.degrees(value):.0f}°", self.right - 30, y + 12)
            Line(points=[self.x + 12, y - 8, self.right - 12, y - 8], width=1.2)
            for tick in range(9):
                x = self.x + 12 + tick * (self.width - 24) / 8
                Line(points=[x, y - 12, x, y - 4], width=1.2)
            Color(0.3, 0.8, 1)
            Ellipse(pos=(self.center_x - value * 80 - 6, y - 14), size=(12, 12))


class Plot(Naive):
    """A line through all that came, a label for each tick."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._values: list[float] = []

    def paint(self, msg: Any) -> None:
        """Axes and line."""
        self._values = [*self._values[-299:], msg.twist.twist.linear.x]
        Color(0.5, 0.5, 0.5)
        for tick in range(5):
            y = self.y + 20 + tick * (self.height - 40) / 4
            Line(points=[self.x + 40, y, self.right - 10, y], width=1)
            self.word(f"{tick / 2 - 1:.1f}", self.x + 20, y)
        Color(0.3, 0.8, 1)
        step, points = (self.width - 50) / 300, []
        for number, value in enumerate(self._values):
            points += [self.x + 40 + number * step, self.center_y + value * (self.height - 40) / 2]
        if len(points) > 2:
            Line(points=points, width=1.2)
