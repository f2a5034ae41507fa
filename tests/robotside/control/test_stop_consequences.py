"""What goes on under STOP."""

from __future__ import annotations

import math

import pytest

from robotside.control.stop_consequences import still_moves
from robotside.motion.measured import MeasuredState

HOVERS = "Ada hovers, on its battery. Hold STOP to release it, then land."
FLOATS = "Ada floats up. Hold STOP to release it, then hold its depth."

DRIFTS = "Ada drifts with wind and current. Hold STOP to release it, then hold its place."


@pytest.mark.parametrize(
    ("kind", "measured", "said"),
    [
        ("quadrotor", MeasuredState(height=2.0), HOVERS),
        ("quadrotor", MeasuredState(height=math.nan), HOVERS),
        ("quadrotor", MeasuredState(height=0.1, landed=True), ""),
        ("hexapod", MeasuredState(height=-1.2), FLOATS),
        ("hexapod", MeasuredState(height=-0.1), ""),
        ("hexapod", MeasuredState(height=math.nan), ""),
        ("boat", MeasuredState(height=-0.1), DRIFTS),
        ("wheels", MeasuredState(height=2.0), ""),
    ],
)
def test_it_is_said_what_a_robot_that_nothing_drives_still_does(
    kind: str, measured: MeasuredState, said: str
) -> None:
    assert still_moves("Ada", kind, measured) == said
