"""The board of gateways: protocols are brought up and down while the robot runs, and refused with a code and a sentence."""

from __future__ import annotations

import asyncio
import errno
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import Identity, Role
from bridge.core.robot_catalogue import Operator
from bridge.msgs.pilothouse_msgs import (
    BringDownGatewayRequest,
    BringUpGatewayRequest,
    CommandResponse,
    Gateway,
    GatewayArray,
)
from robotside.core.notice import Notice
from robotside.gateways import discovery
from robotside.gateways.adapter import Adapter, Surroundings
from robotside.gateways.gateway_url import GatewayUrl
from robotside.serving.gateway_board import FAREWELL_TIME, GatewayBoard
from robotside.serving.gateway_owner import GatewayOwner
from robotside.trust.qr import as_rows
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene

FIXED = {"rosbridge": "ws://192.0.2.7:9090", "http": "http://192.0.2.7:8080"}


class Pigeon:
    """A gateway whose path says what goes wrong with it."""

    hold: asyncio.Event | None = None

    def __init__(self, robot: Surroundings, url: GatewayUrl) -> None:
        self.robot, self.url = robot, url
        self.task: asyncio.Task[None] | None = None

    async def start(self) -> None:
        if Pigeon.hold is not None:
            await Pigeon.hold.wait()
        if self.url.path == "taken":
            raise BridgeError("Port 5 on roof is taken.") from OSError(errno.EADDRINUSE, "in use")
        if self.url.path == "absent":
            raise OSError(errno.EADDRNOTAVAIL, "Cannot assign requested address")
        if self.url.path == "broken":
            raise ImportError("no wings")
        self.task = asyncio.create_task(asyncio.sleep(3600))

    async def stop(self) -> None:
        if self.task is not None:
            self.task.cancel()
            await asyncio.gather(self.task, return_exceptions=True)

    def endpoints(self) -> Mapping[str, str]:
        return {"pigeon": f"coop://{self.url.address}"}

    def guide(self) -> str:
        return "Tie it to a leg."


PIGEON = Adapter(
    "pigeon",
    "by air",
    {"coop": 5, "coops": 6},
    "coop://roof?rate=3",
    "",
    Pigeon,
    listens=frozenset({"coop"}),
    credentials=frozenset({"coop", "coops"}),
    prefixes=frozenset({"coop", "coops"}),
)
EAGLE = replace(PIGEON, name="eagle", package="no_such_library")


class Board:
    """A station with a board, and a listener to it."""

    def __init__(self, state: Path, *, keeps: bool = False) -> None:
        self.scene = Scene(FakeRobot(), state)
        scene = self.scene
        self.owner = GatewayOwner(Surroundings(scene.door, scene.station.events.say))
        self.paused: list[float] = []
        self.go_on = asyncio.Event()
        self.kept: list[tuple[str, str | None]] = []
        self.unkept = ""
        self.board = GatewayBoard(
            scene.door, scene.station, self.owner, lambda: FIXED, self.keep if keeps else None, self.pause
        )
        self.heard: list[GatewayArray] = []
        self.end: Callable[[], None] = lambda: None

    def keep(self, name: str, url: str | None) -> str:
        self.kept.append((name, url))
        return self.unkept

    async def pause(self, seconds: float) -> None:
        self.paused.append(seconds)
        await self.go_on.wait()

    def listen(self) -> None:
        self.end = self.scene.door.subscribe(self, "/gateways", lambda _, msg: self.heard.append(msg))  # type: ignore[arg-type]

    def of(self, name: str) -> Gateway:
        return next(each for each in self.heard[-1].gateways if each.name == name)

    async def up(
        self, name: str = "pigeon", url: str = "", client: Operator | None = None
    ) -> CommandResponse:
        return await self._ask("/gateways/bring_up", BringUpGatewayRequest(name=name, url=url), client)

    async def down(
        self, name: str = "pigeon", *, own: bool = False, client: Operator | None = None
    ) -> CommandResponse:
        return await self._ask("/gateways/bring_down", BringDownGatewayRequest(name=name, own=own), client)

    async def _ask(
        self, service: str, request: BringUpGatewayRequest | BringDownGatewayRequest, client: Operator | None
    ) -> CommandResponse:
        given = self.scene.door.call(client or self.scene.anna, service, request)
        answer = given if isinstance(given, CommandResponse) else await given  # type: ignore[misc]
        assert isinstance(answer, CommandResponse)
        return answer

    def events(self) -> list[str]:
        return self.scene.events("control")


async def settled() -> None:
    """What is under way goes as far as it gets."""
    for _ in range(20):
        await asyncio.sleep(0)


