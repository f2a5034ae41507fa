"""The `rosapi` services that roslibjs and roslibpy call to find out what a robot and its clients offer."""

from __future__ import annotations

import platform
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import msgspec
from msgspec import Raw

from bridge.codec import shown
from bridge.core.errors import ProtocolError
from bridge.msgs import ros1_name
from bridge.msgs.std_msgs import Time
from bridge.protocol import MAX_ARGUMENT_BYTES, absolute, spells_ros2
from bridge.server.rosapi.parameters import Parameters
from bridge.server.rosapi.ros_text import full_text
from bridge.server.rosapi.type_descriptions import typedefs

__all__ = ["NODE", "Graph", "Node", "RosApi"]

NODE = "/pilothouse"
"""The node that all topics and services of the robot belong to."""


class Node(NamedTuple):
    """The robot or one client, as others see it."""

    publishes: list[str]
    subscribes: list[str]
    services: list[str]
    actions: list[str]


class Graph(NamedTuple):
    """Questions about the graph; each is asked anew for every answer."""

    topics: Callable[[], Mapping[str, str]]
    """ROS 1 type by topic."""
    services: Callable[[], Mapping[str, str]]
    """Type by service."""
    actions: Callable[[], Mapping[str, str]]
    """Type by action."""
    nodes: Callable[[], Mapping[str, Node]]
    """By name; the robot is `NODE`."""


Answer = Callable[[dict[str, str]], dict[str, Any]]


class RosApi:
    """Answers questions about topics, services, actions, types, nodes, parameters, and the time on the robot."""

    def __init__(self, graph: Graph, params: Parameters, now: Callable[[], float]) -> None:
        """`now` is the operators' clock [s]."""
        self._graph = graph
        self._params = params
        self._now = now
        table: dict[str, tuple[tuple[str, ...], Answer]] = {
            **self._about_topics(),
            **self._about_services(),
            **self._about_actions(),
            **self._about_nodes(),
            **self._about_params(),
        }
        self._answers = {f"/rosapi/{name}": known for name, known in table.items()}
        self.types = {name: f"rosapi/{_TYPES.get(name) or _camel(name)}" for name in self._answers}
        """Type by name of the services that are answered here."""

    def answer(self, service: str, args: Raw) -> bytes | None:
        """The response of `service` (absolute name) as JSON text; None when it is not answered here.

        `args` is an object, or a list of the fields in their order; anything else counts as empty. ProtocolError when
        it asks for the impossible.
        """
        known = self._answers.get(service)
        if known is None:
            return None
        fields, answer = known
        return msgspec.json.encode(answer(_given(args, fields)))

    def _about_topics(self) -> dict[str, tuple[tuple[str, ...], Answer]]:
        topics = self._graph.topics
        return {
            "topics": ((), lambda _: _listed("topics", topics())),
            "topics_and_raw_types": ((), lambda _: self._raw_types()),
            "topic_type": (("topic",), lambda given: {"type": topics().get(absolute(given["topic"]), "")}),
            "topics_for_type": (("type",), lambda given: {"topics": _of_type(topics(), given["type"])}),
            "message_details": (("type",), lambda given: {"typedefs": _typedefs(given["type"])}),
            "publishers": (("topic",), lambda given: {"publishers": self._who(given["topic"], "publishes")}),
            "subscribers": (
                ("topic",),
                lambda given: {"subscribers": self._who(given["topic"], "subscribes")},
            ),
        }

    def _about_services(self) -> dict[str, tuple[tuple[str, ...], Answer]]:
        services = self._services
        return {
            "services": ((), lambda _: {"services": list(services())}),
            "service_type": (
                ("service",),
                lambda given: {"type": services().get(absolute(given["service"]), "")},
            ),
            "services_for_type": (("type",), lambda given: {"services": _of_type(services(), given["type"])}),
            "service_request_details": (("type",), lambda given: _details(given["type"], "Request")),
            "service_response_details": (("type",), lambda given: _details(given["type"], "Response")),
            "service_host": (("service",), lambda given: {"host": self._host(given["service"])}),
            "service_node": (("service",), lambda given: {"node": self._server(given["service"])}),
            "service_providers": (
                ("service",),
                lambda given: {"providers": self._who(given["service"], "services")},
            ),
        }

    def _about_actions(self) -> dict[str, tuple[tuple[str, ...], Answer]]:
        actions = self._graph.actions
        return {
            "action_servers": ((), lambda _: {"action_servers": list(actions())}),
            "action_type": (
                ("action",),
                lambda given: {"type": actions().get(absolute(given["action"]), "")},
            ),
            "action_goal_details": (("type",), lambda given: _details(given["type"], "Goal")),
            "action_result_details": (("type",), lambda given: _details(given["type"], "Result")),
            "action_feedback_details": (("type",), lambda given: _details(given["type"], "Feedback")),
        }

    def _about_nodes(self) -> dict[str, tuple[tuple[str, ...], Answer]]:
        return {
            "nodes": ((), lambda _: {"nodes": list(self._graph.nodes())}),
            "node_details": (("node",), self._node_details),
            "get_time": ((), lambda _: self._time()),
            "get_ros_version": ((), lambda _: {"version": 1, "distro": "pilothouse"}),
        }

    def _about_params(self) -> dict[str, tuple[tuple[str, ...], Answer]]:
        params = self._params
        return {
            "get_param": (("name", "default"), self._get_param),
            "set_param": (("name", "value"), self._set_param),
            "search_param": (("name",), lambda given: {"global_name": params.search(given["name"])}),
            "has_param": (("name",), lambda given: {"exists": params.has(given["name"])}),
            "delete_param": (("name",), self._delete_param),
            "get_param_names": ((), lambda _: {"names": params.names}),
        }

    def _services(self) -> dict[str, str]:
        return {**self._graph.services(), **self.types}

    def _raw_types(self) -> dict[str, Any]:
        topics = self._graph.topics()
        return _listed("topics", topics) | {
            "typedefs_full_text": [full_text(type) for type in topics.values()]
        }

    def _who(self, name: str, does: str) -> list[str]:
        name = absolute(name)
        return [node for node, known in self._graph.nodes().items() if name in getattr(known, does)]

    def _server(self, service: str) -> str:
        return NODE if absolute(service) in self.types else next(iter(self._who(service, "services")), "")

    def _host(self, service: str) -> str:
        """This machine, by which the services of clients are reached as well."""
        return platform.node() if absolute(service) in self._services() else ""

    def _node_details(self, given: dict[str, str]) -> dict[str, Any]:
        node = self._graph.nodes().get(absolute(given["node"]), Node([], [], [], []))
        services = node.services + (list(self.types) if absolute(given["node"]) == NODE else [])
        return {"subscribing": node.subscribes, "publishing": node.publishes, "services": services}

    def _get_param(self, given: dict[str, str]) -> dict[str, Any]:
        """Newer clients call the default `default_value`."""
        default = given["default"] or given.get("default_value", "")
        return {"value": self._params.get(given["name"], default), "successful": True, "reason": ""}

    def _set_param(self, given: dict[str, str]) -> dict[str, Any]:
        self._params.set(given["name"], given["value"])
        return _DONE

    def _delete_param(self, given: dict[str, str]) -> dict[str, Any]:
        self._params.delete(given["name"])
        return _DONE

    def _time(self) -> dict[str, Any]:
        now = Time.at(self._now())
        return {"time": {"secs": now.secs, "nsecs": now.nsecs}}


