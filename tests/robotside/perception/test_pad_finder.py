"""The pad's tag in pictures that are drawn by geometry, of a camera that looks straight down and hangs askew."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest
from PIL import Image

from robotside.core.pose2 import ORIGIN
from robotside.perception.pad_finder import NOTHING_BELOW, GroundView, PadFinder
from robotside.perception.tag_reader import TAG_SIZE
from sim.world.tag_pattern import CELLS, cells
from tests.lacking import lacking

WIDTH, HEIGHT = 640, 480


@pytest.fixture
def finder() -> PadFinder:
    made = PadFinder()
    if not made.able:
        lacking("pupil_apriltags")
    return made


def view(
    ahead: float, left: float, above: float, *, roll: float = 0.0, pitch: float = 0.0, field: float = 0.84
) -> GroundView:
    """What is seen `above` the ground of a tag that lies so far from the point straight below; z is up, x ahead, y to the left."""
    focal = WIDTH / 2 / math.tan(field / 2)
    u, v = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    rays = np.stack([-(v - HEIGHT / 2) / focal, -(u - WIDTH / 2) / focal, -np.ones_like(u)], axis=-1)
    c, s = math.cos(roll), math.sin(roll)
    about_x = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    c, s = math.cos(pitch), math.sin(pitch)
    about_y = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    rays = rays @ (about_y @ about_x).T
    reach = above / -rays[..., 2]
    forth, aside = reach * rays[..., 0] - ahead, reach * rays[..., 1] - left
    column = np.floor((TAG_SIZE / 2 - aside) / TAG_SIZE * CELLS).astype(int)
    row = np.floor((TAG_SIZE / 2 - forth) / TAG_SIZE * CELLS).astype(int)
    grey = np.full((HEIGHT, WIDTH), 110.0)
    grey[(row >= -1) & (row <= CELLS) & (column >= -1) & (column <= CELLS)] = 240.0
    inner = (row >= 0) & (row < CELLS) & (column >= 0) & (column < CELLS)
    grey[inner] = np.where(np.array(cells(2))[row[inner], column[inner]], 240.0, 15.0)
    grey += np.random.default_rng(3).normal(0.0, 4.0, grey.shape)
    file = io.BytesIO()
    Image.fromarray(np.clip(grey, 0, 255).astype(np.uint8)).save(file, "JPEG", quality=85)
    along = above / (math.cos(roll) * math.cos(pitch))
    return GroundView(file.getvalue(), 1.0, ORIGIN, roll, pitch, along)


@pytest.mark.parametrize(("ahead", "left", "above"), [(0.0, 0.0, 0.6), (0.3, -0.4, 1.5), (-0.5, 0.7, 2.5)])
@pytest.mark.parametrize("field", [0.84, 1.1])
def test_it_lies_where_it_was_put_whatever_the_cameras_field(
    finder: PadFinder, ahead: float, left: float, above: float, field: float
) -> None:
    seen = finder.find(view(ahead, left, above, field=field))
    assert seen is not None
    assert seen[:2] == pytest.approx((ahead, left), abs=0.03)


@pytest.mark.parametrize(("roll", "pitch"), [(0.15, 0.0), (0.0, 0.15), (-0.12, 0.1)])
def test_who_leans_into_the_wind_is_not_off_by_that(finder: PadFinder, roll: float, pitch: float) -> None:
    seen = finder.find(view(0.1, 0.2, 1.5, roll=roll, pitch=pitch))
    assert seen is not None
    assert seen[:2] == pytest.approx((0.1, 0.2), abs=0.04)


def test_without_a_picture_a_tag_or_a_height_there_is_no_pad(finder: PadFinder) -> None:
    assert finder.find(NOTHING_BELOW) is None
    assert finder.find(view(3.0, 0.0, 1.5)) is None
    seen = view(0.0, 0.0, 1.5)
    assert finder.find(GroundView(seen.picture, 1.0, ORIGIN, 0.0, 0.0, math.inf)) is None
    assert finder.find(GroundView(seen.picture[:900], 1.0, ORIGIN, 0.0, 0.0, 1.5)) is None
