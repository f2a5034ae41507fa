"""A small attack on the real robot side: no tracebacks, STOP is answered, and the honest client drives on."""

from __future__ import annotations

import random

import pytest

from bench.hostile import Attacked, attacked
from bench.support.attack.frames import BREAKING, KINDS, chosen
from bench.support.attack.requests import hostile_handshake, hostile_request

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def found() -> Attacked:
    return attacked(3000, 200, calm=0.0, seed=3)


def test_everything_hostile_was_sent(found: Attacked) -> None:
    assert found.count["frames"] >= 3000
    assert found.count["requests"] >= 200


def test_no_hostile_input_is_a_fault_of_the_robot(found: Attacked) -> None:
    assert found.ended is None
    assert found.tracebacks == []


def test_every_stop_of_the_honest_client_is_answered(found: Attacked) -> None:
    assert found.meanwhile["stops"]
    assert None not in found.meanwhile["stops"]


def test_the_honest_client_drives_and_watches_meanwhile(found: Attacked) -> None:
    assert found.meanwhile["way"] > 0
    assert found.meanwhile["poses"] > 0


def test_the_same_seed_makes_the_same_attack() -> None:
    def some(seed: int) -> list[bytes]:
        rng = random.Random(seed)
        return [
            *(bytes(frame.data) for frame in chosen(rng, 50)),
            hostile_request(rng),
            hostile_handshake(rng),
        ]

    assert some(1) == some(1)
    assert some(1) != some(2)


@pytest.mark.parametrize("name", KINDS)
def test_each_kind_of_frame_is_made(name: str) -> None:
    assert all(frame.serialize(mask=True) for frame in KINDS[name][1](random.Random(1)))


def test_what_breaks_a_connection_is_no_frame_of_the_others() -> None:
    assert all(make(random.Random(1)) for make in BREAKING.values())
