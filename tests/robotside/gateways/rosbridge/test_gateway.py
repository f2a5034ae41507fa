"""The rosbridge gateway by itself: start and stop, its URL, frames of its cameras."""

from __future__ import annotations

import io
from collections.abc import AsyncIterator
from pathlib import Path

import msgspec
import pytest
from PIL import Image
from websockets.asyncio.client import connect

from bridge.core import camera_frames
from bridge.core.topics import CAMERA
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time
from robotside.gateways.rosbridge.gateway import RosbridgeGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    robot = FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, cameras=["front"])
    return Scene(robot, tmp_path)


@pytest.fixture
async def gateway(scene: Scene) -> AsyncIterator[RosbridgeGateway]:
    pictures = PictureScaler()
    made = RosbridgeGateway(scene.door, "127.0.0.1", 0, pictures, lambda now: now + 500.0)
    yield made
    await made.stop()
    await pictures.close()


async def test_it_is_stopped_without_having_been_started(gateway: RosbridgeGateway) -> None:
    await gateway.stop()


async def test_who_watches_its_camera_wants_it_and_gets_frames_stamped_by_real_time(
    scene: Scene, gateway: RosbridgeGateway
) -> None:
    await gateway.start()
    where = gateway.endpoints()["rosbridge"]
    assert where == f"ws://127.0.0.1:{gateway.port}"
    taken = CompressedImage(Header(Time.at(7.0), "camera"), "jpeg", b"a picture")
    scene.station.bus.publish(CAMERA, taken)
    assert not scene.robot.wanted.get(CAMERA)
    async with connect(f"{where}/camera/front", proxy=None) as watcher:
        await (await watcher.ping())
        assert scene.robot.wanted[CAMERA]
        scene.station.bus.publish(CAMERA, taken)
        frame = camera_frames.unpack(await watcher.recv())  # type: ignore[arg-type]
    assert (frame.seq, frame.stamp, frame.jpeg) == (2, 507.0, b"a picture")
    assert (frame.width, frame.height) == (0, 0), "nobody knows how large what is no picture is"
    await gateway.stop()
    assert not scene.robot.wanted[CAMERA]


async def test_a_frame_says_how_large_its_picture_is(scene: Scene, gateway: RosbridgeGateway) -> None:
    await gateway.start()
    file = io.BytesIO()
    Image.new("RGB", (320, 240)).save(file, "JPEG")
    filled = (
        b"\xff\xd8\xff" + file.getvalue()[2:]
    )  # a fill byte before the first segment, as ITU T.81 B.1.1.2 allows
    async with connect(f"{gateway.endpoints()['rosbridge']}/camera/front", proxy=None) as watcher:
        await (await watcher.ping())
        scene.station.bus.publish(CAMERA, CompressedImage(Header(Time.at(7.0), "camera"), "jpeg", filled))
        frame = camera_frames.unpack(await watcher.recv())  # type: ignore[arg-type]
    assert (frame.width, frame.height) == (320, 240)
    await gateway.stop()
