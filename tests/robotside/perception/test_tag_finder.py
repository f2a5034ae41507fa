"""The dock's tag in pictures that are drawn by geometry, against where it was put."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest
from PIL import Image

from bridge.core.units import wrap
from robotside.core.pose2 import Pose2
from robotside.perception.dock_finder import Expected
from robotside.perception.tag_finder import TAG_SIZE, TagFinder
from sim.world.tag_pattern import CELLS, cells
from tests.lacking import lacking

FIELD, WIDTH, HEIGHT, AHEAD = 1.1, 640, 480, 0.1
FOCAL = WIDTH / 2 / math.tan(FIELD / 2)


@pytest.fixture
def finder() -> TagFinder:
    made = TagFinder(FIELD, AHEAD)
    if not made.able:
        lacking("pupil_apriltags")
    return made


def picture(at: Pose2, *, tag: int = 7, above: float = 0.3, noise: float = 4.0) -> bytes:
    """What a camera at the origin sees of a tag at `at`, which looks into the dock, `above` the camera."""
    u, v = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    left, up = -(u - WIDTH / 2) / FOCAL, -(v - HEIGHT / 2) / FOCAL
    c, s = math.cos(at.yaw), math.sin(at.yaw)
    away = (c * at.x + s * at.y) / (c + s * left)  # along x, where each ray meets the tag's plane
    aside = -s * (away - at.x) + c * (away * left - at.y)
    over = away * up - above
    column = np.floor((TAG_SIZE / 2 - aside) / TAG_SIZE * CELLS).astype(int)
    row = np.floor((TAG_SIZE / 2 - over) / TAG_SIZE * CELLS).astype(int)
    grey = np.full((HEIGHT, WIDTH), 110.0)
    plate = (row >= -1) & (row <= CELLS) & (column >= -1) & (column <= CELLS) & (away > 0)
    grey[plate] = 240.0
    inner = plate & (row >= 0) & (row < CELLS) & (column >= 0) & (column < CELLS)
    white = np.array(cells(tag))
    grey[inner] = np.where(white[row[inner], column[inner]], 240.0, 15.0)
    grey += np.random.default_rng(3).normal(0.0, noise, grey.shape)
    file = io.BytesIO()
    Image.fromarray(np.clip(grey, 0, 255).astype(np.uint8)).save(file, "JPEG", quality=85)
    return file.getvalue()


def expected(at: Pose2) -> Expected:
    return Expected(Pose2(at.x + AHEAD + 0.2, at.y - 0.2, at.yaw + 0.17), 0.9, 0.6)


@pytest.mark.parametrize(
    "at", [Pose2(2.0, 0.0, 0.0), Pose2(2.0, 0.3, 0.3), Pose2(1.2, -0.2, -0.4), Pose2(2.4, -0.5, 0.0)]
)
def test_from_two_metres_it_is_where_it_was_put(finder: TagFinder, at: Pose2) -> None:
    seen = finder.find(picture(at), expected(at))
    assert seen is not None
    assert seen.by == "tag"
    assert seen.pose.x == pytest.approx(at.x + AHEAD, abs=0.06)
    assert seen.pose.y == pytest.approx(at.y, abs=0.03)
    assert abs(wrap(seen.pose.yaw - at.yaw)) < max(0.06, 2.5 * seen.turn)


def test_its_direction_is_surer_from_nearby(finder: TagFinder) -> None:
    near, far = (finder.find(picture(Pose2(x, 0.0, 0.1)), expected(Pose2(x, 0.0, 0.1))) for x in (1.1, 2.4))
    assert near is not None
    assert far is not None
    assert near.turn < far.turn


def test_a_tag_elsewhere_or_of_another_number_is_no_dock(finder: TagFinder) -> None:
    at = Pose2(2.0, 0.0, 0.0)
    assert finder.find(picture(at), expected(Pose2(2.0, 1.6, 0.0))) is None
    assert finder.find(picture(Pose2(2.0, 0.0, 0.0), above=3.0), expected(at)) is None


def test_no_tag_no_picture_and_a_broken_one_show_nothing(finder: TagFinder) -> None:
    at = Pose2(2.0, 0.0, 0.0)
    assert finder.find(b"", expected(at)) is None
    assert finder.find(b"\xff\xd8 no picture", expected(at)) is None
    assert finder.find(picture(at)[:2000], expected(at)) is None
