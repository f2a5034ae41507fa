"""Places on the glass: nothing overlaps, nothing leaves the window, STOP keeps its corner."""

from __future__ import annotations

import itertools

import pytest

from app.layout.arrange import (
    Body,
    Rect,
    StopPlace,
    connect_columns,
    drive,
    form,
    inputs,
    inputs_alone,
    mission,
    more,
    shell,
    topics,
    two_sticks,
)
from tests.looped import looped

SIZES = [(412, 892), (892, 412), (1280, 800), (1920, 1200), (800, 1280), (360, 640), (640, 360), (1024, 600)]
MAY_LIE_ON = {"video", "map", "side", "drawer", "alone"}
"""Grounds that other things float on."""


def screens(width: int, height: int) -> dict[str, dict[str, Rect]]:
    shape, body = form(width, height), shell(width, height)["body"]
    return {
        "mission": mission(body, shape),
        "sheet": mission(body, shape, sheet_open=True),
        "drive": drive(body, shape),
        "switch": drive(body, shape, switch=True),
        "two": two_sticks(body, shape),
        "two_switch": two_sticks(body, shape, switch=True),
        "pulled": drive(body, shape, switch=True, pulled=True),
        "two_pulled": two_sticks(body, shape, switch=True, pulled=True),
        "topics": topics(body, shape),
        "inputs": inputs(body, shape),
        "more": more(body, shape),
    }


DRIVES = ("drive", "switch", "two", "two_switch", "pulled", "two_pulled")
CASES = [(size, name) for size in SIZES for name in ("mission", "more", *DRIVES)]
NOTICES = [(size, name) for size in SIZES for name in ("mission", "sheet", *DRIVES, "topics")]
INPUTS = [(412, 892), (892, 412), (1280, 800), (1920, 1200), (800, 1280)]
"""In smaller windows there is no room beside STOP for a sentence."""


@looped(("size", "name"), CASES)
def test_nothing_overlaps(size: tuple[int, int], name: str) -> None:
    places = screens(*size)[name]
    ground = MAY_LIE_ON if name in DRIVES else MAY_LIE_ON - {"video"}
    # a notice comes and goes, as does the unfolded strip; a bar for the selected point may lie under it on the smallest phone
    things = {key: rect for key, rect in places.items() if key not in {*ground, "notice", "senses_open"}}
    for (one, first), (two, second) in itertools.combinations(things.items(), 2):
        assert not first.overlaps(second), f"{one} {first} overlaps {two} {second}"


@looped(("size", "name"), NOTICES)
def test_the_room_for_notices_leaves_stop_and_what_is_above_it_free(size: tuple[int, int], name: str) -> None:
    places = screens(*size)[name]
    room, stop = places["notice"], places["stop"]
    beside = stop.right <= room.x or room.right <= stop.x
    assert beside or room.y >= stop.top, "what is higher than the room goes on upwards, never down"
    assert min(room.width, room.height) > 0


@looped(("size", "name"), CASES)
def test_a_notice_covers_nothing_that_can_be_touched(size: tuple[int, int], name: str) -> None:
    if "pulled" in name:
        return  # what is said pushes the drawer back
    places = screens(*size)[name]
    touched = {"stop", "stick", "slider", "actions", "modes", "tools", "panel", "tasks"}
    for key in (touched | {"switch", "right_stick", "confirm"}) & places.keys():
        assert not places["notice"].overlaps(places[key]), key


@pytest.mark.parametrize("crowd", [False, True])
@pytest.mark.parametrize("size", INPUTS)
def test_what_is_said_while_inputs_are_set_up_lies_beside_stop_on_nothing(
    size: tuple[int, int], crowd: bool
) -> None:
    inside = shell(*size, talks=True)["body"]
    body = Body(inside.x, inside.y, inside.width, inside.height, crowd)
    places = inputs(body, form(*size))
    said, stop = places["notice"], places["stop"]
    assert isinstance(stop, StopPlace)
    assert body.holds(said)
    assert not said.overlaps(stop)
    assert stop.other is None or not said.overlaps(stop.other)
    assert (said.width >= 190, said.height >= 60) == (True, True)
    assert not said.overlaps(places["list"])
    assert not said.overlaps(places["detail"])
    assert stop.width * stop.height >= 190 * 53 or crowd


