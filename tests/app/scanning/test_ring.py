"""The mark: thick, of another shape for a thing, a group and the way back, above everything and never over STOP."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from kivy.graphics import Line, Mesh
from kivy.uix.floatlayout import FloatLayout

from app.scanning.placing import beside
from app.scanning.ring import THICK, Ring
from tests.headless import Stage

STOP = (222.0, 10.0, 402.0, 130.0)
THING = (40.0, 300.0, 140.0, 360.0)


@pytest.fixture
def ring(stage: Stage) -> Any:
    root = stage.show(FloatLayout(), (412, 892))
    return Ring(SimpleNamespace(root=root), lambda: [STOP])


def drawn(ring: Ring, kind: type) -> list[Any]:
    return [one for one in ring._group.children if isinstance(one, kind)]


def test_a_thing_a_group_and_the_way_back_differ_by_shape_and_not_by_colour_alone(ring: Ring) -> None:
    shapes = []
    for kind in ("item", "group", "back"):
        ring.show([THING], kind, "Drive, Mission")
        shapes.append((len(drawn(ring, Line)), len(drawn(ring, Mesh)), ring.said))
    assert len(set(shapes)) == 3
    ring.show([THING], "item", "Drive")
    assert max(line.width for line in drawn(ring, Line)) * 2 >= THICK


def test_it_frames_all_of_a_group_and_is_gone_without_one(ring: Ring) -> None:
    ring.show([THING, (200.0, 500.0, 250.0, 520.0)], "group", "Two")
    assert ring.box == (40.0, 300.0, 250.0, 520.0)
    ring.show([], "")
    assert ring.box is None
    assert not ring._group.children


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
