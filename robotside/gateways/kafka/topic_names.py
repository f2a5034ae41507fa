"""Names of Kafka topics: where a robot publishes, and what the headers of a client's record ask for.

    PREFIX.ROBOT.state       online with the time, once a second; offline at an orderly end
    PREFIX.ROBOT.birth       what is published from now on, each topic with its type
    PREFIX.ROBOT.guide       how the robot is used
    PREFIX.ROBOT.topics.a.b  the robot's topic /a/b
    PREFIX.ROBOT.commands    what clients ask for
    PREFIX.ROBOT.stop        STOP, whatever a record says
    PREFIX.ROBOT.answers     answers and how far goals are

The key of a record is the name of the client that speaks or is answered. Its headers are the verb with the name of a topic,
service or action, as in `call: /arm/move`, and `stamp`, `token` and `id`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from bridge.core.errors import BridgeError, Refused
from robotside.gateways.broker.command_desk import BYE, VERBS

__all__ = ["MAX_HEADER", "PREFIX", "Asked", "TopicNames", "client_of", "read_headers"]

PREFIX = "pilothouse"
"""Where the URL of the gateway names no other."""
MAX_PREFIX, MAX_ROBOT = 64, 64
"""Characters of a prefix, and of a robot's name in a topic: Kafka has 249 for all of it."""
MAX_NAME = 100
"""Characters of the name of a robot's topic in the name of a Kafka topic."""
MAX_CLIENT_NAME = 64
"""Characters of a client's name."""
MAX_HEADER = 1024
"""Bytes of a header."""


class Asked(NamedTuple):
    """What the headers of a record ask for."""

    verb: str
    """One of `VERBS`, or `BYE`."""
    name: str
    """Absolute name of the topic, service or action; empty for `BYE`."""
    stamp: str | None
    token: str
    id: bytes


class TopicNames:
    """The topics of one robot at one broker."""

    def __init__(self, prefix: str, robot: str) -> None:
        """`robot` is its name for people, of which what Kafka cannot have in a name becomes a hyphen.

        Raises BridgeError for a prefix that Kafka cannot have.
        """
        prefix = prefix or PREFIX
        if not re.fullmatch(rf"[A-Za-z0-9._-]{{1,{MAX_PREFIX}}}", prefix):
            raise BridgeError(
                f"The prefix of Kafka topics has 1 to {MAX_PREFIX} letters, digits, dots, hyphens or underscores, "
                f"not {prefix[:100]!r}."
            )
        name = re.sub(r"[^A-Za-z0-9_-]+", "-", robot).strip("-")[:MAX_ROBOT]
        self.root = f"{prefix}.{name or 'robot'}"
        self.state, self.birth, self.guide, self.commands, self.stop, self.answers = (
            f"{self.root}.{each}" for each in ("state", "birth", "guide", "commands", "stop", "answers")
        )

    def topic(self, name: str) -> str:
        """Where the robot's topic `name` is published."""
        parts = (re.sub(r"[^A-Za-z0-9_-]", "-", part) for part in name.strip("/").split("/"))
        return f"{self.root}.topics.{'.'.join(parts)[:MAX_NAME]}"


def client_of(key: bytes | None) -> str:
    """The client's name in the key of a record; empty where there is none that can be shown."""
    try:
        name = (key or b"").decode()
    except UnicodeDecodeError:
        return ""
    return name if len(name) <= MAX_CLIENT_NAME and name.isprintable() else ""


def read_headers(headers: Iterable[tuple[str, bytes | None]]) -> Asked:
    """What a record asks for; raises Refused with one sentence for what cannot be read. Headers of others are passed over."""
    known = [(key, _text(key, value)) for key, value in headers if key in _KNOWN]
    found = dict(known)
    if len(found) != len(known):
        raise Refused("A header of the record is there twice.")
    verbs = [key for key in found if key in _VERBS]
    if len(verbs) != 1:
        raise Refused(f"A record has one header of {', '.join(_VERBS)}, with a name, as in call: /arm/move.")
    verb, name = verbs[0], found[verbs[0]]
    if verb != BYE and not name.startswith("/"):
        raise Refused(
            f"The header {verb} is a name with a slash before it, as in /arm/move, not {name[:60]!r}."
        )
    return Asked(
        verb,
        "" if verb == BYE else name,
        found.get("stamp"),
        found.get("token", ""),
        found.get("id", "").encode(),
    )


_VERBS = (*VERBS, BYE)
_KNOWN = frozenset({*_VERBS, "stamp", "token", "id"})


def _text(key: str, value: bytes | None) -> str:
    if len(value or b"") > MAX_HEADER:
        raise Refused(f"The header {key} has at most {MAX_HEADER} bytes, not {len(value or b'')}.")
    try:
        return (value or b"").decode()
    except UnicodeDecodeError as error:
        raise Refused(f"The header {key} is not a text in UTF-8.") from error
