"""The MQTT gateway at a real broker: STOP first, then who may do what, what is too old, and a broker that comes and goes."""

from __future__ import annotations

import asyncio
import json
import socket
import time
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager, suppress
from pathlib import Path
from typing import Any

import aiomqtt
import pytest
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties

from bridge.core.codes import Code
from bridge.core.identity import Role
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Event
from robotside.core.config import TrustSettings
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.mqtt import broker_line
from robotside.gateways.mqtt import gateway as mqtt_gateway
from robotside.gateways.mqtt.gateway import MqttGateway
from robotside.trust.people import TOKEN
from robotside.trust.people_file import PeopleFile
from robotside.trust.trust import Trust
from tests.fakes import FakeRobot
from tests.lacking import lacking
from tests.looped import looped
from tests.robotside import scene as scenes
from tests.robotside.gateways.mqtt.broker import MOSQUITTO, Broker
from tests.robotside.scene import Scene

ROOT = "pilothouse/Fake-1"
AHEAD = {"linear": {"x": 0.2}}
FRESH = 2
"""Expiry of a command [s]."""


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Broker]:
    made = Broker(tmp_path)
    yield made
    made.thaw()
    made.kill()


@pytest.fixture(autouse=True)
async def no_pool_left() -> AsyncIterator[None]:
    """End the threads of the loop's own pool, in which connections are made."""
    yield
    await asyncio.get_running_loop().shutdown_default_executor()


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """A busy computer on which these tests are slow is no robot that stood still, and no client that is lost."""
    monkeypatch.setattr(broker_line, "STALL_TIMEOUT", 60.0)
    monkeypatch.setattr(broker_line, "KEEPALIVE", 60)
    monkeypatch.setattr(broker_line, "STANDING_TIME", 0.0)
    monkeypatch.setattr(mqtt_gateway, "_CHECK_PERIOD", 0.02)


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(1.0)
    return made


@asynccontextmanager
async def serving(
    scene: Scene, url: str, options: str = "role=drive", door: StationDoor | None = None
) -> AsyncIterator[MqttGateway]:
    say = scene.station.events.say
    address = read_url(f"{url}?{options}", {"mqtt": 1883})
    gateway = MqttGateway(Surroundings(door or scene.door, say), address)
    async with asyncio.timeout(60):
        await gateway.start()
        try:
            yield gateway
        finally:
            await gateway.stop()


async def until(so: Callable[[], object]) -> None:
    """Wait until it is so; the test's own time-out ends what never is."""
    while not so():  # noqa: ASYNC110 - what is waited for is no event
        await asyncio.sleep(0.005)


class Client:
    """Another program at the broker."""

    def __init__(self, mqtt: aiomqtt.Client, name: str) -> None:
        self.mqtt, self.name = mqtt, name
        self.heard: dict[str, list[Any]] = {}
        """Messages by topic."""
        self._listening = asyncio.create_task(self._listen())

    async def _listen(self) -> None:
        async for message in self.mqtt.messages:
            topic, text = str(message.topic), bytes(message.payload).decode(errors="replace")
            is_own = f"/clients/{self.name}/" in topic and "/answer" not in topic
            kept = json.loads(text) if text.startswith("{") and not is_own else text
            self.heard.setdefault(topic, []).append(kept)

    async def send(
        self,
        what: str,
        message: object = None,
        *,
        expiry: int | None = None,
        retain: bool = False,
        wish: str = "",
        qos: int = 1,
        **properties: str,
    ) -> None:
        said = Properties(PacketTypes.PUBLISH)
        if expiry is not None:
            said.MessageExpiryInterval = expiry
        if wish:
            said.ResponseTopic = wish
        if properties:
            said.UserProperty = list(properties.items())
        raw = message if isinstance(message, bytes) else json.dumps(message or {}).encode()
        topic = f"{ROOT}/clients/{self.name}/{what}"
        await self.mqtt.publish(topic, raw, qos=qos, retain=retain, properties=said)

    async def ask(self, what: str, message: object = None, **said: Any) -> dict[str, Any]:
        """The answer to a command."""
        topic = said.get("wish") or f"{ROOT}/clients/{self.name}/answer/{what.partition('/')[2]}"
        had = len(self.heard.get(topic, ()))
        await self.send(what, message, **said)
        await until(lambda: len(self.heard.get(topic, ())) > had)
        answer = self.heard[topic][-1]
        assert isinstance(answer, dict)
        return answer

    async def told(self, topic: str) -> Any:
        """The newest message on a topic of the robot."""
        await until(lambda: f"{ROOT}/{topic}" in self.heard)
        return self.heard[f"{ROOT}/{topic}"][-1]

    async def close(self) -> None:
        self._listening.cancel()
        await asyncio.gather(self._listening, return_exceptions=True)


