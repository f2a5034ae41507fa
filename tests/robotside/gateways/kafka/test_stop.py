"""STOP by Kafka: pressed for anyone, whatever a record says, by a topic of its own that no flood fills."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from robotside.gateways.kafka import kafka_line
from tests.fakes import FakeRobot
from tests.looped import looped
from tests.robotside.gateways.kafka.client import AHEAD, client, codes, hold_back, online, serving, until
from tests.robotside.gateways.kafka.cluster import Cluster
from tests.robotside.scene import Scene

STOPS = (b"", b"{}", b"stop!", b'{"client_name": "Fred", "surprise": 1}', b"\xff", b"[" * 70000)


@looped("raw", STOPS)
def test_anybody_stops_the_robot_whatever_the_record_says(raw: bytes, tmp_path: Path) -> None:
    asyncio.run(_stops(raw, tmp_path))


async def _stops(raw: bytes, folder: Path) -> None:
    scene, cluster = Scene(FakeRobot(), folder), Cluster()
    try:
        scene.drive(Twist.planar(0.3, 0.0))
        async with serving(scene, cluster, "role=none") as gateway, client(scene, cluster) as me:
            await online(gateway)
            assert (await me.press_stop(raw, token="wrong"))["success"]
            assert scene.station.controls.stopped
            assert scene.robot.at_rest
    finally:
        cluster.close()


@pytest.mark.parametrize(
    ("topic", "headers", "key"),
    [
        ("stop", [], b""),
        ("stop", [("token", b"\xff"), ("token", b"2"), ("call", b"/odom")], b"\xff"),
        ("commands", [("call", b"/stop")], b""),
        ("commands", [("call", b"/stop"), ("stamp", b"soon"), ("token", b"\xff"), ("run", b"x")], b"me"),
    ],
)
async def test_stop_is_pressed_without_a_key_and_whatever_the_headers_are(
    topic: str, headers: list[tuple[str, bytes]], key: bytes, scene: Scene, cluster: Cluster
) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        scene.drive(Twist.planar(0.3, 0.0))
        await me.put(topic, b"{}", headers, key)
        await until(lambda: scene.station.controls.stopped)
        assert scene.robot.at_rest


async def test_stop_comes_through_while_others_flood_the_robot(scene: Scene, cluster: Cluster) -> None:
    async with (
        serving(scene, cluster) as gateway,
        client(scene, cluster) as me,
        client(scene, cluster, "noise") as noise,
    ):
        await online(gateway)
        ended = asyncio.Event()

        async def flood() -> None:
            while not ended.is_set():
                await asyncio.gather(*(noise.send("publish", "/cmd_vel", AHEAD) for _ in range(100)))

        flooding = asyncio.create_task(flood())
        assert (await me.press_stop())["success"]
        ended.set()
        await flooding
    assert scene.station.controls.stopped


async def test_a_stop_from_before_the_robot_came_is_not_heard(scene: Scene, cluster: Cluster) -> None:
    async with client(scene, cluster) as me:
        await me.put("stop", b"{}")
        await me.put("commands", b"{}", [("call", b"/stop")])
        async with serving(scene, cluster) as gateway:
            await online(gateway)
            await me.ask("call", "/rosapi/get_time")
            assert not scene.station.controls.stopped


@pytest.mark.parametrize("had_one", [False, True])
async def test_a_stop_that_was_pressed_while_the_line_was_gone_holds(
    had_one: bool, scene: Scene, cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene.run(4.0)
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        if had_one:
            assert (await me.press_stop())["success"]
            scene.run(1.0)
            assert scene.release_stop().success
        gate = hold_back(gateway._stop)
        monkeypatch.setattr(kafka_line, "ANSWER_TIMEOUT", 1.0)
        cluster.down()
        await until(lambda: not gateway._stop.is_up and Code.GATEWAY_LOST in codes(scene))
        cluster.up()
        await me.put("stop", b"{}")
        assert not scene.station.controls.stopped
        gate.set()
        await until(lambda: scene.station.controls.stopped)
