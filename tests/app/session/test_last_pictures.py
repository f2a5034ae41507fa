"""The last picture of each robot: small, not taken too often, of a bounded number of robots."""

from __future__ import annotations

import numpy as np

from app.link.camera_decoder import Picture
from app.session.last_pictures import MAX_PIXELS, MAX_ROBOTS, MAX_WIDTH, TAKE_PERIOD, LastPictures


class Clock:
    time = 10.0

    def __call__(self) -> float:
        return self.time


def picture(shade: int, width: int = 320, height: int = 240) -> Picture:
    return Picture(1, 0.0, width, height, bytes([shade]) * (4 * width * height))


def test_it_is_small_and_made_anew_only_after_a_while() -> None:
    clock = Clock()
    kept = LastPictures(clock)
    assert kept.of("a") is None
    kept.take("a", picture(1))
    first = kept.of("a")
    assert first is not None
    assert first.width <= MAX_WIDTH
    assert len(first.rgba) == 4 * first.width * first.height
    clock.time += TAKE_PERIOD / 2
    kept.take("a", picture(2))
    assert kept.of("a") is first
    clock.time += TAKE_PERIOD
    kept.take("a", picture(2))
    assert np.frombuffer(kept.of("a").rgba, np.uint8).max() == 2  # type: ignore[union-attr]


def test_as_many_robots_are_kept_as_there_is_room_for() -> None:
    kept = LastPictures(Clock())
    for number in range(MAX_ROBOTS + 1):
        kept.take(str(number), picture(1, 8, 8))
    assert kept.of("0") is None
    assert kept.of(str(MAX_ROBOTS)) is not None


def test_a_picture_whose_bytes_do_not_fit_is_passed_over() -> None:
    kept = LastPictures(Clock())
    kept.take("a", Picture(1, 0.0, 320, 240, b"\0" * 12))
    kept.take("b", Picture(1, 0.0, 0, 0, b""))
    assert kept.of("a") is kept.of("b") is None


def test_a_picture_far_higher_than_wide_is_kept_as_small_as_any() -> None:
    kept = LastPictures(Clock())
    kept.take("a", picture(1, 40, 25_000))
    thumb = kept.of("a")
    assert thumb is not None
    assert thumb.width * thumb.height <= MAX_PIXELS
    assert len(thumb.rgba) == 4 * thumb.width * thumb.height
