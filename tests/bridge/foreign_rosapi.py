"""What the server that is not ours tells of itself, and its few services."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from tests.bridge.foreign_types import Unfit, internal, spelled, typedefs

if TYPE_CHECKING:
    from tests.bridge.client.foreign_server import ForeignServer

SERVICES = {
    "/reset_odometry": "std_srvs/Empty",
    "/beep": "std_srvs/Trigger",
    "/enable_motors": "std_srvs/SetBool",
}
ASKED = {
    "topics": ("Topics", ()),
    "topic_type": ("TopicType", ("topic",)),
    "topics_for_type": ("TopicsForType", ("type",)),
    "services": ("Services", ()),
    "service_type": ("ServiceType", ("service",)),
    "services_for_type": ("ServicesForType", ("type",)),
    "service_request_details": ("ServiceRequestDetails", ("type",)),
    "service_response_details": ("ServiceResponseDetails", ("type",)),
    "message_details": ("MessageDetails", ("type",)),
    "nodes": ("Nodes", ()),
    "node_details": ("NodeDetails", ("node",)),
    "publishers": ("Publishers", ("topic",)),
    "subscribers": ("Subscribers", ("topic",)),
    "get_param": ("GetParam", ("name", "default")),
    "set_param": ("SetParam", ("name", "value")),
    "has_param": ("HasParam", ("name",)),
    "delete_param": ("DeleteParam", ("name",)),
    "get_param_names": ("GetParamNames", ()),
    "get_time": ("GetTime", ()),
    "action_servers": ("GetActionServers", ()),
}
"""Of each service of rosapi its type and the names of what it is asked with."""


class RosApi:
    """Answers calls by name."""

    def __init__(self, server: ForeignServer, now: Callable[[], float]) -> None:
        self._server = server
        self._now = now
        self.asked = dict(ASKED)
        if server.ros == 2:
            self.asked["get_ros_version"] = ("GetROSVersion", ())
        self.params = {"/max_speed": "0.8", "/robot_name": '"disc"'}

    def answer(self, name: str, args: Any) -> dict[str, Any]:
        """The values; KeyError for a service that there is not, Unfit with the reason for a call that fails."""
        if name in SERVICES:
            return getattr(self, "_do_" + name.strip("/"))(args)
        _, parameters = self.asked[name.removeprefix("/rosapi/") if name.startswith("/rosapi/") else ""]
        given = dict(zip(parameters, args, strict=False)) if isinstance(args, list) else args
        unknown = set(given) - set(parameters) - {"default_value"}
        if unknown:
            raise Unfit(f"{name} takes no {unknown}")
        return getattr(self, "_" + name.rpartition("/")[2])(*(given.get(key, "") for key in parameters))

    def _do_reset_odometry(self, _: Any) -> dict[str, Any]:
        robot = self._server.robot
        robot.x = robot.y = robot.yaw = 0.0
        return {}

    def _do_beep(self, _: Any) -> dict[str, Any]:
        return {"success": True, "message": "beep"}

    def _do_enable_motors(self, args: Any) -> dict[str, Any]:
        on = args[0] if isinstance(args, list) else args.get("data", False)
        if not isinstance(on, bool):
            raise Unfit(f"{on!r} is no bool")
        self._server.robot.motors = on
        return {"success": True, "message": f"motors {'on' if on else 'off'}"}

    def _service_types(self) -> dict[str, str]:
        ros = self._server.ros
        own = {name: spelled(kind, ros, "srv") for name, kind in SERVICES.items()}
        api = {
            f"/rosapi/{name}": spelled(f"rosapi/{kind}", ros, "srv") for name, (kind, _) in self.asked.items()
        }
        return own | {name: kind for name, (_, kind) in self._server.offered.items()} | api

    def _topic_types(self) -> dict[str, str]:
        ros = self._server.ros
        return {name: spelled(topic.type, ros) for name, topic in sorted(self._server.topics.items())}

    def _topics(self) -> dict[str, Any]:
        types = self._topic_types()
        return {"topics": list(types), "types": list(types.values())}

    def _topic_type(self, topic: str) -> dict[str, Any]:
        return {"type": self._topic_types().get(topic, "")}

    def _topics_for_type(self, type: str) -> dict[str, Any]:
        return {"topics": [name for name, kind in self._topic_types().items() if kind == type]}

    def _services(self) -> dict[str, Any]:
        return {"services": list(self._service_types())}

    def _service_type(self, service: str) -> dict[str, Any]:
        return {"type": self._service_types().get(service, "")}

    def _services_for_type(self, type: str) -> dict[str, Any]:
        return {"services": [name for name, kind in self._service_types().items() if kind == type]}

    def _service_request_details(self, type: str) -> dict[str, Any]:
        return {"typedefs": typedefs(internal(type, self._server.ros) + "Request", self._server.ros)}

    def _service_response_details(self, type: str) -> dict[str, Any]:
        return {"typedefs": typedefs(internal(type, self._server.ros) + "Response", self._server.ros)}

    def _message_details(self, type: str) -> dict[str, Any]:
        return {"typedefs": typedefs(internal(type, self._server.ros), self._server.ros)}

    def _nodes(self) -> dict[str, Any]:
        return {"nodes": ["/disc", "/rosapi", "/rosbridge_websocket", "/rosout"]}

    def _node_details(self, node: str) -> dict[str, Any]:
        if node != "/disc":
            return {"subscribing": [], "publishing": [], "services": []}
        publishing = [name for name, topic in self._server.topics.items() if "robot" in topic.publishers]
        return {"subscribing": ["/cmd_vel"], "publishing": publishing, "services": list(SERVICES)}

    def _publishers(self, topic: str) -> dict[str, Any]:
        found = self._server.topics.get(topic)
        who = (
            "/disc" if by == "robot" else "/rosbridge_websocket" for by in (found.publishers if found else ())
        )
        return {"publishers": sorted(set(who))}

    def _subscribers(self, topic: str) -> dict[str, Any]:
        bridge = any(topic in peer.wishes for peer in self._server.peers)
        takes = topic == "/cmd_vel" or topic in self._server.taken
        return {"subscribers": ["/disc"] * takes + ["/rosbridge_websocket"] * bridge}

    def _get_param(self, name: str, default: str) -> dict[str, Any]:
        return {"value": self.params.get(name, default or "null")}

    def _set_param(self, name: str, value: str) -> dict[str, Any]:
        json.loads(value)
        self.params[name] = value
        return {}

    def _has_param(self, name: str) -> dict[str, Any]:
        return {"exists": name in self.params}

    def _delete_param(self, name: str) -> dict[str, Any]:
        self.params.pop(name, None)
        return {}

    def _get_param_names(self) -> dict[str, Any]:
        return {"names": sorted(self.params)}

    def _get_time(self) -> dict[str, Any]:
        nanoseconds = int(self._now() * 1e9)
        names = ("secs", "nsecs") if self._server.ros == 1 else ("sec", "nanosec")
        return {"time": dict(zip(names, divmod(nanoseconds, 10**9), strict=True))}

    def _action_servers(self) -> dict[str, Any]:
        return {"action_servers": ["/fibonacci", *self._server.performers] if self._server.ros == 2 else []}

    def _get_ros_version(self) -> dict[str, Any]:
        return {"version": 2, "distro": "humble"}
