"""The first look round: five cards, STOP first, in nobody's way, and left at any moment."""

from __future__ import annotations

import pytest

from app.screens.tour.cards import CARDS
from app.screens.tour.tour import SEEN
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

SIZES = [(412, 892), (892, 412), (1280, 800), (1920, 1200)]


def overlaps(one, other) -> bool:
    ax, ay = one.to_window(*one.pos)
    bx, by = other.to_window(*other.pos)
    return ax < bx + other.width and bx < ax + one.width and ay < by + other.height and by < ay + one.height


def test_it_begins_for_somebody_new_and_not_again(glass: Glass) -> None:
    tour = glass.app.tour
    assert tour.step is None, "nobody asked for it"
    glass.app.begin_tour_if_new()
    assert tour.step == 0
    glass.stage.frames(3)
    glass.tap(tour.card.leave)
    assert tour.step is None
    assert glass.app.settings.get(SEEN) is True
    glass.app.begin_tour_if_new()
    assert tour.step is None


def test_next_leads_through_all_five_and_off_the_glass(glass: Glass) -> None:
    tour = glass.app.tour
    tour.begin()
    titles = []
    while tour.step is not None:
        glass.stage.frames(3)
        titles.append(tour.card.title)
        glass.tap(tour.card.next)
    assert titles == [step.title for step in CARDS]
    assert len(titles) == 5
    assert not [child for child in glass.app.corner.layer.children if child is tour.ring]


def test_with_a_robot_every_card_points_at_something_that_is_there(driving: Glass) -> None:
    tour, app = driving.app.tour, driving.app
    tour.begin()
    for number in range(len(CARDS)):
        driving.stage.run_for(0.5, 1 / 8)
        assert tour.step == number
        assert tour.ring.parent is app.corner.layer, CARDS[number].title
        target = CARDS[number].target(app)
        assert overlaps(tour.ring, target)
        tour.go_on()


@pytest.mark.parametrize("size", SIZES)
def test_it_never_lies_over_stop_and_stop_is_pressed_while_it_is_there(
    driving: Glass, robot: FakeRobot, size: tuple[int, int]
) -> None:
    app = driving.app
    app.root.size = size
    driving.stage.frames(5)
    app.tour.begin()
    for _ in CARDS:
        driving.stage.run_for(0.5, 1 / 8)
        card, stop = app.tour.card, app.shell.stop
        assert not overlaps(card, stop), size
        assert card.y >= 0
        assert card.x >= 0
        assert card.right <= size[0]
        assert card.top <= size[1]
        app.tour.go_on()
    app.tour.begin()
    driving.stage.run_for(0.5, 1 / 8)
    driving.tap(app.shell.stop)
    driving.until(lambda: "/stop" in robot.services(), "the tour keeps STOP from being pressed")


def test_what_lies_beside_the_card_is_used_as_ever(driving: Glass) -> None:
    app = driving.app
    app.root.size = (1280, 800)
    app.tour.begin()
    app.tour.go_on()
    app.tour.go_on()
    driving.stage.run_for(0.5, 1 / 8)
    driving.tap(app.shell.ids.mission)
    assert app.shell.screen == "mission"
    assert app.tour.step == 2


def test_without_a_robot_the_simulator_is_offered_where_there_is_one(
    glass: Glass, monkeypatch: pytest.MonkeyPatch
) -> None:
    started = []
    monkeypatch.setattr(type(glass.app.simulating), "possible", True)
    monkeypatch.setattr(glass.app.simulating, "start", lambda: started.append(True))
    glass.app.tour.begin()
    glass.stage.run_for(0.5, 1 / 8)
    assert glass.app.tour.card.offers
    glass.tap(glass.app.tour.card.simulate)
    assert started == [True]
    monkeypatch.setattr(type(glass.app.simulating), "possible", False)
    glass.app.tour.look()
    assert not glass.app.tour.card.offers


def test_larger_text_keeps_the_card_that_is_shown(glass: Glass) -> None:
    glass.app.tour.begin()
    glass.app.tour.go_on()
    before = glass.app.tour.card
    glass.app.preferences.choose("text", 1.5)
    glass.stage.frames(3)
    assert glass.app.tour.step == 1
    assert glass.app.tour.card is not before
