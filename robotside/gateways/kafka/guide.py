"""The guide of the Kafka gateway: what can be read and sent, with lines that a shell takes as they are."""

from __future__ import annotations

import json
import shlex
from collections.abc import Iterable, Iterator

from bridge.core.identity import Role
from robotside.gateways.broker.command_desk import CALL, PUBLISH, READ, RUN
from robotside.gateways.gateway_url import GatewayUrl
from robotside.gateways.kafka.topic_names import TopicNames
from robotside.gateways.payloads import offered
from robotside.gateways.payloads.offered import Line, OfferedPayload
from robotside.gateways.plain.visitor import TIME

__all__ = ["LOST_TIME", "guide"]

LOST_TIME = 3.0
"""A robot whose newest state is older than this [s] is lost."""
_VERBS = {offered.READ: READ, offered.PUBLISH: PUBLISH, offered.CALL: CALL, offered.RUN: RUN}
_SAY = """
import sys, time
from confluent_kafka import Producer
robot = Producer({settings})
headers = {{sys.argv[2]: sys.argv[3], "stamp": str(time.time())}} if len(sys.argv) > 3 else None
robot.produce("{root}." + sys.argv[1], sys.argv[-1], "me", headers=headers)
sys.exit(robot.flush(5))
"""
_HEAR = """
import sys, uuid
from confluent_kafka import Consumer
robot = Consumer({settings} | {{"group.id": str(uuid.uuid4()), "auto.offset.reset": "latest"}})
robot.subscribe(["{root}." + sys.argv[1]])
while True:
    record = robot.poll(1)
    if record is not None and record.error() is None:
        print(record.value().decode(), flush=True)
"""


def guide(
    url: GatewayUrl, names: TopicNames, payloads: Iterable[OfferedPayload], role: Role, *, own: bool = False
) -> str:
    """How to use the robot by a shell and confluent-kafka; the broker's password is left to the reader.

    `own` says that the broker is the robot's own.
    """
    words = {"settings": json.dumps(_settings(url)), "root": names.root}
    return "\n".join(
        [
            f"Kafka at {url.shown}; all topics of this robot begin with {names.root}.",
            *(["This cluster is the robot's own, in memory: for development only."] if own else []),
            f"state says once a second online, with the time: a robot whose newest state is older than {LOST_TIME:g} s is lost.",
            "commands takes records whose key is a name of your own. A header says what: call, publish, run, cancel, read or",
            "leave with a name, or bye; each needs a header stamp, the robot's time in seconds, and is done when it is fresh; to drive",
            "takes less than 0.25 s, from a client that has called /rosapi/get_time. A header token has yours, id comes back in",
            "answers, which has your name as key. What is read on demand comes on topics while you say something once a minute.",
            "Any record in stop presses STOP. The role that everybody has here: " + role.word + ".",
            "",
            _shell("say", _SAY.format(**words)),
            _shell("hear", _HEAR.format(**words)),
            "hear answers",
            "say stop '{}'",
            f"say commands {CALL} {TIME} '{{}}'",
            *(line for each in payloads for line in _payload(names, each)),
        ]
    )


def _shell(name: str, program: str) -> str:
    """A function of a shell, in one line, that runs a program of Python."""
    return f'{name}() {{ python -c {shlex.quote(f"exec({program.strip()!r})")} "$@"; }}'


def _settings(url: GatewayUrl) -> dict[str, str]:
    said = {"bootstrap.servers": url.address}
    if url.scheme == "kafkas" or url.user:
        said["security.protocol"] = ("sasl_" if url.user else "") + (
            "ssl" if url.scheme == "kafkas" else "plaintext"
        )
    if url.user:
        said |= {"sasl.mechanism": "PLAIN", "sasl.username": url.user, "sasl.password": "PASSWORD"}
    return said


def _payload(names: TopicNames, each: OfferedPayload) -> Iterator[str]:
    yield ""
    yield f"{each.payload.key}: {each.payload.doc}"
    for line in each.lines:
        units = f"; {line.units}" if line.units else ""
        yield f"  # {line.doc} ({line.type}{units})"
        yield f"  {_command(names, line)}"


def _command(names: TopicNames, line: Line) -> str:
    if line.verb == offered.READ and not line.on_demand:
        return f"hear {names.topic(line.name).removeprefix(f'{names.root}.')}"
    # what is made on demand comes on its topic once it is asked for
    return f"say commands {_VERBS[line.verb]} {line.name} {shlex.quote(line.example or '{}')}"
