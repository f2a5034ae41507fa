"""Two handhelds in front of a real robot side: control is asked for, kept and handed over."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager
from pathlib import Path

from bridge.msgs.geometry_msgs import Twist
from tests.app.link.test_link import Operator
from tests.fakes import FakeRobot
from tests.robotside.foreign.test_foreign_link import until
from tests.robotside.serving.test_station_server import serving

AHEAD = Twist.planar(0.3, 0.0)


class Hand(Operator):
    """An operator who notes what he is told of control."""

    def __init__(self, url: str, folder: Path, name: str, *, wants_control: bool) -> None:
        super().__init__(url, folder / name, wants_control=wants_control, client_id=name.lower(), name=name)
        self.news: list[str] = []
        self.session.authority.on_news = lambda text, _: self.news.append(text)


@asynccontextmanager
async def hands(url: str, folder: Path) -> AsyncIterator[tuple[Hand, Hand]]:
    """Bob, who has control, and Anna, who watches; both take in what comes."""
    bob, anna = Hand(url, folder, "Bob", wants_control=True), Hand(url, folder, "Anna", wants_control=False)

    async def live() -> None:
        while True:
            for hand in (bob, anna):
                hand.turn()
            await asyncio.sleep(0.02)

    living = asyncio.create_task(live())
    try:
        await until(lambda: (bob.session.control, anna.session.control) == ("mine", "other"))
        yield bob, anna
    finally:
        living.cancel()
        with ThreadPoolExecutor(1) as aside:  # their sockets close while the robot side goes on
            for hand in (bob, anna):
                await asyncio.get_running_loop().run_in_executor(aside, hand.close)


async def drives(hand: Hand, robot: FakeRobot) -> None:
    """He pushes until the robot moves: a push that a slow machine let grow old is dropped, and is pushed anew."""

    def moves() -> bool:
        hand.session.link.drive(AHEAD)
        return robot.commands[-1:] == [AHEAD]

    await until(moves)


async def test_control_is_asked_for_kept_and_handed_over(tmp_path: Path) -> None:
    robot = FakeRobot()
    async with (
        serving(tmp_path / "robot", robot) as serves,
        hands(serves.addresses.bridge, tmp_path) as (bob, anna),
    ):
        anna.session.take_control()
        await until(lambda: bob.session.authority.asked and anna.session.authority.asking)
        assert bob.session.authority.status.requested_by == "Anna"
        assert 8.0 < anna.session.authority.left <= 10.0
        anna.session.authority.toggle()
        await until(lambda: not (bob.session.authority.asked or anna.session.authority.asking))
        assert (bob.news, anna.news) == (["You keep control: Anna does not ask any more."], [])

        anna.session.take_control()
        await until(lambda: bob.session.authority.asked and anna.session.authority.asking)
        await drives(bob, robot)
        bob.session.command("grant")
        await until(lambda: anna.session.control == "mine" and bob.session.control == "other")
        assert (bob.news[-1], anna.news) == ("Anna has control now.", ["You have control."])
        assert robot.at_rest
        await drives(anna, robot)

        bob.session.take_control()
        await until(lambda: anna.session.authority.asked)
        anna.session.command("object")
        await until(lambda: not anna.session.authority.asked)
        await until(lambda: bob.news[-1] == "Anna keeps control.")
        bob.session.take_control()
        await until(
            lambda: "request" in bob.session.outcomes and bob.session.outcomes["request"].phase == "refused"
        )
        assert bob.session.outcomes["request"].reason.startswith("Anna has objected; ask again in ")
