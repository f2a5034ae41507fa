from __future__ import annotations

import io
import logging
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from bridge.msgs.geometry_msgs import Twist
from sim.core.shapes import Shape, from_yaw
from sim.physics.bodies import State
from sim.rendering import camera
from sim.rendering.renderer import NoRendererError
from sim.robot import make
from sim.vehicles.patrol import PARAMETERS

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
    assert len(taken) == 8
    assert [image.header.stamp.seconds for image in taken] == pytest.approx([i / 15 for i in range(8)])
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


# nothing that it sees moves

REST = State((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


class Pen:
    """A renderer that a test holds back; each picture names the stamp at which it was asked for."""

    def __init__(self, *, at_once=True):
        self.at_once, self.asked = at_once, []
        self.done = []

    def show(self, view, stamp, moving=()):
        self.asked.append((view, stamp, moving))
        if self.at_once:
            self.done.append((stamp, str(stamp).encode()))
        return self.ready()

    def ready(self, *, wait=False):
        done, self.done = self.done, []
        return done

    def close(self):
        pass


@pytest.fixture
def pen():
    return Pen()


@pytest.fixture
def still(pen):
    """A camera that draws with `pen`."""
    return camera.Camera(pen, PARAMETERS.camera)


def moved(forward=0.0, yaw=0.0):
    return replace(REST, position=(forward, 0.0, 0.0), rotation=from_yaw(yaw))


def shown(taken):
    return [(image.header.stamp.seconds, image.data) for image in taken]


def test_while_nothing_moves_one_picture_is_drawn_and_each_has_the_stamp_of_its_moment(robot, monkeypatch):
    drawn = []
    draw = camera.Renderer.draw
    monkeypatch.setattr(camera.Renderer, "draw", lambda *args: drawn.append(args) or draw(*args))
    robot.want(TOPIC, True)
    robot.read(50.0)
    taken = images(robot.read(52.0))
    assert len(taken) == 30
    assert [image.header.stamp.seconds for image in taken] == pytest.approx(
        [50 + i / 15 for i in range(1, 31)]
    )
    assert len(drawn) == 1
    assert len({id(image.data) for image in taken}) == 1


def test_a_camera_that_creeps_is_drawn_anew_once_it_has_crept_far_enough_in_all(still, pen):
    for step in range(20):
        still.shoot(moved(forward=step * 1.2e-4), float(step))
    assert [stamp for _, stamp, _ in pen.asked] == [0.0, 5.0, 10.0, 15.0]


@pytest.mark.parametrize("change", [{"forward": 0.001}, {"yaw": 0.001}])
def test_the_least_motion_that_can_be_seen_is_drawn(still, pen, change):
    still.shoot(REST, 1.0)
    still.shoot(moved(**change), 2.0)
    assert len(pen.asked) == 2


def test_another_robot_that_moves_in_front_of_it_is_drawn(still, pen):
    for stamp, x in enumerate((3.0, 3.0, 3.1)):
        still.shoot(REST, float(stamp), [Shape("box", (1.0, 1.0, 1.0), (x, 0.0, 0.0))])
    assert [stamp for _, stamp, _ in pen.asked] == [0.0, 2.0]


def test_a_picture_that_is_not_drawn_yet_is_no_picture_and_the_one_before_it_is_not_taken_for_it(still, pen):
    assert shown(still.shoot(REST, 0.0)) == [(0.0, b"0.0")]
    pen.at_once = False
    for stamp in (1.0, 2.0, 3.0):
        assert still.shoot(moved(forward=1.0), stamp) == [], (
            "it sees something else, of which there is no picture"
        )
    pen.done = [(1.0, b"1.0")]
    assert shown(still.collect()) == [(1.0, b"1.0")]
    assert shown(still.shoot(moved(forward=1.0), 4.0)) == [(4.0, b"1.0")]


def test_a_picture_that_comes_late_is_not_taken_for_what_is_seen_by_now(still, pen):
    pen.at_once = False
    still.shoot(REST, 0.0)
    still.shoot(moved(forward=1.0), 1.0)
    pen.done = [(0.0, b"0.0")]
    assert shown(still.collect()) == [(0.0, b"0.0")]
    assert still.shoot(moved(forward=1.0), 2.0) == []
    pen.done = [(1.0, b"1.0")]
    assert shown(still.shoot(moved(forward=1.0), 3.0)) == [(1.0, b"1.0"), (3.0, b"1.0")]


def test_a_camera_whose_renderer_died_shows_nothing_more(still, pen):
    pen.at_once = False
    assert [still.shoot(REST, float(stamp)) for stamp in range(50)] == [[]] * 50
