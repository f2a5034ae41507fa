"""Picture of an arm from the side: places of its joints, and their drawing.

points = side_points((0.0, -1.05, 0.35, 0.70), Links())
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from kivy.metrics import dp, sp

from widgets.core.canvas_ink import Word
from widgets.core.geometry import Points, dial_point
from widgets.core.language import tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = [
    "Links",
    "Side",
    "draw_aim",
    "draw_arm",
    "draw_deck",
    "draw_turn",
    "moved_tip",
    "side_points",
    "turn_words",
]

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


class Side(NamedTuple):
    """Projection of the plane in which an arm bends onto the screen."""

    x: float
    """Of the foot [px]."""
    y: float
    """The same."""
    scale: float
    """Pixels to a metre."""
    box: tuple[float, float, float, float]
    """Left, low, right and top edge of the picture [px]."""

    def at(self, place: Sequence[float]) -> tuple[float, float]:
        """Position on the screen [px] of a place ahead of and above the foot [m]."""
        return self.x + float(place[0]) * self.scale, self.y + float(place[1]) * self.scale

    def point(self, at: Sequence[float]) -> tuple[float, float]:
        """Distance ahead of and above the foot [m] of a place on the screen [px]; one beyond the picture is at its edge."""
        left, low, right, top = self.box
        x, y = min(max(float(at[0]), left), right), min(max(float(at[1]), low), top)
        return (x - self.x) / self.scale, (y - self.y) / self.scale


def moved_tip(
    tip: Sequence[float], angles: tuple[float, ...], aim: tuple[float, float], links: Links
) -> tuple[float, float, float]:
    """Where the tip, which is at `tip` in `base_link` [m] with the joints at `angles` [rad], is to go in there.

    `aim` is ahead of and above the foot in the plane of the arm [m].
    """
    out, up = side_points(angles, links)[-1]
    more = aim[0] - float(out)
    turn = angles[0]
    return (
        tip[0] + more * math.cos(turn),
        tip[1] + more * math.sin(turn),
        tip[2] + aim[1] - float(up),
    )


def side_points(angles: tuple[float, ...], links: Links) -> Points:
    """Foot, joints and tip in the plane in which the arm bends, ahead and up [m]; `angles` of its joints [rad], four at least."""
    out, up = links.foot
    places = [(links.foot[0], 0.0), (out, up)]
    bent = 0.0
    rise = math.atan2(links.upper[1], links.upper[0])
    parts = ((math.hypot(*links.upper), rise), (links.fore, 0.0), (links.hand, 0.0))
    for (length, lean), angle in zip(parts, angles[1:4], strict=True):
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


def draw_aim(shapes: Shapes, tip: Sequence[float], aim: tuple[float, float], colour: Sequence[float]) -> None:
    """Where the tip is wanted, and the way there [px]."""
    x, y = aim
    shapes.dashes(np.array([[tip[0], tip[1]], [x, y]]), dp(2), colour, period=dp(8), dash=dp(4))
    shapes.ring(x, y, dp(9), dp(2), colour)
    for across, up in ((1.0, 0.0), (0.0, 1.0)):
        reach = np.array([across, up]) * dp(14)
        shapes.line(np.array([aim - reach, aim + reach]), dp(1.5), colour)


def draw_turn(
    shapes: Shapes,
    dial: tuple[float, float, float],
    angle: float,
    bearing: float,
    *,
    roomy: bool,
    rolls: bool,
) -> Word:
    """How far the foot is turned, seen from above, on a `dial` of middle and radius [px], or is to be: NaN where it stays [rad].

    With `rolls` the same of the hand, seen from behind.
    """
    x, y, radius = dial
    turning = not math.isnan(bearing)
    shapes.disc(x, y, radius, theme.raised)
    shapes.ring(x, y, radius - dp(0.75), dp(1.5), theme.plan if turning else theme.line)
    clockwise = 1 if rolls else -1
    degrees = math.degrees(angle)
    end = dial_point(clockwise * degrees, radius * 0.8)
    shapes.line(np.array([[x, y], [x + end[0], y + end[1]]]), dp(3), theme.accent)
    if turning:
        degrees = math.degrees(bearing)
        end = dial_point(clockwise * degrees, radius * 0.8)
        shapes.line(np.array([[x, y], [x + end[0], y + end[1]]]), dp(3), theme.plan)
    shapes.disc(x, y, dp(2.5), theme.text)
    text = turn_words(degrees, roomy=roomy, rolls=rolls)
    role = theme.plan if turning else theme.muted
    return Word(text, x + radius + dp(6), y, sp(12.5 if roomy else 11), role, anchor=(0, 0.5))


def turn_words(degrees: float, *, roomy: bool, rolls: bool) -> str:
    """How far the foot is turned, to the left positive, or with `rolls` the hand, clockwise from behind positive [°]."""
    turned = degrees if rolls else -degrees
    side = "" if abs(degrees) < 0.5 else tr("right") if turned > 0 else tr("left")
    word, figure = (tr("hand") if rolls else tr("foot")), f"{abs(degrees):.0f}°"
    return f"{word} {figure} {side}".rstrip() if roomy else f"{word} {figure}{side[:1].upper()}"
