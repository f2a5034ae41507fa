"""The robot side behind real sockets on loopback, and its command line."""

from __future__ import annotations

import asyncio
import errno
import random
import socket
import sys
import time
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager
from pathlib import Path
from types import ModuleType
from typing import ClassVar

import msgspec
import pytest

from bridge.client.client import BridgeClient, Phase
from bridge.core.errors import BridgeError
from bridge.core.toml_files import FileFault
from bridge.discovery.domain import VARIABLE
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    ControlStatus,
    Event,
    GatewayArray,
    RobotInfo,
)
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.__main__ import main
from robotside.bringing_up.announcement import news
from robotside.core.clock import RobotClock
from robotside.gateway_options import ALWAYS
from robotside.gateways.discovery import adapters, read_wish
from robotside.serving.station_server import Addresses, StationServer
from robotside.station.station import Station
from tests.fakes import FakeRobot
from tests.robotside.scene import records_at
from tests.robotside.visitor import visitor


@asynccontextmanager
async def serving(state: Path, robot: FakeRobot) -> AsyncIterator[StationServer]:
    clock = RobotClock(time.time())
    began = time.time() - time.monotonic()

    def wall() -> float:
        return began + time.monotonic()

    station = Station(robot, records_at(state), now=clock.now, clock=wall, rng=random.Random(1), name="Rex")
    serves = StationServer(station, clock, wall, Addresses("127.0.0.1", 0, 0))
    ready = asyncio.Event()
    running = asyncio.create_task(serves.run(lambda _: ready.set()))
    async with asyncio.timeout(60):
        await ready.wait()
        try:
            yield serves
        finally:
            serves.end()
            await running


async def test_a_client_is_told_who_the_robot_is_and_drives_it(tmp_path: Path) -> None:
    robot = FakeRobot()
    async with serving(tmp_path, robot) as serves:
        client = BridgeClient(serves.addresses.bridge)
        told, steered = asyncio.get_running_loop().create_future(), asyncio.Event()
        client.subscribe("/robot/info", RobotInfo, lambda msg, _: told.done() or told.set_result(msg))

        def steer(msg: ControlStatus, _: float) -> None:
            if msg.driver:
                steered.set()

        client.subscribe("/control/status", ControlStatus, steer)
        running = asyncio.create_task(client.run())
        assert (await told).name == "Rex"
        client.publish("/cmd_vel", Twist.planar(0.3, 0.1))
        await steered.wait()
        assert Twist.planar(0.3, 0.1) in robot.commands
        await client.close()
        await running
    assert robot.at_rest


@pytest.mark.parametrize("domain", ["", "team_2"])
async def test_its_hello_names_the_discovery_domain_of_its_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, domain: str
) -> None:
    monkeypatch.setenv(VARIABLE, domain)
    async with serving(tmp_path, FakeRobot()) as serves:
        assert serves.hello().domain == domain


async def test_one_that_is_no_longer_wanted_ends_by_itself(tmp_path: Path) -> None:
    clock, robot = RobotClock(time.time()), FakeRobot()
    station = Station(
        robot, records_at(tmp_path), now=clock.now, clock=time.time, rng=random.Random(1), name="Rex"
    )
    answers = iter([True, False])
    serves = StationServer(
        station, clock, time.time, Addresses("127.0.0.1", 0, 0), wanted=lambda: next(answers, False)
    )
    async with asyncio.timeout(60):
        await serves.run(lambda _: None)
    assert next(answers, None) is None
    assert robot.at_rest