@pytest.mark.parametrize("size", SIZES)
def test_a_switch_stands_near_its_words(size: tuple[int, int]) -> None:
    body, shape = shell(*size)["body"], form(*size)
    assert inputs(body, shape)["detail"].width <= 720 or shape == "tall"
    assert inputs_alone(body, shape)["detail"].width <= 720 or shape == "tall"


@looped("name", DRIVES)
@looped("size", SIZES)
def test_the_unfolded_sensors_cover_nothing_that_drives_or_stops(size: tuple[int, int], name: str) -> None:
    places = screens(*size)[name]
    if "senses_open" not in places:
        assert form(*size) == "short", "they are in the drawer"
        return
    for key in {"stop", "stick", "slider", "actions", "right_stick", "confirm"} & places.keys():
        assert not places["senses_open"].overlaps(places[key]), key
    assert places["senses_open"].height >= 126, "three sensors need so much"


@pytest.mark.parametrize("size", [size for size in SIZES if min(size) > 360])
def test_what_stays_until_it_is_dealt_with_has_room_for_a_finger(size: tuple[int, int]) -> None:
    room = screens(*size)["drive"]["notice_low"]
    assert room.width >= 200
    assert room.height >= 53


@looped("name", ["drive", "switch", "two", "two_switch"])
@looped("size", [(892, 412), (740, 360), (640, 360)])
def test_on_its_side_what_is_said_covers_nothing_that_is_touched(size: tuple[int, int], name: str) -> None:
    places = screens(*size)[name]
    for key in {"stop", "stick", "right_stick", "confirm", "handle", "alone"} & places.keys():
        if key != "alone" or "switch" in name:
            assert not places["notice"].overlaps(places[key]), key
            assert not places["notice_low"].overlaps(places[key]), key


@looped("two", [False, True])
@looped("size", [(892, 412), (740, 360), (640, 360)])
def test_the_drawer_covers_no_stick_no_slide_and_not_stop(size: tuple[int, int], two: bool) -> None:
    places = screens(*size)["two_pulled" if two else "pulled"]
    for key in {"stop", "stick", "right_stick", "confirm", "handle", "alone"} & places.keys():
        assert not places["drawer"].overlaps(places[key]), key
    for key in ("top_left", "top_right", "senses", "slider", "actions", "switch"):
        assert places["drawer"].holds(places[key]), key


@pytest.mark.parametrize("size", [(412, 892), (800, 1280)])
def test_with_two_sticks_upright_it_lies_between_the_tape_and_the_sensors(size: tuple[int, int]) -> None:
    places = screens(*size)["two"]
    room = places["notice_low"]
    assert room.height >= 53
    assert places["senses"].top < room.y
    assert room.top < places["top"].y


@looped(("size", "name"), CASES)
def test_nothing_leaves_the_screen(size: tuple[int, int], name: str) -> None:
    body = shell(*size)["body"]
    for key, rect in screens(*size)[name].items():
        assert body.holds(rect), f"{key} {rect} leaves {body}"
        assert rect.width > 0, key
        assert rect.height > 0, key


@looped("size", SIZES)
@looped("name", ["mission", "sheet", *DRIVES])
def test_stop_keeps_the_lower_right_corner(size: tuple[int, int], name: str) -> None:
    stop, body = screens(*size)[name]["stop"], shell(*size)["body"]
    assert body.right - stop.right <= 16
    assert stop.y - body.y <= 16
    assert min(stop.width, stop.height) >= 53


@pytest.mark.parametrize("size", SIZES)
def test_stop_does_not_move_when_the_sheet_opens(size: tuple[int, int]) -> None:
    assert screens(*size)["mission"]["stop"] == screens(*size)["sheet"]["stop"]


def test_a_phone_on_its_side_leaves_the_middle_of_the_map_free() -> None:
    places = mission(shell(892, 412)["body"], "short")
    area, video, bar = places["map"], places["video"], places["selection"]
    free = Rect(bar.x, bar.top, places["tools"].x - bar.x, places["modes"].y - bar.top)
    assert not free.overlaps(video)
    assert free.width * free.height > 0.35 * area.width * area.height
    assert bar.x > video.right


