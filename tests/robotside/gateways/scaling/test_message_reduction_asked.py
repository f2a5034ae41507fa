"""Less of what the robot tells, as subscribers of the real robot side ask for it, each in its own way."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import pytest

from bridge.core.topics import CAMERA
from tests.bridge.peers import Peer, peer
from tests.robotside.gateways.http.test_camera_streams import filming, shoot
from tests.robotside.gateways.scaling.test_picture_scaling import PHOTO, size


async def ask(who: Peer, topic: str, **reduce: Any) -> None:
    await who.say(op="subscribe", topic=topic, reduce=reduce)


async def hear(who: Peer, topic: str) -> Any:
    """The next message on `topic`."""
    while True:
        told = await who.hear()
        if told.get("topic") == topic:
            return told["msg"]


async def test_two_subscribers_get_as_much_as_each_asked_for(tmp_path: Path) -> None:
    async with (
        filming(tmp_path) as (robot, serves, _),
        peer(serves.server) as phone,
        peer(serves.server) as tablet,
    ):
        await ask(phone, "/scan", beams=20)
        await ask(tablet, "/scan", beams=60)
        assert len((await hear(phone, "/scan"))["ranges"]) == 20
        assert len((await hear(tablet, "/scan"))["ranges"]) == 60
        await ask(phone, "/map", resolution=0.5)
        await tablet.say(op="subscribe", topic="/map")
        coarse, whole = await hear(phone, "/map"), await hear(tablet, "/map")
        assert coarse["info"]["resolution"] == pytest.approx(0.5)
        assert len(coarse["data"]) == len(whole["data"]) / 25
        await ask(phone, "/odom", fields=["pose.pose.position.x"])
        await ask(tablet, "/odom", fields=["twist.twist.linear"])
        assert list(await hear(phone, "/odom")) == ["pose"]
        assert list(await hear(tablet, "/odom")) == ["twist"]
        await ask(phone, CAMERA, width=64, quality=20)
        await ask(tablet, CAMERA, width=100)
        await tablet.say(op="call_service", service="/rosapi/nodes")  # both were heard when it is answered
        while (await tablet.hear())["op"] != "service_response":
            pass
        await robot.until(True)
        shoot(serves, PHOTO)
        sizes = [size(base64.b64decode((await hear(who, CAMERA))["data"])) for who in (phone, tablet)]
        assert sizes == [(64, 48), (100, 75)]
    assert robot.wanted[CAMERA] is False


@pytest.mark.parametrize(
    ("reduce", "said"),
    [
        ({"beams": 0}, "reduce.beams must be a whole number from 1 to 2147483648, not 0."),
        ({"beams": "x"}, "reduce.beams must be int or null, not str"),
        ({"quality": 96}, "reduce.quality must be a whole number from 1 to 95, not 96."),
        ({"resolution": -1}, "reduce.resolution must be above 0, not -1.0."),
        ({"fields": ["ranges", "colour"]}, "sensor_msgs/LaserScan has no field 'colour', only header,"),
        ({"fields": []}, "fields must name one field at least."),
        ({"fields": ["ranges"] * 101}, "reduce.fields may name at most 100 fields, not 101."),
        ([], "reduce must be object or null, not array"),
    ],
)
async def test_nonsense_is_answered_once_and_what_was_subscribed_before_goes_on(
    tmp_path: Path, reduce: object, said: str
) -> None:
    async with filming(tmp_path) as (_, serves, __), peer(serves.server) as phone:
        await phone.say(op="set_level", level="error")
        await phone.say(op="subscribe", topic="/scan", id="1", reduce={"beams": 20})
        await phone.say(op="subscribe", topic="/scan", id="1", reduce=reduce)
        heard = [await phone.hear() for _ in range(4)]
        told = [each for each in heard if each["op"] == "status"]
        assert len(told) == 1, json.dumps(heard)[:500]
        assert said in told[0]["msg"]
        assert (told[0]["id"], len(heard[-1]["msg"]["ranges"])) == ("1", 20)
