from __future__ import annotations

import io
import logging

import numpy as np
import pytest
from PIL import Image

from bridge.msgs.geometry_msgs import Twist
from sim.rendering import camera
from sim.rendering.renderer import NoRendererError
from sim.robot import make

TOPIC = "/camera/image/compressed"


def images(messages):
    return [message for name, message in messages if name == TOPIC]


def opened(message):
    return Image.open(io.BytesIO(message.data))


@pytest.fixture
def robot():
    robot = make("patrol", "parking_lot")
    yield robot
    robot.close()


@pytest.fixture
def robot_without_egl(monkeypatch):
    def fail(_):
        raise NoRendererError("Pictures cannot be drawn by OpenGL here: found 0 devices.")

    monkeypatch.setattr(camera, "Renderer", fail)
    robot = make("patrol", "parking_lot")
    yield robot
    robot.close()


def test_no_picture_is_taken_before_somebody_wants_one(robot):
    robot.read(0.0)
    assert images(robot.read(1.0)) == []


def test_nothing_is_made_to_draw_with_before_somebody_wants_a_picture_and_then_one_for_all_cameras(
    monkeypatch,
):
    made = []

    class Counted(camera.Renderer):
        def __init__(self, world):
            made.append(world)
            super().__init__(world)

    monkeypatch.setattr(camera, "Renderer", Counted)
    robot = make("commander", "parking_lot")
    robot.read(0.0)
    assert made == []
    for topic in (TOPIC, "/camera/rear/image/compressed"):
        robot.want(topic, True)
    taken = {topic for topic, _ in robot.read(0.1) if topic.startswith("/camera")}
    robot.close()
    assert len(taken) == 2
    assert made == [robot.simulation.world]


def test_pictures_come_at_fifteen_hertz_with_the_stamp_of_their_moment(robot):
    robot.want(TOPIC, True)
    robot.read(50.0)
    taken = images(robot.read(51.0))
    assert len(taken) == 15
    assert [image.header.stamp.seconds for image in taken] == pytest.approx(
        [50 + i / 15 for i in range(1, 16)]
    )
    assert (taken[0].header.frame_id, taken[0].format) == ("camera", "jpeg")


def test_pictures_are_jpeg_files_of_the_promised_size(robot):
    robot.want(TOPIC, True)
    image = opened(images(robot.read(0.0))[0])
    assert (image.format, image.size) == ("JPEG", (640, 480))


def test_pictures_stop_when_nobody_wants_them_any_more(robot):
    robot.want(TOPIC, True)
    robot.read(0.0)
    robot.want(TOPIC, False)
    assert images(robot.read(1.0)) == []


def test_pictures_change_as_the_robot_drives(robot):
    robot.want(TOPIC, True)
    first = images(robot.read(0.0))[0]
    robot.drive(Twist.planar(0.0, 1.0))
    last = images(robot.read(1.0))[-1]
    assert np.abs(np.asarray(opened(first), dtype=int) - np.asarray(opened(last), dtype=int)).mean() > 5


def test_without_egl_small_pictures_come_from_a_process_and_the_log_says_so(robot_without_egl, caplog):
    robot = robot_without_egl
    robot.want(TOPIC, True)
    robot.read(0.0)
    taken = images(robot.read(0.5))
    assert len(taken) == 7
    assert [image.header.stamp.seconds for image in taken] == pytest.approx([i / 15 for i in range(7)])
    assert {opened(image).size for image in taken} == {(320, 240)}


def test_without_egl_the_log_says_what_happens(monkeypatch, caplog):
    def fail(_):
        raise NoRendererError("Pictures cannot be drawn by OpenGL here: found 0 devices.")

    monkeypatch.setattr(camera, "Renderer", fail)
    robot = make("patrol", "parking_lot")
    robot.want(TOPIC, True)
    with caplog.at_level(logging.WARNING):
        robot.read(0.0)
    robot.close()
    assert "found 0 devices. The camera gives 320 x 240 pictures instead." in caplog.text
