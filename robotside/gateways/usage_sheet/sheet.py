"""What a usage sheet says, made from what runs."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from urllib.parse import urlsplit

from bridge.core.address import at_port
from bridge.msgs.pilothouse_msgs import ControlStatus, TaskStatus
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads.offered import CALL, PUBLISH, READ, Line, OfferedPayload, offered
from robotside.gateways.usage_sheet.pasted import RobotKey, curl, without_tls
from robotside.gateways.usage_sheet.running import Running

__all__ = ["Command", "Sheet", "make_sheet", "rosbridge_message", "stop_words"]


@dataclass(frozen=True, slots=True)
class Command:
    """One line for a shell."""

    doc: str
    line: str


@dataclass(frozen=True, slots=True)
class Sheet:
    """A usage sheet for one reader."""

    name: str
    about: str
    """What the robot is, and where."""
    state: str
    """What it does now."""
    stopped: str
    """That STOP is pressed, by whom, and what releases it; empty while it is not."""
    bridge: str
    """URL of the rosbridge socket, for this reader."""
    commands: tuple[Command, ...]
    program: str
    """A program in Python."""
    gateways: tuple[Running, ...]
    payloads: tuple[OfferedPayload, ...]
    services: tuple[tuple[str, str], ...]
    """Services of no payload, each with its type."""


def make_sheet(
    door: StationDoor, bridge: str, site: str, gateways: Sequence[Running], pin: str = ""
) -> Sheet:
    """The sheet for who came by the URL `site`.

    `bridge` is the rosbridge socket's own URL. `pin` is the hash of the robot's public key, by which curl knows it.
    """
    info, status = door.info, door.last("/task/status")
    payloads = offered(door)
    told = {line.name for each in payloads for line in each.lines}
    reached = _reached(bridge, site)
    return Sheet(
        info.name,
        f"{info.description}{f' in {info.world}' if info.world else ''}.",
        (status.reason if isinstance(status, TaskStatus) else "") or "It has no task.",
        stop_words(door),
        reached,
        tuple(_commands(site, [name for name in info.cameras if not door.is_off(name)], pin)),
        _program(reached),
        tuple(gateways),
        payloads,
        tuple((name, each.type) for name, each in sorted(door.services.items()) if name not in told),
    )


def stop_words(door: StationDoor, *, named: bool = True) -> str:
    """That STOP is pressed, by whom while `named`, and what releases it, as a sentence; empty while it is not pressed."""
    status = door.last("/control/status")
    if not isinstance(status, ControlStatus) or not status.stopped:
        return ""
    by = f" by {status.stopped_by}" if named and status.stopped_by else ""
    return f"STOP is pressed{by}; release it in the app."


def rosbridge_message(line: Line) -> str:
    """What a client of rosbridge sends to do what `line` offers."""
    if line.verb == READ:
        said: dict[str, object] = {"op": "subscribe", "topic": line.name}
    elif line.verb == PUBLISH:
        said = {"op": "publish", "topic": line.name, "msg": json.loads(line.example or "{}")}
    elif line.verb == CALL:
        said = {"op": "call_service", "service": line.name, "args": json.loads(line.example or "{}")}
    else:
        goal = json.loads(line.example or "{}")
        said = {
            "op": "send_action_goal",
            "id": "1",
            "action": line.name,
            "action_type": line.type,
            "args": goal,
        }
    return json.dumps(said)


def _reached(bridge: str, site: str) -> str:
    """The rosbridge socket as who came by `site` reaches it: by the same host, and encrypted if that is."""
    parts, port = urlsplit(site), urlsplit(bridge).port
    if not parts.hostname or port is None:
        return bridge
    return f"{'wss' if parts.scheme == 'https' else 'ws'}://{at_port(parts.hostname, port)}"


def _commands(site: str, cameras: Sequence[str], pin: str) -> list[Command]:
    known = curl(site, RobotKey(pin))
    found = [
        Command("STOP, from anyone and at any time", f"curl -X POST {without_tls(site)}/stop"),
        Command("health, for who watches over many", f"curl{known} {site}/healthz"),
        Command("this sheet as text", f"curl{known} {site}/usage.txt"),
    ]
    for name in cameras:
        picture = shlex.quote(f"{site}/snapshot/{name}.jpg?width=320")
        found.append(Command(f"a picture of the camera {name}", f"curl{known} -o {name}.jpg {picture}"))
    return found


def _program(bridge: str) -> str:
    secure = bridge.startswith("wss:")
    proof = ', credentials=Credentials("FINGERPRINT", "TOKEN")' if secure else ""
    return "\n".join(
        [
            *(["from bridge.client.credentials import Credentials"] if secure else []),
            "from bridge.client import RemoteRobot",
            "from bridge.msgs.pilothouse_msgs import GetEventsRequest, GetEventsResponse",
            "",
            f'with RemoteRobot("{bridge}"{proof}) as robot:',
            "    robot.wait()",
            '    robot.on("/battery_state", lambda message: print(message.percentage))',
            '    answer = robot.call("/events/get", GetEventsRequest(most=5), GetEventsResponse)',
            "    for event in answer.events:",
            "        print(event.text)",
        ]
    )
