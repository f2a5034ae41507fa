"""The guide of the SOAP gateway, with lines that a shell takes as they are."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator
from xml.sax.saxutils import escape

from bridge.msgs.pilothouse_msgs import ArmState, PlaceArray
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads import offered
from robotside.gateways.payloads.offered import OfferedPayload
from robotside.gateways.soap.fields import NS, SOAP

__all__ = ["guide"]


def guide(url: str, door: StationDoor, payloads: Iterable[OfferedPayload]) -> str:
    """How to use the robot by curl, by zeep and by node's soap at this URL."""
    has = {line.name: line for each in payloads for line in each.lines}
    lines = [
        f"SOAP 1.1 at {url}, WSDL at {url}?wsdl.",
        "The header Caller has a clientId, by which a client keeps control between its calls, and a commandId, by which a",
        "command that is sent again is done once. A token goes into the HTTP header Authorization: Bearer TOKEN.",
        "A refusal is a Fault with the robot's sentence, and its code in the detail. To be called back, a client serves what",
        f"{url}?subscriber.wsdl says, at its own address.",
        "",
        "pip install zeep",
        _zeep(url, "GetStatus()"),
        _node(url, "GetStatus"),
        "",
        *(
            line
            for operation, parts in _calls(door, has)
            for line in (f"# {operation}", _curl(url, operation, parts))
        ),
    ]
    return "\n".join(lines)


def _calls(door: StationDoor, has: dict[str, offered.Line]) -> Iterator[tuple[str, dict[str, str]]]:
    """Operations with what they are given, of those that this robot has."""
    yield "Stop", {}
    yield "GetInfo", {}
    yield "GetStatus", {}
    if "/pose" in has:
        yield "GetPose", {}
    if "/task/start" in has:
        yield from _tasks(door)
    arm = door.last("/arm")
    if "/arm/move" in has and isinstance(arm, ArmState) and arm.poses:
        yield "MoveArm", {"pose": arm.poses[0]}
    for line in has.values():
        if line.verb == offered.PUBLISH and not line.rate and line.example:
            yield "PublishMessage", {"topic": line.name, "message": line.example}
            break
    yield "GetMessage", {"topic": "/control/status"}
    yield "Subscribe", {"topic": "/events"}


def _tasks(door: StationDoor) -> Iterator[tuple[str, dict[str, str]]]:
    yield "ListPlaces", {}
    told = door.last("/places")
    names = [place.name for place in told.places] if isinstance(told, PlaceArray) else []
    if len(names) > 1:
        yield "Deliver", {"source": names[0], "target": names[1], "item": "coffee"}
    if names:
        yield "GoTo", {"place": names[0]}
        yield "GuideTo", {"place": names[-1]}
    for name in ("Pause", "Resume", "Cancel"):
        yield name, {}


def _curl(url: str, operation: str, parts: dict[str, str]) -> str:
    inner = "".join(f"<{name}>{escape(value)}</{name}>" for name, value in parts.items())
    body = f'<{operation} xmlns="{NS}">{inner}</{operation}>'
    said = f'<s:Envelope xmlns:s="{SOAP}"><s:Body>{body}</s:Body></s:Envelope>'
    action = f'SOAPAction: "{NS}#{operation}"'
    return f"curl -s {shlex.quote(url)} -H 'Content-Type: text/xml; charset=utf-8' -H {shlex.quote(action)} -d {shlex.quote(said)}"


def _zeep(url: str, call: str) -> str:
    program = f'import zeep; print(zeep.Client("{url}?wsdl").service.{call})'
    return f"python -c {shlex.quote(program)}"


def _node(url: str, operation: str) -> str:
    program = f'require("soap").createClientAsync("{url}?wsdl").then((robot) => robot.{operation}Async({{}}))'
    return f"node -e {shlex.quote(program + '.then(([answer]) => console.log(answer))')}"
