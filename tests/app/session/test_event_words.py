"""What is said of this handheld and what of another of the same name."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from app.core.command_origin import Origin, gave_stop
from app.session.event_words import own_event, own_reason
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Event, TaskStatus

ME, OTHER = "t1", "t2"


@pytest.mark.parametrize(
    ("code", "text", "mine"),
    [
        ("control_taken", "vm has control.", "You have control."),
        ("stop_pressed", "STOP pressed by vm.", "You pressed STOP."),
        ("stop_released", "STOP released by vm.", "You released STOP."),
        ("task_stopped", "Stopped by vm.", "STOP paused the task."),
        ("task_paused", "Paused by vm.", "You paused."),
        ("task_canceled", "Canceled by vm.", "You canceled it."),
        ("task_discarded", "Discarded by vm.", "You discarded it."),
        ("task_taken_over", "Paused: vm took the stick.", "You took the stick."),
    ],
)
def test_of_two_of_one_name_each_is_told_what_is_about_itself(code: str, text: str, mine: str) -> None:
    event = Event(id=1, text=text, code=code, actor_id=ME)
    assert own_event(event, ME).text == mine
    assert own_event(event, OTHER) is event


def test_a_robot_that_gives_no_code_or_no_id_is_shown_in_its_own_words() -> None:
    for event in (
        Event(text="vm has control."),
        Event(text="vm has control.", code="control_taken"),
        Event(text="vm does something.", code="a_code_of_tomorrow", actor_id=ME),
    ):
        assert own_event(event, ME) is event
    assert (
        own_event(Event(text="Somebody has control.", code="control_taken"), "").text
        == "Somebody has control."
    )


def test_a_stop_that_was_guessed_says_what_gave_it_and_its_task_is_no_second_alarm() -> None:
    how = gave_stop(Origin("voice", 0.99, said="the bus will stop"))
    assert how == "Your voice gave STOP: “the bus will stop”, 99 % sure."
    pressed = Event(text="STOP pressed by vm (2).", code="stop_pressed", actor_id=ME)
    assert own_event(pressed, ME, how).text == how
    assert own_event(pressed, OTHER, how).text == "STOP pressed by vm (2)."
    alarm = Event(kind="task", level="alarm", text="Stopped by vm (2).", code="task_stopped", actor_id=ME)
    told_here = own_event(alarm, ME, how)
    assert (told_here.text, told_here.level) == ("STOP paused the task.", "info")
    assert own_event(alarm, OTHER).level == "alarm"
    assert gave_stop(Origin("shake", said="left-right")) == "A shake gave STOP: “left-right”."
    assert gave_stop(Origin("button")) == "", "a finger knows what it did"


def test_why_the_task_is_paused_is_told_of_you_as_well() -> None:
    paused = TaskStatus(state="PAUSED", reason="Paused by vm (2).", code="task_paused", actor_id=ME)
    stopped = TaskStatus(state="PAUSED", reason="Stopped by vm (2).", code="task_stopped", actor_id=ME)
    assert own_reason(paused, ME).reason == "You paused."
    assert own_reason(stopped, ME).reason == "You pressed STOP."
    assert own_reason(paused, OTHER) is paused, "that is another"


def test_of_one_that_was_told_to_stay_where_it_charges_the_place_is_named() -> None:
    told = [KeyValue("name", "vm"), KeyValue("place", "Pad")]
    stays = TaskStatus(
        state="PAUSED", reason="vm had it stay.", code="task_stays", actor_id=ME, parameters=told
    )
    assert own_reason(stays, ME).reason == "You told it to stay at Pad, charging. Resume lets it go on."
    assert own_reason(replace(stays, parameters=[]), ME).reason == "vm had it stay.", "it names no place"
