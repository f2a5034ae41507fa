"""STOP from the glass, whoever drives, and the deliberate way out of it."""

from __future__ import annotations

import asyncio
import itertools
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from bridge.client.remote_robot import RemoteRobot
from bridge.discovery.beacon import Listener
from bridge.discovery.domain import discovery_domain
from bridge.msgs.geometry_msgs import Twist
from examples.demo.robot import RobotProcess
from examples.demo.witness import Witness
from tests.e2e.handheld import PATIENCE, Cable, Handheld, handheld

PERIOD = 0.05
"""Between two drive commands of the other client [s]."""


@contextmanager
def somebody_drives(url: str) -> Iterator[None]:
    """Another client that goes on pushing its stick forward until the end of the block."""
    enough = threading.Event()

    def push(robot: RemoteRobot) -> None:
        for number in itertools.count():
            # let go now and then: after a pause of this machine a held stick would count no more
            robot.publish("/cmd_vel", Twist.planar(0.4 if number % 20 else 0.0, 0.0))
            if enough.wait(PERIOD):
                return

    with RemoteRobot(url) as robot:
        robot.wait()
        hand = threading.Thread(target=push, args=(robot,))
        hand.start()
        try:
            yield
        finally:
            enough.set()
            hand.join()


def release(glass: Handheld) -> None:
    """Take control and hold STOPPED until the robot may move again."""
    glass.until(lambda: glass.app.session.control in ("free", "mine"), "nobody else's control")
    glass.app.session.take_control()
    glass.control()
    stop = glass.one("StopButton")
    glass.until(lambda: stop.phase == "stopped", "STOPPED on the button")
    finger = glass.hand.down(stop.to_window(*stop.center))
    glass.until(lambda: stop.phase == "ready", "the release after a hold")
    glass.hand.up(finger)
    glass.run(0.1)


def test_a_watcher_stops_a_robot_that_somebody_else_drives(
    robot: RobotProcess, witness: Witness, tmp_path: Path
) -> None:
    with handheld(tmp_path, url=robot.url, discover=False) as glass:
        glass.control()
        glass.app.session.authority.release()
        glass.until(lambda: glass.app.session.control == "free", "free control")
        with somebody_drives(robot.url):
            glass.until(lambda: witness.speed() > 0.2, "the other client to drive")
            stop = glass.one("StopButton")
            glass.play(glass.hand.tap(stop.to_window(*stop.center)))
            glass.until(lambda: stop.phase == "stopped", "STOPPED on the button", 2.0)
            glass.run(1.0)
            assert witness.speed() < 0.01, "a latched STOP holds against the stick of anybody"
        release(glass)


def test_a_stop_that_nobody_heard_goes_on_being_sent_after_the_operator_went_back(
    robot: RobotProcess, cable: Cable, witness: Witness, tmp_path: Path
) -> None:
    with handheld(tmp_path, url=cable.url, discover=False) as glass:
        glass.control()
        glass.app.session.authority.release()
        glass.until(lambda: glass.app.session.control == "free", "free control")
        with somebody_drives(robot.url):
            glass.until(lambda: witness.speed() > 0.2, "the other client to drive")
            cable.freeze()
            stop = glass.one("StopButton")
            glass.play(glass.hand.tap(stop.to_window(*stop.center)))
            glass.until(lambda: stop.phase == "no_answer", "nobody to have heard it")
            glass.app.back()
            assert glass.app.session is None
            glass.until(lambda: "NO ANSWER" in glass.words(), "the STOP that is owed")
            cable.cut()
            cable.thaw()
            glass.until(lambda: glass.one("StopList").title == "STOPPED 1 of 1", "the robot to confirm")
            glass.run(1.0)
            assert witness.speed() < 0.01, "a latched STOP holds against the stick of anybody"
        glass.app.open(cable.url)
        release(glass)


def test_stop_all_from_the_connect_screen_stops_what_somebody_else_drives_and_counts_it_once(
    robot: RobotProcess, witness: Witness, tmp_path: Path
) -> None:
    with handheld(tmp_path, discover=False) as glass, somebody_drives(robot.url):
        glass.until(lambda: witness.speed() > 0.2, "the other client to drive")
        for address in (robot.url, robot.url.replace("127.0.0.1", "localhost")):
            glass.app.robots.add(address, met=True)
        button = glass.one("StopAll")
        glass.settle(button)
        glass.play(glass.hand.tap(button.to_window(*button.center)))
        glass.until(lambda: button.word == "1 of 1", "one robot, and that stopped", 5.0)
        assert glass.one("StopList").title == "STOPPED 1 of 1"
        glass.run(1.0)
        assert witness.speed() < 0.01, "a latched STOP holds against the stick of anybody"


async def announced(name: str, domain: str) -> None:
    """Wait until the robot of that `name` says HELLO in `domain`."""
    heard = asyncio.Event()
    listener = Listener(lambda hello, _: heard.set() if hello.name == name else None, domain=domain)
    await listener.start()
    try:
        async with asyncio.timeout(PATIENCE):
            await heard.wait()
    finally:
        await listener.close()


def test_stop_all_leaves_robots_of_another_domain_alone(robot: RobotProcess, tmp_path: Path) -> None:
    elsewhere = f"{discovery_domain()}-2"
    theirs_only = ("--domain", elsewhere, "--name", "Theirs", "--state", str(tmp_path / "state"))
    with RobotProcess(*theirs_only, log=tmp_path / "theirs.log") as theirs, handheld(tmp_path) as glass:
        asyncio.run(announced("Theirs", elsewhere))
        glass.until(
            lambda: any(each.state == "live" for each in glass.app.robots.entries()),
            "the robot of this domain",
        )
        with somebody_drives(theirs.url), closing(Witness(theirs.url)) as seen:
            glass.until(lambda: seen.speed() > 0.2, "the other client to drive")
            button = glass.one("StopAll")
            glass.settle(button)
            glass.play(glass.hand.tap(button.to_window(*button.center)))
            glass.until(lambda: button.word == "1 of 1", "the robot of this domain to stop")
            glass.run(1.0)
            assert seen.speed() > 0.2, "who drives a robot of another domain goes on"
            assert "Theirs" not in [each.name for each in glass.app.robots.entries()]
