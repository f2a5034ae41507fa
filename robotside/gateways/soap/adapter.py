"""The SOAP gateway as users ask for it."""

from __future__ import annotations

from robotside.gateways.adapter import Adapter, AdapterGateway, Surroundings
from robotside.gateways.gateway_url import SITE, GatewayUrl

__all__ = ["ADAPTER"]


def _make(robot: Surroundings, url: GatewayUrl) -> AdapterGateway:
    from robotside.gateways.soap.gateway import SoapGateway

    return SoapGateway(robot, url)


ADAPTER = Adapter(
    "soap", "web services with WSDL, on the robot's web site", {SITE: 0}, f"{SITE}:/soap", "lxml", _make
)
