"""Places on the map: a card asks for them, and the map stays as it was."""

from __future__ import annotations

from typing import Any

import pytest

from app.screens.mission.place_card import PlaceCard
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.tasks.place_list import SOME

LAB = SOME[2]
SIZES = [(412, 892), (892, 412), (1280, 800)]


@pytest.fixture
def mission(driving: Glass, robot: FakeRobot) -> Any:
    """The mission screen of a robot that knows some places."""
    robot.know(*SOME)
    driving.app.show("mission")
    screen = driving.app.screens["mission"]
    driving.until(lambda: len(screen.map.places) == len(SOME), "no places")
    driving.stage.frames(3)
    return screen


def kept(robot: FakeRobot) -> list[Any]:
    return [request.place for name, request in robot.asked if name == "/places/set"]


def stay_on(glass: Glass, mission: Any, x: float, y: float) -> None:
    """A finger stays at (x, y) [px of the map]."""
    touch = glass.stage.touch(*mission.map.to_window(x, y))
    touch.touch_down()
    glass.stage.run_for(0.8)
    touch.touch_up()
    glass.stage.frames(3)


def card_of(mission: Any) -> PlaceCard:
    assert isinstance(mission.card.shown, PlaceCard)
    return mission.card.shown


@pytest.mark.parametrize("mode", ["view", "points", "place"])
def test_a_finger_that_stays_is_asked_for_a_place_over_the_map_whose_mode_stays(
    driving: Glass, robot: FakeRobot, mission: Any, mode: str
) -> None:
    mission.mode = mode
    x, y, wide, high = mission.map.free_box
    wanted = mission.map.view.to_world(x + wide * 0.7, y + high * 0.6)
    stay_on(driving, mission, x + wide * 0.7, y + high * 0.6)
    card = card_of(mission)
    assert (driving.app.shell.screen, mission.mode) == ("mission", mode)
    assert card.save.disabled
    assert ("New place", "place") in [mark[2:] for mark in mission.map.places]
    card.form.set(name="Office 13", kind="office")
    driving.stage.run_for(0.2)
    driving.tap(card.save)
    assert robot.until(lambda: kept(robot))
    place = kept(robot)[0]
    assert (place.id, place.name, place.kind) == (0, "Office 13", "office")
    assert (place.x, place.y) == pytest.approx(wanted)
    assert (driving.app.shell.screen, mission.mode, mission.card.shown) == ("mission", mode, None)
    driving.until(lambda: any(one[2] == "Office 13" for one in mission.map.places), "not on the map")


def test_a_tap_while_frames_stall_asks_for_no_place_and_keeps_map_and_mode(
    driving: Glass, mission: Any
) -> None:
    mission.mode = "points"
    touch = driving.stage.touch(*mission.map.to_window(*mission.map.center))
    touch.touch_down()
    driving.stage.frames(1, period=3.0)
    touch.touch_up()
    driving.stage.run_for(1.0)
    assert (driving.app.shell.screen, mission.mode, mission.card.shown) == ("mission", "points", None)
    assert len(mission.map.waypoints) == 1


def test_a_short_tap_and_a_drag_ask_for_no_place(driving: Glass, mission: Any) -> None:
    x, y = mission.map.to_window(*mission.map.center)
    driving.stage.tap(x, y)
    driving.stage.run_for(0.8)
    touch = driving.stage.touch(x, y)
    touch.touch_down()
    touch.touch_move(x + 40, y)
    driving.stage.run_for(0.8)
    touch.touch_up()
    assert mission.card.shown is None


def test_a_place_that_was_given_up_is_not_on_the_map(driving: Glass, robot: FakeRobot, mission: Any) -> None:
    before = list(mission.map.places)
    mission.map.dispatch("on_new_place", 1.0, 2.0)
    card = card_of(mission)
    card.form.set(name="Nowhere")
    driving.stage.run_for(0.2)
    driving.tap(card.cancel)
    assert (mission.card.shown, list(mission.map.places), kept(robot)) == (None, before, [])


def test_a_tap_beside_the_card_moves_the_place_and_what_was_typed_stays(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    mission.mode = "place"
    index = next(at for at, one in enumerate(mission.map.places) if one[2] == "Lab")
    mission.map.dispatch("on_open_place", index)
    card = card_of(mission)
    assert card.place == LAB
    card.form.set(note="Mind the step.")
    mission.map.dispatch("on_new_place", 4.0, 5.0)
    assert mission.map.places[index][:3] == (4.0, 5.0, "Lab")
    driving.tap(card.save)
    assert robot.until(lambda: kept(robot))
    place = kept(robot)[0]
    assert (place.id, place.x, place.y, place.note) == (LAB.id, 4.0, 5.0, "Mind the step.")
    assert mission.mode == "place"


def test_a_place_that_is_refused_is_asked_for_again_with_all_that_was_typed(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    robot.refusals["/places/set"] = "Shop lies in the keep-out Ramp."
    mission.map.dispatch("on_new_place", 1.0, 2.0)
    card_of(mission).form.set(name="Shop", note="Ring twice")
    driving.stage.run_for(0.2)
    driving.tap(card_of(mission).save)
    driving.until(lambda: any("keep-out Ramp" in text for text in driving.banners()), driving.banners())
    driving.until(lambda: mission.card.shown is not None, "not asked again")
    place = card_of(mission).place
    assert (place.name, place.note, place.x, place.y) == ("Shop", "Ring twice", 1.0, 2.0)


def test_a_known_place_is_deleted_from_its_card_and_can_be_brought_back(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    mission.mode = "place"
    index = next(at for at, one in enumerate(mission.map.places) if one[2] == "Lab")
    mission.map.dispatch("on_open_place", index)
    delete = next(one for one in mission.card.shown.walk() if getattr(one, "icon", "") == "delete")
    driving.until(lambda: not delete.disabled, "cannot be deleted")
    driving.tap(delete)
    driving.until(lambda: "Deleted: Lab." in driving.banners(), driving.banners())
    assert mission.card.shown is None


@pytest.mark.parametrize("size", SIZES, ids=["upright", "sideways", "tablet"])
def test_the_card_covers_neither_stop_nor_the_place_that_it_asks_of(
    driving: Glass, mission: Any, size: tuple[int, int]
) -> None:
    window, root = driving.stage.window, driving.app.root
    before = tuple(window.size)
    try:
        window.size = root.size = size
        driving.stage.frames(4)
        x, y, wide, high = mission.map.free_box
        place = mission.map.view.to_world(x + wide * 0.2, y + high * 0.3)
        mission.map.dispatch("on_new_place", *place)
        driving.stage.frames(3)
        card, stop = card_of(mission), driving.app.shell.stop
        assert not card.collide_widget(stop)
        assert card.height >= 240
        px, py = mission.map.view.to_screen(*place)
        assert mission.map.collide_point(px, py)
        assert not card.collide_point(px, py)
        card.cancel.trigger_action(0)
        driving.stage.frames(3)
        assert mission.card.shown is None
    finally:
        window.size = root.size = before
        driving.stage.frames(2)
