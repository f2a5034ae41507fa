"""The mark: thick, of another shape for a thing, a group and the way back, above everything and never over STOP."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from kivy.graphics import Line, Mesh, RoundedRectangle
from kivy.uix.floatlayout import FloatLayout

from app.inputs.switch_access.window.placing import beside
from app.inputs.switch_access.window.ring import CASING, THICK, Ring
from tests.headless import Stage

STOP = (222.0, 10.0, 402.0, 130.0)
THING = (40.0, 300.0, 140.0, 360.0)


@pytest.fixture
def ring(stage: Stage) -> Any:
    root = stage.show(FloatLayout(), (412, 892))
    return Ring(SimpleNamespace(root=root), lambda: [STOP])


def drawn(ring: Ring, kind: type) -> list[Any]:
    return [one for one in ring._group.children if isinstance(one, kind)]


def grown(box: Any) -> Any:
    out = (THICK + CASING) / 2
    return box[0] - out, box[1] - out, box[2] + out, box[3] + out


def test_a_thing_a_group_and_the_way_back_differ_by_shape_and_not_by_colour_alone(ring: Ring) -> None:
    shapes = []
    for kind in ("item", "group", "back"):
        ring.show([THING], kind, "Drive, Mission")
        shapes.append((len(drawn(ring, Line)), len(drawn(ring, Mesh)), ring.said))
    assert len(set(shapes)) == 3
    ring.show([THING], "item", "Drive")
    assert max(line.width for line in drawn(ring, Line)) * 2 >= THICK


def test_it_frames_each_of_a_group_that_lies_apart_and_is_gone_without_one(ring: Ring) -> None:
    far = (200.0, 500.0, 250.0, 560.0)
    ring.show([THING, far], "group", "Two")
    assert ring.frames == [grown(THING), grown(far)], "what lies between them is not marked"
    ring.show([(40.0, 300.0, 140.0, 360.0), (148.0, 300.0, 250.0, 360.0)], "group", "Two")
    assert ring.frames == [grown((40.0, 300.0, 250.0, 360.0))], "neighbours are one"
    ring.show([], "")
    assert ring.box is None
    assert not ring._group.children


def test_stop_is_never_within_a_mark(ring: Ring) -> None:
    for boxes in ([(0.0, 0.0, 412.0, 892.0)], [(5.0, 700.0, 100.0, 760.0), (300.0, 140.0, 400.0, 200.0)]):
        ring.show(boxes, "group", "Map to Report")
        for left, low, right, top in ring.frames:
            apart = right <= STOP[0] or left >= STOP[2] or low >= STOP[3] or top <= STOP[1]
            assert apart, (left, low, right, top)


def test_the_words_stand_where_they_cover_no_neighbour_and_the_way_out_has_some(ring: Ring) -> None:
    above = (0.0, 362.0, 412.0, 420.0)
    ring.show([THING], "group", "Top bar", lambda: [above])
    chip = next(one for one in drawn(ring, RoundedRectangle))
    assert chip.pos[1] + chip.size[1] <= above[1]
    ring.show([THING], "item", "Close", named=True)
    assert ring.said == "Close"
    ring.show([THING], "item", "Drive")
    assert ring.said == ""


def test_the_words_lie_on_nothing_that_they_name(ring: Ring) -> None:
    # as the top bar of a phone: back and its name above, a chip at the right, rows close below
    members = [(0.0, 850.0, 46.0, 890.0), (150.0, 850.0, 250.0, 890.0), (10.0, 790.0, 60.0, 840.0)]
    ring.show(members, "group", "Top bar to Keep a log", lambda: [(62.0, 700.0, 412.0, 845.0)])
    chip = next(one for one in drawn(ring, RoundedRectangle))
    x, y = chip.pos
    for left, low, right, top in members:
        assert x >= right or left >= x + chip.size[0] or y >= top or low >= y + chip.size[1]


def test_at_the_left_edge_of_the_glass_a_frame_does_not_lie_on_what_follows(ring: Ring) -> None:
    ring.show([(0.0, 850.0, 46.0, 890.0)], "group", "Top bar")
    (frame,) = ring.frames
    assert frame[0] > 0
    assert frame[2] + THICK / 2 <= 46


def test_beside_stop_the_frame_gives_way(ring: Ring) -> None:
    for thing in ((100.0, 20.0, 220.0, 120.0), (230.0, 131.0, 400.0, 190.0)):
        left, low, right, top = ring._clear_of_stop(thing)
        clear = right + THICK / 2 <= STOP[0] or low - THICK / 2 >= STOP[3]
        assert clear, (left, low, right, top)


def test_a_pad_stands_where_it_covers_least_and_stop_counts_most() -> None:
    room = (0.0, 0.0, 412.0, 892.0)
    x, y = beside((396.0, 200.0), room, [STOP, (0.0, 400.0, 412.0, 892.0)])
    assert y >= STOP[3], "not over STOP"
    assert y + 200 <= 400, "nor over what it works"
    x, y = beside((396.0, 500.0), room, [STOP, (0.0, 400.0, 412.0, 892.0)])
    assert y >= STOP[3], "where it must cover something it is not STOP"
    assert x >= 0
