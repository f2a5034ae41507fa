"""The MQTT gateway as users ask for it."""

from __future__ import annotations

from robotside.gateways.adapter import Adapter, AdapterGateway, Surroundings
from robotside.gateways.gateway_url import OWN, GatewayUrl

__all__ = ["ADAPTER"]


def _make(robot: Surroundings, url: GatewayUrl) -> AdapterGateway:
    from robotside.gateways.mqtt.gateway import MqttGateway

    return MqttGateway(robot, url)


ADAPTER = Adapter(
    "mqtt",
    "topics and commands at an MQTT 5 broker",
    {"mqtt": 1883, "mqtts": 8883, OWN: 1883},
    f"{OWN}://127.0.0.1:1883",
    "aiomqtt",
    _make,
    listens=frozenset({OWN}),
    credentials=frozenset({"mqtt", "mqtts"}),
    prefixes=frozenset({"mqtt", "mqtts", OWN}),
)
