"""The `rosapi` services that roslibjs and roslibpy call to find out what a robot offers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from bridge.msgs import ros1_name
from bridge.msgs.std_msgs import Time
from bridge.topics import Topic

__all__ = ["RosApi"]

NODE = "/pilothouse"
"""The one node that all topics and services belong to."""


class RosApi:
    """Answers questions about the topic and service tables, and what time it is on the robot."""

    def __init__(
        self, topics: Mapping[str, Topic], services: Mapping[str, str], now: Callable[[], float]
    ) -> None:
        """`services` gives each service's ROS type by its name; `now` is the robot's clock [s]."""
        self._topics = topics
        self._services = services
        self._now = now
        self._answers: dict[str, Callable[[dict[str, Any]], dict[str, Any]]] = {
            "/rosapi/get_time": self._get_time,
            "/rosapi/topics": self._all_topics,
            "/rosapi/topic_type": self._topic_type,
            "/rosapi/topics_for_type": self._topics_for_type,
            "/rosapi/services": self._all_services,
            "/rosapi/service_type": self._service_type,
            "/rosapi/services_for_type": self._services_for_type,
            "/rosapi/nodes": lambda _: {"nodes": [NODE]},
            "/rosapi/get_param": lambda _: {"value": "null"},
            "/rosapi/get_param_names": lambda _: {"names": []},
        }

    def answer(self, service: str, args: dict[str, Any]) -> dict[str, Any] | None:
        """The response of `service` (absolute name); None when this is none of ours."""
        found = self._answers.get(service)
        return None if found is None else found(args)

    @property
    def names(self) -> list[str]:
        """The services that are answered here."""
        return list(self._answers)

    def _get_time(self, _: dict[str, Any]) -> dict[str, Any]:
        now = Time.at(self._now())
        return {"time": {"secs": now.secs, "nsecs": now.nsecs}}

    def _all_topics(self, _: dict[str, Any]) -> dict[str, Any]:
        return {
            "topics": list(self._topics),
            "types": [topic.type.MSGTYPE for topic in self._topics.values()],
        }

    def _topic_type(self, args: dict[str, Any]) -> dict[str, Any]:
        topic = self._topics.get(str(args.get("topic", "")))
        return {"type": topic.type.MSGTYPE if topic else ""}

    def _topics_for_type(self, args: dict[str, Any]) -> dict[str, Any]:
        wanted = ros1_name(str(args.get("type", "")))
        return {"topics": [name for name, topic in self._topics.items() if topic.type.MSGTYPE == wanted]}

    def _all_services(self, _: dict[str, Any]) -> dict[str, Any]:
        return {"services": [*self._services, *self._answers]}

    def _service_type(self, args: dict[str, Any]) -> dict[str, Any]:
        return {"type": self._services.get(str(args.get("service", "")), "")}

    def _services_for_type(self, args: dict[str, Any]) -> dict[str, Any]:
        wanted = ros1_name(str(args.get("type", "")))
        return {"services": [name for name, type in self._services.items() if type == wanted]}
