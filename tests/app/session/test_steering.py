"""Who steers and in which mode: one judge for the bar and for the card."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.core.command_origin import NOBODY, Origin
from app.screens.shell import status_text
from app.session.steering import AUTO, MANUAL, PAUSED, READY, STOPPED, YOU, Steering, steering
from bridge.msgs.pilothouse_msgs import ControlStatus, PlaceCandidate, PlaceCandidates, TaskStatus

ME = "me"


def session(
    status: ControlStatus | None,
    task: TaskStatus | None = None,
    *,
    driving: bool = False,
    foreign: bool = False,
    driven: bool = True,
    silent: bool = False,
) -> Any:
    told = {"/control/status": status, "/task/status": task}
    return SimpleNamespace(
        feeds=SimpleNamespace(latest=told.get),
        link=SimpleNamespace(driving=driving, driven_by=Origin() if driven else NOBODY, silent=silent),
        robot=SimpleNamespace(foreign=foreign),
        robot_stop=SimpleNamespace(local=SimpleNamespace(latched=False)),
        own_id=ME,
        connected=True,
    )


MINE, ANNAS = {"driver": "Tablet", "driver_id": ME}, {"driver": "Anna", "driver_id": "a"}
RUNS, WAITS = TaskStatus(task="patrol", state="RUNNING"), TaskStatus(task="patrol", state="PAUSED")


@pytest.mark.parametrize(
    ("status", "task", "driving", "found", "words"),
    [
        (ControlStatus(mode="MANUAL"), None, False, Steering(READY, "", "", False), "READY"),
        (ControlStatus(mode="MANUAL", **MINE), None, False, Steering(MANUAL, YOU, "", False), "MANUAL · you"),
        (
            ControlStatus(mode="MANUAL", **ANNAS),
            None,
            False,
            Steering(MANUAL, "Anna", "", False),
            "MANUAL · Anna",
        ),
        (
            ControlStatus(mode="AUTO", **MINE),
            RUNS,
            False,
            Steering(AUTO, YOU, "patrol", False),
            "AUTO · patrol",
        ),
        (
            ControlStatus(mode="AUTO"),
            RUNS,
            False,
            Steering(AUTO, "", "patrol", False),
            "AUTO · patrol",
        ),
        (
            ControlStatus(mode="PAUSED", **MINE),
            WAITS,
            False,
            Steering(PAUSED, YOU, "patrol", True),
            "PAUSED · patrol",
        ),
        (
            ControlStatus(mode="PAUSED", **MINE),
            WAITS,
            True,
            Steering(MANUAL, YOU, "patrol", True),
            "MANUAL · patrol paused",
        ),
        (
            ControlStatus(mode="PAUSED", **ANNAS),
            WAITS,
            False,
            Steering(PAUSED, "Anna", "patrol", True),
            "PAUSED · patrol",
        ),
        (
            ControlStatus(mode="STOPPED", **MINE),
            WAITS,
            True,
            Steering(STOPPED, YOU, "patrol", True),
            "STOPPED",
        ),
    ],
)
def test_how_a_robot_is_steered(status, task, driving, found, words):
    one = session(status, task, driving=driving)
    assert steering(one) == found
    assert status_text.mode(one)[0] == words


@pytest.mark.parametrize(
    ("status", "task", "driving", "words"),
    [
        (ControlStatus(mode="MANUAL", **MINE), None, False, "READY"),
        (ControlStatus(mode="MANUAL", **MINE), None, True, "MANUAL · you"),
        (ControlStatus(mode="MANUAL", **MINE), WAITS, False, "MANUAL · patrol paused"),
        (ControlStatus(mode="MANUAL", **ANNAS), None, False, "MANUAL · Anna"),
    ],
)
def test_who_has_control_and_has_not_driven_yet_is_ready(status, task, driving, words):
    one = session(status, task, driving=driving, driven=False)
    assert status_text.mode(one)[0] == words


def test_a_robot_that_has_told_nothing_is_steered_by_nobody_knows_whom():
    assert steering(session(None)) is None
    assert status_text.mode(session(None))[0] == "—"


@pytest.mark.parametrize("foreign", [False, True])
def test_while_the_robot_is_not_heard_nobody_is_said_to_drive_it(foreign):
    one = session(ControlStatus(mode="MANUAL", **MINE), driving=True, silent=True, foreign=foreign)
    assert status_text.mode(one) == ("unknown", "help", "muted")


def test_of_a_robot_that_tells_nobody_who_drives_the_own_stick_tells():
    assert steering(session(None, foreign=True)).mode == READY
    assert steering(session(None, foreign=True, driving=True)) == Steering(MANUAL, YOU, "", False)


def test_where_there_is_little_room_the_mode_is_short():
    one = session(ControlStatus(mode="PAUSED", **MINE), WAITS, driving=True)
    assert status_text.mode(one, "short")[0] == "MANUAL · paused"
    assert status_text.mode(one, "tall")[0] == "MANUAL"


@pytest.mark.parametrize(("phase", "words"), [("waiting", "AUTO · waiting"), ("unsure", "AUTO · unsure")])
def test_a_task_that_waits_for_its_way_or_its_place_does_not_read_as_going(phase, words):
    one = session(
        ControlStatus(mode="AUTO", **MINE), TaskStatus(task="go_home", state="RUNNING", phase=phase)
    )
    assert status_text.mode(one, "short")[0] == words


def test_a_robot_that_asks_where_it_is_is_not_just_ready():
    one = session(ControlStatus(mode="MANUAL"))
    asked = PlaceCandidates(candidates=[PlaceCandidate(1), PlaceCandidate(2)])
    told = one.feeds.latest
    one.feeds.latest = lambda topic: asked if topic == "/localisation/candidates" else told(topic)
    assert status_text.mode(one)[0] == "READY · unsure"
