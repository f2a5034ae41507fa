"""People, cones, cars and boxes in pictures, each told as what it is."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from robotside.perception.intruder_tracker import SURE_SCORE
from robotside.perception.sighting import Sighting
from robotside.perception.thing_detector import find_things
from sim.world.tables import Barrel, Block, Car, Cone, Person
from sim.world.world import World
from tests.robotside.perception.drawn import cone_ahead, jpeg, person_ahead, seen, world

GREY = np.full((480, 640, 3), 110, dtype=np.uint8)


def sure(picture: bytes) -> list[Sighting]:
    return [found for found in find_things(picture) if found.score >= SURE_SCORE]


def test_a_cone_is_found_with_its_box() -> None:
    (cone,) = sure(cone_ahead(3.0))
    assert cone.kind == "cone"
    assert cone.centre == pytest.approx(0.5, abs=0.02)
    focal = 320 / np.tan(0.6)
    assert cone.bottom * 480 == pytest.approx(240 + focal * 0.36 / 3.0, abs=14)
    assert cone.height * 480 == pytest.approx(0.6 * focal / 3.0, rel=0.25)


@pytest.mark.parametrize("colour", [(1.0, 0.36, 0.04), (0.95, 0.45, 0.10), (0.24, 0.42, 0.66)])
def test_a_person_is_not_a_cone(colour: tuple[float, float, float]) -> None:
    found = sure(seen(world(people=(Person(x=3.5, y=0.0, yaw=170.0, colour=colour),))))
    assert [each.kind for each in found] == ["person"]


def test_each_of_several_things_is_told_as_what_it_is() -> None:
    yard = world(
        people=(Person(x=4.0, y=1.2, yaw=200.0),),
        cones=(Cone(x=3.5, y=-0.2),),
        barrels=(Barrel(x=4.5, y=-1.6),),
    )
    found = sorted(sure(seen(yard)), key=lambda each: each.centre)
    assert [each.kind for each in found] == ["person", "cone", "box"]


@pytest.mark.parametrize("cut", [0, 3, 200, 2000])
def test_a_picture_that_cannot_be_read_shows_none(cut: int) -> None:
    assert find_things(cone_ahead(3.0)[:cut]) == []


@pytest.mark.parametrize("kind", ["PNG", "GIF", "BMP"])
def test_a_picture_of_another_format_than_a_cameras_is_not_decoded(kind: str) -> None:
    out = io.BytesIO()
    Image.open(io.BytesIO(cone_ahead(3.0))).save(out, kind)
    assert find_things(out.getvalue()) == []


def test_a_picture_that_would_take_all_memory_is_not_decoded() -> None:
    assert find_things(jpeg(Image.new("RGB", (8200, 480)))) == []


def test_an_empty_place_shows_nothing() -> None:
    assert find_things(jpeg(GREY)) == []
    assert sure(seen(world())) == []


@pytest.mark.parametrize("size", [(320, 240), (1280, 960), (640, 360), (480, 640)])
def test_a_picture_may_have_any_size_and_shape(size: tuple[int, int]) -> None:
    whole = Image.open(io.BytesIO(cone_ahead(2.5)))
    scale = max(size[0] / whole.width, size[1] / whole.height)
    large = whole.resize((round(whole.width * scale), round(whole.height * scale)))
    left, top = (large.width - size[0]) // 2, (large.height - size[1]) // 2
    picture = large.crop((left, top, left + size[0], top + size[1]))
    best = find_things(jpeg(picture))[0]
    assert best.kind == "cone"
    assert best.centre == pytest.approx(0.5, abs=0.06)


@pytest.mark.slow
@pytest.mark.parametrize("dusk", [False, True], ids=["by day", "at dusk"])
@pytest.mark.parametrize(
    ("kind", "away", "things"),
    [
        ("cone", (1.5, 3.0, 6.0), {"cones": Cone(x=0.0, y=0.0)}),
        ("cone", (1.5, 3.0, 6.0), {"cones": Cone(x=0.0, y=0.0, colour=(0.1, 0.4, 0.8))}),
        ("person", (2.0, 4.0, 7.0), {"people": Person(x=0.0, y=0.0, posture="walking")}),
        ("person", (2.0, 4.0, 7.0), {"people": Person(x=0.0, y=0.0, posture="crouching")}),
        ("car", (4.5, 6.0, 8.0), {"cars": Car(x=0.0, y=0.0, model="sedan", colour=(0.3, 0.5, 0.6))}),
        ("box", (2.0, 4.0, 6.0), {"barrels": Barrel(x=0.0, y=0.0)}),
    ],
    ids=["cone", "blue cone", "walker", "croucher", "car", "barrel"],
)
def test_it_is_told_from_near_and_far_by_day_and_at_dusk(
    kind: str, away: tuple[float, ...], things: dict[str, object], dusk: bool
) -> None:
    yard: World = world(**{name: (thing,) for name, thing in things.items()})
    told = [[each.kind for each in sure(seen(yard, x=-distance, y=0.2, dusk=dusk))] for distance in away]
    assert sum(kinds == [kind] for kinds in told) >= len(away) - 1, told


def test_a_box_that_somebody_has_left_is_one_and_a_pillar_is_none() -> None:
    left = world(blocks=(Block(x=3.0, y=0.0, length=0.6, width=0.5, height=0.5, colour=(0.6, 0.45, 0.3)),))
    pillar = world(blocks=(Block(x=4.0, y=0.0, length=0.5, width=0.5, height=2.6),))
    assert [each.kind for each in sure(seen(left))] == ["box"]
    assert sure(seen(pillar)) == []


def test_somebody_in_front_of_the_camera_is_a_person() -> None:
    assert [each.kind for each in sure(person_ahead(2.0))] == ["person"]
