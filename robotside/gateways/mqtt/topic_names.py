"""Names of MQTT topics: where a robot publishes, and what a client's topic asks for.

    PREFIX/ROBOT/state                          online, offline, or lost by the last will; retained
    PREFIX/ROBOT/birth                          what is published from now on, each topic with its type; retained
    PREFIX/ROBOT/guide                          how it is used; retained
    PREFIX/ROBOT/topics/NAME                    the robot's topic /NAME
    PREFIX/ROBOT/clients/CLIENT/publish/NAME    CLIENT publishes on the robot's topic /NAME
    PREFIX/ROBOT/clients/CLIENT/call/NAME       CLIENT calls the service /NAME
    PREFIX/ROBOT/clients/CLIENT/run/NAME        CLIENT begins a goal of the action /NAME
    PREFIX/ROBOT/clients/CLIENT/cancel/NAME     CLIENT takes it back
    PREFIX/ROBOT/clients/CLIENT/read/NAME       CLIENT asks for the topic /NAME, which is made on demand
    PREFIX/ROBOT/clients/CLIENT/leave/NAME      CLIENT asks for it no more
    PREFIX/ROBOT/clients/CLIENT/answer/NAME     the answer
    PREFIX/ROBOT/clients/CLIENT/feedback/NAME   how far a goal is
    PREFIX/ROBOT/clients/CLIENT/bye             CLIENT is gone; meant as its last will
    PREFIX/ROBOT/clients/ID/probe               a robot hears its own, or the broker does not pass on what it granted

A broker that lets each user write below `clients/USER` alone proves who is behind each name.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from robotside.gateways.broker.command_desk import BYE, CALL, VERBS

__all__ = ["PREFIX", "PROBE", "Asked", "TopicNames"]

PREFIX = "pilothouse"
"""Where the URL of the gateway names no other."""
PROBE = "/probe"
"""What a robot calls to hear itself; no service."""
MAX_CLIENT_NAME = 64
"""Characters of a client's name."""
MAX_NAME = 256
"""Characters of the name of a topic or service: the topic of its answer is a little longer, and MQTT bounds that."""


class Asked(NamedTuple):
    """What a client's topic asks for."""

    client: str
    verb: str
    """One of `VERBS`, or `BYE`."""
    name: str
    """Absolute name of the topic, service or action; empty for `BYE`."""


class TopicNames:
    """The topics of one robot at one broker."""

    def __init__(self, prefix: str, robot: str) -> None:
        """`robot` is its name for people, of which what MQTT cannot have in a name becomes a hyphen."""
        name = re.sub(r"[^\w.-]+", "-", robot).strip("-")
        self.root = f"{prefix or PREFIX}/{name or 'robot'}"
        self.state = f"{self.root}/state"
        self.birth = f"{self.root}/birth"
        self.guide = f"{self.root}/guide"
        self._clients = f"{self.root}/clients/"

    def topic(self, name: str) -> str:
        """Where the robot's topic `name` is published."""
        return f"{self.root}/topics{name}"

    def command(self, client: str, verb: str, name: str = "") -> str:
        """Where `client` asks for something."""
        return f"{self._clients}{client}/{verb}{name}"

    def answer(self, client: str, name: str, wish: str = "") -> str:
        """Where `client` is answered about `name`: at its own `wish` when that is below its own answers."""
        own = f"{self._clients}{client}/answer"
        # another topic may be one that the robot may write and the client may not
        if (wish == own or wish.startswith(f"{own}/")) and not re.search(r"[+#\0]", wish):
            return wish
        return own + name

    def feedback(self, client: str, name: str) -> str:
        """Where `client` is told how far its goal of `name` is."""
        return f"{self._clients}{client}/feedback{name}"

    @property
    def commands(self) -> tuple[str, ...]:
        """What the robot subscribes to for commands."""
        return tuple(f"{self._clients}+/{verb}" for verb in (*(f"{verb}/#" for verb in VERBS), BYE))

    @property
    def stop(self) -> tuple[str, ...]:
        """What it subscribes to for STOP alone."""
        return (f"{self._clients}+/{CALL}/stop", f"{self._clients}+{PROBE}")

    def probe(self, id: str, *, stop: bool = False) -> str:
        """Where the line for commands, or that for STOP, publishes to hear itself; `id` is its own."""
        return f"{self._clients}{id}{PROBE}" if stop else self.command(id, CALL, PROBE)

    def read(self, topic: str) -> Asked | None:
        """What a topic asks for; None when it is no command, or a name in it is too long or cannot be shown."""
        if not topic.startswith(self._clients):
            return None
        client, _, rest = topic[len(self._clients) :].partition("/")
        verb, _, name = rest.partition("/")
        if not client or len(client) > MAX_CLIENT_NAME or not client.isprintable() or len(name) > MAX_NAME:
            return None
        if (verb, name) == (BYE, ""):
            return Asked(client, BYE, "")
        return Asked(client, verb, f"/{name}") if verb in VERBS and name else None
