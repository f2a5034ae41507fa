from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import PLACE_KINDS, Mission, RobotInfo, ScheduledTask, TaskOrder, Waypoint
from bridge.msgs.pilothouse_msgs import TASKS as KNOWN
from robotside.kinds.registry import KINDS as KINDS_OF_ROBOTS
from robotside.kinds.registry import described
from widgets.core.language import language
from widgets.core.task_words import (
    KINDS,
    PHASES,
    TASKS,
    heading_of,
    known,
    lacking,
    phase_words,
    rhythm,
    span_words,
    title,
    will,
)

SIX = Mission(waypoints=[Waypoint(float(x), 0.0) for x in range(6)], on_intruder="circle")


def test_a_robot_is_offered_what_it_says_that_it_knows():
    assert known(RobotInfo(tasks=["surface", "hold", "dance"])) == ["hold", "surface"]


def test_one_that_does_not_say_is_not_asked_to_fly_or_to_dive():
    assert set(TASKS) - set(known(RobotInfo())) == {"undock", "take_off", "land", "surface"}


@pytest.mark.parametrize(
    ("kind", "order", "sentence"),
    [
        ("quadrotor", TaskOrder(task="hold"), "Hovers where it is until you stop it."),
        (
            "hexapod",
            TaskOrder(task="follow_heading", heading=0.0, height=-3.0),
            "Swims straight towards 090°, 3 m deep, until you stop it.",
        ),
        (
            "boat",
            TaskOrder(task="follow_heading", heading=0.0, throttle=0.6),
            "Sails straight towards 090° with 60 % throttle until you stop it.",
        ),
        ("quadrotor", TaskOrder(task="take_off", height=2.0), "Takes off to 2 m and hovers there."),
        ("wheels", TaskOrder(task="dock"), "Drives onto its dock and charges."),
        (
            "quadrotor",
            TaskOrder(task="dock", places=["Pad"], charge_to=0.8),
            "Flies to Pad, lands on it and charges there until 80 %.",
        ),
        ("quadrotor", TaskOrder(task="dock"), "Flies to its dock, lands on it and charges."),
        ("hexapod", TaskOrder(task="dock", places=["Cage"]), "Swims to Cage and charges."),
        ("boat", TaskOrder(task="dock", charge_to=0.5), "Sails to its dock and charges there until 50 %."),
    ],
)
def test_each_kind_has_its_own_verb(kind, order, sentence):
    assert will(order, robot=described(RobotInfo(kind=kind))) == sentence


@pytest.mark.parametrize("kind", [*KINDS_OF_ROBOTS])
def test_the_verbs_of_each_kind_are_said_in_the_language_of_the_glass(monkeypatch, kind):
    robot = described(RobotInfo(kind=kind))
    monkeypatch.setattr(language, "name", "en_XA")
    for order in (TaskOrder(task="hold"), TaskOrder(task="follow_heading")):
        said = will(order, robot=robot)
        assert robot.moves not in said, said
        assert robot.holds not in said, said


def test_a_verb_that_is_not_known_stays_as_the_robot_has_it(monkeypatch):
    monkeypatch.setattr(language, "name", "de")
    said = will(TaskOrder(task="follow_heading"), robot=RobotInfo(moves="Crawls"))
    assert said.startswith("Crawls ")


def test_there_are_words_for_every_phase_that_a_robot_tells(monkeypatch):
    comment = (
        Path("pilothouse_msgs/msg/TaskStatus.msg").read_text().partition("string phase")[2].splitlines()[0]
    )
    told = re.sub(r"\([^)]*\)", "", comment.partition("#")[2].partition(";")[0]).replace(" or ", ", ")
    phases = [phase.strip() for phase in told.split(",")]
    assert set(phases) == set(PHASES)
    monkeypatch.setattr(language, "name", "de")
    assert all(phase_words(phase) != PHASES[phase] for phase in phases)
    assert phase_words("dancing") == "dancing", "of another program"


def test_there_are_words_for_every_task_and_kind_of_place():
    assert set(TASKS) == set(KNOWN)
    assert set(KINDS) == set(PLACE_KINDS)


