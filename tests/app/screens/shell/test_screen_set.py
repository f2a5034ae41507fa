"""Screens that are made when they are first asked for miss nothing that came before."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.link.channels import CAPABILITIES, EVENT, OUTCOME
from app.link.feeds import Post
from app.screens.shell.screen_set import MAX_MISSED, OUTCOME_AGE, ScreenSet


class Screen:
    """Notes what it hears."""

    def __init__(self) -> None:
        self.heard: list[tuple[str, Any]] = []

    def on_post(self, channel: str, post: Post) -> None:
        self.heard.append((channel, post.value))


class Desk:
    """A set of two screens on a clock of the test's."""

    def __init__(self) -> None:
        self.time, self.made = 100.0, []
        makers: Any = {name: lambda name=name: self.make(name) for name in ("drive", "tasks")}
        self.screens = ScreenSet(makers, lambda: self.time)

    def make(self, name: str) -> Screen:
        self.made.append(name)
        return Screen()

    def post(self, channel: str, value: Any) -> None:
        self.screens.on_post(channel, Post(value, self.time, 1))

    def outcome(self, name: str, phase: str) -> Any:
        value = SimpleNamespace(name=name, phase=phase)
        self.post(OUTCOME, value)
        return value

    def heard(self, name: str) -> list[tuple[str, Any]]:
        screen: Any = self.screens[name]
        return screen.heard


@pytest.fixture
def desk() -> Desk:
    return Desk()


def test_looking_a_screen_up_makes_it_once(desk: Desk) -> None:
    assert desk.screens["tasks"] is desk.screens["tasks"]
    assert desk.made == ["tasks"]
    assert desk.screens.get("drive") is not None
    assert desk.made == ["tasks", "drive"]


def test_nothing_else_makes_one(desk: Desk) -> None:
    assert list(desk.screens) == ["drive", "tasks"]
    assert len(desk.screens) == 2
    assert "drive" in desk.screens
    assert "topics" not in desk.screens
    assert desk.screens.get("topics") is None
    desk.post(EVENT, "event")
    assert dict(desk.screens.made) == {}
    assert desk.made == []
    with pytest.raises(KeyError):
        desk.screens["topics"]


def test_a_late_screen_hears_every_event_and_the_newest_of_all_else_in_order(desk: Desk) -> None:
    desk.post(EVENT, "first")
    desk.post("/scan", "old")
    desk.post(CAPABILITIES, "offer")
    desk.post(EVENT, "second")
    desk.post("/scan", "new")
    told = [(EVENT, "first"), (CAPABILITIES, "offer"), (EVENT, "second"), ("/scan", "new")]
    assert desk.heard("drive") == told
    desk.post(EVENT, "third")
    assert desk.heard("drive") == [*told, (EVENT, "third")], "as it comes, and nothing twice"
    assert desk.heard("tasks") == [*told, (EVENT, "third")]


def test_the_way_of_a_robot_is_kept_for_the_map_within_bounds(desk: Desk) -> None:
    for number in range(MAX_MISSED["/pose"] + 5):
        desk.post("/pose", number)
    heard = [value for _, value in desk.heard("tasks")]
    assert heard == list(range(5, MAX_MISSED["/pose"] + 5))


@pytest.mark.parametrize("channel", [EVENT, OUTCOME])
def test_what_waits_for_a_screen_is_bounded(desk: Desk, channel: str) -> None:
    for number in range(MAX_MISSED[channel] + 5):
        desk.post(channel, SimpleNamespace(name=str(number), phase="sent"))
    assert len(desk.heard("tasks")) == MAX_MISSED[channel]


def test_a_command_under_way_is_told_however_long_ago_and_its_end_for_a_while(desk: Desk) -> None:
    sent = desk.outcome("start", "sent")
    desk.time += 10 * OUTCOME_AGE
    done = desk.outcome("pause", "accepted")
    assert desk.heard("drive") == [(OUTCOME, sent), (OUTCOME, done)]
    desk.time += OUTCOME_AGE
    assert desk.heard("tasks") == [(OUTCOME, sent)], "what became of it is no news"


def test_a_command_that_was_answered_is_not_told_to_be_under_way(desk: Desk) -> None:
    desk.outcome("start", "sent")
    refused = desk.outcome("start", "refused")
    assert desk.heard("drive") == [(OUTCOME, refused)]
    desk.time += OUTCOME_AGE
    assert desk.heard("tasks") == []


def test_screens_that_are_made_anew_in_another_set_are_told_what_these_were_told_within_bounds(
    desk: Desk,
) -> None:
    desk.post(EVENT, "first")
    assert desk.heard("drive") == desk.heard("tasks") == [(EVENT, "first")]
    for number in range(MAX_MISSED[EVENT]):
        desk.post(EVENT, number)
    later = Desk()
    later.screens.take_over(desk.screens)
    assert later.heard("tasks") == [(EVENT, number) for number in range(MAX_MISSED[EVENT])]


def test_a_screen_is_made_anew_in_its_place(desk: Desk) -> None:
    first = desk.screens["drive"]
    assert desk.screens.make_anew("drive") is first
    assert desk.screens["drive"] is not first
    desk.post(EVENT, "event")
    assert desk.heard("drive") == [(EVENT, "event")]
    assert first.heard == []
