"""The guide of the MQTT gateway: what can be read and sent, with lines that a shell takes as they are."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator

from bridge.core.identity import Role
from robotside.gateways.broker.command_desk import CALL, PUBLISH, READ, RUN
from robotside.gateways.gateway_url import GatewayUrl
from robotside.gateways.mqtt.topic_names import TopicNames
from robotside.gateways.payloads import offered
from robotside.gateways.payloads.offered import Line, OfferedPayload
from robotside.gateways.plain.visitor import TIME

__all__ = ["guide"]

_CLIENT = "me"
_EXPIRY = "-D publish message-expiry-interval 2"
_VERBS = {offered.READ: READ, offered.PUBLISH: PUBLISH, offered.CALL: CALL, offered.RUN: RUN}
_STAMP = '-D publish user-property stamp "$(date +%s.%N)"'


def guide(url: GatewayUrl, names: TopicNames, payloads: Iterable[OfferedPayload], role: Role) -> str:
    """How to use the robot by the tools of Mosquitto; the broker's password is left to the reader."""
    where = f"-h {shlex.quote(url.host)} -p {url.port}"
    if url.user:
        where += f" -u {shlex.quote(url.user)} -P PASSWORD"
    if url.scheme == "mqtts":
        where += " --tls-use-os-certs"
    return "\n".join(
        [
            f"MQTT 5 at {url.shown}; all topics of this robot begin with {names.root}/",
            "state says online, offline or lost. Replace `me` by a name of your own; answers come to your topics answer/#,",
            "of a goal (run) also feedback/#; cancel takes it back. What is read on demand, as pictures are, comes on topics/",
            "while you are there: say something once a minute.",
            "A command needs an expiry of at most 10 s, or a stamp, the robot's time in seconds as the user property `stamp`;",
            "to drive takes a stamp of less than 0.25 s ago, from a client that has called rosapi/get_time. A token goes into",
            "the user property `token`. The role that everybody has here: " + role.word + ".",
            "",
            f"mosquitto_sub {where} -v -t {shlex.quote(names.root + '/#')}",
            f"mosquitto_pub {where} -V 5 -t {shlex.quote(names.command(_CLIENT, CALL, TIME))} -m '{{}}'",
            *(line for each in payloads for line in _payload(where, names, each)),
        ]
    )


def _payload(where: str, names: TopicNames, each: OfferedPayload) -> Iterator[str]:
    yield ""
    yield f"{each.payload.key}: {each.payload.doc}"
    for line in each.lines:
        command = _command(where, names, line)
        if command:
            units = f"; {line.units}" if line.units else ""
            yield f"  # {line.doc} ({line.type}{units})"
            yield f"  {command}"


def _command(where: str, names: TopicNames, line: Line) -> str:
    if line.verb == offered.READ and not line.on_demand:
        return f"mosquitto_sub {where} -t {shlex.quote(names.topic(line.name))}"
    # what is made on demand comes on its topic once it is asked for
    topic = shlex.quote(names.command(_CLIENT, _VERBS[line.verb], line.name))
    fresh = _STAMP if line.verb == offered.PUBLISH and line.rate else _EXPIRY
    return f"mosquitto_pub {where} -V 5 {fresh} -t {topic} -m {shlex.quote(line.example or '{}')}"
