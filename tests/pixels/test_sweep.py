"""What the graphics card makes of a laser sweep: its shader tints the dots and leaves out what is beyond the picture."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.arrays import Float32Array
from bridge.msgs.sensor_msgs import LaserScan
from widgets.core.theme import theme
from widgets.sensors.laser_scan import LaserScanView

HALF = math.pi / 2


@pytest.fixture(autouse=True)
def dark():
    theme.name = "dark"
    yield
    theme.name = "dark"


def picture(stage, view: LaserScanView, *ranges: float) -> np.ndarray:
    step = 2 * HALF / (len(ranges) - 1)
    view.show(
        LaserScan(
            angle_min=-HALF, angle_increment=step, range_min=0.1, range_max=10.0, ranges=Float32Array(ranges)
        )
    )
    stage.frames(2)
    return stage.pixels(view)


def places(view: LaserScanView, *ranges: float) -> list[tuple[float, float]]:
    """Where the returns of such a sweep are [px], from the right to the left."""
    x, y, scale = view._place(HALF)
    angles = np.linspace(0.0, math.pi, len(ranges))
    return [
        (x + away * scale * math.cos(angle), y + away * scale * math.sin(angle))
        for away, angle in zip(ranges, angles, strict=True)
    ]


def at(pixels: np.ndarray, x: float, y: float) -> np.ndarray:
    """The pixel at (x, y) counted from the lower left corner, its colour 0 to 1."""
    return pixels[pixels.shape[0] - 1 - math.floor(y), math.floor(x), :3] / 255


@pytest.fixture
def view(stage):
    return stage.show(LaserScanView(state="live", reach=3.0), size=(400, 260))


@pytest.mark.parametrize("palette", ["dark", "sunlight"])
def test_a_dot_has_the_colour_of_its_distance_and_a_return_at_a_bound_that_of_the_farther(
    stage, view, palette
):
    theme.name = palette
    ranges = (0.59, 0.6, 1.19, 1.2, 2.9)
    pixels = picture(stage, view, *ranges)
    roles = (theme.danger, theme.warn, theme.warn, theme.accent, theme.accent)
    for place, role in zip(places(view, *ranges), roles, strict=True):
        assert at(pixels, *place) == pytest.approx(np.array(role[:3]), abs=0.03), (place, role)


def test_a_dot_is_round_and_of_its_size(stage, view):
    ranges = (math.nan, math.nan, 2.0, math.nan, math.nan)
    pixels = picture(stage, view, *ranges)
    x, y = places(view, *ranges)[2]
    around = pixels[pixels.shape[0] - math.floor(y) - 6 : pixels.shape[0] - math.floor(y) + 5, :, :3]
    around = around[:, math.floor(x) - 5 : math.floor(x) + 6] / 255
    covered = (
        np.abs(around - np.array(theme.surface[:3])).sum()
        / np.abs(np.array(theme.accent[:3]) - np.array(theme.surface[:3])).sum()
    )
    assert covered == pytest.approx(math.pi * 2.3**2, rel=0.12)


def test_what_is_beyond_the_picture_or_not_known_has_no_dot(stage, view):
    ranges = (2.0, 3.2, math.inf, math.nan, 2.0)
    pixels = picture(stage, view, *ranges)
    like = np.abs(pixels[..., :3] / 255 - np.array(theme.accent[:3])).max(axis=-1) < 0.05
    rows, columns = np.nonzero(like)
    dots = [places(view, *ranges)[which] for which in (0, 4)]
    assert len(rows)
    for row, column in zip(rows, columns, strict=True):
        here = (column + 0.5, pixels.shape[0] - row - 0.5)
        assert min(math.dist(here, dot) for dot in dots) < 4


def test_free_space_is_tinted_up_to_where_a_return_or_the_picture_ends_it(stage, view):
    pixels = picture(stage, view, 1.0, 1.0, math.inf, math.inf, math.nan)
    x, y, scale = view._place(HALF)

    def tinted(away: float, angle: float) -> bool:
        here = at(pixels, x + away * scale * math.cos(angle), y + away * scale * math.sin(angle))
        return bool(np.abs(here - np.array(theme.surface[:3])).max() > 0.05)

    assert tinted(0.7, math.pi / 8)
    assert not tinted(1.2, math.pi / 8)
    assert tinted(2.7, math.pi * 5 / 8)
    assert not tinted(1.5, math.pi * 15 / 16)


def test_a_sweep_that_fades_fades_whole(stage, view):
    ranges = (2.0, 2.0, 2.0)
    full = picture(stage, view, *ranges)
    view.opacity = 0.0
    stage.frames(2)
    assert not stage.pixels(view)[..., :3].any()
    view.opacity = 1.0
    stage.frames(2)
    assert (stage.pixels(view) == full).all()
