"""Where things sit on the dive screen, at every size: nothing over anything else, and STOP the largest thing to press."""

from __future__ import annotations

from itertools import combinations

import pytest

from app.layout import arrange
from app.layout.arrange_dive import dive
from app.layout.arrange_drive import drive
from app.layout.rects import Body, Rect, StopPlace

SIZES = [(412, 892), (892, 412), (1280, 800), (1920, 1200), (600, 960), (1024, 640)]
TARGET = 52.9
"""14 mm at 96 dots an inch [px]."""
ON_THE_PICTURE = {"inset", "corner", "motion", "senses", "senses_open", "notice", "notice_low"}
HOLDS = {"panel": ("compass", "horizon"), "hands": ("stick", "lift", "tilt"), "actions": ("stop",)}
HOLDS["drawer"] = ("legs", "panel", "horizon", "senses", "actions")
"""Cards to what lies on them."""


def places(
    size: tuple[int, int], *, crowded: bool, pulled: bool = False
) -> tuple[Body, dict[str, Rect], StopPlace]:
    room = arrange.shell(*size)["body"]
    body = Body(room.x, room.y, room.width, room.height, crowded)
    found, stop = dive(body, arrange.form(*size), pulled=pulled, sensed=pulled)
    return body, found | {"stop": stop}, stop


def touched(found: dict[str, Rect]) -> list[str]:
    """What fingers reach: on a phone's side what is done once is in the drawer."""
    return [name for name in ("stick", "lift", "tilt", "stop", "actions", "handle") if name in found]


@pytest.mark.parametrize("pulled", [False, True], ids=["", "pulled"])
@pytest.mark.parametrize("crowded", [False, True], ids=["alone", "with STOP ALL"])
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_nothing_lies_over_anything_else(size: tuple[int, int], crowded: bool, pulled: bool) -> None:
    body, found, _ = places(size, crowded=crowded, pulled=pulled)
    if arrange.form(*size) == "short":
        found.pop("video")  # all of it lies over the picture
    for name, place in found.items():
        assert body.holds(place), name
    for (one, place), (other, that) in combinations(found.items(), 2):
        if {one, other} & ON_THE_PICTURE and "video" in (one, other):
            continue
        if {"senses_open", "notice", "notice_low"} & {one, other}:
            continue  # it lies over others for as long as it is there, and takes them off the glass
        if other in HOLDS.get(one, ()) or one in HOLDS.get(other, ()):
            continue
        assert not place.overlaps(that), (one, other)


@pytest.mark.parametrize("crowded", [False, True], ids=["alone", "with STOP ALL"])
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_everything_that_is_touched_is_large_enough_and_stop_large(
    size: tuple[int, int], crowded: bool
) -> None:
    for pulled in (False, True):
        _, found, stop = places(size, crowded=crowded, pulled=pulled)
        for name in touched(found):
            least = 40 if name == "handle" else TARGET
            assert min(found[name].width, found[name].height) >= least, name
        assert stop.width * stop.height >= 1.4 * 2 * TARGET * TARGET
    assert found["actions"].height >= 2 * TARGET


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_what_is_said_covers_nothing_that_is_touched(size: tuple[int, int]) -> None:
    _, found, _ = places(size, crowded=False)
    for name in touched(found):
        assert "senses_open" not in found or not found["senses_open"].overlaps(found[name])
        assert not found["notice"].overlaps(found[name])


def test_on_a_phones_side_stop_is_as_large_as_for_a_robot_that_drives() -> None:
    body = Body(0, 0, 816, 360, crowded=True)
    _, stop = dive(body, "short")
    assert stop == drive(body, "short")["stop"]
    assert stop.other is not None
