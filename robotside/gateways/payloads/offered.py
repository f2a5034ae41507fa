"""What one robot has of the table of payloads, with types, rates and examples, for guides and gateways."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads.payload import Exchange, Payload
from robotside.gateways.payloads.table import ALWAYS, KEYS, PAYLOADS

__all__ = ["CALL", "PUBLISH", "READ", "RUN", "Line", "OfferedPayload", "chosen_keys", "offered"]

_AT_POSE = ("/goal_pose", "/initialpose")
"""Topics whose example is the robot's own pose: another one would move it, or what it believes of itself."""
READ, PUBLISH, CALL, RUN = "read", "publish", "call", "run"
"""What a client does: it reads a topic, publishes on one, calls a service, or runs an action."""


@dataclass(frozen=True, slots=True)
class Line:
    """One thing that a client can do with the robot."""

    verb: str
    """`READ`, `PUBLISH`, `CALL` or `RUN`."""
    name: str
    type: str
    """ROS type."""
    rate: float
    """Messages per second [Hz]; 0 for what is sent on change, asked for, or sent once."""
    doc: str
    units: str
    example: str
    """JSON to send; empty for `READ`."""
    latched: bool = False
    """The newest message is there for who comes later."""
    on_demand: bool = False
    """The robot makes it only while somebody reads it."""


@dataclass(frozen=True, slots=True)
class OfferedPayload:
    """A payload that the robot has."""

    payload: Payload
    lines: tuple[Line, ...]


def chosen_keys(words: Collection[str]) -> frozenset[str]:
    """The keys that a user chose, with `ALWAYS`; all of them for none. ValueError with one sentence for one that is unknown."""
    unknown = sorted(set(words) - KEYS)
    if unknown:
        known = ", ".join(payload.key for payload in PAYLOADS)
        raise ValueError(f"There is no payload {', '.join(unknown)}; there are {known}.")
    return frozenset(words) | {ALWAYS} if words else KEYS


def offered(door: StationDoor, keys: Collection[str] = KEYS) -> tuple[OfferedPayload, ...]:
    """The payloads among `keys` that the robot has by what it has told so far, in the order of the table."""
    found = []
    for payload in PAYLOADS:
        if payload.key in keys and (not payload.sign or door.offers(payload.sign)):
            lines = tuple(_lines(door, payload))
            if lines:
                found.append(OfferedPayload(payload, lines))
    return tuple(found)


def _lines(door: StationDoor, payload: Payload) -> Iterator[Line]:
    for each in payload.exchanges:
        line = _line(door, each)
        if line is not None:
            yield line


def _example(door: StationDoor, each: Exchange) -> str:
    """What can be sent to this robot without harm: a pose is the one that it has now, a payload one that it has."""
    where = door.last("/pose")
    if each.name in _AT_POSE and isinstance(where, PoseWithCovarianceStamped):
        at = where.pose.pose
        pose = {
            "position": {"x": round(at.position.x, 3), "y": round(at.position.y, 3)},
            "orientation": {"z": round(at.orientation.z, 4), "w": round(at.orientation.w, 4)},
        }
        whole = {"pose": pose} if each.name == "/initialpose" else pose
        return json.dumps({"header": {"frame_id": "map"}, "pose": whole})
    if each.name == "/payloads/set":
        own = [payload.key for payload in PAYLOADS if payload.sign and door.offers(payload.sign)]
        return json.dumps({"key": (["lights"] * ("lights" in own) + own + ["wheels"])[0], "on": True})
    return each.example


def _line(door: StationDoor, each: Exchange) -> Line | None:
    """The line of a topic, service or action; None when the robot has none of that name."""
    if door.is_off(each.name):
        return None
    example = _example(door, each)
    if each.name in door.services:
        return Line(CALL, each.name, door.services[each.name].type, 0, each.doc, each.units, example)
    if each.name in door.actions:
        return Line(RUN, each.name, door.actions[each.name].type, 0, each.doc, each.units, example)
    topic = door.topics.get(each.name)
    if topic is None or not door.offers(each.name):
        return None
    verb, rate = (PUBLISH if topic.to == "robot" else READ), topic.rate
    kind, doc = topic.type.MSGTYPE, topic.doc
    return Line(
        verb,
        each.name,
        kind,
        rate,
        doc,
        each.units,
        example,
        latched=topic.latched,
        on_demand=topic.on_demand,
    )
