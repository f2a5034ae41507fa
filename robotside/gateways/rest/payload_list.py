"""The payloads as a resource: what each can do, and what it says."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import msgspec

from bridge.codec import to_json
from bridge.core.robot_catalogue import Operator
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads.offered import READ, OfferedPayload, offered
from robotside.gateways.rest.statuses import Rejected

__all__ = ["payload_list", "payload_state"]


def payload_list(door: StationDoor, keys: Collection[str]) -> dict[str, Any]:
    """What the robot carries among `keys`, with topics, services and examples."""
    return {"payloads": [_shown(each) for each in offered(door, keys)]}


def _shown(each: OfferedPayload) -> dict[str, Any]:
    lines = [
        {
            "verb": line.verb,
            "name": line.name,
            "type": line.type,
            "rate": line.rate,
            "doc": line.doc,
            "units": line.units,
            "example": line.example,
        }
        for line in each.lines
    ]
    return {"key": each.payload.key, "doc": each.payload.doc, "lines": lines}


def payload_state(door: StationDoor, keys: Collection[str], operator: Operator, key: str) -> bytes:
    """The newest messages of a payload's topics, as JSON; Rejected (404) for a payload that is not there.

    Raises Refused for who may not read them.
    """
    for each in offered(door, keys):
        if each.payload.key == key:
            break
    else:
        raise Rejected(404, f"This robot has no payload {key[:60]!r} here; GET payloads.")
    topics = []
    for line in each.lines:
        if line.verb == READ and not line.on_demand:
            door.check(operator, "subscribe", line.name)
            msg = door.last(line.name)
            message = None if msg is None else msgspec.Raw(to_json(msg))
            topics.append({"name": line.name, "type": line.type, "message": message})
    return msgspec.json.encode({"key": key, "doc": each.payload.doc, "topics": topics})
