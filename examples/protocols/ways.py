"""A way to call a robot's services, by the protocol that a URL names; each protocol is a module beside this one.

A URL is written as for `robotside serve --gateway`: `websocket=ws://HOST:9190`; without a name its scheme tells the protocol.

with way_to("mqtt://127.0.0.1:1883/pilothouse/Patrol-1") as way:
    print(way.call("/arm/move", {"order": {"pose": "home"}}))
"""

from __future__ import annotations

import importlib
import itertools
import uuid
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol

__all__ = ["ANSWER_TIMEOUT", "FAULTS", "PROTOCOLS", "Answer", "Way", "sentence", "way_to"]

ANSWER_TIMEOUT = 40.0
"""An answer that waits for an arm takes so long at most [s]."""
PROTOCOLS = ("coap", "kafka", "mqtt", "rest", "rosbridge", "soap", "websocket")
"""Modules beside this one."""
SCHEMES = {"ws": "rosbridge", "mqtt": "mqtt", "kafka": "kafka", "coap": "coap"}
"""Scheme of a URL without a name to the protocol that it means."""
FAULTS = (ValueError, OSError, ImportError)
"""What a way fails with: a URL that is none, no connection or answer, a library that is not installed."""
_PACKAGES = {"confluent_kafka": "confluent-kafka", "paho": "paho-mqtt"}
"""What pip calls a library that Python calls otherwise."""

Answer = dict[str, Any]
"""As of the service's response: what commands answer has `success`, `message` and `code`."""


class Way(Protocol):
    """Calls one after the other."""

    def call(self, service: str, request: Answer) -> Answer:
        """Call `service` with the fields of its request in ROS's names; its answer, or the refusal.

        TimeoutError without an answer, OSError without a connection.
        """

    def publish(self, topic: str, message: Answer) -> None:
        """Send a message on a topic of the robot; nothing says whether it was taken.

        It has no stamp, so a command on `/cmd_vel` drives nothing by REST, SOAP, MQTT, Kafka and CoAP, where it may be of any age.
        """

    def close(self) -> None:
        """End the connection."""


@contextmanager
def way_to(url: str, name: str = "") -> Iterator[Way]:
    """The way that `url` names, to the end of the block; ValueError for one that is of no protocol.

    The robot calls this client `name`.
    """
    protocol, _, place = url.partition("=") if url.partition("=")[0] in PROTOCOLS else ("", "", url)
    protocol = protocol or SCHEMES.get(place.partition(":")[0], "")
    if not protocol:
        known = ", ".join(f"{each}=URL" for each in PROTOCOLS)
        raise ValueError(f"A way to a robot is {known}, or begins with {' or '.join(SCHEMES)}, not {url!r}.")
    module = importlib.import_module(f"examples.protocols.{protocol}")
    opened: Callable[[str, str], Way] = module.open_way
    client = uuid.uuid4().hex
    with _as_faults(module.OWN_FAULTS):
        way = opened(place, client)
        try:
            yield _Named(way, client, name or f"{protocol} program")
        finally:
            way.close()


@contextmanager
def _as_faults(own: tuple[type[Exception], ...]) -> Iterator[None]:
    """Raise what a library calls its own as one of `FAULTS`."""
    try:
        yield
    except FAULTS:
        raise
    except own as problem:
        raise ConnectionError(_words(problem)) from problem


def sentence(url: str, problem: Exception) -> str:
    """One of `FAULTS` of the way to `url`, for people."""
    if isinstance(problem, ImportError) and problem.name:
        library = problem.name.partition(".")[0]
        return f"{url} needs {library}, which is not installed: pip install {_PACKAGES.get(library, library)} brings it."
    if isinstance(problem, OSError):
        return f"{url} cannot be reached: {_words(problem).rstrip('.')}."
    return str(problem)


def _words(problem: Exception) -> str:
    """What happened, without numbers of the system and names of classes."""
    inner = problem.args[0] if problem.args else None
    if isinstance(problem, TimeoutError) and not problem.args:
        return "it gave no answer in time"
    if "Connection refused" in str(problem):  # deep in what requests says
        return "connection refused"
    if isinstance(problem.__cause__, OSError) and problem.__cause__.strerror:
        return problem.__cause__.strerror.partition(" (")[0].lower()
    found = getattr(problem, "strerror", None) or getattr(inner, "str", lambda: "")() or str(problem)
    return str(found) or type(problem).__name__


class _Named:
    """Adds to each command who gives it and an id of its own, by which the robot carries it out once however often it comes."""

    def __init__(self, way: Way, client: str, name: str) -> None:
        self._way, self._id, self._name = way, client, name
        self._numbers = itertools.count(1)

    def call(self, service: str, request: Answer) -> Answer:
        """As of `Way`."""
        who = {"client_id": self._id, "client_name": self._name}
        return self._way.call(service, {"command_id": f"{self._id}-{next(self._numbers)}", **who, **request})

    def publish(self, topic: str, message: Answer) -> None:
        """As of `Way`."""
        self._way.publish(topic, message)

    def close(self) -> None:
        """End the connection."""
        self._way.close()
