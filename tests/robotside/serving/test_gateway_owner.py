"""The owner of gateways: up, down and up again while the robot runs, and nothing left of one that fails."""

from __future__ import annotations

import asyncio
import dataclasses
import sys
import threading
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path

import pytest

from bridge.core.errors import BridgeError
from robotside.gateways.adapter import Adapter, Surroundings
from robotside.gateways.discovery import adapters
from robotside.gateways.gateway_url import GatewayUrl
from robotside.serving import gateway_owner
from robotside.serving.gateway_owner import GatewayOwner
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene

URL = GatewayUrl("test", "127.0.0.1", 1)


class Gateway:
    """A gateway with one task."""

    def __init__(self, robot: Surroundings, url: GatewayUrl) -> None:
        self.fails = url.path
        self.task: asyncio.Task[None] | None = None

    async def start(self) -> None:
        self.task = asyncio.create_task(asyncio.sleep(3600))
        if self.fails == "start":
            raise BridgeError("It cannot start.")

    async def stop(self) -> None:
        if self.task is not None:
            self.task.cancel()
            await asyncio.gather(self.task, return_exceptions=True)
        if self.fails == "stop":
            raise BridgeError("It cannot stop.")

    def endpoints(self) -> Mapping[str, str]:
        return {"test": "test://127.0.0.1:1"}

    def guide(self) -> str:
        return "Say hello."


def adapter(name: str) -> Adapter:
    return Adapter(name, "for tests", {"test": 1}, "test://127.0.0.1", "", Gateway)


@pytest.fixture
def owner(tmp_path: Path) -> GatewayOwner:
    scene = Scene(FakeRobot(), tmp_path)
    return GatewayOwner(Surroundings(scene.door, scene.station.events.say))


async def test_gateways_come_and_go_and_leave_nothing(owner: GatewayOwner) -> None:
    before = asyncio.all_tasks()
    for _ in range(2):
        await owner.bring_up(adapter("a"), URL)
        await owner.bring_up(adapter("b"), URL)
        assert owner.running == ("a", "b")
        assert owner.endpoints == {"test": "test://127.0.0.1:1"}
        assert owner.guide() == "Say hello.\n\nSay hello."
        await owner.bring_down("a")
        assert owner.running == ("b",)
        await owner.bring_down("b")
        assert asyncio.all_tasks() == before
    assert owner.guide() == ""


async def test_one_that_fails_leaves_nothing_and_may_be_tried_again(owner: GatewayOwner) -> None:
    before = asyncio.all_tasks()
    with pytest.raises(BridgeError, match="cannot start"):
        await owner.bring_up(adapter("a"), GatewayUrl("test", "h", 1, "start"))
    assert asyncio.all_tasks() == before
    await owner.bring_up(adapter("a"), URL)
    await owner.close()
    assert asyncio.all_tasks() == before


async def test_there_is_one_of_a_name_and_none_that_is_not_up(owner: GatewayOwner) -> None:
    await owner.bring_up(adapter("a"), URL)
    with pytest.raises(BridgeError, match="The gateway a is up already"):
        await owner.bring_up(adapter("a"), URL)
    with pytest.raises(BridgeError, match="no gateway 'b' that is up"):
        await owner.bring_down("b")
    await owner.close()


async def test_one_that_does_not_end_keeps_no_other_from_ending(owner: GatewayOwner) -> None:
    before = asyncio.all_tasks()
    await owner.bring_up(adapter("a"), URL)
    await owner.bring_up(adapter("b"), GatewayUrl("test", "h", 1, "stop"))
    await owner.close()
    assert owner.running == ()
    assert asyncio.all_tasks() == before


async def test_what_a_gateway_imports_is_imported_beside_the_loop(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A robot is driven meanwhile; FastAPI alone takes a second."""
    folder = tmp_path / "slowly"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "gateway.py").write_text(
        "import gc, threading\nTHREAD = threading.current_thread()\nCOLLECTS = gc.isenabled()\n"
    )
    monkeypatch.syspath_prepend(tmp_path)

    def make(robot: Surroundings, url: GatewayUrl) -> Gateway:
        return Gateway(robot, url)

    make.__module__ = "slowly.adapter"
    slow = dataclasses.replace(adapter("slowly"), make=make)
    await gateway_owner._load(slow)
    loaded = sys.modules.pop("slowly.gateway")
    assert loaded.THREAD is not threading.main_thread()
    assert not loaded.COLLECTS  # which would hold up the loop too
    sys.modules.pop("slowly")


@pytest.mark.parametrize("name", sorted(adapters()))
def test_each_adapter_has_what_is_imported_before_it_is_made(name: str) -> None:
    package, _, module = adapters()[name].make.__module__.rpartition(".")
    assert module == "adapter"
    assert find_spec(f"{package}.gateway") is not None