@pytest.mark.parametrize(
    ("order", "words"),
    [
        (TaskOrder(task="patrol"), "Patrol"),
        (TaskOrder(task="deliver", places=["Office 12", "Lab"]), "Deliver: Office 12 → Lab"),
        (TaskOrder(task="guide", places=["A", "B", "C", "D"]), "Guide: A → 2 more → D"),
        (TaskOrder(task="go_to", places=["Lab"]), "Go to Lab"),
        (TaskOrder(task="hold", duration=90.0), "Hold for 2 min"),
        (TaskOrder(task="follow_heading", heading=0.0), "Heading 090°"),
        (TaskOrder(task="follow_heading", heading=math.nan), "Heading ahead"),
    ],
)
def test_an_order_in_a_few_words(order, words):
    assert title(order) == words


@pytest.mark.parametrize(
    ("order", "sentence"),
    [
        (
            TaskOrder(task="patrol"),
            "Visits 6 points in order, until you stop it. Goes once round each intruder, then on.",
        ),
        (
            TaskOrder(task="deliver", places=["Office 12", "Lab"]),
            "Fetches at Office 12, brings it to Lab; waits at each for a tap here or the tag of the place.",
        ),
        (
            TaskOrder(task="guide", places=["Hall", "Lab"]),
            "Leads a person to Hall and Lab, waits when no one follows, and reads out the notes.",
        ),
        (TaskOrder(task="go_to", places=["Lab"]), "Goes to Lab and stays there."),
        (TaskOrder(task="hold", duration=math.nan), "Stands still where it is until you stop it."),
        (
            TaskOrder(task="follow_heading", heading=math.pi / 2, speed=0.4, duration=60.0),
            "Drives straight towards 000° at 0.4 m/s for 1 min.",
        ),
        (TaskOrder(task="dock"), "Drives onto its dock and charges."),
    ],
)
def test_what_will_happen_is_said(order, sentence):
    assert will(order, SIX) == sentence


@pytest.mark.parametrize(
    ("order", "missing"),
    [
        (TaskOrder(task="patrol"), "The mission has no points"),
        (TaskOrder(task="deliver"), "Choose where to fetch it."),
        (TaskOrder(task="deliver", places=["A", ""]), "Choose where to bring it."),
        (TaskOrder(task="deliver", places=["", "B"]), "Choose where to fetch it."),
        (TaskOrder(task="deliver", places=["A", "A"]), "It cannot bring from A to A"),
        (TaskOrder(task="guide"), "Choose at least one place"),
        (TaskOrder(task="go_to"), "Choose where to go."),
        (TaskOrder(task=""), "Choose a task."),
    ],
)
def test_what_is_lacking_is_said_instead(order, missing):
    assert lacking(order, Mission()).startswith(missing)
    assert will(order, Mission()) == lacking(order, Mission())


@pytest.mark.parametrize(
    ("task", "words"),
    [
        (ScheduledTask(at="22:00"), "22:00, every day"),
        (ScheduledTask(at="22:00", days=[True] * 5 + [False] * 2), "22:00, Mon to Fri"),
        (ScheduledTask(at="07:30", days=[True, False, True] + [False] * 4), "07:30, Mon, Wed"),
        (ScheduledTask(at="07:30", days=[False] * 7), "07:30, on no day"),
        (ScheduledTask(every=5400.0), "every 1 h 30 min"),
    ],
)
def test_when_a_scheduled_task_starts(task, words):
    assert rhythm(task) == words


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(math.nan, "—"), (45.0, "45 s"), (120.0, "2 min"), (3600.0, "1 h"), (90000.0, "1 d 1 h")],
)
def test_lengths_of_time(seconds, words):
    assert span_words(seconds) == words


def test_a_heading_counts_clockwise_from_north():
    assert [heading_of(math.radians(yaw)) for yaw in (90, 0, -90, 180)] == ["000°", "090°", "180°", "270°"]


def test_a_robot_that_cannot_tell_who_follows_does_not_promise_to_wait():
    order = TaskOrder(task="guide", places=["Lab"])
    said = will(order, follows=False)
    assert said.startswith("Leads a person to Lab and reads out the notes. Does not wait:")
    assert "waits when no one follows" in will(order)