async def test_a_system_that_takes_no_more_connections_is_logged_once(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    loop = asyncio.get_running_loop()
    shortage = {"message": "accept", "exception": OSError(errno.EMFILE, "Too many open files")}
    async with serving(tmp_path, FakeRobot()):
        for _ in range(100):
            loop.call_exception_handler({**shortage, "socket": None})
        loop.call_exception_handler({"message": "Something else."})
    said = [record.getMessage() for record in caplog.records if record.levelname == "ERROR"]
    assert said == [
        "No further connection can be taken at the moment: Too many open files.",
        "Something else.",
    ]
    assert loop.get_exception_handler() is None


@asynccontextmanager
async def connected(serves: StationServer) -> AsyncIterator[BridgeClient]:
    there = asyncio.Event()
    client = BridgeClient(
        serves.addresses.bridge,
        on_state=lambda state: there.set() if state.phase is Phase.CONNECTED else None,
    )
    running = asyncio.create_task(client.run())
    await there.wait()
    yield client
    await client.close()
    await running


async def test_a_cut_connection_stops_the_robot(tmp_path: Path) -> None:
    robot = FakeRobot()
    async with serving(tmp_path, robot) as serves:
        taken, free = asyncio.Event(), asyncio.Event()

        def watch(_: str, msg: Msg) -> None:
            assert isinstance(msg, ControlStatus)
            (taken if msg.driver else free).set()

        async with connected(serves) as client:
            serves.station.bus.subscribe("/control/status", watch)
            free.clear()
            client.publish("/cmd_vel", Twist.planar(0.3, 0.0))
            await taken.wait()
            assert not robot.at_rest
        await free.wait()
        assert robot.commands[-1] is None


async def test_a_refusal_reaches_the_client_as_an_answer(tmp_path: Path) -> None:
    async with serving(tmp_path, FakeRobot()) as serves, connected(serves) as client:
        answer = await client.call("/task/pause", CommandRequest(), CommandResponse)
        assert (answer.success, answer.message) == (False, "No task is running.")


async def test_a_browser_gets_a_page_its_health_and_a_sentence_for_a_camera_that_is_not_there(
    tmp_path: Path,
) -> None:
    async with (
        serving(tmp_path, FakeRobot()) as serves,
        visitor(serves.addresses.http) as web,
    ):
        page = await web.get("/")
        assert "Rex" in page.text
        assert serves.addresses.bridge in page.text
        assert "/cmd_vel" in page.text
        assert (await web.get("/healthz")).json()["ok"] is True
        missing = await web.get("/snapshot/front.jpg")
        assert (missing.status_code, missing.text) == (
            404,
            "This robot has no such camera; there is: none.\n",
        )


class Photographer(FakeRobot):
    """Makes a picture the moment that it is wanted."""

    def __init__(self) -> None:
        super().__init__()
        self.info = msgspec.structs.replace(self.info, cameras=["front"])
        self.show: Callable[[str, Msg], None] = lambda topic, msg: None

    def want(self, topic: str, wanted: bool) -> None:
        super().want(topic, wanted)
        if wanted:
            self.show(topic, CompressedImage(data=b"a picture"))


async def test_a_picture_is_made_for_whoever_asks_and_only_then(tmp_path: Path) -> None:
    robot = Photographer()
    async with serving(tmp_path, robot) as serves, visitor(serves.addresses.http) as web:
        robot.show = serves.station.bus.publish
        answer = await web.get("/snapshot/front.jpg")
        assert (answer.content, answer.headers["content-type"]) == (b"a picture", "image/jpeg")
        assert robot.wanted == {"/camera/image/compressed": False}


async def test_each_camera_shows_its_own_pictures(tmp_path: Path) -> None:
    robot = Photographer()
    robot.info = msgspec.structs.replace(robot.info, cameras=["front", "rear"])
    async with serving(tmp_path, robot) as serves, visitor(serves.addresses.http) as web:
        sent: list[str] = []
        serves.server.publish_frame = lambda camera, _: sent.append(camera)  # type: ignore[method-assign]
        robot.show = lambda topic, _: serves.station.bus.publish(topic, CompressedImage(data=topic.encode()))
        shown = [(await web.get(f"/snapshot/{name}.jpg")).content for name in robot.info.cameras]
        assert shown == [b"/camera/image/compressed", b"/camera/rear/image/compressed"]
        assert sent == ["front", "rear"]


async def test_a_port_that_is_taken_is_said_and_nothing_is_left_open(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        station = Station(FakeRobot(), records_at(tmp_path), now=0.0, clock=lambda: 0.0, rng=random.Random(1))
        serves = StationServer(station, RobotClock(0.0), lambda: 0.0, Addresses("127.0.0.1", port, 0))
        with pytest.raises(BridgeError, match=f"Port {port} on 127.0.0.1 is taken"):
            await serves.run(lambda _: None)
        web = StationServer(station, RobotClock(0.0), lambda: 0.0, Addresses("127.0.0.1", 0, port))
        with pytest.raises(BridgeError, match=f"Cannot serve HTTP on 127.0.0.1:{port}.*--http-port names"):
            await web.run(lambda _: None)


async def test_a_gateway_that_cannot_come_up_is_told_of_and_the_robot_runs_without_it(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        gone, stays = read_wish(f"websocket=ws://127.0.0.1:{port}"), read_wish("mqtt=own://127.0.0.1:0")
        station = Station(FakeRobot(), records_at(tmp_path), now=0.0, clock=lambda: 0.0, rng=random.Random(1))
        events: list[Msg] = []
        station.bus.subscribe("/events", lambda _, event: events.append(event), replay=False)
        boards: list[Msg] = []
        where = Addresses("127.0.0.1", 0, 0)
        serves = StationServer(
            station, RobotClock(0.0), lambda: 0.0, where, gateways=[gone, stays], required=["mqtt"]
        )
        async with asyncio.timeout(60), serves.listening():
            assert serves.gateways.running == ("mqtt",)
            serves.door.subscribe("asker", "/gateways", lambda _, board: boards.append(board))
            serves.door.leave("asker")
            (told,) = (
                each for each in events if isinstance(each, Event) and each.code == "gateway_port_taken"
            )
            assert told.text.startswith("The gateway websocket is not up: ")
            assert str(port) in told.text
            assert news("Rex", told) == f"robotside: Rex: {told.text}"
            assert isinstance(boards[-1], GatewayArray)
            (entry,) = (each for each in boards[-1].gateways if each.name == "websocket")
            assert entry.state == "down"
            assert str(port) in entry.fault


def test_a_gateway_that_the_command_asks_for_and_that_cannot_come_up_ends_it_with_a_sentence_that_names_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("robotside.__main__._robots", lambda *_: ([FakeRobot()], "hall"))
    with socket.create_server(("127.0.0.1", 0)) as other:
        wish = f"websocket=ws://127.0.0.1:{other.getsockname()[1]}"
        words = ["serve", "--state", str(tmp_path), "--port", "0", "--http-port", "0", "--gateway", wish]
        assert main(words) == 2
    assert "robotside: The gateway websocket is not up: " in capsys.readouterr().err


def test_a_state_directory_that_cannot_be_made_is_one_sentence_and_lets_go_of_the_robot(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    robot, state = FakeRobot(), tmp_path / "file" / "state"
    state.parent.write_text("no directory")
    monkeypatch.setattr("robotside.__main__._robots", lambda *_: ([robot], "hall"))
    assert main(["serve", "--state", str(state)]) == 2
    said = f"Nothing can be stored in '{state}': not a directory; --state names another directory."
    assert capsys.readouterr().err == f"robotside: {said}\n"
    assert robot.closed


class Glance:
    """Serves for no time at all, and keeps the stations that it was to serve."""

    stations: ClassVar[list[Station]] = []

    def __init__(self, servings: Sequence[StationServer], *_: object, **__: object) -> None:
        self.servings = servings
        self.stations += [each.station for each in servings]

    def end(self) -> None:
        """Never called."""

    async def run(self, ready: Callable[[StationServer], None]) -> None:
        for each in self.servings:
            ready(each)


@pytest.mark.parametrize(("more", "name"), [([], "Slow-1"), (["--name", "Rex"], "Rex")])
def test_a_settings_file_says_what_the_robot_is_called_and_may_do(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    more: list[str],
    name: str,
) -> None:
    monkeypatch.setattr("robotside.__main__._robots", lambda *_: ([FakeRobot()], "hall"))
    monkeypatch.setattr("robotside.__main__.FleetServer", Glance)
    settings = tmp_path / "robot.toml"
    settings.write_text("[robot]\nname = 'Slow-1'\n[limits]\nmax_speed = 0.2\n")
    assert main(["serve", "--state", str(tmp_path), "--config", str(settings), *more]) == 0
    station = Glance.stations.pop()
    assert (station.info.name, station.info.max_speed) == (name, 0.2)
    assert f"robot={name}" in capsys.readouterr().out


def test_a_mistake_in_the_settings_file_is_one_sentence_and_no_robot_is_made(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setattr("robotside.__main__._robots", lambda *_: pytest.fail("a robot was made"))
    settings = tmp_path / "robot.toml"
    settings.write_text("[limits]\nmax_sped = 1")
    assert main(["serve", "--config", str(settings)]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"robotside: {settings}: limits has no 'max_sped'; there are max_speed,")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("serve --port 99999", "A port is 0 to 65535, not 99999."),
        ("serve --speed 0", "The speed must be above 0 and at most 100, not 0.0."),
        ("serve --speed nan", "The speed must be above 0 and at most 100, not nan."),
        (
            "serve --payloads catapult",
            "There is no payload 'catapult'; there is laser, sonar, ultrasound, line_sensor, camera, lights, tag_reader, arm.",
        ),
        (
            "serve --robot ros:ws://192.0.2.1:9090 --payloads arm",
            "--payloads is for simulated robots only.",
        ),
        (
            "serve --protocols pigeon",
            f"There is no protocol pigeon; there are {', '.join((*ALWAYS, *adapters()))}.",
        ),
        (
            "serve --config /nowhere/robot.toml",
            "The settings cannot be read from '/nowhere/robot.toml': no such file or directory.",
        ),
        (
            "serve --robot rover",
            "There is no robot 'rover'; write simulated ones as sim:patrol or sim:patrol,scout, others as ros:ws://192.168.1.7:9090.",
        ),
        (
            "serve --robot ros:http://here",
            "The address must be like ws://192.168.1.7:9090, not 'http://here'.",
        ),
        (
            "serve --robot ros:",
            "There is no robot 'ros:'; write simulated ones as sim:patrol or sim:patrol,scout, others as ros:ws://192.168.1.7:9090.",
        ),
        (
            "serve --robot ros:ws://here:9 --speed 2",
            "A real robot moves in real time: --speed must be 1, not 2.",
        ),
        (
            "serve --robot ros:ws://localhost:9090",
            "The robot at ws://localhost:9090 would be this program itself; --port names another port.",
        ),
        (
            "serve --robot ros:ws://192.0.2.1:9090,ws://localhost:9091",
            "The robot at ws://localhost:9091 would be this program itself; --port names another port.",
        ),
        (
            "serve --robot ros:ws://[::1:9",
            "The address must be like ws://192.168.1.7:9090, not 'ws://[::1:9' (Invalid IPv6 URL).",
        ),
        (
            "--robot sim:rover",
            "There is no simulated robot 'rover'; there is patrol, scout, commander, minnow, aqua, ardrone.",
        ),
        (
            "serve --robot sim:rover",
            "There is no simulated robot 'rover'; there is patrol, scout, commander, minnow, aqua, ardrone.",
        ),
        (
            "serve --port nine",
            "Argument --port: invalid int value: 'nine'; see python -m robotside serve --help.",
        ),
    ],
)
def test_a_mistake_on_the_command_line_is_one_sentence(
    capsys: pytest.CaptureFixture[str], arguments: str, said: str
) -> None:
    assert main(arguments.split()) == 2
    assert capsys.readouterr().err == f"robotside: {said}\n"


class _Faulty(ModuleType):
    """A module that reads a file with a fault as it is imported."""

    def __getattr__(self, name: str) -> object:
        raise FileFault("commander.toml, line 13: body.mass: must be a number above 0, not -3.")


@pytest.mark.parametrize(
    ("module", "words"), [("sim.robot", "--robot sim:patrol"), ("sim.catalogue", "offer")]
)
def test_a_fault_in_the_file_of_a_vehicle_is_one_sentence(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], module: str, words: str
) -> None:
    monkeypatch.setitem(sys.modules, module, _Faulty(module))
    assert main(words.split()) == 2
    said = "robotside: commander.toml, line 13: body.mass: must be a number above 0, not -3.\n"
    assert capsys.readouterr().err == said


@pytest.mark.parametrize(
    ("words", "told"), [("--help", "`serve` is optional"), ("serve --help", "--robot ROBOT")]
)
def test_help_is_given(capsys: pytest.CaptureFixture[str], words: str, told: str) -> None:
    with pytest.raises(SystemExit) as ended:
        main(words.split())
    assert ended.value.code == 0
    assert told in " ".join(capsys.readouterr().out.split())
