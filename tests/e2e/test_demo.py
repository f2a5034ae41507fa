"""The demo, as far as the mission is on the robot: the rest takes minutes of driving."""

from __future__ import annotations

from mcap.reader import make_reader
from PIL import Image

from tests.e2e.demo_play import played


def test_the_demo_finds_the_robot_sends_it_a_mission_and_lays_streets_beneath_its_map(tmp_path):
    steps = played(tmp_path, "--until", "streets")["steps"]
    assert [step["name"] for step in steps[-2:]] == ["sent", "streets"]
    for step in steps:
        with Image.open(tmp_path / step["picture"]) as picture:
            assert picture.size == (1280, 800)
            assert len(picture.getcolors(1 << 20)) > 100
    with (tmp_path / "run.mcap").open("rb") as recording:
        topics = {channel.topic for _, channel, _ in make_reader(recording).iter_messages()}
    assert {"/pose", "/scan", "/map", "/mission", "/control/status"} <= topics
