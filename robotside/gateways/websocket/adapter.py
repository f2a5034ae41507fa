"""The gateway of plain JSON by WebSocket as users ask for it."""

from __future__ import annotations

from robotside.gateways.adapter import Adapter, AdapterGateway, Surroundings
from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["ADAPTER"]


def _make(robot: Surroundings, url: GatewayUrl) -> AdapterGateway:
    from robotside.gateways.websocket.gateway import WebSocketGateway

    return WebSocketGateway(robot, url)


ADAPTER = Adapter(
    "websocket",
    "plain JSON messages by WebSocket",
    {"ws": 9190},
    "ws://127.0.0.1:9190",
    "",
    _make,
    listens=frozenset({"ws"}),
)
