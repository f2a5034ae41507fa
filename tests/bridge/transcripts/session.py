"""What a client does on a robot behind rosbridge_server, and what it is given: recorded once, replayed by the suite."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

from bridge.client.client import BridgeClient
from bridge.core.errors import BridgeError, Refused
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import BatteryState, CompressedImage, Imu, LaserScan
from bridge.msgs.std_msgs import String
from tests.bridge.wires import Record, link

Results = dict[str, Any]
Tell = Callable[[str], Awaitable[None]]


class Told(Msg, frozen=True):
    """What std_srvs/Trigger and SetBool answer."""

    MSGTYPE = "std_srvs/TriggerResponse"
    success: bool = False
    message: str = ""


class On(Msg, frozen=True):
    """What std_srvs/SetBool is asked."""

    MSGTYPE = "std_srvs/SetBoolRequest"
    data: bool = False


class Speed(Msg, frozen=True):
    """A request that std_srvs/SetBool has no place for."""

    MSGTYPE = "std_srvs/SetBoolRequest"
    speed: float = 0.0


async def session(url: str, quiet: float) -> Results:
    """All of it at the server at `url`. `quiet` is how long what must not come is waited for [s]."""
    found: Results = {}
    async with link(url) as near:
        client = await near.connected()
        await _services(client, found)
        await _streams(client, found)
        await _nothing(client, found, quiet)
        await _driving(client, found)
        async with link(url) as far:
            other = await far.connected()
            await _door(client, other, found)
            await _fragments(other, found)
    return found


async def _asked(client: BridgeClient, service: str, request: Msg | None = None) -> str:
    """What a service answers, or the sentence that it refuses with."""
    try:
        return (await client.call(service, request, Told)).message
    except BridgeError as error:
        return str(error)


async def _services(client: BridgeClient, found: Results) -> None:
    found["ros2"] = client.ros2
    for service in ("/rosapi/topics", "/rosapi/get_param", "/nothing", "/beep"):
        found[service] = await _asked(client, service)
    found["on"] = await _asked(client, "/enable_motors", On(data=True))
    found["unknown field"] = await _asked(client, "/enable_motors", Speed(speed=2.0))


async def _heard(client: BridgeClient, topic: str, kind: type[Msg], count: int = 1, **options: Any) -> Any:
    """The first `count` messages, or the only one."""
    record = Record()
    stop = client.subscribe(topic, kind, record, **options)
    await record.reach(count)
    stop()
    messages = [message for message, _ in record[:count]]
    return messages if count > 1 else messages[0]


async def _streams(client: BridgeClient, found: Results) -> None:
    found["odom"] = await _heard(client, "/odom", Odometry, 3)
    found["throttled"] = await _heard(client, "/odom", Odometry, 2, throttle_rate=350, queue_length=1)
    found["imu"] = await _heard(client, "/imu/data", Imu)
    found["battery"] = await _heard(client, "/battery_state", BatteryState)
    for form in ("none", "png", "cbor"):
        found[f"scan {form}"] = await _heard(client, "/scan", LaserScan, compression=form)
    found["image"] = await _heard(client, "/camera/image/compressed", CompressedImage, compression="cbor")
    found["image in json"] = await _heard(client, "/camera/image/compressed", CompressedImage)
    found["latched"] = await _heard(client, "/robot_description", String)
    client._session.ros2 = True  # as /rosapi/get_ros_version would have said
    found["scan cbor-raw"] = await _heard(client, "/scan", LaserScan, compression="cbor-raw")
    found["imu by its new name"] = await _heard(client, "/imu/data", Imu)
    client._session.ros2 = False
    first, second = Record(), Record()
    stops = [client.subscribe("/odom", Odometry, first), client.subscribe("/odom", Odometry, second)]
    await asyncio.gather(first.reach(1), second.reach(1))
    found["twice"] = (first[0][0], second[0][0])
    for stop in stops:
        stop()


async def _nothing(client: BridgeClient, found: Results, quiet: float) -> None:
    """What the server loses or drops: a call that is answered afterwards shows that the link lives on."""
    lost = Record()
    stop = client.subscribe("/odom", Odometry, lost, compression="cbor")
    await asyncio.sleep(quiet)
    stop()
    found["odom in cbor"] = len(lost)
    for text in ('{"op":"fly"}', '{"op":"set_level","level":"info","id":"s"}', "{"):
        client._connection.send(text)  # type: ignore[union-attr]  # what no client of ours says by itself
    found["after nonsense"] = await _asked(client, "/beep")


async def _driving(client: BridgeClient, found: Results) -> None:
    heard = Record()
    stop = client.subscribe("/cmd_vel_heard", Twist, heard)
    client.advertise("/cmd_vel", Twist)
    client.publish("/cmd_vel", Twist.planar(0.25, -0.5))
    await heard.reach(1)
    found["driven"] = heard[0][0]
    stop()
    client.unadvertise("/cmd_vel")


async def _door(client: BridgeClient, other: BridgeClient, found: Results) -> None:
    asked: list[bool] = []

    def door(request: On) -> Told:
        asked.append(request.data)
        return Told(success=request.data, message="open" if request.data else "shut")

    def gate(request: On) -> Told:
        raise Refused("It is stuck.")

    ends = [
        client.serve("/door", "std_srvs/SetBool", door, request=On),
        client.serve("/gate", "std_srvs/SetBool", gate, request=On),
    ]
    await _asked(client, "/beep")
    found["door"] = [await _asked(other, "/door", On(data=data)) for data in (True, False)]
    found["door asked"] = asked
    found["gate"] = await _asked(other, "/gate", On(data=True))
    for end in ends:
        end()
    await _asked(client, "/beep")


async def _fragments(client: BridgeClient, found: Results) -> None:
    found["scan in pieces"] = await _heard(client, "/scan", LaserScan, fragment_size=300)
