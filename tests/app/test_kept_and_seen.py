"""Events seen to, missions recalled and saved, settings switched: with fingers, on the tasks screen."""

from __future__ import annotations

from typing import Any

import pytest

from bridge.msgs.pilothouse_msgs import Event, Mission, Waypoint
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.parts.cards import ActionToast
from widgets.parts.rows import ListRow

NIGHT = Mission(name="Night", waypoints=[Waypoint(5.0, 5.0)])


@pytest.fixture
def tasks(kept: FakeRobot, driving: Glass) -> Any:
    """Connected, in control, on the tasks screen."""
    driving.until(lambda: driving.app.session.logbook.alarms == 1, "no events")
    driving.app.show("tasks")
    driving.stage.run_for(0.3)
    return driving.app.screens["tasks"]


@pytest.fixture
def kept(robot: FakeRobot) -> FakeRobot:
    """A robot with events and a mission."""
    robot.events = [
        Event(id=1, boot="a", level="alarm", kind="contact", text="It touched something."),
        Event(id=2, boot="a", level="warn", kind="battery", text="Battery at 20 %."),
        Event(id=3, boot="a", text="Waypoint 1 reached"),
    ]
    robot.missions = {"Night": NIGHT}
    return robot


def asked(robot: FakeRobot, service: str) -> list[Any]:
    return [request for name, request in robot.asked if name == service]


def press(glass: Glass, screen: Any, name: str) -> None:
    button = screen.ids[name]
    glass.until(lambda: not button.disabled, f"{name} cannot be pressed")
    glass.tap(button)


def notes(tasks: Any) -> dict[str, str]:
    return {row["text"]: row["note"] for row in tasks.events.log.ids.view.data if "note" in row}


def seen_button(tasks: Any, text: str) -> Any:
    return next(row for row in tasks.events.log.ids.rows.children if row.text == text).children[0]


def test_one_tap_says_that_an_alarm_has_been_seen_to_and_the_rail_counts_it_no_longer(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    rail = glass.app.shell.nav.ids.tasks
    assert tasks.tab == "events"  # an alarm that was not looked at is what the mark on the rail tells of
    glass.until(lambda: (rail.count, rail.urgent) == (2, True), "not counted")
    glass.tap(seen_button(tasks, "It touched something."))
    glass.until(lambda: (rail.count, rail.urgent) == (1, False), "still counted")
    (request,) = asked(robot, "/events/acknowledge")
    assert list(request.ids) == [1]
    glass.until(lambda: notes(tasks)["It touched something."].startswith("Seen by "), notes(tasks))
    assert robot.events[1].acknowledged_by == ""


def test_all_that_wait_are_seen_to_at_once(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    assert tasks.ids["seen_all"].text == "All seen (2)"
    press(glass, tasks, "seen_all")
    glass.until(lambda: not glass.app.session.logbook.open, "still open")
    assert [list(one.ids) for one in asked(robot, "/events/acknowledge")] == [[1, 2]]
    glass.until(lambda: tasks.ids["seen_all"].disabled, "still offered")


def test_what_somebody_else_saw_to_a_moment_before_is_shown_with_the_name_and_not_taken_over(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    robot.hold_answers()
    glass.tap(seen_button(tasks, "It touched something."))
    assert robot.until(lambda: asked(robot, "/events/acknowledge"))
    glass.until(lambda: notes(tasks)["It touched something."] == "Sending to the robot \u2026", notes(tasks))
    robot.events[0] = Event(
        id=1, boot="a", level="alarm", kind="contact", text="It touched something.", acknowledged_by="Anna"
    )
    robot.publish("/events", robot.events[0])
    robot.give_answers()
    glass.until(lambda: notes(tasks)["It touched something."] == "Seen by Anna", notes(tasks))
    glass.stage.run_for(0.3)
    assert notes(tasks)["It touched something."] == "Seen by Anna"


def test_a_refusal_is_said_and_it_can_be_pressed_again(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    robot.refusals["/events/acknowledge"] = "The disk is full."
    glass.tap(seen_button(tasks, "It touched something."))
    said = "Refused: note that it was seen to. The disk is full."
    glass.until(lambda: said in glass.banners(), glass.banners())
    glass.until(lambda: notes(tasks)["It touched something."] == "", notes(tasks))
    assert not seen_button(tasks, "It touched something.").disabled


def test_a_kept_mission_is_recalled_and_that_is_taken_back(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    robot.publish("/mission", Mission(name="Day", waypoints=[Waypoint(1.0, 1.0)]))
    glass.until(lambda: glass.app.session.mission.state == "stored", "no mission")
    glass.app.session.mission.add(2.0, 2.0)
    tasks.tab = "missions"
    glass.until(lambda: [one.name for one in tasks.missions.missions] == ["Night"], "not listed")
    row = next(one for one in tasks.missions.walk(restrict=True) if isinstance(one, ListRow))
    glass.tap(row)
    press(glass, tasks, "recall")
    glass.until(lambda: glass.app.session.mission.draft.name == "Night", "not recalled")
    glass.until(lambda: tasks.missions.current == "Night", "not marked")
    notices = glass.app.shell.notices
    glass.until(lambda: any(isinstance(one, ActionToast) for one in notices.children), "no undo")
    next(one for one in notices.children if isinstance(one, ActionToast)).act()
    glass.until(lambda: tasks.missions.current == "Day", "the robot has the other one")
    assert glass.app.session.mission.draft.points == ((1.0, 1.0), (2.0, 2.0))


def test_the_points_on_the_map_are_kept_under_a_name(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    tasks.tab = "missions"
    press(glass, tasks, "save_as")
    glass.stage.run_for(0.3)
    said = "There are no points on the map to save; set some on the mission screen."
    assert tasks.mission_pane.head.sentence == said
    glass.app.session.mission.add(1.0, 2.0)
    tasks.mission_pane.field.text = "Yard"
    glass.stage.run_for(0.3)
    said = "The point on the map is kept as Yard, and the robot patrols it from now on."
    assert tasks.mission_pane.head.sentence == said
    press(glass, tasks, "keep_mission")
    glass.until(lambda: [one.name for one in tasks.missions.missions] == ["Night", "Yard"], "not kept")
    assert asked(robot, "/mission/set")[0].mission.name == "Yard"


def test_the_robots_settings_stand_as_it_says_and_are_switched(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    options = tasks.settings_pane.options
    glass.tap(tasks.tabs.gear)
    glass.until(lambda: tasks.detail == "settings" and options.state == "live", "no settings")
    options.ask("lost_link_stops_task")
    glass.until(lambda: options.values["lost_link_stops_task"], "not switched")
    (request,) = asked(robot, "/settings/set")
    assert (request.name, request.value) == ("lost_link_stops_task", "on")
    glass.until(lambda: not options.asked, "still asked")


def test_a_setting_that_is_refused_stays_and_the_reason_is_said(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    robot.refusals["/settings/set"] = "Anna has control."
    options = tasks.settings_pane.options
    tasks.open("settings")
    glass.until(lambda: options.state == "live", "no settings")
    options.ask("follow_link")
    glass.until(lambda: any("Anna has control." in text for text in glass.banners()), glass.banners())
    assert (options.values["follow_link"], options.asked) == (True, {})


def test_who_only_watches_sees_the_settings_and_is_told_why_they_cannot_be_switched(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    robot.publish("/control/status", type(robot.control)(driver="Anna", driver_id="anna"))
    tasks.open("settings")
    said = "Anna has control and can switch them."
    glass.until(lambda: tasks.settings_pane.head.sentence == said, "not said")
    assert tasks.settings_pane.options.state == "disabled"
