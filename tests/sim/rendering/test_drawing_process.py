"""Pictures from a process beside the loop: the same as those drawn at once, newest first, and an end of it that is seen."""

from __future__ import annotations

import io
import logging
import math
import os
import select
import signal
import socket
import subprocess
from itertools import pairwise

import pytest
from PIL import Image

from sim.core.shapes import Shape, from_yaw
from sim.rendering import drawing_process
from sim.rendering.drawing_process import DrawingProcess
from sim.rendering.jpeg import jpeg
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.robot import CAMERA_TOPIC, make_several
from sim.world.world_files import load

pytestmark = pytest.mark.slow

START_TIMEOUT = 60.0
"""A process that has not drawn anything by then never will, also on a machine with other work [s]."""
CONE = Shape("box", (0.5, 0.5, 0.5), (3.0, 0.0, 0.4), colour=(1.0, 0.2, 0.0))
MANY = [Shape("box", (0.5, 0.5, 0.5), (3.0, 0.01 * number, 0.4)) for number in range(400)]


@pytest.fixture(scope="module")
def world():
    return load("parking_lot")


class Clock:
    """The seconds by which a process hangs; they stand still unless a test lets them go on."""

    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def process(world, clock):
    process = DrawingProcess(world, clock)
    yield process
    process.close()


@pytest.fixture
def stand_in(world, clock, monkeypatch):
    """A process that does what a test says, with `end` for its end of the socket."""
    made = []

    def start(does):
        monkeypatch.setattr(drawing_process, "_MAIN", HEAD + does)
        made.append(DrawingProcess(world, clock))
        return made[-1]

    yield start
    for process in made:
        process.close()


HEAD = """
import pickle, signal, socket, struct, sys
end = socket.socket(fileno=int(sys.argv[2]))
"""
ENDS_WITH_HALF_A_PICTURE = """
picture = pickle.dumps((0, 1.0, bytes(50_000)))
end.sendall(struct.pack("!I", len(picture)) + picture[:20_000])
signal.pause()
"""
READS_NOTHING = "signal.pause()"
ENDS = "end.close()"


def view(number=0):
    return View((0.0, 0.0, 0.4), from_yaw(math.tau * number / 24), (64, 48), 1.2)


def something_comes(process):
    """It came, or the other side ended; waited for as long as only a fault takes."""
    return select.select([process._pipe], [], [], START_TIMEOUT)[0]


def come(process, camera):
    """What becomes ready next."""
    while not (ready := camera.ready()):
        assert process._pipe is not None
        assert something_comes(process)
    return ready


def look_for(camera, clock, seconds):
    """Look for pictures four times a second until so many seconds have gone."""
    for _ in range(round(4 * seconds)):
        clock.now += 0.25
        assert camera.ready() == []


def ended(process):
    """The number of the process that was told to end, when it has ended."""
    process._process.wait(START_TIMEOUT)
    return process._process.pid


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


def test_half_a_picture_of_a_process_that_stopped_there_holds_up_nobody(stand_in):
    process = stand_in(ENDS_WITH_HALF_A_PICTURE)
    camera = process.for_camera()
    assert camera.show(view(), 1.0) == []
    assert something_comes(process)
    assert [camera.ready() for _ in range(5)] == [[]] * 5
    assert camera.show(view(1), 2.0) == []


def test_a_process_that_reads_nothing_holds_up_nobody_however_many_ask(stand_in):
    process = stand_in(READS_NOTHING)
    cameras = [process.for_camera() for _ in range(60)]
    assert [camera.show(view(), 1.0, MANY) for camera in cameras] == [[]] * 60
    asked = [camera._asked is not None for camera in cameras]
    assert asked == sorted(asked, reverse=True)
    assert 0 < sum(asked) < 60
    for stamp in (2.0, 3.0):
        assert cameras[-1].show(view(), stamp) == []
    assert cameras[-1]._waiting[1] == 3.0


def test_what_found_no_room_goes_on_when_the_process_reads_again(process, clock):
    cameras = [process.for_camera() for _ in range(40)]
    os.kill(process._process.pid, signal.SIGSTOP)
    for number, camera in enumerate(cameras):
        camera.show(view(), float(number), MANY)
    assert process._pipe._unsent
    os.kill(process._process.pid, signal.SIGCONT)
    left = dict(enumerate(cameras))
    while left:
        got = {number: ready for number, camera in left.items() if (ready := camera.ready())}
        assert all(stamp == number for number, ((stamp, _),) in got.items())
        left = {number: camera for number, camera in left.items() if number not in got}
        assert got or something_comes(process)


