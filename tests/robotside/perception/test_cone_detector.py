"""Cones in pictures, and what only looks like one."""

from __future__ import annotations

import io
import math

import msgspec
import numpy as np
import pytest
from PIL import Image, ImageDraw

from robotside.perception.cone_detector import find_cones
from robotside.perception.intruder_tracker import SURE_SCORE
from sim.core.shapes import from_yaw
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.world.tables import Person
from sim.world.world import World
from sim.world.world_files import load

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


def lights(renderer: Renderer, x: float, y: float, away: float, side: float) -> list[bytes]:
    """What a robot sees that looks at (x, y) from `away` [m] on that `side` [deg]: by the world's light, and at dusk."""
    turn = math.radians(side)
    eye = (x + away * math.cos(turn), y + away * math.sin(turn), 0.36)
    noon = renderer.render(View(eye, from_yaw(turn + math.pi), (640, 480), 1.2))
    dusk = (noon * np.array((0.62, 0.50, 0.42))).astype(np.uint8)
    return [jpeg(Image.fromarray(picture)) for picture in (noon, dusk)]


def dressed(colour: tuple[float, float, float]) -> World:
    """The parking lot without cones, and somebody in a jacket of this colour in the middle of it."""
    return msgspec.structs.replace(
        load("parking_lot"), cones=(), lamps=(), people=(Person(x=0.0, y=0.0, colour=colour),)
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "world",
    [load("office"), load("orchard"), dressed((1.0, 0.36, 0.04)), dressed((0.95, 0.45, 0.10))],
    ids=["office", "orchard", "a jacket as orange as a cone", "an orange jacket"],
)
def test_no_person_is_surely_a_cone(world: World) -> None:
    renderer = Renderer(world)
    for person in world.people:
        for away in (2.0, 4.5, 8.0, 15.0):
            for side in range(0, 360, 45):
                for picture in lights(renderer, person.x, person.y, away, side):
                    surest = max((found.score for found in find_cones(picture)), default=0.0)
                    assert surest < SURE_SCORE, (person, away, side)
    renderer.close()


@pytest.mark.slow
def test_a_drawn_cone_is_surely_one_from_near_and_far() -> None:
    world = load("parking_lot")
    renderer = Renderer(msgspec.structs.replace(world, cars=(), lamps=(), cones=world.cones[2:3]))
    cone_ = world.cones[2]
    for away in (1.5, 2.5, 4.0, 6.0):
        for side in range(0, 360, 60):
            found = find_cones(lights(renderer, cone_.x, cone_.y, away, side)[0])
            assert found, (away, side)
            assert found[0].score >= SURE_SCORE, (away, side)
            assert abs(found[0].centre - 0.5) < 0.05, (away, side)
    renderer.close()
