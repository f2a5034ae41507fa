"""The plain WebSocket with a real client: STOP first, then who may do what, what is wrong, and clients that are gone."""

from __future__ import annotations

import asyncio
import json
import socket
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import ArmOrder, Event
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.server.flow import send_window
from bridge.server.reception.places import Limits
from robotside.core.config import TrustSettings
from robotside.door.station_door import StationDoor
from robotside.gateways.websocket import gateway as websocket_gateway
from robotside.gateways.websocket.gateway import WebSocketGateway
from robotside.trust.people import TOKEN
from robotside.trust.people_file import PeopleFile
from robotside.trust.trust import Trust
from tests.bridge.wires import until
from tests.certificates import client_context, tls
from tests.fakes import FakeRobot
from tests.looped import looped
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.gateways.websocket.client import Client, client, serving
from tests.robotside.scene import Scene

AHEAD = {"linear": {"x": 0.2}}
DRIVE = {"publish": "/cmd_vel", "message": AHEAD}
TIME = {"call": "/rosapi/get_time", "id": "time"}


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    robot = EquippedRobot()
    robot.info = msgspec.structs.replace(robot.info, cameras=["front"])
    made = Scene(robot, tmp_path)
    made.run(1.0)
    return made


def codes(scene: Scene) -> list[str]:
    return [msg.code for _, msg in scene.said if isinstance(msg, Event)]


async def driving(scene: Scene, me: Client) -> None:
    """The client drives the robot."""
    await me.say({"publish": "/cmd_vel"})  # a hand that was at rest
    await me.say(DRIVE)
    await until(lambda: not scene.robot.at_rest)


STOPS = (
    b'{"call": "/stop"}',
    b'{"call": "stop", "id": 1, "request": {"client_name": "Fred"}}',
    b"stop",
    b" STOP\n",
    b'{"call": "/stop", "surprise": 1, "token": "wrong"}',
    b'{"call": "/stop", "request": {"stamp": NaN}}',
    b'{"call": "/stop", "request": {"stamp": 1e999}',
    b'{"call": "/stop", "request": [], "publish": "/cmd_vel"}',
    b'{"publish":"/stop"}',
    b'{"call": "/stop", "request": "' + b"x" * 70000,
    b'{"c\\u0061ll": "/stop"}',
    b'{"call": "/stop"} \xff',
)


@looped("raw", STOPS)
def test_anybody_stops_the_robot_whatever_the_message_says(raw: bytes, tmp_path: Path) -> None:
    asyncio.run(_stops(raw, tmp_path))


async def _stops(raw: bytes, folder: Path) -> None:
    scene = Scene(FakeRobot(), folder)
    scene.drive(Twist.planar(0.3, 0.0))
    async with serving(scene, "role=none") as gateway, client(gateway) as me:
        assert (await me.ask(raw))["success"]
        assert scene.station.controls.stopped
        assert scene.robot.at_rest
        scene.release_stop()


async def test_who_shows_a_wrong_token_is_told_so_and_stops_the_robot(scene: Scene, tmp_path: Path) -> None:
    trust = Trust(PeopleFile(tmp_path), scene.station.clock, TrustSettings())
    door = StationDoor(scene.station, trust)
    try:
        async with serving(scene, "", door) as gateway:
            url = gateway.endpoints()["websocket"]
            head = {"Authorization": "Bearer abc.wrong"}
            async with connect(url, proxy=None, additional_headers=head, close_timeout=0.1) as ws:
                me = Client(ws)
                refused = await me.hear("refused")
                assert (refused["refused"], refused["code"]) == ("token", Code.TRUST_KEY)
                assert "role that you have here: none" in (await me.hear("guide"))["guide"]
                answer = await me.ask({"call": "/control/acquire"})
                assert answer["code"] == Code.TRUST_UNKNOWN
                assert (await me.ask({"call": "/stop"}))["success"]
        assert scene.station.controls.stopped
    finally:
        door.close()
        trust.close()


