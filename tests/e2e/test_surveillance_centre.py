"""One robot side between several robots and several tablets: all watch, one drives, anyone stops; each robot by itself."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from pathlib import Path

import pytest

from app.discovery.known_robots import Entry
from app.discovery.roll_calls import RollCalls
from bridge.client.client import BridgeClient
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, ControlStatus, Event, RobotInfo
from bridge.msgs.rosapi_msgs import GetTimeRequest, GetTimeResponse
from tests.bridge.client.foreign_server import ForeignServer, foreign
from tests.bridge.wires import link, until

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]


class Tablet:
    """Somebody who watches one robot at the centre, and may ask for more."""

    def __init__(self, client: BridgeClient, name: str) -> None:
        self._client, self.name = client, name
        self.info, self.odom, self.control = RobotInfo(), Odometry(), ControlStatus()
        self.said: list[str] = []
        for topic, kind in (
            ("/robot/info", RobotInfo),
            ("/odom", Odometry),
            ("/control/status", ControlStatus),
        ):
            client.subscribe(topic, kind, self._keep)
        client.subscribe("/events", Event, lambda msg, _: self.said.append(msg.text))

    def _keep(self, msg: RobotInfo | Odometry | ControlStatus, _: float) -> None:
        if isinstance(msg, RobotInfo):
            self.info = msg
        elif isinstance(msg, Odometry):
            self.odom = msg
        else:
            self.control = msg

    async def ask(self, service: str) -> CommandResponse:
        return await self._client.call(service, CommandRequest(client_name=self.name), CommandResponse)

    async def know_the_time(self) -> None:
        await self._client.call("/rosapi/get_time", GetTimeRequest(), GetTimeResponse)

    def push(self, speed: float = 0.2) -> None:
        self._client.publish("/cmd_vel", Twist.planar(speed, 0.0))


@asynccontextmanager
async def centre(robots: list[ForeignServer], state: Path) -> AsyncIterator[list[str]]:
    """The centre as a process; its addresses, one for each robot."""
    names = ",".join(f"ws://127.0.0.1:{each.port}" for each in robots)
    words = f"-m robotside serve --robot ros:{names} --name North,South --port 0 --http-port 0 --with-parent --state"
    process = await asyncio.create_subprocess_exec(
        sys.executable, *words.split(), str(state), cwd=ROOT, stdout=asyncio.subprocess.PIPE
    )
    assert process.stdout is not None
    try:
        addresses: list[str] = []
        async with asyncio.timeout(60):
            while len(addresses) < len(robots):
                line = (await process.stdout.readline()).decode()
                addresses += line.partition("bridge=")[2].split()[:1]
        yield addresses
    finally:
        if process.returncode is None:
            process.terminate()
        await process.communicate()


@asynccontextmanager
async def tablet(address: str, name: str) -> AsyncIterator[Tablet]:
    async with link(address) as line:
        made = Tablet(await line.connected(), name)
        await made.know_the_time()
        yield made


async def test_all_watch_one_drives_anyone_stops_and_a_robot_that_is_gone_is_gone_alone(tmp_path):
    async with AsyncExitStack() as rooms:
        north, south = [await rooms.enter_async_context(foreign()) for _ in range(2)]
        first, second = await rooms.enter_async_context(centre([north, south], tmp_path))
        anna, ben, carl = [
            await rooms.enter_async_context(tablet(address, name))
            for address, name in ((first, "Anna"), (first, "Ben"), (second, "Carl"))
        ]
        # both watch the same robot, and the third one another
        await until(lambda: anna.info.name == ben.info.name == "North" and carl.info.name == "South")

        # one drives: the other one is refused with her name, and the other robot does not move
        assert (await anna.ask("/control/acquire")).success
        refused = await ben.ask("/control/acquire")
        assert not refused.success
        assert "Anna" in refused.message
        await until(lambda: anna.push() or north.robot.speed == pytest.approx(0.2))
        assert south.robot.speed == 0.0
        await until(lambda: ben.odom.twist.twist.linear.x > 0.0)
        await until(lambda: north.robot.speed == 0.0)  # nobody pushes any more

        # the third drives the other robot meanwhile
        assert (await carl.ask("/control/acquire")).success
        await until(lambda: carl.push() or south.robot.speed == pytest.approx(0.2))

        # anyone stops
        assert (await ben.ask("/stop")).success
        await until(lambda: anna.control.stopped)
        anna.push()
        await until(lambda: any("STOP" in said or "stop" in said for said in anna.said))
        assert north.robot.speed == 0.0
        assert not carl.control.stopped

        # one robot is gone: it alone
        await south.close()
        await until(lambda: any("cannot be reached" in said for said in carl.said))
        assert not any("cannot be reached" in said for said in anna.said)


async def test_a_robot_that_is_killed_is_lost_to_who_watches_over_many(tmp_path):
    async with foreign() as north, foreign() as south, centre([north, south], tmp_path) as (first, _):
        reached: dict[str, bool] = {}
        calls = RollCalls(lambda hello, _: reached.update({hello.name: hello.reached}), lambda: 0.0)
        calls.wants([Entry(first, "", saved=True)])
        await calls._ask(first)
        assert reached == {"North": True, "South": True}
        await south.close()
        async with asyncio.timeout(60):
            while reached["South"]:
                await asyncio.sleep(0.2)  # as a handheld asks, only sooner
                await calls._ask(first)
        assert reached["North"]


async def test_a_tablet_that_knows_one_address_of_the_centre_knows_all_its_robots(tmp_path):
    async with foreign() as north, foreign() as south, centre([north, south], tmp_path) as (first, second):
        heard: dict[str, str] = {}
        calls = RollCalls(lambda hello, _: heard.update({hello.name: hello.url}), lambda: 0.0)
        calls.wants([Entry(first, "", saved=True)])
        await calls._ask(first)
        assert heard == {"North": first, "South": second}