_TYPES = {"/rosapi/action_servers": "GetActionServers", "/rosapi/get_ros_version": "GetROSVersion"}
"""The services whose types are not called as they are."""
_PACKAGE = "rosapi_msgs/"
"""ROS 2's package of their types, after which the classes are called; ROS 1 has them in `rosapi`."""
_DONE = {"successful": True, "reason": ""}


def _camel(service: str) -> str:
    return "".join(word.capitalize() for word in service.rpartition("/")[2].split("_"))


def _listed(key: str, known: Mapping[str, str]) -> dict[str, Any]:
    return {key: list(known), "types": list(known.values())}


def _of_type(known: Mapping[str, str], type: str) -> list[str]:
    wanted = ros1_name(type)
    ending = wanted.rpartition("/")[2]
    return [name for name, each in known.items() if each.endswith(ending) and ros1_name(each) == wanted]


def _details(type: str, half: str) -> dict[str, Any]:
    return {"typedefs": _typedefs(type, half)}


def _typedefs(type: str, half: str = "") -> list[dict[str, Any]]:
    """The description of a type in the terms of the ROS that it is spelled as."""
    name, ros2 = f"{ros1_name(type)}{half}", spells_ros2(type)
    if not name.startswith("rosapi/"):
        return typedefs(name, ros2=ros2)
    return [_of_rosapi(each) for each in typedefs(name.replace("rosapi/", _PACKAGE, 1), ros2=ros2)]


def _of_rosapi(definition: dict[str, Any]) -> dict[str, Any]:
    """The same definition under ROS 1's name of the package."""
    kinds = [each.replace(_PACKAGE, "rosapi/") for each in definition["fieldtypes"]]
    return definition | {"type": definition["type"].replace(_PACKAGE, "rosapi/"), "fieldtypes": kinds}


def _given(args: Raw, fields: tuple[str, ...]) -> dict[str, str]:
    """The texts among the arguments by name, empty for a missing one."""
    if len(args) > MAX_ARGUMENT_BYTES:
        raise ProtocolError(f"args may have at most {MAX_ARGUMENT_BYTES} bytes, not {len(args)}.")
    try:
        values = msgspec.json.decode(args)
    except msgspec.ValidationError as error:  # JSON, but with a number beyond all numbers
        raise ProtocolError(f"args cannot be used: {error}.") from error
    if isinstance(values, list):
        values = dict(zip(fields, values, strict=False))
    elif not isinstance(values, dict):
        values = {}
    given = dict.fromkeys(fields, "")
    for name, value in values.items():
        if isinstance(value, str):
            given[name] = value
        elif name in fields and value is not None:
            raise ProtocolError(f"{name} must be a text, not {shown(value)}.")
    return given
