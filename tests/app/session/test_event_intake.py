"""Events on their way into the logbook: once each, in our words where they are about us, kept until they can be shown."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.core.command_origin import Origin
from app.core.settings_store import Settings
from app.link.commands import Outcome
from app.link.feeds import Post
from app.session.event_intake import EventIntake
from app.session.logbook import Logbook
from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time


class Intake:
    def __init__(self, folder: Path) -> None:
        self.robot: Any = SimpleNamespace(
            outcomes={},
            link=SimpleNamespace(robot_time=lambda: 100.0),
        )
        self.heard: list[str] = []
        self.events = EventIntake(
            self.robot,
            "me",
            Logbook(Settings(folder / "settings.json"), lambda *_, **__: None),
            lambda post: self.heard.append(post.value.text),
        )

    def tell(self, number: int, text: str, kind: str = "control", at: float = 100.0, **fields: Any) -> None:
        event = Event(id=number, kind=kind, text=text, stamp=Time.at(at), **fields)
        self.events.on_event(Post(event, 100.0, 1))


@pytest.fixture
def intake(tmp_path: Path) -> Intake:
    return Intake(tmp_path)


def test_what_is_about_us_is_told_in_our_words_at_once(intake: Intake) -> None:
    intake.tell(1, "tablet has control.", code="control_taken", actor_id="me")
    intake.tell(2, "tablet has control.", code="control_taken", actor_id="other")
    assert intake.heard == ["You have control.", "tablet has control."]


@pytest.mark.parametrize(
    ("at", "phase", "said"),
    [
        (100.0, "accepted", "A shake gave STOP: “left-right”, 97 % sure."),
        (100.0, "sent", "A shake gave STOP: “left-right”, 97 % sure."),
        (100.0, "refused", "You pressed STOP."),
        (40.0, "accepted", "You pressed STOP."),
    ],
)
def test_what_gave_a_stop_is_said_of_the_one_that_was_asked_for(
    intake: Intake, at: float, phase: str, said: str
) -> None:
    shaken = Origin("shake", 0.97, said="left-right")
    intake.robot.outcomes["stop"] = Outcome("stop", "1", phase, origin=shaken)
    intake.tell(1, "STOP pressed by tablet.", "stop", at=at, code="stop_pressed", actor_id="me")
    assert intake.heard == [said]


def test_the_same_event_is_published_once(intake: Intake) -> None:
    for _ in range(2):
        intake.tell(1, "Patrol started.", "task")
    assert intake.heard == ["Patrol started."]


def test_events_are_kept_until_there_are_screens(intake: Intake) -> None:
    intake.tell(1, "Patrol started.", "task")
    intake.events.shown = True
    intake.tell(2, "Patrol ended.", "task")
    assert [post.value.text for post in intake.events.early] == ["Patrol started."]
