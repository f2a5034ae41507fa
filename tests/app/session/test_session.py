"""What the operator is told of STOP on a robot that has one, in virtual time."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from app.core.command_origin import Origin
from app.core.settings_store import Settings
from app.link.channels import EVENT, LINK, OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Feeds, Post
from app.session.session import Session
from app.stop.stop_state import REST_TIMEOUT
from bridge.client.client import LinkState, Phase
from bridge.core.identity import public_id
from bridge.msgs.pilothouse_msgs import ControlStatus, Event, TaskStatus
from tests.bridge.wires import Clock

UNREACHED = "STOP is pressed, but the robot cannot be reached: the connection was cut."


class Wire:
    """Stands for the link; notes what it is asked for."""

    url = "ws://127.0.0.1:9090"
    state = LinkState(Phase.CONNECTED, "", 0, 0.0)
    silence = 0.0
    robot_time = staticmethod(lambda: math.nan)

    def __init__(self) -> None:
        self.asked: list[str] = []

    def stop(self) -> None:
        self.asked.append("stop")

    def unlatch(self) -> None:
        self.asked.append("unlatch")

    def latch(self) -> None:
        self.asked.append("latch")

    def command(self, name: str, **_: object) -> None:
        self.asked.append(name)


class Watch:
    """A session, its clock and its link."""

    def __init__(self, folder: Path) -> None:
        self.clock, self.link = Clock(), Wire()
        self.session = Session(
            self.link,  # type: ignore[arg-type]
            Feeds(self.clock),
            Settings(folder / "settings.json"),
            now=self.clock,
            client_id="me",
            wants_control=False,
        )

    def told(self, *, stopped: bool = True, at_rest: bool) -> None:
        mode = "STOPPED" if stopped else "MANUAL"
        status = ControlStatus(mode=mode, stopped=stopped, at_rest=at_rest)
        self.session.deliver("/control/status", Post(status, self.clock.time, 1))

    def outcome(self, phase: str, reason: str = "") -> None:
        self.session.deliver(OUTCOME, Post(Outcome("stop", "1", phase, reason), self.clock.time, 1))


@pytest.fixture
def watch(tmp_path: Path) -> Watch:
    return Watch(tmp_path)


def test_stop_is_done_when_the_robot_says_that_it_rests(watch: Watch) -> None:
    watch.session.stop()
    watch.outcome("sent")
    assert watch.session.robot_stop.phase == "sent"
    watch.told(at_rest=False)
    watch.outcome("accepted")
    assert (watch.session.robot_stop.phase, watch.session.robot_stop.latched) == ("sent", True)
    watch.told(at_rest=True)
    assert watch.session.robot_stop.phase == "stopped"


def test_a_robot_that_does_not_come_to_rest_in_time_is_said_to_move(watch: Watch) -> None:
    watch.told(at_rest=False)
    watch.clock.time += REST_TIMEOUT - 0.1
    watch.told(at_rest=False)
    assert watch.session.robot_stop.phase == "sent"
    watch.clock.time += 0.2
    assert watch.session.robot_stop.phase == "moves"
    assert watch.session.robot_stop.sentence == "STOP is pressed, and it does not come to rest."
    watch.told(at_rest=True)
    assert watch.session.robot_stop.phase == "stopped"


def test_a_robot_that_was_stopped_when_its_link_was_lost_is_not_said_to_be_stopped(watch: Watch) -> None:
    watch.told(at_rest=True)
    watch.session.deliver(LINK, Post(LinkState(Phase.WAITING, "No robot answers.", 1, 1.0), 0.0, 1))
    watch.clock.time += 4.0
    assert watch.session.robot_stop.phase == "lost"
    assert watch.session.robot_stop.lost_for == 4.0
    assert watch.session.robot_stop.sentence == "STOPPED when it was last heard, 4 s ago. No robot answers."


def test_what_somebody_else_releases_is_ready_to_be_pressed_again(watch: Watch) -> None:
    watch.session.stop()
    watch.told(at_rest=True)
    watch.outcome("accepted")
    watch.told(stopped=False, at_rest=True)
    watch.clock.time += 60.0
    assert watch.session.robot_stop.phase == "ready"


def test_a_robot_side_that_cannot_reach_its_robot_has_not_stopped_it(watch: Watch) -> None:
    watch.outcome("sent")
    watch.told(at_rest=False)
    watch.outcome("no_reply", UNREACHED)
    assert (watch.session.robot_stop.phase, watch.session.robot_stop.latched) == ("no_answer", True)
    watch.outcome("accepted")
    assert watch.session.robot_stop.phase == "sent"
    watch.told(at_rest=True)
    assert watch.session.robot_stop.phase == "stopped"


def test_who_else_pressed_stop_is_said_though_it_has_the_same_name(tmp_path: Path) -> None:
    watch = Watch(tmp_path)
    for client_id, said in (("other", "Pressed by tablet."), (public_id("me"), "")):
        status = ControlStatus(stopped=True, stopped_by="tablet", stopped_by_id=client_id)
        watch.session.deliver("/control/status", Post(status, watch.clock.time, 1))
        assert watch.session.robot_stop.sentence == said


def test_stop_can_be_let_go_before_it_was_done_and_is_asked_for_no_longer(watch: Watch) -> None:
    watch.outcome("no_reply", UNREACHED)
    watch.told(at_rest=False)
    watch.session.release_stop()
    assert watch.link.asked == ["unlatch", "stop_release"]
    watch.told(stopped=False, at_rest=False)
    assert (watch.session.robot_stop.phase, watch.session.robot_stop.latched) == ("ready", False)


@pytest.mark.parametrize("late", ["no_reply", "refused", "accepted"])
def test_a_stop_that_was_released_is_not_sent_over_the_next_link_for_a_late_word_about_it(
    watch: Watch, late: str
) -> None:
    watch.session.stop()
    watch.outcome("sent")
    watch.session.release_stop()
    watch.outcome(late, UNREACHED)
    next_link = Wire()
    watch.session.resume(next_link)  # type: ignore[arg-type]
    assert next_link.asked == []
    assert watch.session.robot_stop.phase == "ready"
    assert not watch.session.command_sent("stop")


def test_a_stop_that_is_not_done_goes_on_over_a_new_link(watch: Watch) -> None:
    watch.outcome("no_reply", UNREACHED)
    new = Wire()
    watch.session.resume(new)  # type: ignore[arg-type]
    assert new.asked == ["stop"]
    watch.outcome("accepted")
    later = Wire()
    watch.session.resume(later)  # type: ignore[arg-type]
    assert later.asked == []


def test_a_stop_that_was_pressed_at_the_last_moment_of_a_link_goes_on_over_the_next(watch: Watch) -> None:
    """Nothing has come back of it yet, not even that it is on its way."""
    watch.session.stop()
    new = Wire()
    watch.session.resume(new)  # type: ignore[arg-type]
    assert "stop" in new.asked


def test_a_link_that_is_lost_and_found_before_anybody_looks_brings_every_control_to_rest(
    watch: Watch,
) -> None:
    rests: list[str] = []
    watch.session.on_rest = lambda: rests.append("rest")
    for phase in (Phase.CONNECTED, Phase.CONNECTING, Phase.CONNECTED):
        watch.session.deliver(LINK, Post(LinkState(phase, "", 0, 0.0), watch.clock(), 1))
    assert rests == ["rest"]


def test_what_paused_the_task_and_gave_stop_is_told_as_done_here(watch: Watch) -> None:
    reason = "Paused by vm (2)."
    other = TaskStatus(task_id=1, state="PAUSED", reason=reason, code="task_paused", actor_id="other")
    watch.session.deliver("/task/status", Post(other, watch.clock(), 1))
    assert watch.session.feeds.latest("/task/status").reason == "Paused by vm (2)."
    mine = TaskStatus(task_id=1, state="PAUSED", reason=reason, code="task_paused", actor_id=public_id("me"))
    watch.session.deliver("/task/status", Post(mine, watch.clock(), 1))
    assert watch.session.feeds.latest("/task/status").reason == "You paused."
    shaken = Outcome("stop", "1", "accepted", origin=Origin("shake", 0.97, said="left-right"))
    watch.session.deliver(OUTCOME, Post(shaken, watch.clock(), 1))
    text = "STOP pressed by vm (2)."
    stop = Event(id=1, kind="stop", level="alarm", text=text, code="stop_pressed", actor_id=public_id("me"))
    watch.session.deliver(EVENT, Post(stop, watch.clock(), 1))
    assert watch.session.logbook.events[-1].text == "A shake gave STOP: “left-right”, 97 % sure."


def test_events_are_kept_for_the_screens_until_there_are_any_whoever_else_listens(watch: Watch) -> None:
    watch.session.listeners.append(lambda _channel, _post: None)
    for text, shown in (("before", False), ("after", True)):
        watch.session.events.shown = shown
        watch.session.deliver(EVENT, Post(Event(text=text), watch.clock(), 1))
    assert [post.value.text for post in watch.session.events.early] == ["before"]
