"""SmartFarm: the operator drives to the orange tree, an external program finds the oranges, the arm touches each."""

from __future__ import annotations

import io
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from bridge.client import RemoteRobot
from examples.demo.robot import RobotProcess
from examples.smart_farm.operator import Farmer
from examples.smart_farm.oranges import oranges

FRUIT, JACKET = (242, 122, 13), (219, 158, 41)


def picture(*discs: tuple[float, float, float], colour: tuple[int, int, int] = FRUIT) -> bytes:
    """A green picture with discs, each of middle and radius [px]."""
    image = Image.new("RGB", (640, 480), (30, 80, 30))
    for x, y, radius in discs:
        ImageDraw.Draw(image).ellipse((x - radius, y - radius, x + radius, y + radius), fill=colour)
    out = io.BytesIO()
    image.save(out, "JPEG", quality=90)
    return out.getvalue()


def test_an_orange_is_as_far_away_as_it_looks_large() -> None:
    ((x, y, z),) = oranges(picture((320, 240, 30)), 1.2, (0.08, 0.0, 0.36))
    focus = 320 / np.tan(0.6)
    assert x == pytest.approx(0.08 + 0.035 * focus / 30, rel=0.05)
    assert (y, z) == pytest.approx((0.0, 0.36), abs=0.005)


def test_one_to_the_left_and_above_is_there() -> None:
    ((x, y, z),) = oranges(picture((220, 140, 30)), 1.2, (0.0, 0.0, 0.0))
    focus = 320 / np.tan(0.6)
    assert y / x == pytest.approx(100 / focus, rel=0.02)
    assert z / x == pytest.approx(100 / focus, rel=0.02)


@pytest.mark.parametrize(
    "shown",
    [
        picture(),
        picture((320, 240, 3)),
        picture((10, 240, 30)),
        picture((320, 240, 30), colour=JACKET),
        picture((300, 240, 30), (340, 240, 30)),
    ],
    ids=["nothing", "far away", "cut off", "a jacket", "two as one"],
)
def test_what_is_no_whole_orange_is_left_out(shown: bytes) -> None:
    assert [*oranges(shown, 1.2, (0.0, 0.0, 0.0))] == []


@pytest.mark.slow
def test_the_arm_touches_every_orange_that_the_detector_reports(tmp_path: Path) -> None:
    options = ("--robot", "sim:patrol", "--world", "orchard", "--payloads", "arm", "--speed", "4")
    with (
        RobotProcess(*options, "--state", str(tmp_path / "state"), log=tmp_path / "robot.log") as process,
        (tmp_path / "detector.log").open("wb") as log,
        subprocess.Popen(
            [sys.executable, "-m", "examples.smart_farm.detector", "--robot", process.url], stderr=log
        ) as detector,
        RemoteRobot(process.url) as robot,
    ):
        try:
            robot.wait(60)
            farmer = Farmer(robot)
            farmer.place(-12.5, 0.0, 0.0)
            farmer.go_to("orange tree")
            found = farmer.look()
            assert len(found) >= 3
            assert [farmer.touch(orange) for orange in found] == [True] * len(found)
        finally:
            detector.terminate()
            detector.wait(20)
