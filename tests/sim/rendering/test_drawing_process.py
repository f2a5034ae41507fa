"""Pictures from a process beside the loop: the same as those drawn at once, newest first, and an end of it that is seen."""

from __future__ import annotations

import io
import logging
import math
import os
import signal

import pytest
from PIL import Image

from sim.core.shapes import Shape, from_yaw
from sim.rendering.drawing_process import DrawingProcess
from sim.rendering.jpeg import jpeg
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.robot import CAMERA_TOPIC, make_several
from sim.world.world_files import load

START_TIMEOUT = 60.0
"""A process that has not drawn anything by then never will, also on a machine with other work [s]."""
CONE = Shape("box", (0.5, 0.5, 0.5), (3.0, 0.0, 0.4), colour=(1.0, 0.2, 0.0))


@pytest.fixture(scope="module")
def world():
    return load("parking_lot")


@pytest.fixture
def process(world):
    process = DrawingProcess(world)
    yield process
    process.close()


def view(number=0):
    return View((0.0, 0.0, 0.4), from_yaw(math.tau * number / 24), (64, 48), 1.2)


def come(process, camera):
    """What becomes ready next."""
    while not (ready := camera.ready()):
        assert process._pipe.poll(START_TIMEOUT)
    return ready


def test_a_picture_is_the_one_that_is_drawn_at_once(world, process):
    camera = process.for_camera()
    assert camera.show(view(), 1.5, [CONE]) == []
    renderer = Renderer(world)
    try:
        assert come(process, camera) == [(1.5, jpeg(renderer.draw(view(), [CONE])))]
    finally:
        renderer.close()
    assert camera.ready() == []


def test_of_views_that_wait_the_newest_is_drawn(process):
    camera, number = process.for_camera(), process._process.pid
    os.kill(number, signal.SIGSTOP)  # so that all are asked for before the first is drawn
    for turn in range(10):
        assert camera.show(view(turn), float(turn)) == []
    os.kill(number, signal.SIGCONT)
    assert [come(process, camera)[0][0] for _ in range(2)] == [0.0, 9.0]
    assert camera.ready() == []


def test_each_camera_gets_its_own_pictures(process):
    cameras = [process.for_camera() for _ in range(3)]
    for number, camera in enumerate(cameras):
        camera.show(view(8 * number), float(number))
    got = [come(process, camera) for camera in reversed(cameras)]
    assert [stamp for ((stamp, _),) in got] == [2.0, 1.0, 0.0]
    assert len({picture for ((_, picture),) in got}) == 3


def test_a_process_that_died_gives_no_more_pictures_and_the_log_says_so(process, caplog):
    camera = process.for_camera()
    camera.show(view(), 1.0)
    come(process, camera)
    camera.show(view(), 2.0)
    process._process.kill()
    process._process.wait()
    with caplog.at_level(logging.WARNING):
        for stamp in range(3, 20):
            camera.show(view(stamp), float(stamp))
        later = [camera.show(view(stamp), float(stamp)) for stamp in range(20, 40)]
    assert later == [[]] * 20
    assert caplog.text.count("there are no more") == 1


def test_closing_ends_the_process_also_one_that_has_not_drawn_yet(world):
    process = DrawingProcess(world)
    process.for_camera().show(view(), 1.0)
    process.close()
    process.close()
    assert process._process.returncode is not None
    assert process.for_camera().show(view(), 2.0) == []


def test_without_egl_it_draws_small_pictures_and_the_log_says_so(world, monkeypatch, caplog):
    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nowhere")
    process = DrawingProcess(world)
    try:
        camera = process.for_camera()
        camera.show(View((0.0, 0.0, 0.4), from_yaw(0.0), (640, 480), 1.2), 1.0)
        with caplog.at_level(logging.WARNING):
            ((stamp, picture),) = come(process, camera)
    finally:
        process.close()
    assert stamp == 1.0
    assert Image.open(io.BytesIO(picture)).size == (320, 240)
    assert "The camera gives 320 x 240 pictures instead." in caplog.text


def test_a_robot_that_draws_beside_gives_pictures_with_the_stamp_of_their_moment():
    (robot,) = make_several(["patrol"], "parking_lot", draws_beside=True)
    try:
        robot.want(CAMERA_TOPIC, True)
        robot.read(50.0)
        process = robot.simulation.renderer._process
        assert process._pipe.poll(START_TIMEOUT)
        first = [message for topic, message in robot.read(50.0) if topic == CAMERA_TOPIC]
        assert [image.header.stamp.seconds for image in first] == [50.0]
        later = [message for topic, message in robot.read(51.0) if topic == CAMERA_TOPIC]
        assert len(later) == 15
        assert {id(image.data) for image in later} == {id(first[0].data)}
    finally:
        robot.close()
    assert process._process.returncode is not None
