"""Who is there and what for: the robot and its clients as nodes, for `rosapi`."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from bridge.core.robot_catalogue import Action, Service, Session
from bridge.server.client_services import Exchange, Party
from bridge.server.rosapi.services import NODE, Graph, Node
from bridge.server.switchboard import Switchboard

__all__ = ["Who"]


class Who:
    """Looks at what a server has at the moment."""

    def __init__(
        self,
        switchboard: Switchboard,
        services: Mapping[str, Service],
        actions: Mapping[str, Action],
        exchange: Exchange,
        clients: Mapping[Session, Party],
        offers: Callable[[str], bool],
    ) -> None:
        """All are looked at again for every answer; of the table's topics only those are told that the robot `offers`."""
        self._switchboard = switchboard
        self._services = services
        self._actions = actions
        self._exchange = exchange
        self._clients = clients
        self._offers = offers

    def graph(self) -> Graph:
        """How `rosapi` asks."""
        return Graph(self._topics, self._service_types, self._action_types, self._nodes)

    def _topics(self) -> dict[str, str]:
        return {
            channel.name: channel.type
            for channel in self._switchboard.channels.values()
            if channel.entry is None or self._offers(channel.name)
        }

    def _service_types(self) -> dict[str, str]:
        own = {name: service.type for name, service in self._services.items()}
        offered = self._exchange.services.items()
        return own | {name: party.remembered.services[name].type for name, party in offered}

    def _action_types(self) -> dict[str, str]:
        own = {name: action.type for name, action in self._actions.items()}
        offered = self._exchange.actions.items()
        return own | {name: party.remembered.actions[name].type for name, party in offered}

    def _nodes(self) -> dict[str, Node]:
        topics = [topic for topic in self._switchboard.topics.values() if self._offers(topic.name)]
        robot = Node(
            [topic.name for topic in topics if topic.to == "handheld"],
            [topic.name for topic in topics if topic.to == "robot"],
            list(self._services),
            list(self._actions),
        )
        return {NODE: robot} | {
            f"/client_{session.id}": Node(
                list(party.remembered.advertised),
                list(party.remembered.subscriptions),
                list(party.remembered.services),
                list(party.remembered.actions),
            )
            for session, party in self._clients.items()
        }
