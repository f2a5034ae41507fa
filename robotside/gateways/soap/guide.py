"""The guide of the SOAP gateway, with lines that a shell takes as they are."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator
from urllib.parse import urlsplit
from xml.sax.saxutils import escape

from bridge.msgs.pilothouse_msgs import ArmState, PlaceArray
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads import offered
from robotside.gateways.payloads.offered import OfferedPayload
from robotside.gateways.soap.fields import NS, SOAP
from robotside.gateways.soap.operations import STOP
from robotside.gateways.usage_sheet.pasted import PLAIN, SHOWN, RobotKey, curl, is_secure, without_tls

__all__ = ["guide"]


def guide(url: str, door: StationDoor, payloads: Iterable[OfferedPayload], key: RobotKey = PLAIN) -> str:
    """How to use the robot, whose key is `key`, by curl, by zeep and by node's soap at this URL."""
    has = {line.name: line for each in payloads for line in each.lines}
    lines = [
        f"SOAP 1.1 at {url}, WSDL at {url}?wsdl.",
        "The header Caller has a clientId, by which a client keeps control between its calls, and a commandId, by which a",
        f"command that is sent again is done once. A token goes into the HTTP header {SHOWN}.",
        "A refusal is a Fault with the robot's sentence, and its code in the detail. To be called back, a client serves what",
        f"{url}?subscriber.wsdl says, at its own address.",
        "",
        "pip install zeep",
        _zeep(url, "GetStatus()", key),
        _node(url, "GetStatus", key),
        "",
        *(
            line
            for operation, parts in _calls(door, has)
            for line in (f"# {operation}", _curl(url, operation, parts, key))
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


def _curl(url: str, operation: str, parts: dict[str, str], key: RobotKey) -> str:
    inner = "".join(f"<{name}>{escape(value)}</{name}>" for name, value in parts.items())
    body = f'<{operation} xmlns="{NS}">{inner}</{operation}>'
    said = f'<s:Envelope xmlns:s="{SOAP}"><s:Body>{body}</s:Body></s:Envelope>'
    action = f'SOAPAction: "{NS}#{operation}"'
    where = without_tls(url) if operation == STOP.name else url
    told = f"-H 'Content-Type: text/xml; charset=utf-8' -H {shlex.quote(action)} -d {shlex.quote(said)}"
    return f"curl -s {shlex.quote(where)} {told}{curl(where, key)}"


def _zeep(url: str, call: str, key: RobotKey) -> str:
    client, imports, begin = f'zeep.Client("{url}?wsdl"', "zeep", ""
    if is_secure(url):
        imports, client = "requests, zeep", f"{client}, transport=zeep.Transport(session=session)"
        begin = (
            f'way = requests.adapters.HTTPAdapter(); way.init_poolmanager(1, 1, assert_fingerprint="{key.fingerprint}"); '
            "session = requests.Session(); session.trust_env = session.verify = False; "
            f'session.headers.update({_header()}); session.mount("https://", way); '
        )
    program = f"import {imports}; {begin}print({client}).service.{call})"
    return f"python -c {shlex.quote(program)}"


def _node(url: str, operation: str, key: RobotKey) -> str:
    options = ", {request}" if is_secure(url) else ""
    program = (
        f'require("soap").createClientAsync("{url}?wsdl"{options}).then((robot) => robot.{operation}Async({{}}))'
        ".then(([answer]) => console.log(answer))"
    )
    return f"node -e {shlex.quote(_known(url, program, key) if options else program)}"


def _known(url: str, program: str, key: RobotKey) -> str:
    """A program for node that knows the robot's certificate by its fingerprint, and sends nothing to another machine."""
    parts = urlsplit(url)
    where = f'{{host: "{parts.hostname}", port: {parts.port or 443}, rejectUnauthorized: false}}'
    return (
        f'const way = require("tls").connect({where}, () => {{ const own = way.getPeerX509Certificate(); way.destroy(); '
        f'if (own.fingerprint256.replaceAll(":", "").toLowerCase() !== "{key.fingerprint}") throw new Error("not the robot"); '
        'const httpsAgent = new (require("https").Agent)({ca: own.toString(), checkServerIdentity: () => undefined}); '
        f'const request = require("axios").create({{httpsAgent, proxy: false, headers: {_header()}}}); {program}; }})'
    )


def _header() -> str:
    name, _, value = SHOWN.partition(": ")
    return f'{{"{name}": "{value}"}}'