@pytest.fixture
def known(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The protocols of these tests, and how often somebody looked for them."""
    looks: list[int] = []

    def adapters() -> dict[str, Adapter]:
        looks.append(1)
        return {"eagle": EAGLE, "pigeon": PIGEON}

    monkeypatch.setattr(discovery, "adapters", adapters)
    monkeypatch.setattr(Pigeon, "hold", None)
    return looks


@pytest.fixture
async def board(tmp_path: Path, known: list[int]) -> Board:
    return Board(tmp_path)


async def test_nobody_looks_for_protocols_before_somebody_asks(board: Board, known: list[int]) -> None:
    board.scene.run(1.0)
    assert not known
    assert board.scene.station.bus.last("/gateways") is None
    board.listen()
    assert known
    seen = len(known)
    board.end()
    await board.owner.bring_up(PIGEON, GatewayUrl("coop", "roof", 5))
    assert len(known) == seen
    await board.owner.close()


async def test_each_protocol_is_listed_with_what_is_needed_to_ask_for_it(board: Board) -> None:
    board.listen()
    assert [each.name for each in board.heard[-1].gateways] == ["rosbridge", "http", "eagle", "pigeon"]
    ros, pigeon = board.of("rosbridge"), board.of("pigeon")
    assert (ros.fixed, ros.state, ros.endpoint) == (True, "up", "ws://192.0.2.7:9090")
    assert (pigeon.fixed, pigeon.state, pigeon.package, pigeon.doc) == (False, "down", "", "by air")
    assert (pigeon.usual, pigeon.schemes, pigeon.listens) == (
        "coop://roof?rate=3",
        ["coop:5", "coops:6"],
        ["coop"],
    )
    assert board.of("eagle").package == "no_such_library"
    assert board.heard[-1].stamp.seconds == pytest.approx(board.scene.clock)


async def test_it_is_up_only_when_it_is_and_down_when_nothing_is_left(board: Board) -> None:
    before = asyncio.all_tasks()
    board.listen()
    answer = await board.up(url="coop://anna:secret@roof:7/x?role=drive&payloads=arm,lights&rate=2")
    assert (answer.success, answer.message) == (True, "pigeon is up at coop://roof:7.")
    assert [each.gateways[3].state for each in board.heard] == ["down", "coming_up", "up"]
    pigeon = board.of("pigeon")
    assert (pigeon.endpoint, pigeon.guide) == ("coop://roof:7", "Tie it to a leg.")
    assert pigeon.qr_rows == as_rows("coop://roof:7")
    assert pigeon.options == ["role=drive", "payloads=arm,lights", "rate=2"]
    assert (await board.down()).message == "pigeon is down."
    assert [each.gateways[3].state for each in board.heard[3:]] == ["going_down", "down"]
    assert (board.of("pigeon").endpoint, board.of("pigeon").guide, board.of("pigeon").options) == ("", "", [])
    assert asyncio.all_tasks() == before
    assert not any("secret" in repr(each) for each in board.heard)


async def test_while_it_is_coming_up_it_is_not_shown_as_up(board: Board) -> None:
    board.listen()
    Pigeon.hold = asyncio.Event()
    asked = asyncio.ensure_future(board.up())
    await settled()
    assert (board.of("pigeon").state, board.of("pigeon").endpoint) == ("coming_up", "")
    assert (await board.up()).code == "gateway_runs"
    assert (await board.down()).code == "gateway_down"
    Pigeon.hold.set()
    assert (await asked).success
    await board.owner.close()


async def test_what_cannot_be_brought_up_is_refused_with_its_code_and_a_sentence(board: Board) -> None:
    board.listen()
    before = asyncio.all_tasks()
    for name, url, code, words in (
        ("dove", "", "gateway_unknown", "no protocol 'dove'; there are rosbridge, http, eagle, pigeon"),
        ("eagle", "", "gateway_lacking", "eagle needs no_such_library, which is not installed"),
        ("rosbridge", "", "gateway_fixed", "rosbridge always runs"),
        ("pigeon", "ftp://roof", "gateway_url_invalid", "A URL is written as coop://HOST:5"),
        (
            "pigeon",
            "coop://roof?role=manage",
            "gateway_url_invalid",
            "role of everybody is none, watch or drive",
        ),
        ("pigeon", "coop://" + "x" * 3000, "gateway_url_invalid", "at most 2000 characters, not 3007"),
        ("pigeon", "coop://roof/taken", "gateway_port_taken", "Port 5 on roof is taken"),
        ("pigeon", "coop://roof/absent", "gateway_unable", "cannot use coop://roof:5/absent: Cannot assign"),
        ("pigeon", "coop://roof/broken", "gateway_unable", "pigeon cannot be loaded: no wings"),
    ):
        answer = await board.up(name, url)
        assert (answer.success, answer.code) == (False, code), name + url
        assert words in answer.message
    assert board.of("pigeon").state == "down"
    assert board.of("pigeon").fault == "pigeon cannot be loaded: no wings."
    assert asyncio.all_tasks() == before
    assert (await board.up()).success, "one that failed can be tried again"
    assert board.of("pigeon").fault == ""
    assert (await board.up()).code == "gateway_runs"
    await board.owner.close()


async def test_only_who_manages_the_robot_brings_one_up_or_down(board: Board) -> None:
    driver = board.scene.client("driver")
    driver.identity = Identity("d", "driver", Role.DRIVE)
    with pytest.raises(Refused, match="needs the role manage"):
        await board.up(client=driver)
    assert (await board.up()).success
    with pytest.raises(Refused, match="needs the role manage"):
        await board.down(client=driver)
    assert board.owner.running == ("pigeon",)
    await board.owner.close()


async def test_rosbridge_and_http_are_never_brought_down(board: Board) -> None:
    for name in FIXED:
        answer = await board.down(name)
        assert (answer.success, answer.code) == (False, "gateway_fixed")
    assert (await board.down("dove")).code == "gateway_down"


async def test_who_came_by_it_is_told_first_and_answered_before_it_ends(board: Board) -> None:
    own = board.scene.client("bird")
    own.way = "pigeon"
    await board.up()
    answer = await board.down(client=own)
    assert (answer.success, answer.code) == (False, "gateway_own")
    assert "ws://192.0.2.7:9090 stays" in answer.message
    assert board.owner.running == ("pigeon",)
    answer = await board.down(own=True, client=own)
    assert answer.success
    assert "goes down in 0.5 s" in answer.message
    assert board.owner.running == ("pigeon",)
    board.go_on.set()
    await settled()
    assert not board.owner.running
    assert board.paused == [FAREWELL_TIME]


async def test_the_end_of_the_robot_ends_one_that_is_on_its_way(board: Board) -> None:
    before = asyncio.all_tasks()
    Pigeon.hold = asyncio.Event()
    asked = asyncio.ensure_future(board.up())
    await settled()
    await board.board.close()
    await board.owner.close()
    with pytest.raises(Refused, match="about to end"):
        await asked
    assert asyncio.all_tasks() == before
    assert (await board.up()).code == "gateway_unable"


async def test_what_it_says_of_its_broker_is_how_it_stands(board: Board) -> None:
    board.listen()
    await board.up()
    gateway = board.owner.standing("pigeon").gateway
    assert isinstance(gateway, Pigeon)
    lost = Notice(Code.GATEWAY_LOST, "The coop is not reached.", gateway="pigeon", reason="storm")
    gateway.robot.say("control", lost, "warn")
    assert (board.of("pigeon").state, board.of("pigeon").fault) == ("lost", "The coop is not reached.")
    assert board.of("pigeon").endpoint == "coop://roof:5"
    gateway.robot.say("control", Notice(Code.GATEWAY_UP, "It is reached again.", gateway="pigeon"))
    assert (board.of("pigeon").state, board.of("pigeon").fault) == ("up", "")
    assert board.events()[-2:] == ["The coop is not reached.", "It is reached again."]
    await board.owner.close()


async def test_who_brought_it_up_and_down_and_that_everybody_may_drive_are_events(board: Board) -> None:
    await board.up(url="coop://roof?role=drive")
    await board.down()
    await board.up(url="coop://roof?role=watch")
    name = board.scene.station.controls.name(board.scene.anna)
    assert board.events() == [
        "Everybody who reaches pigeon at coop://roof:5 may drive without a key.",
        f"{name} brought pigeon up at coop://roof:5.",
        f"{name} brought pigeon down.",
        f"{name} brought pigeon up at coop://roof:5.",
    ]
    await board.owner.close()


async def test_what_was_brought_up_and_down_is_kept_for_the_next_start(
    tmp_path: Path, known: list[int]
) -> None:
    board = Board(tmp_path, keeps=True)
    answer = await board.up(url="coop://anna:secret@roof?role=drive")
    assert answer.message == "pigeon is up at coop://roof:5. So it is after the next start."
    await board.up("eagle")
    assert not (await board.up(url="coop://elsewhere")).success
    assert board.kept == [("pigeon", "coop://anna:secret@roof?role=drive")], (
        "what did not come up is not kept"
    )
    board.unkept = "The file is read-only."
    answer = await board.down()
    assert (answer.success, board.kept[-1]) == (True, ("pigeon", None))
    assert answer.message == "pigeon is down. The next start does not know of it: The file is read-only."
