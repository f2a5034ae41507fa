"""Map and picture of the mission screen change places."""

from __future__ import annotations

from typing import Any

import pytest

from app.layout.rects import Rect
from tests.app.glass import Glass


@pytest.fixture
def mission(driving: Glass) -> Any:
    """The mission screen on a tablet."""
    driving.app.show("mission")
    screen = driving.app.screens["mission"]
    screen.arrange(Rect(76, 0, 1204, 744), "wide", 1.0)
    return screen


def place(widget: Any) -> Rect:
    return Rect(*widget.pos, *widget.size)


def test_a_tap_on_the_picture_swaps_and_one_on_the_small_map_swaps_back(driving, mission):
    small, large, view = place(mission.video), place(mission.map), mission.map.view
    driving.tap(mission.swap.frame)
    assert (place(mission.map), place(mission.video)) == (small, large)
    driving.tap(mission.swap.frame)
    assert (place(mission.map), place(mission.video)) == (large, small)
    assert mission.map.view.turn_scale == pytest.approx(view.turn_scale)
    assert mission.map.view.offset == pytest.approx(view.offset)


def test_nothing_of_a_large_map_is_touched_while_it_is_small(driving, mission):
    mission.mode = "points"
    driving.tap(mission.swap.frame)
    assert mission.mode == "view"
    assert mission.ids.modes.disabled
    assert mission.ids["zoom_in"].parent is None
    view = mission.map.view
    x, y = mission.map.center
    driving.stage.drag([(x, y), (x + 40, y), (x + 500, y)])
    assert mission.map.view == view
    assert driving.app.session.mission.draft.points == ()


def test_the_small_one_lies_above_the_large_one(driving, mission):
    driving.tap(mission.swap.frame)
    ids = mission.ids
    assert (mission.video.parent, mission.map.parent) == (ids.ground, ids.floats)
    assert ids.floats.children[-1] is mission.map
    driving.tap(mission.swap.frame)
    assert (mission.map.parent, mission.video.parent) == (ids.ground, ids.floats)


def test_the_sign_for_a_tap_is_seen_on_whatever_is_small(driving, mission):
    for _ in range(2):
        assert mission.ids.floats.children[0] is mission.swap.frame
        assert place(mission.swap.frame) == place(mission.map if mission.swap.large else mission.video)
        driving.tap(mission.swap.frame)


def test_what_is_to_be_edited_on_the_map_makes_it_large(driving, mission):
    large = place(mission.map)
    driving.tap(mission.swap.frame)
    mission.mode = "points"
    assert place(mission.map) == large
    assert mission.mode == "points"
    assert mission.ids["zoom_in"].parent is not None
    mission.mode = "view"
    driving.tap(mission.swap.frame)
    mission._maps.toggle_card(mission)
    assert mission.card.open
    assert not mission.swap.large
    assert place(mission.map) == large
