"""The demo's second story, as far as its delivery is ordered."""

from __future__ import annotations

import pytest

from tests.e2e.demo_play import played

pytestmark = pytest.mark.slow


def test_the_second_story_makes_places_and_orders_a_delivery(tmp_path):
    steps = played(tmp_path, "--story", "errand", "--until", "ordered")["steps"]
    assert [step["name"] for step in steps] == ["fenced", "place-made", "place-here", "ordered"]
