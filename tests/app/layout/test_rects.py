"""STOP has one rectangle for a body and a hand, whatever the screen; a left hand has everything in a mirror."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.layout.arrange import drive, form, inputs, mission, more, shell, tasks, topics, two_sticks
from app.layout.arrange_dive import dive
from app.layout.arrange_panels import panels
from app.layout.rects import Body, Rect, StopPlace, mirrored
from app.screens.replay.places import replay
from tests.looped import looped

SIZES = [(412, 892), (892, 412), (1280, 800), (1920, 1200), (800, 1280), (740, 360), (1024, 600)]
GLOVE = 76.0
"""Of a target in gloves [px]."""


def body_of(size: tuple[int, int], *, left: bool, crowd: bool = False, target: float = 0.0) -> Body:
    room = shell(*size, left_hand=left)["body"]
    return Body(room.x, room.y, room.width, room.height, crowd, left, target)


def screens(body: Body, shape: str) -> dict[str, dict[str, Rect]]:
    dived = {pulled: dive(body, shape, pulled=pulled) for pulled in (False, True)}
    return {
        "mission": mission(body, shape),
        "sheet": mission(body, shape, sheet_open=True),
        "drive": drive(body, shape),
        "switch": drive(body, shape, switch=True),
        "pulled": drive(body, shape, pulled=True),
        "two": two_sticks(body, shape),
        "two switch": two_sticks(body, shape, switch=True),
        "dive": dived[False][0] | {"stop": dived[False][1]},
        "dive pulled": dived[True][0] | {"stop": dived[True][1]},
        "panels": panels(body, shape),
        "panels edited": panels(body, shape, editing=True),
        "tasks": tasks(body, shape),
        "topics": topics(body, shape),
        "inputs, setup": inputs(body, shape),
        "more, fleet": more(body, shape),
        "replay": replay(body, shape),
    }


@looped("target", [0.0, GLOVE])
@looped("left", [False, True])
@looped("size", SIZES)
def test_stop_is_the_same_rectangle_on_every_screen_and_no_smaller_beside_stop_all(
    size: tuple[int, int], left: bool, target: float
) -> None:
    shape, seen = form(*size), set()
    for crowd in (False, True):
        body = body_of(size, left=left, crowd=crowd, target=target)
        for name, places in screens(body, shape).items():
            stop = places["stop"]
            assert isinstance(stop, StopPlace), name
            seen.add(tuple(round(value, 6) for value in (stop.x, stop.y, stop.width, stop.height)))
            assert body.holds(stop), name
            assert (stop.other is not None) == crowd, name
            if stop.other is not None:
                assert body.holds(stop.other), name
                assert not stop.other.overlaps(stop), name
                assert min(stop.other.width, stop.other.height) >= max(53, target), name
                assert stop.other.width * stop.other.height < stop.width * stop.height, name
    assert len(seen) == 1, seen
    x, y, width, height = seen.pop()
    edge = x - body.x if left else body.right - x - width
    assert (edge, y - body.y) == pytest.approx((12, 12))
    assert min(width, height) >= max(80, target)


@looped("target", [0.0, GLOVE])
@looped("left", [False, True])
@looped("size", SIZES)
def test_stop_all_stays_where_it_is_on_a_screen_whatever_is_opened_or_edited_there(
    size: tuple[int, int], left: bool, target: float
) -> None:
    shape = form(*size)
    seen = screens(body_of(size, left=left, crowd=True, target=target), shape)
    for name, opened in {
        "mission": "sheet",
        "drive": "pulled",
        "two": "two switch",
        "dive": "dive pulled",
        "panels": "panels edited",
    }.items():
        stop, other = seen[name]["stop"], seen[opened]["stop"]
        assert isinstance(stop, StopPlace)
        assert stop == other, (name, opened)
    edited = seen["panels edited"]
    stop = edited["stop"]
    assert isinstance(stop, StopPlace)
    assert stop.other is not None
    assert shape == "tall" or not edited["board"].overlaps(stop.other)
    assert not edited["side"].overlaps(stop.other)


@looped("crowd", [False, True])
@looped("size", SIZES)
def test_for_a_left_hand_nothing_lies_over_stop_or_over_stop_all(size: tuple[int, int], crowd: bool) -> None:
    shape, body = form(*size), body_of(size, left=True, crowd=crowd)
    grounds = {"video", "map", "side", "drawer", "alone", "stop", "senses_open"}
    for name, places in screens(body, shape).items():
        stop = places["stop"]
        assert isinstance(stop, StopPlace)
        for slot, place in places.items():
            place = Rect(place.x + 1e-6, place.y, place.width - 2e-6, place.height)  # noqa: PLW2901 - what only touches
            if slot in grounds or (slot == "notice" and name in ("replay", "more, fleet")):
                continue
            assert not place.overlaps(stop), (name, slot)
            if stop.other is not None and slot != "notice":
                assert not place.overlaps(stop.other), (name, slot)


@looped("size", SIZES)
def test_the_other_hand_sees_the_same_in_a_mirror(size: tuple[int, int]) -> None:
    shape, body = form(*size), body_of(size, left=True)
    for name, places in screens(body, shape).items():
        if name.startswith("two"):
            continue  # whose sticks keep their sides
        seen = screens(replace(body, left_hand=False), shape)[name]
        for slot, place in places.items():
            there, here = mirrored(place, body), seen[slot]
            assert (there.x, there.y) == pytest.approx((here.x, here.y)), (name, slot)
            assert (there.width, there.height) == (here.width, here.height), (name, slot)


@looped("switch", [False, True])
@looped("size", SIZES)
def test_of_two_sticks_each_stays_under_its_thumb(size: tuple[int, int], switch: bool) -> None:
    for left in (False, True):
        places = two_sticks(body_of(size, left=left), form(*size), switch=switch)
        stick, other = places["stick"], places["right_stick"]
        assert stick.right < other.x
        assert (places["stop"].right <= stick.x) == (left and form(*size) != "tall")
        assert not any(one.overlaps(places["stop"]) for one in (stick, other))


def test_with_one_stick_the_left_hand_stops_and_the_right_one_drives() -> None:
    for size in SIZES:
        places = drive(body_of(size, left=True), form(*size))
        assert places["stop"].right < places["stick"].x


def test_the_navigation_of_a_left_hand_is_at_the_right_and_leaves_the_rest_free() -> None:
    for size in SIZES:
        places = shell(*size, left_hand=True)
        nav, body = places["nav"], places["body"]
        assert form(*size) == "tall" or nav.x == body.right
        assert not nav.overlaps(body)
        assert body.right <= size[0]
