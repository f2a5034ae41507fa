"""The REST gateway as users ask for it."""

from __future__ import annotations

from robotside.gateways.adapter import Adapter, AdapterGateway, Surroundings
from robotside.gateways.gateway_url import SITE, GatewayUrl

__all__ = ["ADAPTER"]


def _make(robot: Surroundings, url: GatewayUrl) -> AdapterGateway:
    from robotside.gateways.rest.gateway import RestGateway

    return RestGateway(robot, url)


ADAPTER = Adapter(
    "rest",
    "resources by HTTP on the robot's web site, with OpenAPI, streams and webhooks",
    {SITE: 0},
    f"{SITE}:/api",
    "fastapi",
    _make,
    listens=frozenset({SITE}),
)
