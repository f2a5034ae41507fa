"""Codes on their way out: what a client gets beside each sentence, and that a restart changes none of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.core.identity import public_id
from bridge.msgs.pilothouse_msgs import CommandRequest, Event, StartTaskRequest, TaskOrder, TaskStatus
from tests.fakes import FakeRobot
from tests.robotside.scene import SQUARE, Scene

ANNA, BERT = {"client_id": "a1", "client_name": "tablet"}, {"client_id": "b2", "client_name": "tablet"}
ANNA_ID, BERT_ID = public_id("a1"), public_id("b2")


@pytest.fixture(autouse=True)
def controlled(scene: Scene) -> None:
    assert scene.ask("/control/acquire", CommandRequest(**ANNA)).success


def told(scene: Scene, code: str) -> Event:
    (event,) = [msg for msg in scene.of("/events") if isinstance(msg, Event) and msg.code == code]
    return event


def named(msg: Event | TaskStatus) -> dict[str, str]:
    return {pair.key: pair.value for pair in msg.parameters}


def test_of_two_of_one_name_the_id_tells_who_it_was(scene: Scene) -> None:
    taken = told(scene, "control_taken")
    assert (taken.text, taken.actor_id, named(taken)) == ("tablet has control.", ANNA_ID, {"name": "tablet"})
    scene.ask("/stop", CommandRequest(**BERT), scene.client("bert"))
    pressed = told(scene, "stop_pressed")
    assert (pressed.text, pressed.actor_id) == ("STOP pressed by tablet (2).", BERT_ID)
    assert named(pressed) == {"name": "tablet (2)"}
    assert scene.control.stopped_by_id == BERT_ID


def test_a_refusal_says_why_and_about_whom(scene: Scene) -> None:
    answer = scene.ask("/control/acquire", CommandRequest(**BERT), scene.client("bert"))
    assert (answer.code, answer.actor_id) == ("control_held", ANNA_ID)
    scene.ask("/stop", CommandRequest(**ANNA))
    assert scene.ask("/task/go_home", CommandRequest(**ANNA)).code == "stop_is_pressed"
    late = CommandRequest(**ANNA, stamp=scene.clock - 60.0, valid_for=5.0)
    answer = scene.ask("/task/pause", late)
    assert answer.code == "command_late"
    assert {pair.key: pair.value for pair in answer.parameters} == {"age": "60", "allowed": "5"}


def test_what_is_accepted_has_no_code(scene: Scene) -> None:
    answer = scene.ask("/control/acquire", CommandRequest(**ANNA))
    assert (answer.success, answer.code, answer.actor_id, answer.parameters) == (True, "", "", [])


def test_why_a_task_is_paused_stands_in_its_status_until_it_goes_on(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    scene.ask("/task/pause", CommandRequest(**ANNA))
    assert (scene.task.reason, scene.task.code, scene.task.actor_id) == (
        "Paused by tablet.",
        "task_paused",
        ANNA_ID,
    )
    scene.ask("/task/resume", CommandRequest(**ANNA))
    scene.run(1.0)
    assert (scene.task.state, scene.task.code, scene.task.actor_id, scene.task.parameters) == (
        "RUNNING",
        "",
        "",
        [],
    )


def test_a_task_that_cannot_be_done_is_refused_by_the_code_of_what_is_wrong_in_it(scene: Scene) -> None:
    order = TaskOrder(task="go_to", places=["Nowhere"])
    answer = scene.ask("/task/start", StartTaskRequest(**ANNA, order=order))
    assert (answer.code, answer.parameters[0].value) == ("place_unknown", "Nowhere")


def test_a_code_is_the_same_after_a_restart(scene: Scene, tmp_path: Path) -> None:
    scene.ask("/stop", CommandRequest(**ANNA))
    before = told(scene, "stop_pressed")
    again = Scene(FakeRobot(), tmp_path)
    (kept,) = [event for event in again.station.events.since(0, "b1") if event.id == before.id]
    assert kept == before
