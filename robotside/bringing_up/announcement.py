"""What `serve` tells of a robot in the terminal, in few lines; its usage sheet has the rest."""

from __future__ import annotations

from collections.abc import Mapping
from urllib.parse import urlsplit

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import Event
from bridge.trust.robot_link import RobotLink
from robotside.gateways.addresses import EVERYWHERE, is_here
from robotside.trust.qr import as_text

__all__ = ["news", "qr_code", "ready"]


def ready(robot: str, bridge: str, site: str, gateways: Mapping[str, str], *, host: str) -> list[str]:
    """That `robot` is served; `gateways` are URLs by protocol, `host` is what it listens on."""
    lines = [f"robotside: ready bridge={bridge} http={site} robot={robot}"]
    lines += [f"robotside: gateway {protocol}={url}" for protocol, url in gateways.items()]
    return [*lines, f"robotside: usage {site}/{_guide(site, host)}"]


def qr_code(robot: str, bridge: str) -> str:
    """A QR code that brings the app to the robot; empty where no other machine reaches it."""
    parts = urlsplit(bridge)
    if not parts.hostname or is_here(parts.hostname):
        return ""
    link = RobotLink.of(bridge, robot).text
    return f"{as_text(link)}\nTo connect to {robot}, scan this with the phone's camera.\n{link}"


def news(robot: str, event: Msg) -> str:
    """What an event tells of a gateway, such as that its broker does not answer, or of a payload; empty for any other."""
    if isinstance(event, Event) and event.code.startswith(("gateway_", "payload_")):
        return f"robotside: {robot}: {event.text}"
    return ""


def _guide(site: str, host: str) -> str:
    """The command that shows the same in the terminal; empty where a program of this machine needs a key for it."""
    if not (is_here(host) or host in EVERYWHERE):
        return ""
    port = urlsplit(site).port or 80
    return " or python -m robotside guide" + (f" --at http://127.0.0.1:{port}" if port != 8080 else "")
