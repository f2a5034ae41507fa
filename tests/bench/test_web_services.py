"""All three kinds of calls are answered by the robot side that is measured."""

from __future__ import annotations

import pytest

from bench.support.station import serving
from bench.web_services import FIGURES, calls


@pytest.mark.slow
def test_a_small_sample_has_every_figure() -> None:
    with serving("bench.support.filming", "--protocols", "rest,soap") as robot:
        found = calls(robot, 2)
    assert set(found) == {figure.name for figure in FIGURES}
    assert all(found[name] > 0 for name in found if not name.endswith("_cpu"))
