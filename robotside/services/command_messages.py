"""Commands that come as messages: drive commands, a goal on the map, where the robot is."""

from __future__ import annotations

from collections.abc import Callable

from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseStamped
from bridge.msgs.pilothouse_msgs import Waypoint
from robotside.core.notice import Problem
from robotside.core.pose2 import Pose2
from robotside.core.refusal import Refusal
from robotside.records import NotRecorded
from robotside.services.task_services import TaskOrders
from robotside.station.station import Station
from robotside.tasks.order_heights import given_height

__all__ = ["listener"]


def listener(station: Station) -> Callable[[Operator, str, Msg, float | None], Problem]:
    """The one that takes in all that clients publish, and gives why it is not obeyed.

    A goal is an order as those of the services; its refusal is an event.
    """
    orders = TaskOrders(station)

    def on_message(client: Operator, topic: str, msg: Msg, stamp: float | None) -> Problem:
        refused: Problem = ""
        if isinstance(msg, PoseStamped):
            pose, height = Pose2.from_msg(msg.pose), given_height(msg.pose.position.z, station.info)
            before = station.controls.settled(station.clock())
            try:
                orders.go_to(client, Waypoint(pose.x, pose.y, pose.yaw, height=height))
            except (Refusal, NotRecorded) as problem:
                station.controls.give_back(client, before)
                refused = problem.notice
                station.events.say("command", refused, "warn")
        return station.on_message(client, topic, msg, stamp) or refused

    return on_message
