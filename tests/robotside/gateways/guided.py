"""A robot behind TLS with a gateway and its guide, for tests that paste it."""

from __future__ import annotations

import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from bridge.core.identity import Role
from robotside.gateways.discovery import read_wish
from robotside.serving.station_server import StationServer
from robotside.trust.people import TOKEN, added, make_person
from robotside.trust.people_file import PeopleFile
from tests.robotside.serving.test_station_keys import serving

__all__ = ["serving_securely"]


@asynccontextmanager
async def serving_securely(state: Path, name: str) -> AsyncIterator[tuple[StationServer, str, str]]:
    """The robot, the guide of its gateway as others are told it who come by TLS, and the token of who manages it."""
    made, token = make_person("Anna", Role.MANAGE, TOKEN, now=time.time())
    PeopleFile(state).change(lambda people: added(people, made))
    async with serving(state) as (serves, _, _):
        site = f"https://127.0.0.1:{serves.addresses.http_port}"
        serves.addresses.http = site  # as of a robot that others reach
        await serves.gateways.bring_up(*read_wish(name))
        yield serves, serves.gateways.guide(), token
