"""The CoAP gateway as users ask for it."""

from __future__ import annotations

from robotside.gateways.adapter import Adapter, AdapterGateway, Surroundings
from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["ADAPTER"]


def _make(robot: Surroundings, url: GatewayUrl) -> AdapterGateway:
    from robotside.gateways.coap.gateway import CoapGateway

    return CoapGateway(robot, url)


ADAPTER = Adapter(
    "coap",
    "topics to observe and commands by CoAP",
    {"coap": 5683},
    "coap://127.0.0.1:5683",
    "aiocoap",
    _make,
    listens=frozenset({"coap"}),
)
