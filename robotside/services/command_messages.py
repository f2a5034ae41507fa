"""Commands that come as messages: drive commands, a goal on the map, where the robot is."""

from __future__ import annotations

from collections.abc import Callable

from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseStamped
from bridge.msgs.pilothouse_msgs import Waypoint
from robotside.core.pose2 import Pose2
from robotside.core.refusal import Refusal
from robotside.records import NotRecorded
from robotside.services.task_services import TaskOrders
from robotside.station.station import Station

__all__ = ["listener"]


def listener(station: Station) -> Callable[[Operator, str, Msg, float | None], None]:
    """The one that takes in all that clients publish. A goal is an order as those of the services; its refusal is an event."""
    orders = TaskOrders(station)

    def on_message(client: Operator, topic: str, msg: Msg, stamp: float | None) -> None:
        if isinstance(msg, PoseStamped):
            pose = Pose2.from_msg(msg.pose)
            before = station.controls.settled(station.clock())
            try:
                orders.go_to(client, Waypoint(pose.x, pose.y, pose.yaw))
            except (Refusal, NotRecorded) as problem:
                station.controls.give_back(client, before)
                station.events.say("command", problem.notice, "warn")
        station.on_message(client, topic, msg, stamp)

    return on_message
