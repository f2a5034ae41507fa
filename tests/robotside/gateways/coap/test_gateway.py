"""CoAP with real clients: STOP first, then who may do what, what is too old, what is wrong, and clients that are gone."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pytest
from aiocoap import Context, Message
from aiocoap.numbers.codes import Code as CoapCode
from aiocoap.numbers.constants import TransportTuning
from aiocoap.numbers.optionnumbers import OptionNumber
from aiocoap.numbers.types import ACK, CON, NON, RST
from aiocoap.optiontypes import OpaqueOption

from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import ArmOrder, Event
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.core.config import TrustSettings
from robotside.door.station_door import StationDoor
from robotside.gateways.coap import datagrams, flood_guard, observation, observers, site
from robotside.gateways.coap.gateway import CoapGateway
from robotside.gateways.gateway_url import read_url
from robotside.trust.people import TOKEN
from robotside.trust.people_file import PeopleFile
from robotside.trust.trust import Trust
from tests.bridge.wires import until
from tests.fakes import FakeRobot
from tests.looped import looped
from tests.robotside.gateways.coap.client import Client, client, serving
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.scene import Scene

AHEAD = {"linear": {"x": 0.2}}
TIME = "/rosapi/get_time"


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    robot = EquippedRobot()
    robot.info = msgspec.structs.replace(robot.info, cameras=["front"])
    made = Scene(robot, tmp_path)
    made.run(1.0)
    return made


@pytest.fixture(autouse=True)
async def no_pool_left() -> AsyncIterator[None]:
    """End the threads of the loop's own pool, in which aiocoap's client looks up addresses."""
    yield
    await asyncio.get_running_loop().shutdown_default_executor()


def codes(scene: Scene) -> list[str]:
    return [msg.code for _, msg in scene.said if isinstance(msg, Event)]


async def driving(scene: Scene, me: Client, query: str = "") -> None:
    """The client drives the robot."""
    await me.post(f"{TIME}?{query}")
    await me.post(f"/cmd_vel?{query}&stamp={scene.clock}".replace("?&", "?"), AHEAD)
    assert not scene.robot.at_rest


class Device:
    """A client that writes its own datagrams."""

    def __init__(self, gateway: CoapGateway) -> None:
        self._sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._sock.setblocking(False)
        self._sock.connect(("127.0.0.1", gateway._port))
        self._loop = asyncio.get_running_loop()

    def say(
        self, kind: Any, number: int, code: CoapCode, path: str = "", raw: bytes = b"", **options: Any
    ) -> None:
        message = Message(code=code, payload=raw, _mtype=kind, _mid=number, _token=b"\x07", **options)
        message.opt.uri_path = tuple(path.strip("/").split("/")) if path else ()
        if code == CoapCode.EMPTY:
            message.token = b""
        self._sock.send(message.encode())

    async def hear(self) -> Any:
        """The next message."""
        return Message.decode(await self._loop.sock_recv(self._sock, 4096))

    def heard(self) -> int:
        """How many messages are there, which are forgotten."""
        count = 0
        while True:
            try:
                self._sock.recv(4096)
            except BlockingIOError:
                return count
            count += 1

    def close(self) -> None:
        self._sock.close()


@asynccontextmanager
async def device(gateway: CoapGateway) -> AsyncIterator[Device]:
    made = Device(gateway)
    try:
        yield made
    finally:
        made.close()


STOPS: tuple[tuple[str, bytes, str, dict[str, Any]], ...] = (
    ("POST", b"", "", {}),
    ("PUT", b'{"client_name": "Fred"}', "", {}),
    ("POST", b"stop!", "", {}),
    ("POST", b'{"stamp": NaN, "surprise": 1}', "", {}),
    ("DELETE", b"", "", {}),
    ("POST", b"", "?token=wrong", {}),
    ("POST", b"", "?stamp=soon&colour=red", {}),
    ("POST", b"\xff", "", {"content_format": 60}),
    ("POST", b"", "", {"accept": 41}),
)


@looped(("method", "raw", "query", "options"), STOPS)
def test_anybody_stops_the_robot_whatever_the_request_says(
    method: str, raw: bytes, query: str, options: dict[str, Any], tmp_path: Path
) -> None:
    asyncio.run(_stops(method, raw, query, options, tmp_path))


async def _stops(method: str, raw: bytes, query: str, options: dict[str, Any], folder: Path) -> None:
    scene = Scene(FakeRobot(), folder)
    scene.drive(Twist.planar(0.3, 0.0))
    around = {"plain_from": lambda _: False}  # also where everything else wants TLS
    async with serving(scene, "role=none", **around) as gateway, client(gateway) as me:
        answer = await me.ask(method, f"/stop{query}", raw, **options)
        assert answer.code == "2.04"
        assert answer.json["success"]
        assert scene.station.controls.stopped
        assert scene.robot.at_rest
        scene.release_stop()


async def test_to_look_at_stop_does_not_press_it(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        assert (await me.get("/stop")).code == "4.05"
        assert not scene.station.controls.stopped


async def test_a_stop_of_any_size_or_with_an_option_that_is_not_known_is_pressed(scene: Scene) -> None:
    async with serving(scene) as gateway, device(gateway) as me:
        me.say(NON, 1, CoapCode.POST, "/stop", b"x" * 1500)
        assert (await me.hear()).code == CoapCode.CHANGED
        assert scene.station.controls.stopped
        scene.release_stop()
        odd = Message(code=CoapCode.POST, _mtype=CON, _mid=2, _token=b"\x07")
        odd.opt.uri_path = ("stop",)
        odd.opt.add_option(OpaqueOption(OptionNumber(2049), b"?"))
        me._sock.send(odd.encode())
        assert (await me.hear()).code == CoapCode.CHANGED
        assert scene.station.controls.stopped


async def test_stop_comes_through_a_flood_of_which_little_is_heard(scene: Scene) -> None:
    heard: list[object] = []
    async with serving(scene) as gateway, device(gateway) as noise, client(gateway) as me:
        asked = gateway._site._respond
        gateway._site._respond = lambda pipe: heard.append(pipe) or asked(pipe)
        flood = json.dumps(AHEAD).encode()
        for number in range(20):
            for step in range(200):
                with_stop = "/cmd_vel" if step % 2 else "/nothing/stop"
                noise.say(NON, (number * 200 + step) & 0xFFFF, CoapCode.POST, with_stop, flood)
            await asyncio.sleep(0)
        assert (await me.post("/stop")).json["success"]
        assert scene.station.controls.stopped
        await until(lambda: scene.robot.at_rest)
        assert len(heard) < 20 * 200 / 2


async def test_stop_is_heard_at_the_very_moment_at_which_nothing_else_is(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(flood_guard, "ALL_RATE", 0.0)
    async with serving(scene) as gateway:
        own, heard = gateway._server.socket, []
        own._dispatch = heard.append
        order, look, stop = (
            Message(code=code, payload=b"stop", _mtype=NON, _mid=1, uri_path=path).encode()
            for code, path in (
                (CoapCode.POST, ("cmd_vel",)),
                (CoapCode.GET, ("stop",)),
                (CoapCode.POST, ("stop",)),
            )
        )
        for number in range(1000):
            own._hear(order, ("127.0.0.1", number % 7))
        count = len(heard)
        assert count <= flood_guard.ALL_BURST
        for raw in (order, look, stop, order, look):
            own._hear(raw, ("127.0.0.1", 5000))
        assert [datagrams.is_stop(message) for message in heard[count:]] == [True]


async def test_of_a_flood_a_few_are_heard_before_others_have_their_turn(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(flood_guard, "ALL_RATE", 0.0)
    monkeypatch.setattr(flood_guard, "ALL_BURST", 50.0)
    async with serving(scene) as gateway, device(gateway) as noise:
        own, heard = gateway._server.socket, []
        own._dispatch = heard.append
        for number in range(50):
            noise.say(NON, number, CoapCode.POST, "/cmd_vel")
        own._read()
        assert len(heard) == datagrams.MAX_HEARD
        await until(lambda: len(heard) == 50)
        for number in range(40):
            noise.say(NON, number, CoapCode.POST, "/cmd_vel")
        noise.say(NON, 99, CoapCode.POST, "/stop")
        own._read()
        assert datagrams.is_stop(heard[-1]), "what is dropped takes no turn"


async def test_stop_is_answered_where_too_much_is_under_way_and_nothing_else(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(site, "MAX_UNDER_WAY", 0)
    async with serving(scene) as gateway, client(gateway) as me:
        assert (await me.get("/odom")).code == "5.03"
        assert (await me.post(TIME)).code == "5.03"
        assert (await me.post("/stop")).json["success"]


async def test_a_driver_drives_with_a_stamp_and_rests_when_it_says_goodbye(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await driving(scene, me)
        await me.post("/bye?client=another")
        assert not scene.robot.at_rest
        await me.post("/bye")
        assert scene.robot.at_rest
        assert not scene.control.driver


async def test_a_driver_who_falls_silent_leaves_the_robot_at_rest_after_a_quarter_of_a_second(
    scene: Scene,
) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await driving(scene, me)
        scene.run(0.2)
        assert not scene.robot.at_rest
        scene.run(0.1)
        assert scene.robot.at_rest


async def test_a_drive_command_of_unknown_or_too_great_age_moves_nothing(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await me.post("/cmd_vel", AHEAD)
        await me.post(f"/cmd_vel?stamp={scene.clock}", AHEAD)  # of a clock that was never compared
        await me.post(TIME)
        await me.post("/cmd_vel", AHEAD)
        await me.post(f"/cmd_vel?stamp={scene.clock - 0.3}", AHEAD)
        await me.post(f"/cmd_vel?stamp={scene.clock + 60}", AHEAD)
        assert scene.robot.at_rest


async def test_drive_commands_count_in_the_order_in_which_they_were_given(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await driving(scene, me)
        scene.run(0.1)
        await me.post(f"/cmd_vel?stamp={scene.clock}", {})
        assert scene.robot.at_rest
        await me.post(f"/cmd_vel?stamp={scene.clock - 0.05}", AHEAD)  # it was on its way for longer
        assert scene.robot.at_rest


async def test_what_the_robot_does_not_obey_is_refused(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await driving(scene, me)
        await me.post("/stop")
        scene.run(0.05)
        answer = await me.post(f"/cmd_vel?stamp={scene.clock}", AHEAD, accept=50)
        assert answer.code == "4.09"
        assert (answer.json["success"], answer.json["code"]) == (False, Code.STOP_IS_PRESSED)


async def test_a_call_needs_a_stamp(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        for query, code in (("", Code.GATEWAY_UNDATED), (f"?stamp={scene.clock - 60}", Code.COMMAND_LATE)):
            answer = await me.post(f"/control/acquire{query}", accept=50)
            assert answer.code in ("4.00", "4.09")
            assert (answer.json["success"], answer.json["code"]) == (False, code)
        assert not scene.control.driver
        assert (await me.post(f"/control/acquire?stamp={scene.clock}&client=me")).json["success"]
        assert scene.control.driver == "me"


async def test_a_datagram_that_comes_twice_is_carried_out_once(scene: Scene) -> None:
    place = json.dumps({"stamp": scene.clock, "place": {"name": "Office", "x": 1.0, "y": 1.0}}).encode()
    async with serving(scene) as gateway, device(gateway) as me:
        answers = []
        for _ in range(2):
            me.say(CON, 9, CoapCode.POST, "/places/set", place)
            answers.append((await me.hear()).payload)
        me.say(NON, 10, CoapCode.POST, "/places/set", place.replace(b"Office", b"Lab"))
        me.say(NON, 10, CoapCode.POST, "/places/set", place.replace(b"Office", b"Hall"))
        answers.append((await me.hear()).payload)
    assert answers[0] == answers[1]
    assert [each.name for each in scene.station.records.places.all()] == ["Office", "Lab"]


WRONG: tuple[tuple[str, str, object, dict[str, Any], str, str], ...] = (
    ("POST", "/cmd_vel", {"linear": {"x": "0.2"}}, {}, "4.00", "linear.x must be a number or null"),
    ("PUT", "/cmd_vel", {"colour": 1}, {}, "4.00", "has no field"),
    ("POST", "/cmd_vel", b'{"linear": {"x": NaN}}', {}, "4.00", "not JSON"),
    ("POST", "/cmd_vel", b'{"linear": {"x": 1e999}}', {}, "4.00", "not JSON"),
    ("POST", "/cmd_vel", b"[1]", {}, "4.00", "must be an object"),
    ("POST", "/cmd_vel", b"\xa0", {"content_format": 60}, "4.15", "not 60"),
    ("POST", "/mode/set", {"mode": True}, {}, "4.00", "mode must be a text"),
    ("POST", "/mode/set", {}, {"accept": 41}, "4.06", "JSON or text"),
    ("POST", "/odom", {}, {}, "4.05", "GET it"),
    ("POST", "/nothing", {}, {}, "4.04", "does not carry /nothing"),
    ("POST", "/people/list", {}, {}, "4.04", "does not carry /people/list"),
    ("POST", "/task/run", {}, {}, "4.04", "does not carry /task/run"),
    ("GET", "/arm/move", None, {}, "4.05", "POST to it"),
    ("GET", "/cmd_vel", None, {}, "4.05", "POST to it"),
    ("GET", "/nothing", None, {}, "4.04", "does not carry /nothing"),
    ("GET", "/tag", None, {}, "4.04", "Nothing was said on /tag yet"),
    ("GET", "/odom", None, {"accept": 22}, "4.06", "JSON or text"),
    ("GET", "/odom?colour=red", None, {}, "4.00", "token, client, stamp, rate"),
    ("GET", "/odom?rate=2&rate=3", None, {}, "4.00", "each once"),
    ("GET", "/odom?rate=0", None, {"observe": 0}, "4.00", "above 0 and at most 50 Hz, not 0"),
    ("GET", "/odom?rate=nan", None, {"observe": 0}, "4.00", "is a number, not 'nan'"),
    ("POST", "/cmd_vel?stamp=soon", {}, {}, "4.00", "is a number, not 'soon'"),
    ("POST", f"{TIME}?client={'x' * 65}", {}, {}, "4.00", "at most 64 characters"),
    ("DELETE", "/odom", None, {}, "4.05", "GET, POST and PUT are"),
    ("POST", "/cmd_vel", {}, {"if_none_match": True}, "4.02", "option 5 is not known"),
    ("POST", "/places/set", {"place": {"name": "x" * 70_000}}, {}, "4.13", "at most 65536 bytes"),
)


async def test_what_is_wrong_with_a_request_is_answered_and_nothing_is_done(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(flood_guard, "SOURCE_RATE", 1e6)
    monkeypatch.setattr(flood_guard, "ALL_RATE", 1e6)
    async with serving(scene) as gateway, client(gateway) as me:
        for method, path, said, options, code, why in WRONG:
            answer = await me.ask(method, path, said, **options)
            assert answer.code == code, (path, answer)
            assert why in answer.text, (path, answer)
    assert scene.robot.at_rest
    assert not scene.station.records.places.all()


async def test_a_message_that_is_too_long_for_a_datagram_is_refused(scene: Scene) -> None:
    async with serving(scene) as gateway, device(gateway) as me:
        me.say(CON, 1, CoapCode.POST, "/cmd_vel", b" " * 3000)
        answer = await me.hear()
        assert answer.code == CoapCode.REQUEST_ENTITY_TOO_LARGE
        assert b"in blocks" in answer.payload


async def test_what_is_no_coap_is_passed_over(scene: Scene) -> None:
    async with serving(scene) as gateway, device(gateway) as me:
        for raw in (
            b"",
            b"\x00",
            b"GET / HTTP/1.1\r\n\r\n",
            b"\xff" * 40,
            b"\x40\x01\x00\x01\xd1",
            b"\x4f\x02\x00\x01stop",
        ):
            me._sock.send(raw)
        me.say(CON, 1, CoapCode.POST, "/stop")
        assert (await me.hear()).code == CoapCode.CHANGED


async def test_who_has_no_token_has_the_role_of_the_gateway_and_a_token_gives_more(
    scene: Scene, tmp_path: Path
) -> None:
    trust = Trust(PeopleFile(tmp_path), scene.station.clock, TrustSettings())
    person, token = await trust.add("Anna", Role.DRIVE, TOKEN)
    door = StationDoor(scene.station, trust)
    trust.on_lost = door.expel
    try:
        async with (
            serving(scene, "role=watch", door) as gateway,
            client(gateway) as me,
            AsyncExitStack() as stack,
        ):
            now = f"stamp={scene.clock}"
            assert (await me.post(f"/control/acquire?{now}")).code == "4.03"
            assert (await me.post(f"/control/acquire?{now}&token={token[:-1]}~")).code == "4.01"
            assert (await me.post(f"/control/acquire?{now}&token={token}")).json["success"]
            assert scene.control.driver == "Anna"
            watcher = await stack.enter_async_context(device(gateway))
            watcher.say(NON, 1, CoapCode.GET, "/odom", observe=0, uri_query=(f"token={token}",))
            assert (await watcher.hear()).opt.observe == 0
            await driving(scene, me, f"token={token}")
            await trust.remove(person.id)
            assert scene.robot.at_rest
            assert (await watcher.hear()).code == CoapCode.UNAUTHORIZED
            await until(lambda: len(gateway._site.observers) == 0)
        assert Code.GATEWAY_OPEN not in codes(scene)
    finally:
        door.close()
        trust.close()


async def test_wrong_tokens_count_for_their_host_whatever_name_they_come_under(
    scene: Scene, tmp_path: Path
) -> None:
    trust = Trust(PeopleFile(tmp_path), scene.station.clock, TrustSettings())
    door = StationDoor(scene.station, trust)
    try:
        async with serving(scene, "role=watch", door) as gateway, client(gateway) as me:
            told = {
                (await me.get(f"/odom?client=c{number}&token=x.{number}", accept=50)).json["code"]
                for number in range(30)
            }
            assert told == {Code.TRUST_KEY, Code.TRUST_ATTEMPTS}
            assert (await me.post("/stop?token=x.y")).json["success"]
    finally:
        door.close()
        trust.close()


async def test_who_has_no_role_reads_nothing(scene: Scene) -> None:
    async with serving(scene, "role=none") as gateway, client(gateway) as me:
        for options in ({}, {"observe": 0}):
            assert (await me.get("/odom", **options)).code == "4.01"
        assert (await me.post(f"/control/acquire?stamp={scene.clock}")).code == "4.01"
        assert "odom" not in (await me.get("/guide")).text
        assert "odom" not in (await me.get("/.well-known/core")).text


async def test_without_tls_only_stop_is_answered_to_others_than_this_machine(scene: Scene) -> None:
    async with serving(scene, plain_from=lambda host: host != "127.0.0.1") as gateway, client(gateway) as me:
        for answer in (await me.get("/odom"), await me.post(TIME), await me.get("/guide")):
            assert (answer.code, "only STOP is answered" in answer.text) == ("4.01", True)


async def test_a_gateway_that_lets_everybody_drive_says_so(scene: Scene) -> None:
    async with serving(scene, "role=watch"):
        assert Code.GATEWAY_OPEN not in codes(scene)
    async with serving(scene, "role=drive"):
        assert Code.GATEWAY_OPEN in codes(scene)


async def test_a_payload_that_was_not_chosen_is_not_carried(scene: Scene) -> None:
    async with serving(scene, "role=drive&payloads=wheels") as gateway, client(gateway) as me:
        assert (await me.get("/odom")).code == "2.05"
        assert (await me.get("/places")).code == "4.04"
        assert (await me.post(f"/arm/move?stamp={scene.clock}")).code == "4.04"


async def test_the_arm_obeys_and_the_answer_is_json_or_text_as_asked(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        order = {"order": {"pose": "home"}}
        answer = await me.request("PUT", f"/arm/move?stamp={scene.clock}", order, content_format=50).response
        assert int(answer.opt.content_format) == 50
        assert json.loads(answer.payload)["success"]
        text = await me.request("GET", "/odom", accept=0).response
        assert int(text.opt.content_format) == 0
    assert [each.pose for _, each in scene.robot.orders if isinstance(each, ArmOrder)] == ["home"]


async def test_a_map_is_read_in_blocks_of_one_and_the_same_map(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        whole = json.loads((await me.get("/map")).text)
        assert len(whole["data"]) == whole["info"]["width"] * whole["info"]["height"]
        assert len(gateway._site._out._bodies) == 1


async def test_a_mission_is_sent_in_blocks(scene: Scene) -> None:
    points = [{"x": float(number % 5), "y": 1.0} for number in range(60)]
    mission = {"stamp": scene.clock, "mission": {"waypoints": points, "home": [{"x": 0.0}]}}
    assert len(json.dumps(mission)) > 1024
    async with serving(scene) as gateway, client(gateway) as me:
        answer = await me.post("/mission/set", mission)
        assert answer.json["success"], answer
    assert len(scene.station.records.missions.stored.waypoints) == 60


async def test_a_camera_is_asked_for_its_next_picture(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        asked = asyncio.ensure_future(me.request("GET", "/camera/image/compressed").response)
        await until(lambda: scene.robot.wanted.get("/camera/image/compressed"))
        scene.station.bus.publish(
            "/camera/image/compressed", CompressedImage(format="jpeg", data=b"\xff\xd8" * 900)
        )
        answer = await asked
        assert int(answer.opt.content_format) == 22
        assert answer.payload == b"\xff\xd8" * 900
        assert not scene.robot.wanted["/camera/image/compressed"]


async def test_an_answer_that_takes_a_moment_comes_with_the_acknowledgement(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert 1.0 < datagrams.Tuning.EMPTY_ACK_DELAY < TransportTuning.ACK_TIMEOUT
    monkeypatch.setattr(datagrams.Tuning, "EMPTY_ACK_DELAY", 60.0)  # on a machine that may be busy
    async with serving(scene) as gateway, device(gateway) as me:
        me.say(CON, 5, CoapCode.GET, "/camera/image/compressed")
        await until(lambda: scene.robot.wanted.get("/camera/image/compressed"))
        await asyncio.sleep(2 * TransportTuning.EMPTY_ACK_DELAY)
        scene.station.bus.publish(
            "/camera/image/compressed", CompressedImage(format="jpeg", data=b"\xff" * 3000)
        )
        answer = await me.hear()
        assert (answer.mtype, answer.mid, answer.code) == (ACK, 5, CoapCode.CONTENT)


async def test_an_observer_is_told_the_newest_in_order(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        watching = me.request("GET", "/odom?rate=50", observe=0)
        stamps = [json.loads((await watching.response).payload)["header"]["stamp"]]
        told = aiter(watching.observation)
        for _ in range(5):
            scene.run(0.1)
            stamps.append(json.loads((await anext(told)).payload)["header"]["stamp"])
        seconds = [each["secs"] + each["nsecs"] / 1e9 for each in stamps]
        assert seconds == sorted(set(seconds))
        again = await me.request("GET", "/odom", observe=1).response
        assert again.opt.observe is None


async def test_what_was_not_said_yet_is_observed_from_nothing_on(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(observers, "FIRST_TIMEOUT", 0.0)
    async with serving(scene) as gateway, client(gateway) as me:
        for path in ("/tag", "/detections"):
            assert (await me.request("GET", path, observe=0).response).payload == b"null"


def confirming(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every notification wants to be acknowledged, within a moment."""
    monkeypatch.setattr(observation, "CONFIRM_PERIOD", 0.0)
    monkeypatch.setattr(datagrams.Tuning, "ACK_TIMEOUT", 0.02)
    monkeypatch.setattr(datagrams.Tuning, "MAX_RETRANSMIT", 1)


