"""A robot with REST on its web site, for the tests of it."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import httpx

from robotside.door.gate import OPEN, Gate
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.rest.adapter import ADAPTER
from robotside.gateways.rest.gateway import RestGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from tests.robotside.scene import Scene
from tests.robotside.visitor import visitor

__all__ = ["Served", "serving"]

TIMEOUT = 60.0


class Served:
    """The robot, its site and its gateway."""

    def __init__(self, scene: Scene, door: StationDoor, http: HttpGateway, rest: RestGateway) -> None:
        self.scene, self.door, self.http, self.rest = scene, door, http, rest

    @property
    def url(self) -> str:
        return self.rest.endpoints()["rest"]

    def client(self, token: str = "", **headers: str) -> httpx.AsyncClient:
        """One that asks for paths relative to the gateway's."""
        shown = {"Authorization": f"Bearer {token}"} if token else {}
        named = {name.replace("_", "-"): value for name, value in headers.items()}
        return visitor(f"{self.url}/", headers=shown | named, timeout=TIMEOUT)


@asynccontextmanager
async def serving(
    scene: Scene, options: str = "", *, gate: Gate = OPEN, **words: Any
) -> AsyncIterator[Served]:
    """Serve the robot of a scene, whose time the test lets pass."""
    door, pictures = StationDoor(scene.station, gate), PictureScaler()
    http = HttpGateway(door, "127.0.0.1", 0, pictures, lambda: "", **words)
    around = Surroundings(door, scene.station.events.say, site=http.mounts)
    rest = RestGateway(around, read_url(f"{ADAPTER.default}{options}", ADAPTER.schemes))
    await http.start()
    try:
        await rest.start()
        yield Served(scene, door, http, rest)
    finally:
        await rest.stop()
        await http.stop()
        await pictures.close()
        door.close()
