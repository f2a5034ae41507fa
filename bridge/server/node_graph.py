"""The node graph for `rosapi`: the robot and its clients with their topics, services and actions."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from bridge.core.robot_catalogue import Action, Operator, Service
from bridge.server.client_services import ClientServices, Peer
from bridge.server.rosapi.services import NODE, Graph, Node
from bridge.server.switchboard import Switchboard

__all__ = ["NodeGraph"]


class NodeGraph:
    """The present state of a server as a graph."""

    def __init__(
        self,
        switchboard: Switchboard,
        services: Mapping[str, Service],
        actions: Mapping[str, Action],
        client_services: ClientServices,
        clients: Mapping[Operator, Peer],
        offers: Callable[[str], bool],
    ) -> None:
        """All arguments are read anew for every answer; of the robot's topics those that it `offers` are listed."""
        self._switchboard = switchboard
        self._services = services
        self._actions = actions
        self._client_services = client_services
        self._clients = clients
        self._offers = offers

    def graph(self) -> Graph:
        """The questions that `rosapi` asks."""
        return Graph(self._topics, self._service_types, self._action_types, self._nodes)

    def _topics(self) -> dict[str, str]:
        return {
            channel.name: channel.type
            for channel in self._switchboard.channels.values()
            if channel.entry is None or self._offers(channel.name)
        }

    def _service_types(self) -> dict[str, str]:
        own = {name: service.type for name, service in self._services.items()}
        offered = self._client_services.services.items()
        return own | {name: peer.protocol.services[name].type for name, peer in offered}

    def _action_types(self) -> dict[str, str]:
        own = {name: action.type for name, action in self._actions.items()}
        offered = self._client_services.actions.items()
        return own | {name: peer.protocol.actions[name].type for name, peer in offered}

    def _nodes(self) -> dict[str, Node]:
        topics = [topic for topic in self._switchboard.topics.values() if self._offers(topic.name)]
        robot = Node(
            [topic.name for topic in topics if topic.to == "handheld"],
            [topic.name for topic in topics if topic.to == "robot"],
            list(self._services),
            list(self._actions),
        )
        return {NODE: robot} | {
            f"/client_{operator.id}": Node(
                list(peer.protocol.advertised),
                list(peer.protocol.subscriptions),
                list(peer.protocol.services),
                list(peer.protocol.actions),
            )
            for operator, peer in self._clients.items()
        }
