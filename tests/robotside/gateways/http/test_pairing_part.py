"""How to pair, on the robot's page: only while it is open, and only for who manages the robot."""

from __future__ import annotations

import asyncio
import urllib.request
from pathlib import Path

import pytest

from bridge.core.identity import Role
from robotside.core.config import TrustSettings
from robotside.gateways.http.pairing_part import pairing_part
from robotside.trust.pairing import Pairing
from tests.robotside.serving.test_station_keys import serving


def test_an_open_offer_is_shown_with_its_code_and_a_closed_one_is_not() -> None:
    pairing = Pairing("ab" * 32, '<"Rex">', lambda: 0.0)
    pairing.host, pairing.port = "192.0.2.1", 9090
    assert pairing_part(None) == ""
    assert pairing_part(pairing) == ""
    offer = pairing.open(Role.DRIVE)
    part = pairing_part(pairing)
    assert f"<b>{offer.code[:3]} {offer.code[3:]}</b>" in part
    assert "<svg" in part
    assert '<"Rex">' not in part
    pairing.scan(offer.secret, "192.0.2.9:1")
    assert pairing_part(pairing) == ""


@pytest.mark.parametrize(
    ("role", "sees"), [("manage", True), ("drive", False), ("watch", False), ("none", False)]
)
async def test_only_who_manages_sees_it(tmp_path: Path, role: str, sees: bool) -> None:
    settings = TrustSettings(local_role=role)  # type: ignore[arg-type]
    async with serving(tmp_path, settings=settings) as (serves, keys, _):
        offer = keys.pairing.open(Role.DRIVE)

        def page() -> str:
            with urllib.request.urlopen(f"{serves.addresses.http}/") as answer:
                return str(answer.read().decode())

        text = await asyncio.to_thread(page)
        assert (offer.secret in text) is sees
        assert (f"{offer.code[:3]} {offer.code[3:]}" in text) is sees
        await asyncio.get_running_loop().shutdown_default_executor()
