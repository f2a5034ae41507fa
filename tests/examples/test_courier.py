"""Deliveries between named offices, ordered by each of the papers' protocols: coffee, a parcel back, and on."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from examples import courier
from examples.courier import NotDelivered, deliver, place
from examples.demo.witness import Witness
from examples.protocols.ways import way_to
from tests.examples.everywhere import Everywhere, everywhere

pytestmark = pytest.mark.slow

OFFICES = {"reception": (-10.2, 1.6), "room_3": (2.0, 2.9), "room_1": (-6.8, 2.9), "room_5": (-6.8, -2.9)}
"""Where they are [m]."""
DOCK = (-11.6, -1.2, 0.0)
REACHED_DISTANCE = 0.5
"""A place counts as reached within this [m]."""
ORDERS = {
    "rosbridge": ("coffee", ("reception", "room_3")),
    "rest": ("parcel", ("room_3", "room_1")),
    "soap": ("letter", ("room_1", "room_5")),
}
"""By each protocol something between two offices."""


@pytest.fixture
def rex(tmp_path: Path) -> Iterator[Everywhere]:
    with everywhere(tmp_path, "--robot", "sim:scout", "--world", "office", "--speed", "10") as served:
        yield served


def test_what_is_ordered_by_each_protocol_arrives(rex: Everywhere, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(courier, "LOOK_PERIOD", 0.05)
    monkeypatch.setattr(courier, "DELIVERY_TIMEOUT", 300.0)
    with way_to(rex.ways["rosbridge"], "reception") as way:
        place(way, *DOCK)
        assert way.call("/control/acquire", {})["success"]  # it was heard after the place
        assert way.call("/control/release", {})["success"]
    witness = Witness(rex.process.url)
    try:
        for protocol, (what, places) in ORDERS.items():
            said: list[str] = []
            with way_to(rex.ways[protocol], f"courier by {protocol}") as way:
                run = deliver(way, what, places, say=said.append, confirm=True)
            assert (run["state"], run["visited"]) == ("SUCCEEDED", 2)
            assert run["by"] == f"courier by {protocol}"
            assert run["reason"] == f"Delivered at {places[1]}."
            assert run["order"]["message"] == what
            assert witness.distance(*OFFICES[places[1]]) <= REACHED_DISTANCE
            assert said[1:] == [f"It has been at {place}." for place in places]
    finally:
        witness.close()


def test_an_office_that_there_is_not_is_refused_by_each_protocol(rex: Everywhere) -> None:
    for protocol, url in rex.ways.items():
        with way_to(url, f"by {protocol}") as way:
            place(way, *DOCK)
            with pytest.raises(NotDelivered, match="moon"):
                deliver(way, "coffee", ("reception", "moon"))
            way.call("/control/release", {})
