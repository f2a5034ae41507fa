"""What goes on under STOP."""

from __future__ import annotations

import math

import pytest

from robotside.control.stop_consequences import still_moves
from robotside.motion.measured import Measured

HOVERS = "Ada hovers, on its battery. Hold STOP to release it, then land."
FLOATS = "Ada floats up. Hold STOP to release it, then hold its depth."

DRIFTS = "Ada drifts with wind and current. Hold STOP to release it, then hold its place."


@pytest.mark.parametrize(
    ("kind", "measured", "said"),
    [
        ("quadrotor", Measured(height=2.0), HOVERS),
        ("quadrotor", Measured(height=math.nan), HOVERS),
        ("quadrotor", Measured(height=0.1, landed=True), ""),
        ("hexapod", Measured(height=-1.2), FLOATS),
        ("hexapod", Measured(height=-0.1), ""),
        ("hexapod", Measured(height=math.nan), ""),
        ("boat", Measured(height=-0.1), DRIFTS),
        ("wheels", Measured(height=2.0), ""),
    ],
)
def test_it_is_said_what_a_robot_that_nothing_drives_still_does(
    kind: str, measured: Measured, said: str
) -> None:
    assert still_moves("Ada", kind, measured) == said
