"""Text for people: figures as they are read, and foreign text made safe to show and keep."""

from __future__ import annotations

import math

from bridge.core.units import heading_from_yaw

__all__ = ["heading", "number", "place_sentence", "plain"]


def heading(yaw: float) -> str:
    """A yaw [rad] as the heading that people steer by, as in `090°`: 0 north, clockwise; `?` for what is no number."""
    return f"{round(heading_from_yaw(yaw)) % 360:03d}°" if math.isfinite(yaw) else "?"


def number(value: float) -> str:
    """`value` with one decimal, or shortened from a million on, as in `1e+308`."""
    return f"{value:.1f}" if abs(value) < 1e6 else f"{value:.4g}"


def place_sentence(name: str, x: float, y: float) -> str:
    """A place as people read it: its name and coordinates."""
    return f"{name} at ({number(x)}, {number(y)})"


def plain(text: str, most: int) -> str:
    """`text` on one line, without control and direction characters, cut to `most` characters."""
    line = " ".join(text[: 4 * most].split())
    return "".join(filter(str.isprintable, line))[:most].rstrip()