@asynccontextmanager
async def client(broker: Broker, name: str = "me") -> AsyncIterator[Client]:
    async with aiomqtt.Client("127.0.0.1", broker.port, protocol=aiomqtt.ProtocolVersion.V5) as mqtt:
        made = Client(mqtt, name)
        await mqtt.subscribe(f"{ROOT}/#", qos=1)
        try:
            yield made
        finally:
            await made.close()


def codes(scene: Scene) -> list[str]:
    return [msg.code for _, msg in scene.said if isinstance(msg, Event)]


async def online(me: Client) -> None:
    await until(
        lambda: {"state": "online", "robot": "Fake-1", "boot": "b1"} in me.heard.get(f"{ROOT}/state", ())
    )


async def driving(scene: Scene, me: Client) -> None:
    """The client drives the robot."""
    await me.ask("call/rosapi/get_time")
    await me.send("publish/cmd_vel", AHEAD, stamp=str(scene.clock))
    await until(lambda: not scene.robot.at_rest)


STOPS = (b"", b"{}", b"stop!", b'{"client_name": "Fred", "surprise": 1}', b"\xff", b"[" * 70000)


@looped("raw", STOPS)
def test_anybody_stops_the_robot_whatever_the_message_says(raw: bytes, tmp_path: Path) -> None:
    asyncio.run(_stops(raw, tmp_path))


async def _stops(raw: bytes, folder: Path) -> None:
    scene, broker = Scene(FakeRobot(), folder), Broker(folder)
    try:
        scene.drive(Twist.planar(0.3, 0.0))
        async with serving(scene, broker.url, "role=none"), client(broker) as me:
            await online(me)
            assert (await me.ask("call/stop", raw, token="wrong"))["success"]
            assert scene.station.controls.stopped
            assert scene.robot.at_rest
    finally:
        broker.kill()


@pytest.mark.parametrize("retain", [False, True])
@pytest.mark.parametrize("deaf", ["_stop", "_commands"])
async def test_stop_comes_by_either_connection_while_the_other_is_deaf(
    deaf: str, retain: bool, scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url) as gateway, client(broker) as me:
        await online(me)
        await until(lambda: gateway._stop.is_up)
        line = getattr(gateway, deaf)
        asyncio.get_running_loop().remove_reader(
            line._client._client.socket()
        )  # half open: it seems to be up
        scene.drive(Twist.planar(0.3, 0.0))
        assert (await me.ask("call/stop", retain=retain))["success"]
        assert line.is_up
        assert scene.station.controls.stopped
        assert scene.robot.at_rest


async def test_a_retained_stop_from_before_is_not_heard(scene: Scene, broker: Broker) -> None:
    if not MOSQUITTO:
        lacking("mosquitto", "the other broker passes on what it has kept, and a STOP is pressed then too")
    async with client(broker) as me:
        await me.send("call/stop", retain=True)
        async with serving(scene, broker.url) as gateway:
            await online(me)
            await until(lambda: gateway._stop.is_up)
            await me.ask("call/rosapi/get_time")
            assert not scene.station.controls.stopped


