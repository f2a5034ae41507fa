"""The panel beside the map: on a phone the first rows fit, and none is cut through."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from kivy.uix.floatlayout import FloatLayout

from app.core.settings_store import Settings
from app.layout.rects import Rect
from app.link.capabilities import Capabilities
from app.link.channels import EVENT
from app.link.feeds import Feeds, Post
from app.missions.mission_editor import Draft
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.client.client import LinkState, Phase
from bridge.core.identity import public_id
from bridge.msgs.pilothouse_msgs import ControlStatus, Event, TaskProgress, TaskStatus
from tests.headless import Stage

SIZES = {"tall": (388, 166), "short": (276, 254)}
"""Form to the room that `app.layout.arrange` gives the panel on a phone of 412 by 892."""


@pytest.fixture
def session(tmp_path: Path) -> Session:
    link = SimpleNamespace(
        url="ws://127.0.0.1:9090",
        state=LinkState(Phase.CONNECTED, "", 0, 0.0),
        silent=False,
        silence=0.0,
        robot_time=lambda: 100.0,
        command=lambda *_, **__: None,
    )
    settings = Settings(tmp_path / "settings.json")
    return Session(
        link,  # type: ignore[arg-type]
        Feeds(lambda: 100.0),
        settings,
        now=lambda: 100.0,
        client_id="me",
        wants_control=False,
    )


@pytest.fixture
def panel(stage: Stage, session: Session, request: pytest.FixtureRequest) -> Any:
    from app.screens.mission.mission_panel import MissionPanel

    dashboard = Dashboard(session.feeds)
    panel = MissionPanel(session, dashboard)
    panel.dashboard_of_test = dashboard
    panel.take_form(request.param)
    stage.show(panel, SIZES[request.param])
    settle(stage, panel)
    return panel


def settle(stage: Stage, panel: Any) -> None:
    panel.tick()
    stage.frames(4)


def tell(session: Session, topic: str, message: Any) -> None:
    session.deliver(topic, Post(message, 100.0, 1))


def run_a_task(stage: Stage, session: Session, panel: Any) -> None:
    tell(session, "/task/status", TaskStatus(task="patrol", state="RUNNING", waypoint=1, waypoints=3))
    panel.events.show(Event(id=1, text="Patrol started.", kind="task"))
    session.mission.robot_has(session.mission.sending())
    settle(stage, panel)


def seen(panel: Any, widget: Any) -> bool:
    """Wholly in sight."""
    low, top = (widget.to_window(widget.x, y)[1] for y in (widget.y, widget.top))
    return widget.parent is not None and low >= panel.y - 1 and top <= panel.top + 1


def cut(panel: Any) -> list[str]:
    rows = [row for row in panel.ids.column.children if row is not panel.motion] + panel.motion.children
    edges = [(type(row).__name__, row.to_window(0, row.y)[1], row.to_window(0, row.top)[1]) for row in rows]
    return [name for name, low, top in edges if top - low > 1 and low < panel.y - 1 < panel.y + 1 < top]


both = pytest.mark.parametrize("panel", ["tall", "short"], indirect=True)


@both
def test_at_rest_sending_and_the_motion_are_in_sight_and_nothing_is_cut(panel: Any) -> None:
    assert seen(panel, panel.ids["send"])
    assert seen(panel, panel.motion.ids.choice)
    assert cut(panel) == []
    assert panel.figures.parent is None


@both
def test_while_a_task_runs_the_figures_stand_where_sending_was(
    stage: Stage, session: Session, panel: Any
) -> None:
    run_a_task(stage, session, panel)
    assert seen(panel, panel.figures)
    assert not seen(panel, panel.ids["send"])
    assert cut(panel) == []


@pytest.mark.parametrize("panel", ["tall"], indirect=True)
def test_a_running_task_shows_the_latest_event(stage: Stage, session: Session, panel: Any) -> None:
    run_a_task(stage, session, panel)
    settle(stage, panel)
    assert seen(panel, panel._latest)
    assert panel._latest.text == "Patrol started."


@both
def test_what_is_changed_while_a_task_runs_can_be_sent(stage: Stage, session: Session, panel: Any) -> None:
    run_a_task(stage, session, panel)
    session.mission.add(1.0, 2.0)
    settle(stage, panel)
    assert seen(panel, panel.ids["send"])


@pytest.mark.parametrize("panel", ["tall"], indirect=True)
@pytest.mark.parametrize(("task", "lap", "metres"), [("patrol", "2", 7.5), ("go_home", "", math.nan)])
def test_the_way_home_has_no_laps_and_no_next_point(
    session: Session, panel: Any, task: str, lap: str, metres: float
) -> None:
    dashboard = panel.dashboard_of_test
    dashboard.enter()
    for topic, message in (
        ("/task/status", TaskStatus(task=task, state="RUNNING", lap=2, laps=3)),
        ("/task/progress", TaskProgress(progress=0.5, distance_to_next=7.5, time_left=9.0)),
    ):
        tell(session, topic, message)
        dashboard.deliver(topic, message)
    assert panel.lap.words == lap
    assert panel.next.value == pytest.approx(metres, nan_ok=True)
    assert panel.left.value == 9.0


@both
@pytest.mark.parametrize(
    ("laps", "left", "done"), [(0, "Lap ends in", "2 % of this lap"), (3, "Time left", "2 %")]
)
def test_the_figures_of_a_patrol_without_an_end_are_said_to_be_of_this_lap(
    stage: Stage, session: Session, panel: Any, laps: int, left: str, done: str
) -> None:
    dashboard = panel.dashboard_of_test
    dashboard.enter()
    for topic, message in (
        ("/task/status", TaskStatus(task="patrol", state="RUNNING", waypoints=2, lap=1, laps=laps)),
        ("/task/progress", TaskProgress(progress=0.02, time_left=80.0)),
    ):
        tell(session, topic, message)
        dashboard.deliver(topic, message)
    assert (panel.left.name, panel._progress.done) == (left, done)
    ended = TaskStatus(task="patrol", state="SUCCEEDED", waypoints=2, lap=1, laps=laps)
    tell(session, "/task/status", ended)
    dashboard.deliver("/task/status", ended)
    assert (panel.left.name, panel._progress.done) == ("Time left", "")


@both
def test_without_points_nothing_can_be_sent_and_one_reason_is_said(
    stage: Stage, session: Session, panel: Any
) -> None:
    session.robot.capabilities = Capabilities({}, frozenset({"/task/start", "/mission/set"}))
    tell(session, "/control/status", ControlStatus(driver_id=session.own_id, driver="me"))
    session.mission.robot_has(Draft().message())
    session.mission.set_home(1.0, 2.0)
    panel.show_draft()
    settle(stage, panel)
    assert (panel.ids["send"].disabled, panel.tasks.inviting) == (True, False)
    assert panel._send.note == "Home is drawn, not on the robot yet. Choose Points, then tap the map."
    session.mission.set_motion(laps=3)
    session.mission.add(3.0, 2.0)
    panel.show_draft()
    settle(stage, panel)
    assert not panel.ids["send"].disabled
    assert (panel._send.calls, panel.tasks.inviting) == (False, True), "one is lit: Start sends too"


@both
def test_points_that_the_robot_has_can_be_taken_from_it(stage: Stage, session: Session, panel: Any) -> None:
    session.robot.capabilities = Capabilities({}, frozenset({"/task/start", "/mission/set"}))
    tell(session, "/control/status", ControlStatus(driver_id=session.own_id, driver="me"))
    session.mission.robot_has(Draft(points=((1.0, 2.0),)).message())
    session.mission.clear()
    panel.show_draft()
    settle(stage, panel)
    assert (panel.ids["send"].disabled, panel._send.words) == (False, "Remove its points")


@both
def test_start_invites_only_when_there_are_points(stage: Stage, session: Session, panel: Any) -> None:
    assert not panel.tasks.inviting
    session.mission.add(1.0, 2.0)
    settle(stage, panel)
    assert panel.tasks.inviting


@both
@pytest.mark.parametrize("at_rest", [True, False])
def test_with_stop_pressed_nothing_that_moves_can_be_asked_for(
    stage: Stage, session: Session, panel: Any, at_rest: bool
) -> None:
    assert not panel.tasks.held
    tell(session, "/control/status", ControlStatus(stopped=True, mode="STOPPED", at_rest=at_rest))
    settle(stage, panel)
    assert panel.tasks.held


@pytest.mark.parametrize(
    ("driver", "who", "said"),
    [
        ("tablet", public_id("me"), "You have control."),
        ("tablet (2)", public_id("me"), "You have control."),
        ("Ben", "other", "Ben has control."),
        ("tablet", "other", "tablet has control."),
    ],
)
def test_who_has_control_is_told_so_and_nobody_of_the_same_name(
    session: Session, driver: str, who: str, said: str
) -> None:
    heard: list[Any] = []
    session.listeners.append(lambda name, post: name == EVENT and heard.append(post.value.text))
    taken = Event(id=1, kind="control", text=f"{driver} has control.", code="control_taken", actor_id=who)
    tell(session, EVENT, taken)
    assert heard == [said]


@pytest.mark.parametrize("form", ["wide", "short", "tall"])
def test_a_robot_without_missions_and_tasks_is_offered_none(
    stage: Stage, session: Session, form: str
) -> None:
    from app.screens.mission.mission_panel import MissionPanel

    session.robot.capabilities = Capabilities({"/odom": "nav_msgs/Odometry"}, frozenset())
    panel: Any = MissionPanel(session, Dashboard(session.feeds))
    chosen: list[str] = []
    panel.lacking.bind(on_choose=lambda _, screen: chosen.append(screen))
    panel.take_form(form)
    stage.show(panel, SIZES.get(form, (316, 600)))
    settle(stage, panel)
    assert [one.parent for one in (panel.ids["send"].parent, panel.motion, panel.tasks)] == [None] * 3
    assert seen(panel, panel.lacking)
    assert panel.lacking.top > panel.center_y, "it begins at the top"
    panel.lacking.ids.drive.dispatch("on_release")
    assert chosen == ["drive"]
    screen = FloatLayout()
    panel.put_tasks(screen, Rect(0, 0, 200, 100))
    assert (panel.plain.parent, panel.plain.width) == (screen, 200)
    panel.put_tasks(screen, None)
    assert panel.plain.parent is None


def test_a_robot_that_turns_out_to_have_tasks_is_offered_them(stage: Stage, session: Session) -> None:
    from app.screens.mission.mission_panel import MissionPanel

    session.robot.capabilities = Capabilities({}, frozenset())
    panel: Any = MissionPanel(session, Dashboard(session.feeds))
    panel.take_form("wide")
    stage.show(panel, (316, 600))
    settle(stage, panel)
    session.robot.capabilities = Capabilities({}, frozenset({"/task/start", "/mission/set"}))
    settle(stage, panel)
    assert seen(panel, panel.ids["send"])
    assert panel.lacking.parent is None
    assert panel.figures.parent is panel.readouts
