"""Pairing from the handheld's side: by link, by code, and with somebody in between."""

from __future__ import annotations

import hmac
import math
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import pytest
import spake2

from bridge.client import pairing
from bridge.client.pairing import IN_BETWEEN, Paired, PairingFailed, pair_by_code, pair_by_link
from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Service
from bridge.msgs.pilothouse_msgs import (
    PairBeginRequest,
    PairBeginResponse,
    PairFinishRequest,
    PairFinishResponse,
    PairScanRequest,
    PairScanResponse,
)
from bridge.trust.pairing import BadPairing, PairLink, confirmations, sides
from tests.bridge.certificates import served
from tests.bridge.fronts import front
from tests.bridge.wires import server

SECRET = "abcdefghijklmnopqrstuv"
CODE = "493 017"
GOOD = {"id": "anna", "token": "anna.secret", "role": "drive", "ends": math.nan, "robot": "Patrol-1"}


class Robot:
    """A robot's half of pairing, with nothing kept and nothing counted."""

    def __init__(self) -> None:
        self.answer: dict[str, Any] = dict(GOOD)
        self.code = CODE.replace(" ", "")
        self.names: list[str] = []
        self.messages: list[str] = []
        self.says: str | None = None
        """What it says in place of its own message."""
        self.proves = True
        self._key = b""

    def scan(self, _: Any, request: PairScanRequest) -> PairScanResponse:
        if request.secret != SECRET:
            raise Refused("Pairing is closed.")
        self.names.append(request.name)
        return PairScanResponse(**self.answer)

    def begin(self, _: Any, request: PairBeginRequest) -> PairBeginResponse:
        handheld, robot = sides(served("patrol")[1])
        mine = spake2.SPAKE2_B(self.code.encode(), idA=handheld, idB=robot)
        said = mine.start().hex()
        self.messages.append(request.message)
        self._key = mine.finish(bytes.fromhex(request.message))
        return PairBeginResponse(message=said if self.says is None else self.says)

    def finish(self, _: Any, request: PairFinishRequest) -> PairFinishResponse:
        its, mine = confirmations(self._key)
        if not hmac.compare_digest(its, request.confirmation):
            raise Refused("That is not the code of this robot.")
        self.names.append(request.name)
        return PairFinishResponse(confirmation=mine if self.proves else "00", **self.answer)

    @asynccontextmanager
    async def served(self) -> AsyncIterator[int]:
        kinds = (
            ("scan", PairScanRequest, PairScanResponse),
            ("begin", PairBeginRequest, PairBeginResponse),
            ("finish", PairFinishRequest, PairFinishResponse),
        )
        services = [
            Service(
                f"/pair/{name}", f"pilothouse_msgs/Pair{name.title()}", asks, answers, getattr(self, name)
            )
            for name, asks, answers in kinds
        ]
        async with server(services=services) as made, front("patrol", made.port) as port:
            yield port


def link(port: int, name: str = "patrol", secret: str = SECRET) -> PairLink:
    return PairLink("127.0.0.1", port, served(name)[1], secret, "Patrol-1")


async def test_a_link_pairs_with_the_robot_of_the_link():
    robot = Robot()
    async with robot.served() as port:
        paired = await pair_by_link(link(port), "tablet-B")
    assert robot.names == ["tablet-B"]
    assert paired.url == f"wss://127.0.0.1:{port}"
    assert (paired.fingerprint, paired.token) == (served("patrol")[1], "anna.secret")
    assert (paired.id, paired.role, paired.robot) == ("anna", Role.DRIVE, "Patrol-1")
    assert math.isnan(paired.ends)
    assert "secret" not in repr(paired)


async def test_the_secret_of_a_link_is_told_to_nobody_else():
    robot = Robot()
    async with robot.served() as port:
        with pytest.raises(PairingFailed, match="its key is not the one of Patrol-1"):
            await pair_by_link(link(port, "another"), "tablet-B")
    assert not robot.names


async def test_a_link_that_ran_out_is_told_in_the_robot_s_words():
    async with Robot().served() as port:
        with pytest.raises(PairingFailed, match="^Pairing is closed.$"):
            await pair_by_link(link(port, secret="x" * 22), "tablet-B")


