"""Marks on the dial of a course: the way round to it, its knob, and the boat in the middle."""

from __future__ import annotations

import math

import numpy as np
from kivy.metrics import dp

from bridge.core.units import yaw_from_heading
from widgets.core.canvas_ink import tint
from widgets.core.geometry import HULL, dial_point
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["KNOB", "draw_arc", "draw_boat", "draw_knob"]

RAY = 0.6
"""Of the radius, where the line to a course begins."""
KNOB = 0.86
"""Of the radius, where the commanded course's knob is."""
Round = tuple[float, float, float]
"""Middle and radius of a dial [px]."""


def draw_arc(shapes: Shapes, place: Round, start: float, turn: float) -> None:
    """Along the rim from the heading to the course."""
    x, y, radius = place
    bearings = start + np.linspace(0.0, turn, max(int(abs(turn) / 3), 2))
    points = np.array([dial_point(one, radius * 0.97) for one in bearings]) + np.array([x, y])
    shapes.line(points, dp(5), tint(theme.plan, 0.55))


def draw_knob(shapes: Shapes, place: Round, bearing: float, *, filled: bool, held: bool = False) -> None:
    """Of a course: filled where the robot follows it, hollow where it is only asked for."""
    if math.isnan(bearing):
        return
    x, y, radius = place
    across, up = dial_point(bearing, radius * KNOB)
    size = max(radius * 0.12, dp(9)) * (1.25 if held else 1.0)
    inner = dial_point(bearing, radius * RAY)
    ray = np.array([[x + inner[0], y + inner[1]], [x + across, y + up]])
    if filled:
        shapes.line(ray, dp(2.5), theme.plan)
    else:
        shapes.dashes(ray, dp(2.5), theme.plan, period=dp(8), dash=dp(3))
    shapes.disc(x + across, y + up, size + dp(2), theme.raised)
    shapes.disc(x + across, y + up, size, theme.plan if filled else theme.raised)
    shapes.ring(x + across, y + up, size, dp(2.5), theme.plan)
    if held:
        shapes.disc(x + across, y + up, size * 0.5, theme.plan)


def draw_boat(shapes: Shapes, place: Round, heading: float) -> None:
    """In the middle of the dial, its bow where it points."""
    x, y, radius = place
    yaw = yaw_from_heading(heading)
    ahead, right = np.array([math.cos(yaw), math.sin(yaw)]), np.array([math.sin(yaw), -math.cos(yaw)])
    hull = np.array([across * right + along * ahead for across, along in HULL]) * radius * 0.36
    hull = hull + np.array([x, y])
    shapes.polygon([(a, b) for a, b in hull], tint(theme.accent, 0.2))
    shapes.line(np.array([*hull, hull[0]]), dp(2), theme.accent)