async def test_stop_comes_through_while_others_flood_the_robot(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me, client(broker, "noise") as noise:
        await online(me)

        stopped = asyncio.Event()

        async def flood() -> None:
            while not stopped.is_set():
                await noise.send("publish/cmd_vel", AHEAD)

        flooding = [asyncio.create_task(flood()) for _ in range(4)]
        assert (await me.ask("call/stop"))["success"]
        stopped.set()
        await asyncio.gather(*flooding)
    assert scene.station.controls.stopped


async def test_a_driver_drives_with_a_stamp_and_rests_when_it_says_goodbye(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await driving(scene, me)
        await me.send("bye")
        await until(lambda: scene.robot.at_rest)
        assert not scene.control.driver


async def test_a_goodbye_in_another_ones_name_needs_its_token(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await driving(scene, me)
        await me.send("bye", token="another")
        await me.ask("call/rosapi/get_time")
        assert not scene.robot.at_rest


async def test_a_drive_command_of_unknown_or_too_great_age_moves_nothing(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await me.send("publish/cmd_vel", AHEAD)
        await me.send("publish/cmd_vel", AHEAD, stamp=str(scene.clock))  # of a clock that was never compared
        await me.ask("call/rosapi/get_time")
        await me.send("publish/cmd_vel", AHEAD, expiry=FRESH)
        await me.send("publish/cmd_vel", AHEAD, stamp=str(scene.clock - 1.0))
        await me.ask("call/rosapi/get_time")
        assert scene.robot.at_rest


async def test_the_robot_rests_when_its_broker_dies_and_obeys_nothing_old_when_it_is_back(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url):
        async with client(broker) as me:
            await online(me)
            await driving(scene, me)
            broker.kill()
            await until(lambda: scene.robot.at_rest)
        assert not scene.control.driver
        assert Code.GATEWAY_LOST in codes(scene)
        broker.start()
        async with client(broker) as me:
            await me.send("call/task/start", {"order": {"task": "hold"}}, expiry=FRESH)
            await online(me)
            await until(lambda: Code.GATEWAY_UP in codes(scene))
            await me.ask("call/rosapi/get_time")
            assert scene.robot.at_rest


async def test_a_broker_that_is_absent_is_an_event_and_is_reached_when_it_comes(
    scene: Scene, broker: Broker
) -> None:
    broker.kill()
    async with serving(scene, broker.url):
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
        broker.start()
        async with client(broker) as me:
            await online(me)
            assert (await me.ask("call/control/acquire", expiry=FRESH))["success"]
    assert codes(scene).count(Code.GATEWAY_LOST) == 1


async def test_a_broker_that_answers_too_late_has_no_second_robot_whose_will_says_lost(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(broker_line, "CONNECT_TIMEOUT", 0.3)
    before = asyncio.all_tasks()
    broker.freeze()
    async with serving(scene, broker.url):
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
        monkeypatch.setattr(broker_line, "CONNECT_TIMEOUT", 60.0)
        broker.thaw()
        async with client(broker) as me:
            await online(me)
            await me.ask("call/rosapi/get_time")
            assert me.heard[f"{ROOT}/state"][-1]["state"] == "online"
    assert asyncio.all_tasks() == before


async def test_a_broker_that_falls_silent_leaves_the_robot_at_rest(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(broker_line, "KEEPALIVE", 2)
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await driving(scene, me)
        broker.freeze()
        await until(lambda: scene.robot.at_rest)
        broker.thaw()
        await until(lambda: Code.GATEWAY_UP in codes(scene))


async def test_a_robot_that_stood_still_does_nothing_that_waited_meanwhile_but_stop(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        broker.freeze()  # so that all of it comes while the robot stands still
        await me.send("call/control/acquire", expiry=FRESH, qos=0)
        await me.send("call/stop", qos=0)
        monkeypatch.setattr(broker_line, "STALL_TIMEOUT", 0.25)
        broker.thaw()
        time.sleep(1.0)  # noqa: ASYNC251 - the loop stands still
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
        monkeypatch.setattr(broker_line, "STALL_TIMEOUT", 60.0)
        await until(lambda: Code.GATEWAY_UP in codes(scene) and scene.station.controls.stopped)
        await me.ask("call/rosapi/get_time")
        assert not scene.control.driver


async def test_a_call_needs_something_that_says_how_old_it_is(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        for said in ({}, {"expiry": 3600}):
            answer = await me.ask("call/control/acquire", **said)
            assert (answer["success"], answer["code"]) == (False, Code.GATEWAY_UNDATED)
        late = await me.ask("call/control/acquire", stamp=str(scene.clock - 60), expiry=FRESH)
        assert (late["success"], late["code"]) == (False, Code.COMMAND_LATE)
        assert not scene.control.driver
        assert (await me.ask("call/control/acquire", {"stamp": scene.clock}))["success"]
        assert (await me.ask("call/control/release", expiry=FRESH))["success"]
        assert (await me.ask("call/control/acquire", stamp=str(scene.clock)))["success"]
        assert scene.control.driver == "me"


async def test_a_retained_command_from_before_is_not_heard(scene: Scene, broker: Broker) -> None:
    async with client(broker) as me:
        await me.send("call/control/acquire", retain=True, expiry=FRESH)
        async with serving(scene, broker.url):
            await online(me)
            await me.ask("call/rosapi/get_time")
            assert not scene.control.driver


async def test_a_command_that_is_to_be_retained_is_refused(scene: Scene, broker: Broker) -> None:
    if not MOSQUITTO:
        lacking("mosquitto", "the other broker does not pass on what is retained")
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        answer = await me.ask("call/control/acquire", retain=True, expiry=FRESH)
        assert (answer["success"], answer["code"]) == (False, Code.GATEWAY_RETAINED)
        assert not scene.control.driver


async def test_a_command_that_is_sent_twice_is_done_once(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        place = {"command_id": "c1", "place": {"name": "Office", "x": 1.0, "y": 1.0}}
        first = await me.ask("call/places/set", place, expiry=FRESH)
        await me.send("bye")  # the next one comes by another operator
        again = await me.ask("call/places/set", place, expiry=FRESH)
        assert first["success"]
        assert again == first
    assert [place.name for place in scene.station.records.places.all()] == ["Office"]


WRONG: dict[str, tuple[bytes, str]] = {
    "publish/cmd_vel": (b'{"linear": {"x": "0.2"}}', "linear.x must be a number or null"),
    "publish/cmd_manoeuvre": (b'{"kind": "rest", "colour": 1}', "has no field"),
    "publish/goal_pose": (b'{"pose": {"position": {"x": NaN}}}', "not JSON"),
    "publish/initialpose": (b"[1]", "must be an object"),
    "publish/odom": (b"{}", "does not listen to"),
    "publish/nothing": (b"{}", "does not carry /nothing"),
    "call/task/start": (b'{"task": 1e999}', "not JSON"),
    "call/mode/set": (b'{"mode": true}', "mode must be a text"),
    "call/people/list": (b"{}", "does not carry /people/list"),
    "call/nothing": (b"{}", "does not carry /nothing"),
    "call/places/set": (b'{"place": {"name": "' + b"x" * 70000 + b'"}}', "at most 65536 bytes"),
}


async def test_what_is_wrong_with_a_message_is_answered_and_nothing_is_done(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        for what, (raw, why) in WRONG.items():
            answer = await me.ask(what, raw, expiry=FRESH)
            assert not answer["success"], what
            assert why in answer["message"], what
        late = await me.ask("call/task/start", {}, stamp="soon")
        assert "is a time in seconds, not 'soon'" in late["message"]
    assert scene.robot.at_rest


async def test_who_has_no_token_has_the_role_of_the_gateway_and_a_token_gives_more(
    scene: Scene, broker: Broker, tmp_path: Path
) -> None:
    trust = Trust(PeopleFile(tmp_path), scene.station.clock, TrustSettings())
    _, token = await trust.add("Anna", Role.DRIVE, TOKEN)
    door = StationDoor(scene.station, trust)
    try:
        async with serving(scene, broker.url, "role=watch", door), client(broker) as me:
            await online(me)
            refused = await me.ask("call/control/acquire", expiry=FRESH)
            assert (refused["success"], refused["code"]) == (False, Code.TRUST_ROLE)
            wrong = await me.ask("call/control/acquire", expiry=FRESH, token=token[:-1] + "~")
            assert (wrong["success"], wrong["code"]) == (False, Code.TRUST_KEY)
            assert (await me.ask("call/control/acquire", expiry=FRESH, token=token))["success"]
            assert scene.control.driver == "Anna"
        assert Code.GATEWAY_OPEN not in codes(scene)
    finally:
        door.close()
        trust.close()


async def test_without_a_role_the_gateway_lets_watch(scene: Scene, broker: Broker, tmp_path: Path) -> None:
    async with serving(scene, broker.url, ""), client(broker) as me:
        await online(me)
        assert (await me.told("topics/control/status"))["mode"]
        refused = await me.ask("call/control/acquire", expiry=FRESH)
        assert refused["code"] == Code.TRUST_ROLE


async def test_a_gateway_that_lets_everybody_drive_says_so(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url, "role=drive"):
        assert Code.GATEWAY_OPEN in codes(scene)


async def test_an_answer_goes_below_the_clients_own_topic_and_nowhere_else(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        mine = f"{ROOT}/clients/me/answer/42"
        assert "time" in await me.ask("call/rosapi/get_time", wish=mine)
        await me.send("call/rosapi/get_time", wish=f"{ROOT}/clients/other/call/stop")
        await until(lambda: f"{ROOT}/clients/me/answer/rosapi/get_time" in me.heard)
    assert not scene.station.controls.stopped


async def test_topics_come_with_the_newest_state_kept_and_no_payload_that_was_not_chosen(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url, "payloads=wheels&rate=50"), client(broker) as me:
        await online(me)
        assert (await me.told("topics/robot/info"))["name"] == "Fake-1"
        scene.run(1.0)
        assert "pose" in await me.told("topics/odom")
        async with client(broker, "late") as late:
            assert (await late.told("topics/control/status"))["mode"] == "MANUAL"
        left_out = await me.ask("call/task/start", expiry=FRESH)
        assert left_out["code"] == Code.GATEWAY_LEFT_OUT
        assert not [topic for topic in me.heard if topic.endswith(("/scan", "/task/status"))]


async def test_the_state_is_offline_after_an_end_and_lost_by_the_last_will(
    scene: Scene, broker: Broker
) -> None:
    async with client(broker) as me:
        async with serving(scene, broker.url) as gateway:
            await online(me)
            guide = await me.told("guide")
            assert guide == gateway.guide()
        await until(lambda: me.heard[f"{ROOT}/state"][-1]["state"] == "offline")
        async with serving(scene, broker.url) as gateway:
            await until(lambda: me.heard[f"{ROOT}/state"][-1]["state"] == "online")
            gateway._commands._client._client.socket().shutdown(
                socket.SHUT_RDWR
            )  # as a robot that is cut off
            await until(lambda: "lost" in [each["state"] for each in me.heard[f"{ROOT}/state"]])


async def test_nothing_is_left_of_a_gateway_that_was_stopped(scene: Scene, broker: Broker) -> None:
    before = asyncio.all_tasks()
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await driving(scene, me)
    assert asyncio.all_tasks() == before
    assert scene.robot.at_rest
    assert not scene.door._operators
    assert not scene.door._subscriptions


async def test_a_gateway_is_stopped_without_having_been_started(scene: Scene) -> None:
    gateway = MqttGateway(
        Surroundings(scene.door, scene.station.events.say), read_url("mqtt://127.0.0.1", {"mqtt": 1})
    )
    await gateway.stop()
    assert gateway.endpoints() == {"mqtt": f"mqtt://127.0.0.1:1/{ROOT}"}


@asynccontextmanager
async def refusing_broker(refused: str) -> AsyncIterator[str]:
    """The URL of a broker that refuses subscriptions whose topic has the word, as one with an access list does."""

    async def answer(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with suppress(asyncio.IncompleteReadError, ConnectionError):
            while True:
                kind, body = await packet(reader)
                if kind == 1:  # CONNECT
                    writer.write(bytes((0x20, 3, 0, 0, 0)))
                elif kind == 3:  # PUBLISH with QoS 1; the others need no answer
                    start = 2 + int.from_bytes(body[:2])
                    writer.write(bytes((0x40, 2)) + body[start : start + 2])
                elif kind == 8:  # SUBSCRIBE
                    code = 0x87 if refused.encode() in body else 1
                    writer.write(bytes((0x90, 4)) + body[:2] + bytes((0, code)))
                elif kind == 12:  # PINGREQ
                    writer.write(bytes((0xD0, 0)))
        writer.close()

    async def packet(reader: asyncio.StreamReader) -> tuple[int, bytes]:
        kind, size, shift = (await reader.readexactly(1))[0] >> 4, 0, 0
        while True:
            part = (await reader.readexactly(1))[0]
            size, shift = size | (part & 127) << shift, shift + 7
            if part < 128:
                return kind, await reader.readexactly(size)

    async with await asyncio.start_server(answer, "127.0.0.1", 0) as server:
        yield f"mqtt://127.0.0.1:{server.sockets[0].getsockname()[1]}"


@pytest.mark.parametrize(
    ("refused", "line"), [("/clients/+/call/#", "The MQTT broker"), ("/call/stop", "STOP has no connection")]
)
async def test_a_broker_that_refuses_a_subscription_is_an_event_that_says_what_to_allow(
    refused: str, line: str, scene: Scene
) -> None:
    async with refusing_broker(refused) as url, serving(scene, url):
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
    said = next(msg.text for _, msg in scene.said if isinstance(msg, Event) and msg.code == Code.GATEWAY_LOST)
    assert said.startswith(line)
    assert "does not let the robot read pilothouse/Fake-1/clients/" in said
    assert refused in said
    assert Code.GATEWAY_UP not in codes(scene)


async def test_a_broker_that_comes_and_goes_is_told_of_once(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(broker_line, "STANDING_TIME", 3600.0)
    async with serving(scene, broker.url) as gateway:
        for _ in range(2):
            await until(lambda: gateway._commands.is_up)
            broker.kill()
            await until(lambda: not gateway._commands.is_up)
            broker.start()
        await until(lambda: gateway._commands.is_up and gateway._stop.is_up)
        # STOP's connection may be seen to be lost a moment before
        texts = [msg.text for _, msg in scene.said if isinstance(msg, Event)]
        assert len([text for text in texts if text.startswith("The MQTT broker at")]) == 1
        assert Code.GATEWAY_UP not in codes(scene)


async def test_two_robots_of_one_name_take_stop_only_until_one_of_them_is_gone(
    scene: Scene, broker: Broker, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(scenes._KEPT, tmp_path / "other", scenes.empty() | {"facts": {"log": "b2"}})
    other = Scene(FakeRobot(), tmp_path / "other")
    async with serving(scene, broker.url) as gateway, client(broker) as me:
        await online(me)
        await driving(scene, me)
        async with serving(other, broker.url):
            await until(lambda: all(Code.GATEWAY_NAMESAKE in codes(each) for each in (scene, other)))
            assert scene.robot.at_rest
            refused = await me.ask("call/control/acquire", expiry=FRESH)
            assert (refused["success"], refused["code"]) == (False, Code.GATEWAY_NAMESAKE)
            assert "another --name" in refused["message"]
            assert not scene.control.driver
            assert not other.control.driver
            await me.send("call/stop")
            await until(lambda: scene.station.controls.stopped and other.station.controls.stopped)
        await until(lambda: not gateway._namesakes)
        assert (await me.ask("call/rosapi/get_time")).get("time")


async def test_a_message_that_cannot_be_written_ends_no_other(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url) as gateway, client(broker) as me:
        await online(me)
        for text in ("file \udcff is bad", "next"):
            gateway._put(scene.door.topics["/events"], "/events", Event(text=text))
        await until(lambda: "next" in [each["text"] for each in me.heard.get(f"{ROOT}/topics/events", ())])
