"""The switches of a robot's payloads: what is off is not offered by any gateway and takes no power."""

from __future__ import annotations

from collections.abc import Callable

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import camera_topics
from bridge.msgs.pilothouse_msgs import (
    LightState,
    Payload,
    PayloadArray,
    SetPayloadRequest,
    SetPayloadResponse,
)
from bridge.msgs.std_msgs import Time
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.core.text import plain
from robotside.door.station_door import StationDoor
from robotside.kinds.registry import kind_of
from robotside.services.preconditions import Preconditions
from robotside.station.station import Station

__all__ = ["TOPIC", "PayloadSwitches"]

TOPIC = "/payloads"

_NEEDED = {
    "robot": "Who the robot is, STOP and control are always there.",
    "tasks": "What pauses and ends a task has to be at hand.",
    "laser": "The laser keeps the robot off obstacles and tells it where it is.",
    "bumper": "The bumper stops the robot where it touches something.",
    "imu": "It tells how the robot leans, by which its speed is limited.",
}
"""Payloads that are never switched off, with the reason."""
_INSTEAD_OF_LASER = {
    "sonar": "Without a laser the sonars keep the robot off obstacles.",
    "satellite": "Without a laser the satellites tell where the robot is, and where its fence.",
    "compass": "Without a laser the compass tells where the robot looks.",
}
"""Payloads that a robot without a laser needs."""
_MEASURES_LEVEL = ("ranges", "depth")
"""Payloads by which what flies or dives knows how high or deep it is."""
_HIDDEN = "wheels"
"""The payload whose sensors go on: the robot needs to know how it moves, whoever else is told."""


class PayloadSwitches:
    """The payloads of one robot, for clients."""

    def __init__(self, door: StationDoor, station: Station, on_change: Callable[[], None]) -> None:
        """`on_change` is called whenever one was switched."""
        self._door, self._station, self._on_change = door, station, on_change
        self._permits = Preconditions(station)
        self._off: dict[str, Payload] = {}
        """Those that are off, by key, as they were."""
        self._wanted = False
        door.make(TOPIC, self._want)
        service = door.answering.service(
            "/payloads/set", self._set, "SetPayload", SetPayloadRequest, SetPayloadResponse
        )
        door.also([service])

    def _want(self, wanted: bool) -> None:
        self._wanted = wanted
        self._update()

    def _update(self) -> None:
        if self._wanted:
            self._station.bus.publish(TOPIC, PayloadArray(Time.at(self._station.clock()), self._payloads()))

    def _payloads(self) -> list[Payload]:
        from robotside.gateways.payloads.offered import CALL, RUN, offered
        from robotside.gateways.payloads.table import PAYLOADS

        there = dict(self._off)
        for each in offered(self._door):
            key, why = each.payload.key, self._why_fixed(each.payload.key)
            if key in self._off:
                continue
            commands = [line.name for line in each.lines if line.verb in (CALL, RUN)]
            topics = [line.name for line in each.lines if line.name not in commands]
            there[key] = Payload(key, each.payload.doc, True, bool(why), why, topics, commands)
        return [there[each.key] for each in PAYLOADS if each.key in there]

    def _set(self, client: Operator, asked: SetPayloadRequest) -> str:
        key = plain(asked.key, 50)
        known = {each.key: each for each in self._payloads()}
        if key not in known:
            said = f"This robot has no payload {key!r}; it has {', '.join(known)}."
            raise Refusal(Notice(Code.PAYLOAD_UNKNOWN, said, payload=key))
        words = key.replace("_", " ")
        if known[key].on == asked.on:
            return f"{words.capitalize()} is {_word(asked.on)} already."
        if not asked.on:
            self._may_go(known[key], client)
        who = self._station.controls.name(client)
        said = f"{who} switched {words} {_word(asked.on)}."
        self._switch(known[key], said, on=asked.on, actor_id=self._station.controls.id(client), name=who)
        return f"{words.capitalize()} is {_word(asked.on)}."

    def leave_out(self, key: str) -> None:
        """Switch a payload off because the robot was brought up without it. Raises Refusal where something needs it."""
        known = {each.key: each for each in self._payloads()}
        if key not in known:
            said = f"This robot has no payload {key!r} to go without; it has {', '.join(known)}."
            raise Refusal(Notice(Code.PAYLOAD_UNKNOWN, said, payload=key))
        if known[key].on:
            self._may_go(known[key])
            said = f"{key.replace('_', ' ').capitalize()} is off: the robot was brought up without."
            self._switch(known[key], said, on=False)

    def _switch(self, was: Payload, said: str, *, on: bool, actor_id: str = "", name: str = "") -> None:
        """Switch it, and tell of it by the sentence `said`; `name` is who did so, nobody at the start."""
        key = was.key
        if on:
            del self._off[key]
        else:
            self._off[key] = Payload(key, was.doc, False, False, said, was.topics, was.services)
        self._door.switch(key, self._names(key), on=on, power=key != _HIDDEN)
        notice = Notice(
            Code.PAYLOAD_SWITCHED, said, actor_id=actor_id, name=name, payload=key, state=_word(on)
        )
        self._station.events.say("control", notice)
        self._update()
        self._on_change()

    def _may_go(self, payload: Payload, client: Operator | None = None) -> None:
        """Raises Refusal where something needs it; what moves or shines on it is at rest afterwards."""
        key = payload.key
        if payload.fixed:
            raise Refusal(Notice(Code.PAYLOAD_FIXED, f"{payload.why} It stays on.", payload=key))
        if client is not None:
            self._permits.may_change(client)
        self._permits.idle()
        if self._station.controls.driver is not None and not self._station.at_rest:
            said = f"Somebody drives the robot: {key.replace('_', ' ')} stays on until it stands."
            raise Refusal(Notice(Code.PAYLOAD_IN_USE, said, payload=key))
        if key == "arm":
            self._station.robot.hold_payloads()
        if key == "lights":
            try:
                self._station.robot.command("lights", LightState(brightness=0.0))
            except ValueError as problem:
                raise Refusal(Notice(Code.EQUIPMENT_REFUSED, str(problem))) from problem

    def _why_fixed(self, key: str) -> str:
        if key in _INSTEAD_OF_LASER and not self._door.offers("/scan"):
            return _INSTEAD_OF_LASER[key]
        kind = kind_of(self._station.info.kind)
        if key in _MEASURES_LEVEL and (kind.flies or kind.dives):
            return "It tells how high or deep the robot is."
        return _NEEDED.get(key, "")

    def _names(self, key: str) -> set[str]:
        """Every topic, service and action of a payload, those of this robot alone too."""
        from robotside.gateways.payloads.table import key_of

        door = self._door
        found = {name for name in (*door.topics, *door.services, *door.actions) if key_of(name) == key}
        return found | set(camera_topics(door.info.cameras).values()) if key == "camera" else found


def _word(on: bool) -> str:
    return "on" if on else "off"
