"""The card of a robot on the connect screen: it claims no more than what the robot said."""

from __future__ import annotations

from typing import Any

import pytest

from app.discovery.known_robots import Entry
from app.screens.connect.robot_card import RobotCard

ME = "tablet"


@pytest.mark.parametrize(
    ("driver", "words", "action"),
    [
        ("", "free", "Connect"),
        (ME, "driven by tablet", "Connect"),
        ("phone", "driven by phone", "Watch"),
    ],
)
def test_who_drives_is_told_by_name_and_under_our_own_it_is_asked_for_control(
    stage: Any, driver: str, words: str, action: str
) -> None:
    card = stage.show(RobotCard(), size=(440, 200))
    card.show_entry(Entry("ws://10.0.0.3:9090", "Patrol-1", driver=driver, silent=0.1), ME)
    assert (card.driver_text, card.action) == (words, action)


def test_one_that_uses_the_name_of_a_paired_robot_is_told_apart(stage: Any) -> None:
    card = stage.show(RobotCard(), size=(440, 200))
    sentence = "Not your paired Patrol-1: another robot uses its name."
    card.show_entry(Entry("ws://10.0.0.3:9090", "Patrol-1", silent=0.1, warning=sentence), ME)
    assert (card.subtitle, card.warning) == ("10.0.0.3 · Saved address", sentence)


@pytest.mark.parametrize(
    ("trust", "words", "action"),
    [
        ("paired", "Paired", "Connect"),
        ("stranger", "Not paired", "Pair"),
        ("open", "Not protected", "Connect"),
        ("", "", "Connect"),
    ],
)
def test_a_card_says_how_its_robot_is_reached(stage: Any, trust: str, words: str, action: str) -> None:
    card = stage.show(RobotCard(), size=(440, 200))
    card.show_entry(Entry("wss://10.0.0.3:9090", "Patrol-1", silent=0.1, trust=trust), ME)
    assert (card.trust_text, card.action, bool(card.trust_icon)) == (words, action, bool(words))
    assert card.saved == (trust == "paired"), "what is paired can be forgotten"


def test_a_long_name_of_who_drives_is_cut_and_stays_on_its_card(stage: Any) -> None:
    card = stage.show(RobotCard(), size=(384, 200))
    entry = Entry("ws://10.0.0.3:9090", "Patrol-1", driver="a client at 10.0.0.4", silent=0.1)
    card.show_entry(entry, ME)
    stage.frames(2)
    assert card.driver_text == "a client…"
    assert card.driver_icon == "person"


@pytest.mark.parametrize("name", ["          and more", " \t\u200b "])
def test_a_name_of_blanks_does_not_leave_the_card_without_a_driver(stage: Any, name: str) -> None:
    card = stage.show(RobotCard(), size=(384, 200))
    card.show_entry(Entry("ws://10.0.0.3:9090", "Patrol-1", driver=name, silent=0.1), ME)
    assert card.driver_text == (" ".join(name.split()) if "and" in name else "somebody")
