"""The crop of a picture: small, of what was seen, and nothing where there is nothing."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from robotside.perception.crop import MAX_BYTES, MAX_EDGE, cropped
from robotside.perception.sighting import Sighting
from tests.robotside.perception.drawn import jpeg


def test_it_shows_what_was_seen_in_its_middle_and_is_small() -> None:
    picture = np.zeros((480, 640, 3), dtype=np.uint8)
    picture[200:300, 300:360] = (250, 30, 30)
    file = cropped(jpeg(picture), Sighting(300 / 640, 200 / 480, 360 / 640, 300 / 480, 0.9, "person"))
    crop = np.asarray(Image.open(io.BytesIO(file)))
    high, wide = crop.shape[:2]
    assert max(high, wide) <= MAX_EDGE
    assert crop[high // 2, wide // 2, 0] > 200
    assert crop[2, 2, 0] < 50


def test_even_noise_over_all_of_a_large_picture_fits_its_bound() -> None:
    noise = np.random.default_rng(1).integers(0, 255, (960, 1280, 3), dtype=np.uint8)
    file = cropped(jpeg(noise, 95), Sighting(0.0, 0.0, 1.0, 1.0, 0.9, "car"))
    assert 0 < len(file) <= MAX_BYTES


@pytest.mark.parametrize("file", [b"", b"\xff\xd8\xff", jpeg(np.zeros((48, 64, 3), np.uint8))[:100]])
def test_of_what_is_no_picture_there_is_none(file: bytes) -> None:
    assert cropped(file, Sighting(0.2, 0.2, 0.4, 0.4, 0.9)) == b""
