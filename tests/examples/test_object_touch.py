"""The example's page in a browser: the camera's picture, three poses of which one touches the box, and STOP."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from bridge.client import RemoteRobot
from bridge.msgs.pilothouse_msgs import ArmOrder, ArmState, MoveArmRequest
from examples.demo.robot import RobotProcess
from examples.object_touch.__main__ import WORLD, page_server, page_url
from tests.examples.chromium import Chromium

pytestmark = pytest.mark.slow

SAID = "document.getElementById('said').textContent"
TOUCHING = "document.getElementById('touching').textContent"
READY = "document.querySelector('[data-pose=home]').disabled === false"


@contextmanager
def served() -> Iterator[int]:
    """The port of the example's page."""
    server = page_server(0)
    serving = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05})
    serving.start()
    try:
        yield server.server_port
    finally:
        server.shutdown()
        serving.join()
        server.server_close()


@pytest.fixture
def page(tmp_path: Path) -> Iterator[tuple[Chromium, RobotProcess]]:
    with served() as port:
        lets_in = ("--allow-origin", f"http://localhost:{port}")
        options = ("--robot", "sim:patrol", "--world", str(WORLD), "--payloads", "arm", *lets_in)
        with (
            RobotProcess(*options, "--state", str(tmp_path / "state"), log=tmp_path / "robot.log") as robot,
            Chromium(tmp_path) as chromium,
        ):
            chromium.open(page_url(port, robot.url, robot.web))
            yield chromium, robot


def newest(robot: RobotProcess) -> ArmState:
    """The arm as another client hears of it, measured after the call."""
    told: list[ArmState] = []
    heard = threading.Event()

    def hear(msg: ArmState) -> None:
        told.append(msg)
        if len(told) == 3:  # the first one may be of before
            heard.set()

    with RemoteRobot(robot.url) as other:
        other.on("/arm", hear)
        assert heard.wait(60)
    return told[2]


def test_the_page_shows_the_picture_touches_the_box_and_stops_the_arm(
    page: tuple[Chromium, RobotProcess],
) -> None:
    chromium, robot = page
    chromium.until("document.getElementById('picture').naturalWidth === 640")
    chromium.until(READY)
    for pose, touching in (("home", ""), ("stretch", "The hand touches something."), ("rest", "")):
        chromium.click(f"[data-pose={pose}]")
        chromium.until(f"{SAID}.startsWith('The arm is there')")
        chromium.until(f"{TOUCHING} === {touching!r}")
        chromium.until(f"document.querySelector('[data-pose={pose}]').ariaPressed === 'true'")
        arm = newest(robot)
        assert (arm.pose, arm.touching) == (pose, bool(touching))
        if touching and "PICTURES" in os.environ:  # for the docs
            (Path(os.environ["PICTURES"]) / "object-touch.png").write_bytes(chromium.picture())
        chromium.run("document.getElementById('said').textContent = ''")

    chromium.click("[data-pose=stretch]")
    chromium.click("#stop")
    chromium.until("[...document.querySelectorAll('[data-pose]')].every(each => each.disabled)")
    chromium.until(f"{SAID}.startsWith('STOP')")
    held, later = newest(robot), newest(robot)
    assert list(held.angles) == list(held.wanted) == list(later.angles)
    assert not held.touching


def test_what_is_not_heard_any_more_is_not_claimed_and_comes_again_with_the_link(
    page: tuple[Chromium, RobotProcess],
) -> None:
    chromium, _ = page
    picture, pressed = (
        "document.getElementById('picture')",
        "document.querySelectorAll('[aria-pressed=true]').length",
    )
    chromium.until(f"{picture}.naturalWidth === 640")
    chromium.until(READY)
    chromium.click("[data-pose=home]")
    chromium.until(f"{pressed} === 1")
    box = "document.querySelector('.frame').getBoundingClientRect().height"
    height = chromium.run(box)
    chromium.run(
        "window.setTimeout = again => window.again = again; show('touching', 'something'); socket.close()"
    )
    chromium.until(f"{SAID}.startsWith('No link')")
    assert chromium.run(f"[{TOUCHING}, {pressed}, {picture}.naturalWidth, {box}]") == ["", 0, 0, height]
    chromium.run("again()")
    chromium.until(f"{picture}.naturalWidth === 640")
    chromium.until(f"{pressed} === 1")


def test_stop_is_on_the_glass_of_a_phone_however_it_is_held(page: tuple[Chromium, RobotProcess]) -> None:
    chromium, _ = page
    chromium.until(READY)
    for width, height in ((892, 412), (412, 892), (640, 300)):
        chromium.resize(width, height)
        chromium.until(f"innerHeight === {height}")
        chromium.run("scrollTo(0, 0)")
        top, bottom = chromium.run(
            "(box => [box.top, box.bottom])(document.getElementById('stop').getBoundingClientRect())"
        )
        assert 0 <= top < bottom <= height


def test_while_another_client_has_control_the_page_says_who(page: tuple[Chromium, RobotProcess]) -> None:
    chromium, robot = page
    chromium.until(READY)
    with RemoteRobot(robot.url) as other:
        other.wait(60)
        request = MoveArmRequest(client_id="anna", client_name="Anna", order=ArmOrder(pose="home"))
        assert other.call("/arm/move", request, timeout=60).success
        chromium.click("[data-pose=stretch]")
        chromium.until(f"{SAID}.startsWith('Anna has control')")
    assert newest(robot).pose != "stretch"
