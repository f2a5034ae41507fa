"""Events on their way into the logbook: once each, in our words where they are about us, kept until they can be shown."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.core.settings_store import Settings
from app.link.feeds import Post
from app.session.event_intake import MAX_UNDECIDED, EventIntake
from app.session.logbook import Logbook
from app.session.own_events import OwnName
from bridge.msgs.pilothouse_msgs import ControlStatus, Event


class Intake:
    def __init__(self, folder: Path) -> None:
        self.robot: Any = SimpleNamespace(
            authority=SimpleNamespace(wanted=True),
            outcomes={},
            link=SimpleNamespace(robot_time=lambda: 100.0),
        )
        self.heard: list[str] = []
        self.events = EventIntake(
            self.robot,
            OwnName("me", "tablet", lambda: 100.0),
            Logbook(Settings(folder / "settings.json"), lambda *_, **__: None),
            lambda post: self.heard.append(post.value.text),
        )

    def tell(self, number: int, text: str, kind: str = "control") -> None:
        self.events.on_event(Post(Event(id=number, kind=kind, text=text), 100.0, 1))


@pytest.fixture
def intake(tmp_path: Path) -> Intake:
    return Intake(tmp_path)


def test_an_event_that_may_be_about_us_waits_for_the_robots_word_of_control(intake: Intake) -> None:
    intake.tell(1, "tablet has control.")
    assert intake.heard == []
    intake.events.on_control(ControlStatus(driver="tablet", driver_id="me"))
    intake.events.decide()
    assert intake.heard == ["You have control."]


def test_only_so_many_events_wait(intake: Intake) -> None:
    for number in range(1, MAX_UNDECIDED + 2):
        intake.tell(number, "tablet has control.")
    assert intake.heard == ["tablet has control."]


def test_who_only_watches_waits_for_nothing(intake: Intake) -> None:
    intake.robot.authority.wanted = False
    intake.tell(1, "tablet has control.")
    assert intake.heard == ["tablet has control."]


def test_the_same_event_is_published_once(intake: Intake) -> None:
    for _ in range(2):
        intake.tell(1, "Patrol started.", "task")
    assert intake.heard == ["Patrol started."]


def test_events_are_kept_until_there_are_screens(intake: Intake) -> None:
    intake.tell(1, "Patrol started.", "task")
    intake.events.shown = True
    intake.tell(2, "Patrol ended.", "task")
    assert [post.value.text for post in intake.events.early] == ["Patrol started."]