def test_in_place_of_a_process_that_died_another_draws_what_was_asked_for(process, clock, caplog):
    camera = process.for_camera()
    camera.show(view(), 1.0)
    come(process, camera)
    camera.show(view(), 2.0)
    process._process.kill()
    first = ended(process)
    with caplog.at_level(logging.WARNING):
        while process._pipe is not None:
            camera.ready()  # also what it may have drawn before
        camera.show(view(), 3.0)
        clock.now += drawing_process.MIN_RESTART_PERIOD - 0.01
        assert camera.ready() == []
        assert process._process.pid == first
        clock.now += 0.01
        assert come(process, camera)[0][0] == 3.0
    assert process._process.pid != first
    assert caplog.text.count("has ended; another takes its place") == 1


def test_a_wish_that_went_down_with_its_process_is_asked_again(process, clock):
    camera = process.for_camera()
    os.kill(process._process.pid, signal.SIGSTOP)  # so that it does not answer before it ends
    camera.show(view(), 1.0)
    process._process.kill()
    ended(process)
    clock.now += drawing_process.MIN_RESTART_PERIOD  # so that the next one starts with the look that notices
    assert come(process, camera)[0][0] == 1.0


def test_a_process_that_hangs_is_ended_and_another_draws(process, clock, caplog):
    camera = process.for_camera()
    camera.show(view(), 1.0)
    come(process, camera)
    first = process._process.pid
    os.kill(first, signal.SIGSTOP)
    camera.show(view(), 2.0)
    with caplog.at_level(logging.WARNING):
        look_for(camera, clock, drawing_process.PICTURE_TIMEOUT - 0.25)
        assert process._pipe is not None
        look_for(camera, clock, 0.25)
    if process._pipe is None:
        ended(process)
    assert come(process, camera)[0][0] == 2.0
    assert process._process.pid != first
    assert caplog.text.count("hangs; another takes its place") == 1


def test_time_in_which_nobody_looked_is_no_silence_and_the_first_picture_has_longer(stand_in, clock, caplog):
    camera = stand_in(READS_NOTHING).for_camera()
    camera.show(view(), 1.0)
    clock.now += 3600.0
    with caplog.at_level(logging.WARNING):
        assert camera.ready() == []
        look_for(camera, clock, drawing_process.FIRST_PICTURE_TIMEOUT - drawing_process.MAX_GAP - 0.25)
        assert not caplog.records
        look_for(camera, clock, 0.25)
        assert "hangs; another takes its place" in caplog.text


def test_processes_that_end_at_once_are_started_ever_more_seldom_and_the_log_stays_short(
    stand_in, clock, monkeypatch, caplog
):
    process = stand_in(ENDS)
    camera, starts = process.for_camera(), [clock.now]
    camera.show(view(), 1.0)
    with caplog.at_level(logging.WARNING):
        while len(starts) < 7:
            ended(process)
            clock.now += 1.0
            assert camera.ready() == []
            if process._started != starts[-1]:
                starts.append(process._started)
    gaps = [later - earlier for earlier, later in pairwise(starts)]
    assert gaps == [5.0, 10.0, 20.0, 40.0, 60.0, 60.0]
    assert len(caplog.records) <= 1 + sum(gaps) / drawing_process.WARNING_PERIOD


def test_a_start_that_fails_is_one_sentence(world, monkeypatch):
    def full(*_, **__):
        raise OSError(24, "Too many open files")

    monkeypatch.setattr(socket, "socketpair", full)
    with pytest.raises(
        RuntimeError, match=r"^The process that draws .* cannot be started: Too many open files\.$"
    ):
        DrawingProcess(world)


def test_a_start_that_fails_closes_what_it_opened_and_is_tried_again_later(
    stand_in, clock, monkeypatch, caplog
):
    process = stand_in(ENDS)
    camera = process.for_camera()
    ended(process)

    def full(*_, **__):
        raise OSError(12, "Cannot allocate memory")

    popen = subprocess.Popen
    monkeypatch.setattr(subprocess, "Popen", full)
    clock.now += 5.0
    with caplog.at_level(logging.WARNING):
        assert camera.show(view(), 1.0) == []
        assert camera.ready() == []
    assert process._pipe is None
    first = process._process.pid
    monkeypatch.setattr(subprocess, "Popen", popen)
    clock.now += 10.0
    assert camera.ready() == []
    assert process._process.pid != first


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
        while not (first := [message for topic, message in robot.read(50.0) if topic == CAMERA_TOPIC]):
            assert something_comes(process)
        assert [image.header.stamp.seconds for image in first] == [50.0]
        later = [message for topic, message in robot.read(51.0) if topic == CAMERA_TOPIC]
        assert len(later) == 15
        assert {id(image.data) for image in later} == {id(first[0].data)}
    finally:
        robot.close()
    assert process._process.returncode is not None
