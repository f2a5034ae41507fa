"""The card of a robot on the connect screen: it claims no more than what the robot said."""

from __future__ import annotations

from typing import Any

import pytest

from app.discovery.known_robots import Entry
from app.screens.connect.connect import RobotCard

ME = "id-of-this-handheld"


@pytest.mark.parametrize(
    ("driver_id", "words", "action"),
    [
        ("", "free", "Connect"),
        (ME, "driven by you", "Connect"),
        ("id-of-another", "driven by tablet", "Watch"),
    ],
)
def test_who_drives_is_told_by_identity_because_two_handhelds_may_bear_one_name(
    stage: Any, driver_id: str, words: str, action: str
) -> None:
    card = stage.show(RobotCard(), size=(440, 200))
    driver = "tablet" if driver_id else ""
    card.show_entry(
        Entry("ws://10.0.0.3:9090", "Patrol-1", driver=driver, driver_id=driver_id, silent=0.1), ME
    )
    assert (card.driver_text, card.action) == (words, action)


def test_a_long_name_of_who_drives_is_cut_and_stays_on_its_card(stage: Any) -> None:
    card = stage.show(RobotCard(), size=(384, 200))
    entry = Entry("ws://10.0.0.3:9090", "Patrol-1", driver="a client at 10.0.0.4", driver_id="x", silent=0.1)
    card.show_entry(entry, ME)
    stage.frames(2)
    assert card.driver_text == "a client…"
    assert card.driver_icon == "person"


@pytest.mark.parametrize("name", ["          and more", " \t\u200b "])
def test_a_name_of_blanks_does_not_leave_the_card_without_a_driver(stage: Any, name: str) -> None:
    card = stage.show(RobotCard(), size=(384, 200))
    card.show_entry(Entry("ws://10.0.0.3:9090", "Patrol-1", driver=name, driver_id="x", silent=0.1), ME)
    assert card.driver_text == (" ".join(name.split()) if "and" in name else "somebody")
