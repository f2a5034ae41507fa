"""A session that was recorded at a rosbridge_server is played to our client again: see transcripts/README.md."""

from __future__ import annotations

import asyncio
import base64
import json
import math
from collections import defaultdict
from pathlib import Path

import pytest
from websockets.asyncio.server import serve

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu, LaserScan
from tests.bridge.transcripts.session import session
from tests.bridge.wires import TIMEOUT

TRANSCRIPT = Path(__file__).parent / "transcripts" / "ros2_jazzy.jsonl"
RANGES = [0.5 + 0.125 * beam for beam in range(30)]
"""What the robot's laser saw after one beam that failed and one that found nothing [m]."""


def recorded():
    return [json.loads(line) for line in TRANSCRIPT.read_text().splitlines()]


def meaning(text):
    """What a client says, without the id where the client chooses it."""
    try:
        op = json.loads(text)
    except ValueError:
        return text
    if op["op"] != "service_response":
        op.pop("id", None)
    return op


class Replay:
    """Plays the server's part of a transcript; each frame once the client has said everything that was said before it."""

    def __init__(self, lines):
        self.lines = lines
        self.links = []
        self.heard = defaultdict(asyncio.Queue)
        self._ids = {}

    async def join(self, ws):
        self.links.append(ws)
        queue = self.heard[len(self.links) - 1]
        async for text in ws:
            queue.put_nowait(text)

    async def play(self):
        for line in self.lines:
            if line["from"] == "client":
                await self._expect(line)
            else:
                await self._say(line)

    async def _expect(self, line):
        async with asyncio.timeout(TIMEOUT):
            text = await self.heard[line["link"]].get()
        assert meaning(text) == meaning(line["text"])
        if isinstance(meaning(text), dict) and "id" in text:
            self._ids[line["link"], json.loads(line["text"]).get("id")] = json.loads(text).get("id")

    async def _say(self, line):
        frame = line["text"] if "text" in line else base64.b64decode(line["base64"])
        if isinstance(frame, str):
            op = json.loads(frame)
            known = self._ids.get((line["link"], op.get("id")))
            if known not in (None, op.get("id")):
                frame = json.dumps(op | {"id": known})
        await self.links[line["link"]].send(frame)


async def replayed(lines):
    """What the session gives when the transcript answers, and whether the client said more than was recorded."""
    replay = Replay(lines)
    async with serve(replay.join, "127.0.0.1", 0, compression=None) as listening:
        port = next(iter(listening.sockets)).getsockname()[1]
        async with asyncio.TaskGroup() as both:
            both.create_task(replay.play())
            found = both.create_task(session(f"ws://127.0.0.1:{port}", 0.0))
    return found.result(), sum(queue.qsize() for queue in replay.heard.values())


async def test_the_client_still_says_what_it_said_to_the_server_and_nothing_more():
    _, more = await replayed(recorded())
    assert more == 0


async def test_a_client_that_says_something_else_is_noticed():
    lines = recorded()
    changed = next(line for line in lines if '"throttle_rate":350' in line.get("text", ""))
    changed["text"] = changed["text"].replace("350", "351")
    with pytest.raises(ExceptionGroup) as caught:
        await replayed(lines)
    assert caught.group_contains(AssertionError, match="351")


async def test_what_the_server_refuses_is_told_in_its_words():
    found, _ = await replayed(recorded())
    for service in ("/rosapi/topics", "/rosapi/get_param", "/nothing"):
        assert found[service] == f"Service {service} does not exist"
    assert found["unknown field"] == "Message type std_srvs/SetBool_Request does not have a field speed"
    assert (found["/beep"], found["on"]) == ("beep", "motors on")


async def test_a_server_without_rosapi_is_taken_for_one_of_ros_1_and_understood_all_the_same():
    found, _ = await replayed(recorded())
    assert found["ros2"] is False
    stamps = [message.header.stamp.seconds for message in found["odom"]]
    assert stamps[0] > 1.7e9
    assert stamps[2] - stamps[0] == pytest.approx(0.2, abs=0.05)


async def test_its_messages_arrive_typed_with_all_their_values():
    found, _ = await replayed(recorded())
    odom, imu = found["odom"][0], found["imu"]
    assert isinstance(odom, Odometry)
    assert (odom.child_frame_id, odom.pose.pose.position.x, odom.twist.twist.angular.z) == (
        "base_footprint",
        1.25,
        -0.125,
    )
    assert (len(odom.pose.covariance), odom.pose.covariance[7]) == (36, 0.5)
    assert (imu.linear_acceleration.z, imu.orientation_covariance[0]) == (9.75, -1.0)
    assert isinstance(found["imu by its new name"], Imu)
    assert found["latched"].data == "<robot name='disc'/>"
    assert found["twice"][0] is not None
    assert found["twice"][0] == found["twice"][1]


async def test_numbers_that_json_cannot_say_arrive_as_not_a_number():
    found, _ = await replayed(recorded())
    battery = found["battery"]
    assert math.isnan(battery.current)
    assert math.isnan(battery.temperature)
    assert math.isnan(found["imu"].angular_velocity.x)
    assert (battery.voltage, list(battery.cell_voltage), battery.present) == (12.5, [4.0, 4.25], True)


@pytest.mark.parametrize(
    ("form", "nothing"),
    [
        ("scan none", math.isnan),
        ("scan png", math.isnan),
        ("scan in pieces", math.isnan),
        ("scan cbor", math.isinf),
        ("scan cbor-raw", math.isinf),
    ],
)
async def test_a_laser_sweep_is_the_same_in_every_form(form, nothing):
    found, _ = await replayed(recorded())
    sweep = found[form]
    assert isinstance(sweep, LaserScan)
    assert (math.isnan(sweep.ranges[0]), nothing(sweep.ranges[1])) == (True, True)
    assert list(sweep.ranges[2:]) == RANGES
    assert list(sweep.intensities) == [7.0] * 32


async def test_a_picture_is_the_same_in_both_forms():
    found, _ = await replayed(recorded())
    expected = bytes([255, 216]) + bytes(range(256))
    assert (bytes(found["image"].data), bytes(found["image in json"].data)) == (expected, expected)


async def test_the_server_throttles_as_it_was_asked_to():
    found, _ = await replayed(recorded())
    first, second = (message.header.stamp.seconds for message in found["throttled"])
    assert second - first >= 0.25


async def test_what_the_server_loses_and_drops_leaves_the_link_alive():
    found, _ = await replayed(recorded())
    assert found["odom in cbor"] == 0
    assert found["after nonsense"] == "beep"


async def test_a_command_comes_back_from_the_robot_and_another_client_calls_our_service():
    found, _ = await replayed(recorded())
    assert found["driven"] == Twist.planar(0.25, -0.5)
    assert found["door asked"] == [True, False]
    assert found["door"] == ["open", "shut"]


async def test_what_our_service_refuses_reaches_whoever_called_it():
    found, _ = await replayed(recorded())
    assert found["gate"] == "It is stuck."
