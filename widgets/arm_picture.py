"""The picture of an arm from the side: where its joints are, and how they are drawn.

points = side_points((0.0, -1.05, 0.35, 0.70), Links())
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from kivy.metrics import dp

from widgets.geometry import Points
from widgets.shapes import Shapes
from widgets.theme import theme

__all__ = ["Links", "draw_arm", "draw_deck", "side_points"]

FINGER = 0.055
"""Length of a finger of the gripper [m]."""


class Links(NamedTuple):
    """Lengths of an arm whose first joint turns and whose others bend, as ROBOTIS gives them for the OpenMANIPULATOR-X."""

    foot: tuple[float, float] = (0.012, 0.0765)
    """Ahead and above of the foot: the second joint [m]."""
    upper: tuple[float, float] = (0.024, 0.128)
    """From there to the third joint, ahead and up, while all angles are 0 [m]."""
    fore: float = 0.124
    """From there to the fourth joint [m]."""
    hand: float = 0.126
    """From there to the tip [m]."""


def side_points(angles: tuple[float, ...], links: Links) -> Points:
    """Foot, joints and tip in the plane in which the arm bends, ahead and up [m]; `angles` of its four joints [rad]."""
    out, up = links.foot
    places = [(links.foot[0], 0.0), (out, up)]
    bent = 0.0
    rise = math.atan2(links.upper[1], links.upper[0])
    parts = ((math.hypot(*links.upper), rise), (links.fore, 0.0), (links.hand, 0.0))
    for (length, lean), angle in zip(parts, angles[1:], strict=True):
        bent += angle
        out, up = out + length * math.cos(lean - bent), up + length * math.sin(lean - bent)
        places.append((out, up))
    return np.array(places)


def draw_deck(
    shapes: Shapes, foot: tuple[float, float], span: tuple[float, float], scale: float, links: Links
) -> None:
    """The deck under an arm whose foot is there [px], from left to right within `span` [px]; `scale` in pixels to a metre."""
    (x, y), half = foot, 0.045 * scale
    left, right = max(span[0], x - 0.2 * scale), min(span[1], x + 0.42 * scale)
    shapes.line(np.array([[left, y], [right, y]]), dp(2), theme.muted)
    top = y + links.foot[1] * scale * 0.8
    middle = x + links.foot[0] * scale
    corners = [
        (middle - half, y),
        (middle - half * 0.6, top),
        (middle + half * 0.6, top),
        (middle + half, y),
    ]
    shapes.polygon(corners, theme.muted)


def draw_arm(shapes: Shapes, points: Points, scale: float, *, opening: float, touching: bool) -> None:
    """Links, joints, and the two fingers `opening` [m] apart; NaN draws them shut. `points` as from `side_points` [px]."""
    thick = min(max(dp(5), 0.034 * scale), dp(13))
    shapes.line(points[1:4], thick, theme.accent)
    ahead = points[4] - points[3]
    ahead = ahead / max(float(np.hypot(*ahead)), 1e-9)
    across = np.array([-ahead[1], ahead[0]])
    palm = points[4] - ahead * FINGER * scale
    shapes.line(np.array([points[3], palm]), thick * 0.8, theme.accent)
    apart = max(0.0 if math.isnan(opening) else opening * scale / 2, dp(2.5))
    role = theme.warn if touching else theme.text
    shapes.line(np.array([palm - across * apart, palm + across * apart]), dp(3.5), role)
    for side in (-1, 1):
        start = palm + across * apart * side
        shapes.line(np.array([start, start + ahead * FINGER * scale]), dp(3), role)
    shapes.discs(points[1:4], thick * 0.72, theme.text)
    shapes.discs(points[1:4], thick * 0.34, theme.surface)
