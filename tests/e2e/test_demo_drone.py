"""The demo of a drone, as far as it is still on the ground."""

from __future__ import annotations

import pytest

from tests.e2e.demo_play import played

pytestmark = pytest.mark.slow


def test_a_drone_stays_on_the_ground_when_its_slide_is_let_go_early(tmp_path):
    summary = played(tmp_path, "--robot", "ardrone", "--until", "let-go")
    steps = [step["name"] for step in summary["steps"]]
    assert steps == ["connect-screen", "connected", "profile", "let-go"]
    assert (summary["robot"], summary["world"]) == ("ardrone", "parking_lot")
