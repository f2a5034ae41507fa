from __future__ import annotations

import math

import numpy as np
import pytest

from sim.world.paint import Paint
from sim.world.world_files import load

SPOT = 0.005
CELLS = np.array([(0.0, 0.02 * number) for number in range(8)])


@pytest.fixture(scope="module")
def world():
    return load("parking_lot")


def test_a_robot_on_its_way_reads_what_one_reads_that_was_just_put_there(world):
    """All over the place, slowly as a robot goes and in leaps: on lines, on arrows and far from any paint."""
    paint, painted, clear = Paint(world), 0, 0
    way = [(-17.0 + 0.03 * step, 6.0 * math.sin(0.02 * step)) for step in range(1100)]
    leaps = [(16.0 * math.sin(2.4 * step), 9.0 * math.cos(1.7 * step)) for step in range(200)]
    for x, y in (*way, *leaps):
        cells = CELLS + np.array((x, y))
        here = paint.share(cells, SPOT)
        assert here.tolist() == Paint(world).share(cells, SPOT).tolist()
        painted, clear = painted + bool(here.any()), clear + (not here.any())
    assert painted > 20
    assert clear > 500
