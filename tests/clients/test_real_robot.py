"""The simulated patrol robot, started as anybody would start it, and programs on roslibpy and roslib."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator

import pytest

from bench.support.wire import wire
from examples.demo.robot import RobotProcess
from tests.clients.peers import START, both, peer
from tests.releasing import release_stop

VELOCITY = {"name": "/cmd_vel", "type": "geometry_msgs/Twist"}
STOP = {"name": "/stop", "type": "std_srvs/Trigger"}


@pytest.fixture(scope="module")
def port(tmp_path_factory: pytest.TempPathFactory) -> Iterator[int]:
    """Of the bridge of the robot's own process."""
    folder = tmp_path_factory.mktemp("robot")
    options = ("--robot", "sim:patrol", "--name", "Patrol-7", "--state", str(folder / "state"))
    with RobotProcess(*options, log=folder / "robot.log") as robot:
        yield int(robot.url.rsplit(":", 1)[1])


async def push(script, speed=0.4):
    """One drive command."""
    await script.do("publish", **VELOCITY, msg={"linear": {"x": speed}})


async def drive_until(script, python, moved):
    """Push, each time from zero, until the odometry that the other program hears fits."""
    seen = 0
    async with asyncio.timeout(START):
        while True:
            await push(script, 0.0)
            await push(script)
            seen += 1
            if moved(await speed(python, seen)):
                return


async def speed(python, count):
    """As the odometry that came as the `count`-th tells it."""
    return (await python.message("/odom", count))["twist"]["twist"]["linear"]["x"]


async def test_it_is_seen_driven_and_stopped_by_both(port):
    async with both(port) as (python, script):
        await python.do("subscribe", name="/robot/info", type="pilothouse_msgs/RobotInfo")
        assert (await python.message("/robot/info"))["name"] == "Patrol-7"

        for topic, kind in (("/scan", "sensor_msgs/LaserScan"), ("/odom", "nav_msgs/Odometry")):
            await script.do("subscribe", name=topic, type=kind, compression="cbor")
        assert (await script.message("/scan"))["ranges"]["array"] == "Float32Array"
        assert (await script.message("/odom"))["pose"]["covariance"]["array"] == "Float64Array"
        picture = {"name": "/camera/image/compressed", "type": "sensor_msgs/CompressedImage"}
        await script.do("subscribe", **picture, compression="cbor")
        assert (await script.message(picture["name"]))["data"]["values"][:2] == [0xFF, 0xD8]

        await python.do("subscribe", name="/odom", type="nav_msgs/Odometry")
        await drive_until(script, python, lambda speed: speed > 0.1)
        assert (await python.do("call", **STOP))["values"]["success"]
        python.events.clear()
        await drive_until(script, python, lambda speed: abs(speed) < 0.01)
        await release_stop(
            lambda name: script.do("call", name=name, type="std_srvs/Trigger"),
            lambda answer: answer["values"]["success"],
        )


async def test_a_stick_held_through_a_frozen_link_moves_nothing_before_it_was_at_zero(port):
    async with (
        wire(port) as link,
        peer("roslibpy", port) as watcher,
        peer("roslibpy", link.port) as driver,
    ):
        await watcher.do("subscribe", name="/odom", type="nav_msgs/Odometry")
        for pushes_on_while_it_is_frozen in (False, True):
            watcher.events.clear()
            await drive_until(driver, watcher, lambda speed: speed > 0.1)
            link.freeze()
            watcher.events.clear()
            seen = 1
            while abs(await speed(watcher, seen)) > 0.01:
                if pushes_on_while_it_is_frozen:
                    await push(driver)
                seen += 1
            link.thaw()
            for more in range(40):
                await push(driver)
                assert abs(await speed(watcher, seen + 1 + more)) < 0.02
        watcher.events.clear()
        await drive_until(driver, watcher, lambda speed: speed > 0.1)