def test_three_buttons_of_46_dp_stand_in_the_drawer_of_a_phone() -> None:
    places = drive(shell(892, 412)["body"], "short", pulled=True)
    assert (places["actions"].height - 2 * 8) / 3 >= 46


def test_the_laser_of_a_phone_has_a_square() -> None:
    for sensed, least in ((False, 180), (True, 136)):
        places = drive(shell(412, 892)["body"], "tall", sensed=sensed)
        assert places["top_left"].width == places["top_left"].height > least


@pytest.mark.parametrize("switch", [False, True])
def test_upright_the_small_sensors_lie_on_no_picture_and_on_no_instrument(switch: bool) -> None:
    places = drive(shell(412, 892)["body"], "tall", switch=switch)
    strip = places["senses"]
    assert strip.top <= places["video"].y
    assert not any(strip.overlaps(places[name]) for name in ("top_left", "top_right", "readouts", "actions"))
    assert min(places["top_left"].height, strip.height) >= 54


@pytest.mark.parametrize("size", SIZES)
def test_the_frame_fills_the_window(size: tuple[int, int]) -> None:
    places = shell(*size)
    assert sum(rect.width * rect.height for rect in places.values()) == pytest.approx(size[0] * size[1])


@pytest.mark.parametrize(
    ("size", "shape"),
    [((412, 892), "tall"), ((892, 412), "short"), ((1280, 800), "wide"), ((800, 1280), "tall")],
)
def test_the_form_follows_the_window(size: tuple[int, int], shape: str) -> None:
    assert form(*size) == shape


def test_a_dense_phone_is_still_a_phone() -> None:
    assert form(2400, 1080, dp=2.625) == "short"
    assert shell(2400, 1080, dp=2.625)["bar"].height == 48 * 2.625


@pytest.mark.parametrize(("width", "columns"), [(412, 1), (892, 2), (1280, 3), (1920, 4)])
def test_cards_stand_side_by_side_where_there_is_room(width: int, columns: int) -> None:
    assert connect_columns(width) == columns


@pytest.mark.parametrize("size", [size for size in SIZES if min(size) > 360])
@pytest.mark.parametrize("name", ["drive", "switch", "two"])
def test_stop_all_beside_stop_covers_nothing(size: tuple[int, int], name: str) -> None:
    room, shape = shell(*size)["body"], form(*size)
    body = Body(room.x, room.y, room.width, room.height, crowded=True)
    made = {
        "drive": drive(body, shape),
        "switch": drive(body, shape, switch=True),
        "two": two_sticks(body, shape),
        "two_switch": two_sticks(body, shape, switch=True),
    }
    stop = made[name]["stop"]
    assert isinstance(stop, StopPlace)
    assert stop.other is not None
    for key, place in made[name].items():
        if key not in {"stop", "video", "notice", "senses_open"}:
            assert not stop.other.overlaps(place), key


@pytest.mark.parametrize("size", [size for size in SIZES if min(size) > 360])
def test_in_gloves_the_maps_modes_and_tools_are_as_large_as_a_target(size: tuple[int, int]) -> None:
    target = 76.0
    room, shape = shell(*size, target=target)["body"], form(*size)
    places = mission(Body(room.x, room.y, room.width, room.height, target=target), shape)
    assert places["modes"].height >= target
    assert min(places["tools"].width, places["tools"].height) >= target
    assert not places["modes"].overlaps(places["tools"])
    assert not places["modes"].overlaps(places["selection"])
    assert room.holds(places["modes"])
    assert room.holds(places["tools"])


@pytest.mark.parametrize("size", SIZES)
def test_in_gloves_bar_and_navigation_are_as_wide_as_a_target(size: tuple[int, int]) -> None:
    places = shell(*size, target=76.0)
    assert places["bar"].height >= 76
    assert min(places["nav"].width, places["nav"].height) >= 76
    assert not places["bar"].overlaps(places["body"])
    assert not places["nav"].overlaps(places["body"])
    assert not places["nav"].overlaps(places["bar"])
