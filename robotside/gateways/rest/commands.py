"""The commands of the resources: which method of which path calls which service of the robot, and with what."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bridge.codec import shown
from bridge.core.errors import ProtocolError

__all__ = ["COMMANDS", "Command"]

Body = dict[str, Any]
Fill = Callable[[Body, Mapping[str, Any]], Body]
"""Makes the service's request of the body and of the parts of the path."""


def _whole(body: Body, parts: Mapping[str, Any]) -> Body:
    """The body is the request, with what the path names."""
    for name, value in parts.items():
        if body.get(name, value) != value:
            raise ProtocolError(f"{name} is {shown(body[name])} in the body and {shown(value)} in the path.")
    return {**body, **parts}


def _within(field: str) -> Fill:
    """The body is one field of the request."""
    return lambda body, parts: {field: _whole(body, parts)}


@dataclass(frozen=True, slots=True)
class Command:
    """One method of one path."""

    method: str
    path: str
    service: str
    doc: str
    example: str = ""
    """A body that can be sent; empty for one without."""
    field: str = ""
    """The field of the service's request that the body is; empty where it is the whole request."""
    carried: bool = True
    """It is part of a payload; people and their pairing are of none."""

    @property
    def fill(self) -> Fill:
        """Makes the service's request."""
        return _within(self.field) if self.field else _whole

    @property
    def part(self) -> str:
        """What the path names, `id` or `name`; empty for nothing."""
        return self.path.partition("{")[2].partition("}")[0]


_MISSION = '{"waypoints": [{"x": 1.0, "y": 0.0}], "home": [{"x": 0.0, "y": 0.0}]}'
_PLACE = '{"name": "Office 12", "x": 1.0, "y": 2.0}'
_SCHEDULED = '{"at": "08:00", "order": {"task": "patrol"}}'
_POSE = '{"order": {"pose": "home"}}'

COMMANDS: tuple[Command, ...] = (
    Command("POST", "/control", "/control/acquire", "Takes control."),
    Command("DELETE", "/control", "/control/release", "Gives control back."),
    Command("POST", "/control/request", "/control/request", "Asks the driver for control."),
    Command("POST", "/control/grant", "/control/grant", "Gives control to who asked for it."),
    Command("POST", "/control/object", "/control/object", "Keeps control though somebody asked for it."),
    Command("POST", "/stop/hold", "/stop/hold", "Begins to release STOP; call /stop/release a second later."),
    Command("POST", "/stop/release", "/stop/release", "Releases STOP at the end of the hold."),
    Command("PUT", "/mode", "/mode/set", "MANUAL pauses the task, AUTO resumes it.", '{"mode": "MANUAL"}'),
    Command("PUT", "/settings/{name}", "/settings/set", "Switches a setting.", '{"value": "on"}'),
    Command("POST", "/place", "/localisation/choose", "Says at which of its candidates it is.", '{"id": 1}'),
    Command("POST", "/robot/reset", "/robot/reset", "Puts a simulated robot back to its start."),
    Command("POST", "/tasks", "/task/start", "Starts a task.", '{"order": {"task": "go_home"}}'),
    Command("DELETE", "/tasks", "/task/cancel", "Ends the task."),
    Command("POST", "/tasks/pause", "/task/pause", "Pauses the task."),
    Command("POST", "/tasks/resume", "/task/resume", "Resumes the task or the queue."),
    Command("POST", "/tasks/cancel", "/task/cancel", "Ends the task."),
    Command("POST", "/tasks/confirm", "/task/confirm", "Answers what the task asks."),
    Command("POST", "/tasks/home", "/task/go_home", "Sends the robot home."),
    Command(
        "PUT",
        "/tasks/queue",
        "/task/queue/set",
        "Replaces the tasks that wait; `revision` is that of the queue that was read.",
        '{"revision": 0, "orders": [{"task": "go_home"}]}',
    ),
    Command("PUT", "/missions/current", "/mission/set", "Stores a mission.", _MISSION, field="mission"),
    Command("POST", "/missions/{name}/recall", "/mission/recall", "Makes a kept mission the stored one."),
    Command("POST", "/places", "/places/set", "Stores a new place.", _PLACE, field="place"),
    Command("PUT", "/places/{id}", "/places/set", "Changes a place.", _PLACE, field="place"),
    Command("DELETE", "/places/{id}", "/places/delete", "Deletes a place."),
    Command("POST", "/schedule", "/schedule/set", "Stores a scheduled task.", _SCHEDULED, field="task"),
    Command("PUT", "/schedule/{id}", "/schedule/set", "Changes a scheduled task.", _SCHEDULED, field="task"),
    Command("DELETE", "/schedule/{id}", "/schedule/delete", "Deletes a scheduled task."),
    Command("POST", "/events/acknowledge", "/events/acknowledge", "Acknowledges events.", '{"ids": [1]}'),
    Command("PUT", "/payloads/arm", "/arm/move", "Moves the arm to a pose, a point or angles.", _POSE),
    Command("POST", "/payloads/arm", "/arm/move", "Moves the arm, also by increments.", _POSE),
    Command("PUT", "/payloads/lights", "/lights/set", "Sets the lights.", '{"brightness": 1.0}'),
    Command("DELETE", "/people/{id}", "/people/remove", "Forgets a person.", carried=False),
    Command("POST", "/people/guests", "/people/guest", "Opens pairing for a guest.", "{}", carried=False),
    Command(
        "POST", "/people/invitations", "/people/invite", "Opens pairing for a handheld.", "{}", carried=False
    ),
)
"""Those whose service a robot lacks answer 404."""
