"""The Kafka gateway as users ask for it."""

from __future__ import annotations

from robotside.gateways.adapter import Adapter, AdapterGateway, Surroundings
from robotside.gateways.gateway_url import OWN, GatewayUrl

__all__ = ["ADAPTER"]


def _make(robot: Surroundings, url: GatewayUrl) -> AdapterGateway:
    from robotside.gateways.kafka.gateway import KafkaGateway

    return KafkaGateway(robot, url)


ADAPTER = Adapter(
    "kafka",
    "topics and commands at a Kafka broker",
    {"kafka": 9092, "kafkas": 9093, OWN: 0},
    f"{OWN}://127.0.0.1",
    "aiokafka",
    _make,
    listens=frozenset({OWN}),
    credentials=frozenset({"kafka", "kafkas"}),
    prefixes=frozenset({"kafka", "kafkas", OWN}),
)
