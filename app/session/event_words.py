"""Words for what this handheld did itself, chosen by a code and an actor's id.

A robot tells what somebody did by that one's name. Whoever did it reads "you" instead. What has no code, as from a robot
that is not ours or runs an older program, stays in the robot's own words.
"""

from __future__ import annotations

from collections.abc import Mapping

from msgspec.structs import replace

from app.core.robot_sentences import sentence
from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event, TaskStatus
from widgets.core.language import mark, tr

__all__ = ["own_event", "own_reason"]

_EVENTS: Mapping[str, str] = {
    Code.CONTROL_TAKEN: mark("You have control."),
    Code.STOP_PRESSED: mark("You pressed STOP."),
    Code.STOP_RELEASED: mark("You released STOP."),
    Code.TASK_STOPPED: mark("STOP paused the task."),
    Code.TASK_PAUSED: mark("You paused."),
    Code.TASK_STAYS: mark("You told it to stay at {place}, charging. Resume lets it go on."),
    Code.TASK_TAKEN_OVER: mark("You took the stick."),
    Code.TASK_CANCELED: mark("You canceled it."),
    Code.TASK_DISCARDED: mark("You discarded it."),
}
"""Codes of what an actor did, to the words for that actor."""
_REASONS: Mapping[str, str] = {**_EVENTS, Code.TASK_STOPPED: _EVENTS[Code.STOP_PRESSED]}
"""The same where they stand for why a task is as it is."""


def own_event(event: Event, own_id: str, gave_stop: str = "") -> Event:
    """`event` as it reads on the handheld that the robot publishes by `own_id`.

    `gave_stop` says what gave its STOP, as of `command_origin.gave_stop`; empty for a hand on a button.
    """
    words = _own_words(_EVENTS, event) if own_id and event.actor_id == own_id else ""
    if not words:
        said = sentence(event.code, event.parameters, event.text)
        return event if said == event.text else replace(event, text=said)
    if event.code == Code.STOP_PRESSED:
        words = gave_stop or words
    # its STOP is the alarm; that it paused the task takes nobody's eye from that
    return replace(event, text=words, level="info" if event.code == Code.TASK_STOPPED else event.level)


def own_reason(status: TaskStatus, own_id: str) -> TaskStatus:
    """`status` with its reason as it reads on the handheld that the robot publishes by `own_id`."""
    words = _own_words(_REASONS, status) if own_id and status.actor_id == own_id else ""
    words = words or sentence(status.code, status.parameters, status.reason)
    return status if words == status.reason else replace(status, reason=words)


def _own_words(table: Mapping[str, str], told: Event | TaskStatus) -> str:
    """What the actor reads in place of the robot's sentence; empty where it is told in the robot's."""
    try:
        return tr(table.get(told.code, "")).format_map({pair.key: pair.value for pair in told.parameters})
    except KeyError:  # another program's robot leaves out what its code should name
        return ""