async def observed(scene: Scene, gateway: CoapGateway, me: Device) -> Any:
    """The first notification, which wants to be acknowledged."""
    me.say(NON, 1, CoapCode.GET, "/odom", observe=0, uri_query=("rate=50",))
    assert (await me.hear()).opt.observe == 0
    scene.run(0.1)
    told = await me.hear()
    assert told.mtype == CON
    assert len(gateway._site.observers) == 1
    return told


async def test_an_observer_who_acknowledges_nothing_is_sent_one_message_and_forgotten(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(scene) as gateway, device(gateway) as me:
        await observed(scene, gateway, me)
        for _ in range(50):
            scene.run(0.1)
            await asyncio.sleep(0)
        assert me.heard() == 0, "nothing more goes to what may be somebody else's address"
    confirming(monkeypatch)
    async with serving(scene) as gateway, device(gateway) as me:
        await observed(scene, gateway, me)
        await until(lambda: len(gateway._site.observers) == 0)
        assert not gateway._server.socket._unanswered
        assert me.heard() <= 1


async def test_an_observer_who_answers_by_a_reset_is_forgotten(scene: Scene) -> None:
    async with serving(scene) as gateway, device(gateway) as me:
        told = await observed(scene, gateway, me)
        me.say(RST, told.mid, CoapCode.EMPTY)
        await until(lambda: len(gateway._site.observers) == 0)


async def test_an_observer_who_acknowledges_is_told_on(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(observation, "CONFIRM_PERIOD", 0.0)
    async with serving(scene) as gateway, device(gateway) as me:
        told = await observed(scene, gateway, me)
        for _ in range(3):
            me.say(ACK, told.mid, CoapCode.EMPTY)
            scene.run(0.1)
            told = await me.hear()
            assert told.mtype == CON


async def test_beyond_so_many_observers_one_is_answered_once(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(observers, "MAX_OBSERVERS_OF_HOST", 1)
    async with serving(scene) as gateway, client(gateway) as me, client(gateway) as other:
        first = await me.request("GET", "/odom", observe=0).response
        assert first.opt.observe == 0
        second = await other.request("GET", "/odom", observe=0).response
        assert second.opt.observe is None
        assert second.code == CoapCode.CONTENT


async def test_brought_down_it_tells_observers_and_leaves_no_task_and_no_port(scene: Scene) -> None:
    context = await Context.create_client_context()
    before = asyncio.all_tasks()
    async with serving(scene) as gateway, device(gateway) as watcher:
        watcher.say(NON, 1, CoapCode.GET, "/odom", observe=0)
        assert (await watcher.hear()).opt.observe == 0
        await driving(scene, Client(context, gateway.endpoints()["coap"]))
        await gateway.stop()
        assert scene.robot.at_rest
        assert (await watcher.hear()).code == CoapCode.SERVICE_UNAVAILABLE
        assert asyncio.all_tasks() == before
        assert not scene.door._operators
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as again:
            again.bind(("127.0.0.1", gateway._port))
    await context.shutdown()


async def test_where_it_cannot_listen_is_said_in_one_sentence(scene: Scene) -> None:
    async with serving(scene) as gateway:
        taken = CoapGateway(gateway._robot, replace(gateway._url, port=gateway._port))
        with pytest.raises(BridgeError, match="is taken by another program"):
            await taken.start()
        await taken.stop()
    for host, why in (("0.0.0.0", "at one address of this machine"), ("[::]", "at one address")):
        everywhere = CoapGateway(gateway._robot, read_url(f"coap://{host}:5683", {"coap": 5683}))
        with pytest.raises(BridgeError, match=why):
            await everywhere.start()
        await everywhere.stop()
