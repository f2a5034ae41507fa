"""The `rosapi` services that roslibjs and roslibpy call to find out what a robot offers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import msgspec
from msgspec import Raw

from bridge.msgs import ros1_name
from bridge.msgs.std_msgs import Time
from bridge.topics import Topic
from bridge.typedefs import typedefs

__all__ = ["RosApi"]

NODE = "/pilothouse"
"""The one node that all topics and services belong to."""


class RosApi:
    """Answers questions about the topic and service tables, and what time it is on the robot."""

    def __init__(
        self, topics: Mapping[str, Topic], services: Mapping[str, str], now: Callable[[], float]
    ) -> None:
        """`services` gives each service's ROS type by its name; `now` is the operators' clock [s]."""
        self._topics = topics
        self._services = services
        self._now = now
        self._answers: dict[str, Callable[[str], dict[str, Any]]] = {
            "/rosapi/get_time": self._get_time,
            "/rosapi/topics": self._all_topics,
            "/rosapi/topic_type": self._topic_type,
            "/rosapi/topics_for_type": self._topics_for_type,
            "/rosapi/services": self._all_services,
            "/rosapi/service_type": self._service_type,
            "/rosapi/services_for_type": self._services_for_type,
            "/rosapi/message_details": lambda name: {"typedefs": typedefs(ros1_name(name))},
            "/rosapi/nodes": lambda _: {"nodes": [NODE]},
            "/rosapi/get_param": lambda _: {"value": "null"},
            "/rosapi/get_param_names": lambda _: {"names": []},
        }

    def answer(self, service: str, args: Raw) -> bytes | None:
        """The response of `service` (absolute name) as JSON text; None when it is not answered here.

        `args` holds the one value that is asked about, in an object or a list; what is neither counts as empty.
        """
        found = self._answers.get(service)
        return None if found is None else msgspec.json.encode(found(_asked_about(args)))

    def _get_time(self, _: str) -> dict[str, Any]:
        now = Time.at(self._now())
        return {"time": {"secs": now.secs, "nsecs": now.nsecs}}

    def _all_topics(self, _: str) -> dict[str, Any]:
        types = [topic.type.MSGTYPE for topic in self._topics.values()]
        return {"topics": list(self._topics), "types": types}

    def _topic_type(self, topic: str) -> dict[str, Any]:
        found = self._topics.get(topic)
        return {"type": found.type.MSGTYPE if found else ""}

    def _topics_for_type(self, type: str) -> dict[str, Any]:
        wanted = ros1_name(type)
        return {"topics": [name for name, topic in self._topics.items() if wanted == topic.type.MSGTYPE]}

    def _all_services(self, _: str) -> dict[str, Any]:
        return {"services": [*self._services, *self._answers]}

    def _service_type(self, service: str) -> dict[str, Any]:
        return {"type": self._services.get(service, "")}

    def _services_for_type(self, type: str) -> dict[str, Any]:
        wanted = ros1_name(type)
        return {"services": [name for name, known in self._services.items() if known == wanted]}


def _asked_about(args: Raw) -> str:
    """The first text among the arguments."""
    values = msgspec.json.decode(args)
    given = values.values() if isinstance(values, dict) else values if isinstance(values, list) else ()
    return next((value for value in given if isinstance(value, str)), "")
