"""Boxes with round corners: only what can be seen is drawn, and the corners never reach beyond the box."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from kivy.factory import Factory
from kivy.graphics import BorderImage, Color
from kivy.lang import Builder
from kivy.uix.widget import Widget

from widgets.core import rounded
from widgets.core.rounded import MAX_RADIUS, MAX_TEXTURES, RIM, Corners, Rounded
from widgets.core.theme import theme

RED = (1, 0, 0, 0.5)


def coverage(corners: Corners) -> np.ndarray:
    """Of each pixel, 0 to 1, lowest row first."""
    return np.array([list(row) for row in rounded.coverage(corners)]) / 255


def image(box: Rounded) -> Any:
    (found,) = (part for part in box.children if isinstance(part, BorderImage))
    return found


def coverage_of(box: Rounded) -> np.ndarray:
    """Of the picture that it draws."""
    radii = box._corners
    assert radii is not None
    return coverage(radii)


def corners(box: Rounded) -> float:
    """Of the picture's part that is not stretched [px]."""
    border = image(box).border[0] - RIM
    return 0 if coverage_of(box)[-1 - RIM, RIM] == 1 else border


@pytest.mark.parametrize(
    ("rgba", "size"),
    [((1, 0, 0, 0), (100, 50)), (RED, (0, 50)), (RED, (100, 0)), (RED, (-4, 50))],
    ids=["clear", "without width", "without height", "less than nothing"],
)
def test_what_cannot_be_seen_is_not_drawn(rgba: tuple[float, ...], size: tuple[float, float]) -> None:
    box = Rounded(rgba, size=size)
    assert not box.drawn
    assert not box.children
    box.rgba, box.size = RED, (100, 50)
    assert box.drawn
    box.rgba, box.size = rgba, size
    assert not box.children


def test_a_box_is_one_picture_in_one_colour() -> None:
    box = Rounded(RED, (10, 20), (100, 50), [8])
    colour = next(part for part in box.children if isinstance(part, Color))
    assert list(colour.rgba) == list(RED)
    assert (tuple(image(box).pos), tuple(image(box).size)) == (
        (10 - RIM, 20 - RIM),
        (100 + 2 * RIM, 50 + 2 * RIM),
    )
    box.pos, box.size, box.rgba = (1, 2), (30, 40), (0, 1, 0, 1)
    assert (tuple(image(box).pos), tuple(image(box).size)) == (
        (1 - RIM, 2 - RIM),
        (30 + 2 * RIM, 40 + 2 * RIM),
    )
    assert (box.pos, box.size, box.rgba) == ((1, 2), (30, 40), [0, 1, 0, 1])
    assert list(colour.rgba) == [0, 1, 0, 1]


def test_a_box_that_only_moves_takes_its_picture_along() -> None:
    box = Rounded(RED, (10, 20), (100, 50), [8])
    box.pos = (1, 2)
    assert tuple(image(box).pos) == (1 - RIM, 2 - RIM)
    assert tuple(image(box).size) == (100 + 2 * RIM, 50 + 2 * RIM)


@pytest.mark.parametrize(
    ("size", "radius", "drawn"),
    [
        ((100, 50), [8], 8),
        ((100, 50), [40], 25),
        ((101, 27), [13.5], 13),
        ((9, 80), [11], 4),
        ((100, 50), [-1], 0),
    ],
)
def test_corners_are_no_larger_than_the_box(
    size: tuple[float, float], radius: list[float], drawn: float
) -> None:
    assert corners(Rounded(RED, (0, 0), size, radius)) == drawn
    box = Rounded(RED, (0, 0), (1000, 1000), [0])
    box.radius, box.size = radius, size
    assert corners(box) == drawn


def test_corners_have_a_greatest_size() -> None:
    assert corners(Rounded(RED, (0, 0), (9000, 9000), [4000])) == MAX_RADIUS


def test_boxes_alike_share_a_picture_and_more_kinds_than_are_kept_are_drawn() -> None:
    one, other = (Rounded(RED, (0, 0), (50 + n, 50), [7]) for n in range(2))
    assert image(one).texture is image(other).texture
    for radius in range(MAX_TEXTURES + 5):
        assert corners(Rounded(RED, (0, 0), (500, 500), [radius])) == radius
    assert image(one).texture is not None


@pytest.mark.parametrize("radius", [0, 1, 14])
def test_what_is_stretched_lies_within_full_pixels(radius: int) -> None:
    """A picture is smoothed between its pixels: beside clear ones the stretched middle would fade out."""
    picture, border = coverage((radius,) * 4), int(image(Rounded(RED, (0, 0), (90, 90), [radius])).border[0])
    middle = len(picture) // 2
    assert len(picture) == 2 * border + 1
    assert (picture[middle, middle - 1 : middle + 2] == 1).all()
    assert (picture[middle - 1 : middle + 2, middle] == 1).all()


def test_a_corner_is_a_quarter_of_a_disc() -> None:
    picture = coverage((20, 20, 20, 20))
    side = 2 * 20 + 1
    assert picture.shape == (side + 2 * RIM, side + 2 * RIM)
    missing = side**2 - picture.sum()
    assert missing == pytest.approx((4 - np.pi) * 20**2, rel=0.02)
    assert not picture[0].any()
    assert not picture[:, -1].any()
    for turned in (picture[::-1], picture[:, ::-1], picture.T):
        assert np.array_equal(turned, picture)


def test_each_corner_has_its_own_radius_from_the_upper_left_on() -> None:
    picture = coverage((6, 0, 0, 0))
    assert picture[-1 - RIM, RIM] < 0.5, "the highest row is the last"
    assert picture[-1 - RIM, -1 - RIM] == picture[RIM, RIM] == picture[RIM, -1 - RIM] == 1
    assert coverage((0, 6, 0, 0))[-1 - RIM, -1 - RIM] < 0.5
    assert coverage((0, 0, 6, 0))[RIM, -1 - RIM] < 0.5
    assert coverage((0, 0, 0, 6))[RIM, RIM] < 0.5


def test_a_rule_makes_one_that_follows_its_widget(stage: Any) -> None:
    Builder.load_string("""
<RoundedInARule@Widget>:
    canvas.before:
        Rounded:
            rgba: theme.accent
            pos: self.pos
            size: self.size
            radius: [theme.corner]
""")
    widget: Widget = stage.show(Factory.RoundedInARule(), (90, 40))
    (box,) = (part for part in widget.canvas.before.children if isinstance(part, Rounded))
    assert len(widget.canvas.before.children) == 1, "its parts are in it alone"
    assert (box.size, box.rgba) == ((90, 40), pytest.approx(theme.accent))
    widget.pos, widget.width = (5, 6), 70
    stage.frames(2)
    assert (box.pos, box.size) == ((5, 6), (70, 40))
