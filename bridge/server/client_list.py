"""The clients of a server as topics, as rosbridge_server has them: `/client_count` and `/connected_clients`."""

from __future__ import annotations

from collections.abc import Callable, Collection

from bridge.codec.now import stamp_of
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import SERVER_TOPICS
from bridge.msgs import Msg
from bridge.msgs.rosbridge_msgs import ConnectedClient, ConnectedClients
from bridge.msgs.std_msgs import Int32

__all__ = ["CLIENT_TOPICS", "publish_clients"]

COUNT, CLIENTS = CLIENT_TOPICS = SERVER_TOPICS
"""Latched; a server adds them to the robot's own."""


def publish_clients(operators: Collection[Operator], publish: Callable[[str, Msg], None]) -> None:
    """Publish who is connected now; to be called when that has changed."""
    publish(COUNT.name, Int32(len(operators)))
    clients = [
        ConnectedClient(each.address.rpartition(":")[0].strip("[]"), stamp_of(each.opened))
        for each in operators
    ]
    publish(CLIENTS.name, ConnectedClients(clients))
