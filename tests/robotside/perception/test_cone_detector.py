"""Cones in pictures, and what only looks like one."""

from __future__ import annotations

import io

import pytest
from PIL import Image, ImageDraw

from robotside.perception.cone_detector import find_cones

ORANGE, WHITE, GREY, SKY = (245, 100, 25), (235, 235, 230), (110, 112, 115), (150, 185, 225)


def picture(width: int = 640, height: int = 480) -> tuple[Image.Image, ImageDraw.ImageDraw]:
    image = Image.new("RGB", (width, height), GREY)
    draw = ImageDraw.Draw(image)
    draw.rectangle((0, 0, width, height // 2), fill=SKY)
    return image, draw


def cone(
    draw: ImageDraw.ImageDraw, x: float, foot: float, tall: float, orange: tuple[int, int, int] = ORANGE
) -> None:
    wide, narrow = 0.25 * tall, 0.09 * tall

    def band(low: float, high: float, colour: tuple[int, int, int]) -> None:
        a, b = (wide + (narrow - wide) * part for part in (low, high))
        draw.polygon(
            [
                (x - a / 2, foot - low * tall),
                (x + a / 2, foot - low * tall),
                (x + b / 2, foot - high * tall),
                (x - b / 2, foot - high * tall),
            ],
            fill=colour,
        )

    band(0.0, 1.0, orange)
    band(0.42, 0.70, WHITE)
    draw.rectangle((x - 0.18 * tall, foot - 0.05 * tall, x + 0.18 * tall, foot), fill=orange)


def jpeg(image: Image.Image, quality: int = 80) -> bytes:
    out = io.BytesIO()
    image.save(out, "JPEG", quality=quality)
    return out.getvalue()


@pytest.mark.parametrize("tall", [36, 60, 120, 240])
def test_a_cone_is_found_with_its_box(tall: int) -> None:
    image, draw = picture()
    cone(draw, 200, 400, tall)
    found = find_cones(jpeg(image))
    assert len(found) == 1
    assert found[0].centre * 640 == pytest.approx(200, abs=4)
    assert found[0].bottom * 480 == pytest.approx(400, abs=6)
    assert found[0].height * 480 == pytest.approx(tall, rel=0.15, abs=5)
    assert found[0].score > 0.6


def test_a_cone_in_the_shade_is_found() -> None:
    image, draw = picture()
    cone(draw, 300, 350, 100, (150, 62, 18))
    assert len(find_cones(jpeg(image))) == 1


def test_two_cones_are_two_and_the_picture_may_have_any_size() -> None:
    image, draw = picture(320, 240)
    cone(draw, 80, 200, 70)
    cone(draw, 240, 190, 60)
    assert len(find_cones(jpeg(image))) == 2


def test_what_has_no_white_band_or_another_colour_is_no_cone() -> None:
    image, draw = picture()
    draw.rectangle((50, 250, 90, 350), fill=ORANGE)
    draw.rectangle((150, 300, 500, 380), fill=(150, 30, 35))
    draw.rectangle((550, 200, 560, 400), fill=(220, 185, 40))
    draw.ellipse((300, 100, 320, 120), fill=(160, 15, 18))
    assert find_cones(jpeg(image)) == []


def test_a_wide_orange_thing_with_white_is_no_cone() -> None:
    image, draw = picture()
    draw.rectangle((100, 300, 400, 400), fill=ORANGE)
    draw.rectangle((100, 340, 400, 360), fill=WHITE)
    assert find_cones(jpeg(image)) == []


def test_an_empty_place_shows_no_cone() -> None:
    assert find_cones(jpeg(picture()[0])) == []


@pytest.mark.parametrize("cut", [0, 3, 200, 2000])
def test_a_picture_that_cannot_be_read_shows_none(cut: int) -> None:
    image, draw = picture()
    cone(draw, 200, 400, 100)
    assert find_cones(jpeg(image)[:cut]) == []


@pytest.mark.parametrize("kind", ["PNG", "GIF", "BMP"])
def test_a_picture_of_another_format_than_a_cameras_is_not_decoded(kind: str) -> None:
    image, draw = picture()
    cone(draw, 200, 400, 100)
    assert find_cones(jpeg(image))
    out = io.BytesIO()
    image.save(out, kind)
    assert find_cones(out.getvalue()) == []


def test_a_picture_that_would_take_all_memory_is_not_decoded() -> None:
    image, draw = picture(8200, 480)
    cone(draw, 200, 400, 300)
    assert find_cones(jpeg(image.crop((0, 0, 8190, 480))))
    assert find_cones(jpeg(image)) == []