async def test_a_code_pairs_as_well():
    robot = Robot()
    async with robot.served() as port:
        paired = await pair_by_code(f"wss://127.0.0.1:{port}", CODE, "tablet-B")
    assert paired == Paired(
        f"wss://127.0.0.1:{port}",
        served("patrol")[1],
        "anna.secret",
        "anna",
        Role.DRIVE,
        paired.ends,
        "Patrol-1",
    )
    assert robot.names == ["tablet-B"]
    assert CODE.replace(" ", "") not in robot.messages[0]


async def test_a_wrong_code_is_refused_by_the_robot_and_nothing_is_kept():
    robot = Robot()
    async with robot.served() as port:
        with pytest.raises(PairingFailed, match="^That is not the code of this robot.$"):
            await pair_by_code(f"wss://127.0.0.1:{port}", "493018", "tablet-B")
    assert not robot.names


async def test_somebody_in_between_with_the_right_code_on_both_sides_gets_nothing():
    """It passes on every byte; but the handheld sees its certificate and the robot has another."""
    robot = Robot()
    async with robot.served() as port, front("somebody", port, onward_tls=True) as between:
        with pytest.raises(PairingFailed, match="not the code"):
            await pair_by_code(f"wss://127.0.0.1:{between}", CODE, "tablet-B")
    assert not robot.names


async def test_another_certificate_than_at_first_sight_ends_it(monkeypatch):
    """Somebody shows the robot's certificate first and then his own, to read what comes after."""

    async def seen(_: str) -> str:
        return served("patrol")[1]

    robot = Robot()
    monkeypatch.setattr(pairing, "_certificate_at", seen)
    async with robot.served() as port, front("somebody", port, onward_tls=True) as between:
        with pytest.raises(PairingFailed, match="Another robot answers"):
            await pair_by_code(f"wss://127.0.0.1:{between}", CODE, "tablet-B")
    assert not robot.messages


async def test_a_robot_that_cannot_prove_the_code_is_not_kept():
    robot = Robot()
    robot.proves = False
    async with robot.served() as port:
        with pytest.raises(PairingFailed) as raised:
            await pair_by_code(f"wss://127.0.0.1:{port}", CODE, "tablet-B")
    assert str(raised.value) == IN_BETWEEN


@pytest.mark.parametrize(
    "message",
    ["", "zz", "42", "41" + "00" * 32, "42" + "ff" * 32, "42" + "01" + "00" * 31, "42" + "00" * 64, "é"],
)
async def test_what_is_no_message_of_spake2_is_one_sentence(message):
    robot = Robot()
    robot.says = message
    async with robot.served() as port:
        with pytest.raises(PairingFailed) as raised:
            await pair_by_code(f"wss://127.0.0.1:{port}", CODE, "tablet-B")
    assert str(raised.value) == IN_BETWEEN


@pytest.mark.parametrize("wrong", ["", "12345", "1234567", "abcdef", "12345６"])
async def test_what_is_no_code_reaches_no_robot(wrong):
    with pytest.raises(BadPairing):
        await pair_by_code("wss://127.0.0.1:9", wrong, "tablet-B")


@pytest.mark.parametrize(
    "wrong",
    [{"token": ""}, {"token": "a b"}, {"token": "x" * 513}, {"id": ""}, {"id": "<b>"}, {"role": "king"}],
)
async def test_what_is_kept_for_good_is_checked(wrong):
    robot = Robot()
    robot.answer |= wrong
    async with robot.served() as port:
        with pytest.raises(PairingFailed, match="no pairing"):
            await pair_by_link(link(port), "tablet-B")


async def test_a_robot_s_name_is_bounded_and_readable():
    robot = Robot()
    robot.answer["robot"] = "\x1b[31m" + "x" * 1000
    async with robot.served() as port:
        assert (await pair_by_link(link(port), "tablet-B")).robot == "[31m" + "x" * 76


async def test_nobody_there_is_one_sentence():
    with pytest.raises(PairingFailed, match="No robot answers at 127.0.0.1:9"):
        await pair_by_link(link(9), "tablet-B")
    with pytest.raises(PairingFailed, match="No robot answers at 127.0.0.1:9"):
        await pair_by_code("wss://127.0.0.1:9", CODE, "tablet-B")


async def test_without_tls_nobody_pairs():
    """A code over a plain socket would be bound to no certificate."""
    async with server() as made:
        with pytest.raises(PairingFailed, match="not protected"):
            await pair_by_code(f"ws://127.0.0.1:{made.port}", CODE, "tablet-B")
