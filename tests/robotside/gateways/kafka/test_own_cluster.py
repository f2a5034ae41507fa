"""The robot's own cluster: on this machine alone, for development, and gone with the gateway."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator

import pytest

from bridge.core.errors import BridgeError
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.kafka import own_cluster
from robotside.gateways.kafka.adapter import ADAPTER
from robotside.gateways.kafka.gateway import KafkaGateway
from robotside.gateways.kafka.own_cluster import OwnCluster
from tests.robotside.gateways.kafka.client import client, online
from tests.robotside.scene import Scene


@pytest.fixture(autouse=True)
async def no_pool_left() -> AsyncIterator[None]:
    """End the threads of the loop's own pool, in which the cluster is made."""
    yield
    await asyncio.get_running_loop().shutdown_default_executor()


def listens(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


async def test_the_gateway_brings_it_and_programs_of_this_machine_may_what_they_may_elsewhere(
    scene: Scene,
) -> None:
    before = asyncio.all_tasks()
    url = read_url(ADAPTER.default, ADAPTER.schemes)
    gateway = KafkaGateway(Surroundings(scene.door, scene.station.events.say), url)
    async with asyncio.timeout(60):
        await gateway.start()
        assert gateway._cluster is not None
        port = gateway._cluster.port
        assert gateway.endpoints() == {"kafka": f"kafka://127.0.0.1:{port}/pilothouse.Fake-1"}
        assert "for development only" in gateway.guide()
        await online(gateway)
        async with client(scene, gateway._url) as me:
            assert (await me.ask("call", "/control/acquire"))["success"]
        await gateway.stop()
    assert not listens(port)
    assert asyncio.all_tasks() == before


def test_it_listens_for_this_machine_alone_at_a_port_of_its_choice() -> None:
    for host in ("0.0.0.0", "192.0.2.7", "::"):
        with pytest.raises(BridgeError, match=f"on this machine only, not on {host}"):
            OwnCluster(host, 0)
    with pytest.raises(
        BridgeError, match="picks its port itself, so 9092 cannot be had: kafka=kafka://localhost:9092"
    ):
        OwnCluster("localhost", 9092)


async def test_where_it_is_not_installed_that_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(own_cluster, "find_spec", lambda _: None)
    cluster = OwnCluster("127.0.0.1", 0)
    with pytest.raises(BridgeError, match="install confluent-kafka, or give the URL"):
        await cluster.start()
    await cluster.stop()
