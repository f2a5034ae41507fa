"""STOP ALL with lanes that a test tells what to do."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from app.stop.fleet import Fleet
from tests.app.stop.lanes import Lanes


@pytest.fixture
def lanes() -> Lanes:
    return Lanes()


@pytest.fixture
def fleet(lanes: Lanes) -> Iterator[Fleet]:
    fleet = Fleet(client_id="me", client_name="tablet", open_lane=lanes, most=5)
    yield fleet
    fleet.let_go()
    fleet.close()
    assert not lanes.open
