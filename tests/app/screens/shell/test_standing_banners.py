"""Banners that stay for as long as they are true."""

from __future__ import annotations

import math
import time

import pytest
from msgspec.structs import replace

from app.screens.shell.standing_banners import loop_words
from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import ControlStatus, Event, PlaceCandidate, PlaceCandidates
from bridge.msgs.std_msgs import Time
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets import WhereCard
from widgets.parts.kit import Toast


@pytest.mark.parametrize(
    ("status", "words"),
    [
        (ControlStatus(), ""),
        (
            ControlStatus(loop_cap=0.4, real_time_factor=0.4, loop_lag=0.5),
            "Simulation at 0.4 of real time, 0.5\u00a0s behind: the robot goes slower.",
        ),
        (
            ControlStatus(loop_cap=0.0, real_time_factor=0.1, loop_lag=1.0),
            "Simulation at 0.1 of real time, 1\u00a0s behind: the robot rests.",
        ),
        (
            ControlStatus(loop_cap=0.5, loop_lag=0.5),
            "The robot's computer is 0.5\u00a0s late: the robot goes slower.",
        ),
        (
            ControlStatus(loop_cap=0.0, loop_lag=1.5),
            "The robot's computer is 1.5\u00a0s late: the robot rests.",
        ),
    ],
)
def test_a_robot_whose_loop_lags_says_by_how_much_and_what_it_does(status: ControlStatus, words: str) -> None:
    assert loop_words(status) == words


def test_it_stays_on_the_glass_until_the_robot_keeps_up(driving: Glass, robot: FakeRobot) -> None:
    keeps_up = robot.control
    robot.control = replace(keeps_up, loop_cap=0.4, real_time_factor=0.4, loop_lag=0.5)
    robot.publish("/control/status", robot.control)
    driving.until(lambda: any(said.startswith("Simulation at") for said in driving.banners()), "not said")
    robot.control = keeps_up
    robot.publish("/control/status", robot.control)
    driving.until(lambda: not any(said.startswith("Simulation") for said in driving.banners()), "it stays")


ASKS = PlaceCandidates(
    candidates=[PlaceCandidate(1, 2.0, 1.0, 0.0, 0.6, 0.1), PlaceCandidate(2, 6.0, 1.0, 0.0, 0.4, 0.1)]
)


def asked(glass: Glass, robot: FakeRobot) -> WhereCard:
    robot.publish("/localisation/candidates", ASKS)
    card = glass.app.shell.standing.where
    glass.until(lambda: card.parent is not None, "it does not ask")
    return card


def test_the_robot_asks_where_it_is_and_a_button_answers(driving: Glass, robot: FakeRobot) -> None:
    card = asked(driving, robot)
    driving.until(lambda: not card.blocked, "it cannot be answered")
    driving.stage.run_for(0.6)
    driving.tap(card.places[1])
    driving.until(lambda: "/localisation/choose" in robot.services(), "not sent")
    assert next(request for name, request in robot.asked if name == "/localisation/choose").id == 2
    robot.publish("/localisation/candidates", PlaceCandidates())
    driving.until(lambda: card.parent is None, "it stays though nothing is asked")


def test_neither_leads_to_the_map_on_which_it_is_placed(driving: Glass, robot: FakeRobot) -> None:
    card = asked(driving, robot)
    driving.until(lambda: not card.blocked, "it cannot be answered")
    driving.stage.run_for(0.6)
    driving.tap(card.by_hand)
    driving.until(lambda: driving.app.screens["mission"].mode == "place_robot", "no placing")
    assert "/localisation/choose" not in robot.services()


def test_where_no_map_shows_the_places_a_button_leads_to_one(driving: Glass, robot: FakeRobot) -> None:
    card = asked(driving, robot)
    assert card.said == "The map shows them; yes means A."
    driving.stage.run_for(0.6)
    driving.tap(card.look)
    driving.until(lambda: card.look.parent is None, "it still leads to the map that is on the glass")
    assert driving.app.screens["mission"].mode == "view"
    assert card.said == "Tap the right one on the map or here; yes means A."


def test_the_card_covers_no_place_that_it_asks_about(driving: Glass, robot: FakeRobot) -> None:
    card = asked(driving, robot)
    driving.app.show("mission")
    area = driving.app.screens["mission"].map
    driving.until(lambda: len(area.candidates) == 2, "the map shows none")
    driving.stage.run_for(0.6)
    left, low, wide, high = area.free_box
    for each in area.candidates:
        x, y = area.view.to_screen(each.x, each.y)
        assert left < x < left + wide
        assert low < y < low + high
        assert not card.collide_point(*card.to_widget(*area.to_window(x, y)))


def test_who_put_the_robot_reads_that_it_found_itself_elsewhere(driving: Glass, robot: FakeRobot) -> None:
    driving.until(lambda: math.isfinite(driving.app.session.link.robot_time()), "no clock")
    driving.app.session.place_robot(-2.4, 0.0, 0.0)
    told = [KeyValue("x", "2.0"), KeyValue("y", "0.0")]
    code, at = Code.POSITION_FOUND.value, Time.at(time.time())
    robot.happen(
        Event(id=77, stamp=at, kind="localisation", level="warn", text="Found.", code=code, parameters=told)
    )
    words = "It found itself 4.4\u00a0m from where you put it."
    driving.until(
        lambda: words in [*driving.banners(), *toasts(driving)], "nothing says that it was overruled"
    )


def test_that_the_laser_meets_too_little_to_tell_the_place_is_said(driving: Glass, robot: FakeRobot) -> None:
    driving.until(lambda: math.isfinite(driving.app.session.link.robot_time()), "no clock")
    code, at = Code.POSITION_UNSEEN.value, Time.at(time.time())
    words = "Position unsure: the laser meets too little to tell it."
    robot.happen(Event(id=78, stamp=at, kind="localisation", level="warn", text=words, code=code))
    driving.until(lambda: words in [*driving.banners(), *toasts(driving)], "not said")


def toasts(glass: Glass) -> list[str]:
    return [child.text for child in glass.app.shell.notices.children if isinstance(child, Toast)]


def test_who_has_no_control_reads_who_can_answer(driving: Glass, robot: FakeRobot) -> None:
    card = asked(driving, robot)
    robot.control = replace(robot.control, driver="Anna", driver_id="a")
    robot.publish("/control/status", robot.control)
    driving.until(lambda: card.said == "Anna has control and can answer.", "not said")
    assert all(button.disabled for button in (*card.places, card.by_hand))


def test_yes_means_the_first_place_and_no_leads_to_placing(driving: Glass, robot: FakeRobot) -> None:
    card = asked(driving, robot)
    driving.until(lambda: not card.blocked, "it cannot be answered")
    assert card.said.endswith("yes means A.")
    questions = driving.app.intents
    assert questions.answer(True).sentence == "Am I at A or B? A · 60\u00a0%."
    driving.until(lambda: "/localisation/choose" in robot.services(), "not sent")
    assert next(request for name, request in robot.asked if name == "/localisation/choose").id == 1


def test_no_by_voice_leads_to_placing(driving: Glass, robot: FakeRobot) -> None:
    card = asked(driving, robot)
    driving.until(lambda: not card.blocked, "it cannot be answered")
    assert driving.app.intents.answer(False).sentence == "Am I at A or B? Not yet."
    driving.until(lambda: driving.app.screens["mission"].mode == "place_robot", "no placing")