async def test_stop_comes_through_while_others_flood_the_robot(scene: Scene) -> None:
    async with (
        serving(scene) as gateway,
        client(gateway) as me,
        client(gateway) as noise,
        client(gateway) as nonsense,
    ):
        stopped = asyncio.Event()

        async def flood(who: Client, said: object) -> None:
            while not stopped.is_set():
                await who.say(said)
                await asyncio.sleep(0)

        flooding = [asyncio.create_task(flood(noise, DRIVE)), asyncio.create_task(flood(nonsense, "{"))]
        await until(lambda: not scene.robot.at_rest)
        assert (await me.ask({"call": "/stop"}))["success"]
        stopped.set()
        await asyncio.gather(*flooding, return_exceptions=True)
    assert scene.station.controls.stopped
    assert scene.robot.at_rest


async def test_stop_is_answered_where_all_places_are_taken_and_nothing_else(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(websocket_gateway, "LIMITS", Limits(1, 1, 1, 1))
    async with serving(scene) as gateway, client(gateway) as busy:
        assert (await busy.ask({"call": "/control/acquire"}))["success"]
        async with client(gateway) as late:
            for said in (
                {"call": "/control/acquire"},
                DRIVE,
                {"subscribe": "/odom"},
                {"run": "/task/run", "id": 1},
            ):
                assert "only STOP is answered" in (await late.ask(said))["message"]
            assert "time" in await late.ask(TIME)
            assert (await late.ask({"call": "/stop"}))["success"]
    assert scene.station.controls.stopped


async def test_a_driver_who_goes_leaves_the_robot_at_rest(scene: Scene) -> None:
    async with serving(scene) as gateway:
        for goodbye in (True, False):
            async with client(gateway) as me:
                await driving(scene, me)
                if not goodbye:
                    me.ws.transport.abort()
            await until(lambda: scene.robot.at_rest)
            assert not scene.control.driver
            scene.run(1.0)


async def test_a_driver_who_falls_silent_leaves_the_robot_at_rest_after_a_quarter_of_a_second(
    scene: Scene,
) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await driving(scene, me)
        scene.run(0.2)
        assert not scene.robot.at_rest
        scene.run(0.1)
        assert scene.robot.at_rest


async def test_a_driver_whose_link_is_half_open_is_cut_off(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(send_window, "DEAD_TIMEOUT", 0.1)
    monkeypatch.setattr(send_window, "IDLE_PING_PERIOD", 0.05)
    monkeypatch.setattr(websocket_gateway, "PING_PERIOD", 0.01)
    async with serving(scene) as gateway:
        ws = await connect(gateway.endpoints()["websocket"], proxy=None, ping_interval=None)
        await ws.send(json.dumps(DRIVE))
        await until(lambda: not scene.robot.at_rest)
        ws.transport.pause_reading()  # it answers no ping any more
        await until(lambda: not gateway._sessions)
        assert scene.robot.at_rest
        assert not scene.control.driver
        ws.transport.abort()


async def test_a_drive_command_with_a_stamp_counts_when_it_is_fresh_by_a_clock_that_was_compared(
    scene: Scene,
) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        assert (await me.ask(DRIVE | {"stamp": scene.clock}))["code"] == Code.DRIVE_CLOCK_UNKNOWN
        await me.ask(TIME)
        assert scene.robot.at_rest, "its clock was not compared"
        await me.say({"publish": "/cmd_vel"})
        await me.say(DRIVE | {"stamp": scene.clock})
        await until(lambda: not scene.robot.at_rest)
        scene.run(1.0)
        assert scene.robot.at_rest
        assert (await me.ask(DRIVE | {"stamp": scene.clock - 0.3}))["code"] == Code.DRIVE_LATE
        assert (await me.ask(DRIVE | {"stamp": scene.clock + 60}))["code"] == Code.DRIVE_CLOCK_AHEAD
        await me.ask({"call": "/stop"})
        refused = await me.ask(DRIVE | {"stamp": scene.clock})
        assert (refused["success"], refused["code"]) == (False, Code.STOP_IS_PRESSED)
        assert scene.robot.at_rest


async def test_without_a_stamp_the_answered_pings_say_how_old_a_command_may_be(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        (session,) = gateway._sessions.values()
        session.on_pong = lambda _: None  # its link stands still
        session.operator.answered = scene.clock - 0.8
        assert (await me.ask(DRIVE))["code"] == Code.DRIVE_UNSTAMPED
        assert scene.robot.at_rest
        session._round_trip.answered = scene.clock - 6
        session.measure_round_trip()
        assert (await me.ask({"call": "/control/acquire"}))["code"] == Code.GATEWAY_UNDATED
        old = await me.ask({"call": "/control/acquire", "stamp": scene.clock - 60})
        assert old["code"] == Code.COMMAND_LATE
        assert (await me.ask({"call": "/control/acquire", "stamp": scene.clock}))["success"]


async def test_a_command_that_is_sent_twice_is_done_once(scene: Scene) -> None:
    place = {
        "call": "/places/set",
        "request": {"client_id": "x", "command_id": "c1", "place": {"name": "Office", "x": 1.0, "y": 1.0}},
    }
    async with serving(scene) as gateway:
        answers = []
        for _ in range(2):
            async with client(gateway) as me:
                answers.append(await me.ask(place))
    assert answers[0]["success"]
    assert answers[1] == answers[0]
    assert [place.name for place in scene.station.records.places.all()] == ["Office"]


WRONG: tuple[tuple[object, str], ...] = (
    ({"publish": "/cmd_vel", "message": {"linear": {"x": "0.2"}}}, "linear.x must be a number or null"),
    ({"publish": "/cmd_vel", "message": {"linear": {"z_": 1}}}, "has no field"),
    ({"publish": "/cmd_vel", "mesage": {}}, "mesage"),
    ('{"publish": "/cmd_vel", "message": {"linear": {"x": NaN}}}', "not JSON"),
    ('{"publish": "/cmd_vel", "message": {"linear": {"x": 1e999}}}', "not JSON"),
    ('{"publish": "/cmd_vel"', "not JSON"),
    (b"\xff\xfe", "not JSON"),
    ("[1]", "must be an object"),
    ("", "has none of them"),
    ({"id": 1}, "has none of them"),
    ({"publish": "/cmd_vel", "call": "/mode/set"}, "call and publish at once"),
    ({"publish": "/odom"}, "does not listen to"),
    ({"publish": "/nothing"}, "does not carry /nothing"),
    ({"publish": 1}, "Expected `str`"),
    ({"subscribe": "/nothing"}, "does not carry /nothing"),
    ({"subscribe": "/cmd_vel"}, "says nothing there"),
    ({"subscribe": "/odom", "rate": 0}, "above 0 and at most 50 Hz, not 0"),
    ({"subscribe": "/odom", "rate": 1000}, "not 1000"),
    ({"subscribe": "/odom", "rate": "5"}, "Expected `float | null`, got `str`"),
    ({"call": "/mode/set", "request": {"mode": True}}, "mode must be a text"),
    ({"call": "/people/list"}, "does not carry /people/list"),
    ({"call": "/nothing"}, "does not carry /nothing"),
    ({"call": "/mode/set", "id": "x" * 65}, "at most 64 characters"),
    ({"call": "/places/set", "request": {"place": {"name": "x" * 70000}}}, "at most 65536 bytes"),
    ({"run": "/task/run"}, "missing required field `id`"),
    ({"run": "/nothing", "id": 1}, "does not carry /nothing"),
    ({"run": "/task/run", "id": 1, "goal": {"order": {"task": 1}}}, "order.task must be a text"),
    ({"cancel": 7}, "No action with the id 7"),
    ({"token": "abc"}, "knows no keys"),
)


async def test_what_is_wrong_with_a_message_is_answered_and_nothing_is_done(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        for said, why in WRONG:
            answer = await me.ask(said)
            assert answer["success"] is False, said
            assert why in answer["message"], (said, answer)
            assert "code" in answer
    assert scene.robot.at_rest


async def test_a_message_that_is_far_too_long_ends_its_connection(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        with pytest.raises(ConnectionClosed):
            await me.ask(b" " * 300_000)


async def test_who_has_no_token_has_the_role_of_the_gateway_and_a_token_gives_more(
    scene: Scene, tmp_path: Path
) -> None:
    trust = Trust(PeopleFile(tmp_path), scene.station.clock, TrustSettings())
    person, token = await trust.add("Anna", Role.DRIVE, TOKEN)
    door = StationDoor(scene.station, trust)
    trust.on_lost = door.expel
    try:
        async with serving(scene, "role=watch", door) as gateway, client(gateway) as me:
            assert (await me.ask({"call": "/control/acquire"}))["code"] == Code.TRUST_ROLE
            await me.say(DRIVE)
            assert (await me.hear("refused"))["code"] == Code.TRUST_ROLE
            await me.say({"token": token[:-1] + "~"})
            assert (await me.hear("refused"))["code"] == Code.TRUST_KEY
            assert "role drive" in (await me.ask({"token": token}))["message"]
            assert (await me.ask({"call": "/control/acquire"}))["success"]
            assert scene.control.driver == "Anna"
            await driving(scene, me)
            await trust.remove(person.id)
            with pytest.raises(ConnectionClosed):
                await me.hear("nothing")
            assert scene.robot.at_rest
        assert Code.GATEWAY_OPEN not in codes(scene)
    finally:
        door.close()
        trust.close()


async def test_who_has_no_role_is_sent_and_told_nothing(scene: Scene) -> None:
    async with serving(scene, "role=none") as gateway, client(gateway) as me:
        for said in ({"subscribe": "/odom"}, {"subscribe": "/camera"}, {"call": "/events/get"}, DRIVE):
            assert (await me.ask(said))["code"] == Code.TRUST_UNKNOWN


async def test_a_gateway_that_lets_everybody_drive_says_so(scene: Scene) -> None:
    async with serving(scene, "role=watch"):
        assert Code.GATEWAY_OPEN not in codes(scene)
    async with serving(scene, "role=drive"):
        assert Code.GATEWAY_OPEN in codes(scene)


async def test_a_page_of_another_origin_is_refused(scene: Scene) -> None:
    async with serving(scene) as gateway:
        with pytest.raises(InvalidStatus) as refused:
            async with client(gateway, origin="http://evil.example"):
                pass
    assert refused.value.response.status_code == 403


async def test_it_speaks_tls_on_the_same_port(scene: Scene, tmp_path: Path) -> None:
    async with serving(scene, "role=drive", tls=tls(tmp_path), plain_from=lambda _: False) as gateway:
        url = gateway.endpoints()["websocket"].replace("ws:", "wss:")
        async with connect(url, ssl=client_context(), proxy=None, close_timeout=0.1) as ws:
            assert (await Client(ws).ask({"call": "/stop"}))["success"]
        with pytest.raises(InvalidStatus) as refused:
            async with client(gateway):
                pass
    assert refused.value.response.status_code == 426


async def test_topics_come_as_often_as_asked_and_the_newest_state_at_once(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await me.say({"subscribe": "/control/status"})
        assert (await me.hear("topic"))["message"]["mode"] == "MANUAL"
        await me.say({"subscribe": "/odom", "rate": 0.01})
        await me.ask(TIME)
        scene.run(2.0)
        assert (await me.hear("topic"))["topic"] == "/odom"
        await me.say({"subscribe": "/odom", "rate": 50})
        await me.ask(TIME)
        scene.run(0.1)
        assert "pose" in (await me.hear("topic"))["message"]
        await me.say({"unsubscribe": "/odom"})
        await me.ask(TIME)
        scene.run(1.0)
        scene.ask("/stop")
        assert (await me.hear("topic"))["topic"] == "/control/status"


async def test_a_payload_that_was_not_chosen_is_not_carried(scene: Scene) -> None:
    async with serving(scene, "role=drive&payloads=wheels") as gateway, client(gateway) as me:
        for said in ({"call": "/task/start"}, {"subscribe": "/camera"}, {"subscribe": "/places"}):
            assert "does not carry" in (await me.ask(said))["message"]


def picture(stamp: int, size: int = 1000) -> CompressedImage:
    made = CompressedImage(format="jpeg", data=bytes([stamp]) * size)
    stamped = msgspec.structs.replace(made.header, stamp=type(made.header.stamp)(stamp, 0))
    return msgspec.structs.replace(made, header=stamped)


async def test_a_camera_comes_as_its_bytes_behind_what_they_are(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        assert (await me.ask({"subscribe": "/camera/front", "rate": 50, "id": 1}))["success"]
        assert scene.robot.wanted["/camera/image/compressed"]
        scene.station.bus.publish("/camera/image/compressed", picture(7))
        head = await me.hear("size")
        assert head == {"topic": "/camera/image/compressed", "stamp": 7.0, "format": "jpeg", "size": 1000}
        assert await me.hear() == bytes([7]) * 1000
        await me.ask({"unsubscribe": "/camera/front", "id": 2})
        assert not scene.robot.wanted["/camera/image/compressed"]


async def test_a_slow_reader_of_a_camera_gets_the_newest_picture_and_keeps_little_waiting(
    scene: Scene,
) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await me.ask({"subscribe": "/camera", "rate": 50, "id": 1})
        (session,) = gateway._sessions.values()
        session.queue.window.limit = 4096  # a link that takes little
        me.ws.transport.pause_reading()
        for stamp in range(100):
            scene.station.bus.publish("/camera/image/compressed", picture(stamp, 50_000))
            await asyncio.sleep(0)
        me.ws.transport.resume_reading()
        stamps = [(await me.hear("size"))["stamp"]]
        while stamps[-1] < 99:
            stamps.append((await me.hear("size"))["stamp"])
    assert len(stamps) < 10
    assert stamps == sorted(stamps)


async def test_a_bare_word_moves_the_arm_to_the_pose_of_that_name(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        assert (await me.ask("home"))["success"]
        assert [order.pose for _, order in scene.robot.orders if isinstance(order, ArmOrder)] == ["home"]
        assert "not JSON" in (await me.ask("home!"))["message"]


async def test_a_bare_word_to_a_robot_without_an_arm_is_refused(tmp_path: Path) -> None:
    async with serving(Scene(FakeRobot(), tmp_path)) as gateway, client(gateway) as me:
        assert "has no arm" in (await me.ask("home"))["message"]


RUN = {"run": "/task/run", "id": "t", "goal": {"order": {"task": "hold"}}}


async def running(scene: Scene, me: Client) -> None:
    """The client runs a task of a robot that knows where it is."""
    here = {"header": {"frame_id": "map"}, "pose": {"pose": {"orientation": {"w": 1.0}}}}
    assert (await me.ask({"publish": "/initialpose", "message": here, "id": 1}))["success"]
    scene.run(3.0)
    await me.say(RUN)
    await until(lambda: scene.task.state == "RUNNING")


async def test_an_action_tells_of_its_way_and_ends_when_it_is_cancelled(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        await running(scene, me)
        again = await me.ask(RUN)
        assert "is under way" in again["message"]
        scene.run(2.0)
        assert (await me.hear("feedback"))["id"] == "t"
        await me.say({"cancel": "t"})
        result = await me.hear("result")
        assert (result["id"], result["success"]) == ("t", False)
        assert "cancelled" in result["response"]["message"]
        await until(lambda: scene.task.state == "CANCELED")


async def test_who_leaves_ends_what_it_runs(scene: Scene) -> None:
    async with serving(scene) as gateway:
        async with client(gateway) as me:
            await running(scene, me)
        await until(lambda: scene.task.state == "CANCELED")


async def test_a_client_runs_a_bounded_number_of_actions(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.gateways.websocket.goals.MAX_GOALS", 1)
    async with serving(scene) as gateway, client(gateway) as me:
        await running(scene, me)
        assert "1 actions of this client are under way" in (await me.ask(RUN | {"id": 2}))["message"]


async def test_brought_down_it_leaves_no_task_and_no_port(scene: Scene) -> None:
    before = asyncio.all_tasks()
    async with serving(scene) as gateway:
        port = gateway._listener.port
        async with client(gateway) as me:
            await me.say({"subscribe": "/odom"})
            await running(scene, me)
            await gateway.stop()
            assert scene.robot.at_rest
    assert asyncio.all_tasks() == before
    assert not scene.door._operators
    with socket.socket() as again:
        again.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        again.bind(("127.0.0.1", port))


async def test_a_port_that_is_taken_is_said_in_one_sentence(scene: Scene) -> None:
    async with serving(scene) as gateway:
        at = replace(gateway._url, port=gateway._listener.port)
        second = WebSocketGateway(gateway._robot, at)
        with pytest.raises(BridgeError, match="is taken by another program"):
            await second.start()
        await second.stop()
