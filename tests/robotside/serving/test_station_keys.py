"""A station with keys: who is let in, pairing from the command line, and a driver who is removed beside the running robot."""

from __future__ import annotations

import asyncio
import random
import ssl
import threading
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.client.credentials import Credentials
from bridge.client.pairing import Paired, PairingFailed, pair_by_code, pair_by_link
from bridge.core.codes import Code
from bridge.core.identity import Role
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, GetMeRequest, GetMeResponse
from bridge.trust.pairing import PairLink
from robotside.core.clock import RobotClock
from robotside.core.config import TrustSettings
from robotside.serving.station_keys import StationKeys
from robotside.serving.station_server import Addresses, StationServer
from robotside.station.station import Station
from robotside.trust.certificate import own_certificate
from robotside.trust.pair_requests import NoRobot, PairRequest, ask
from robotside.trust.people import TOKEN, added, make_person, removed
from robotside.trust.people_file import PeopleFile
from tests.fakes import FakeRobot
from tests.robotside.scene import records_at
from tests.robotside.serving.test_station_server import connected
from tests.robotside.visitor import visitor


@asynccontextmanager
async def serving(
    state: Path, *, settings: TrustSettings | None = None, plain: Role | None = None
) -> AsyncIterator[tuple[StationServer, StationKeys, FakeRobot]]:
    clock, robot = RobotClock(time.time()), FakeRobot()
    began = time.time() - time.monotonic()

    def wall() -> float:
        return began + time.monotonic()

    station = Station(robot, records_at(state), now=clock.now, clock=wall, rng=random.Random(1), name="Rex")
    keys = StationKeys(state, station, own_certificate(state), settings or TrustSettings(), plain=plain)
    serves = StationServer(station, clock, wall, Addresses("127.0.0.1", 0, 0), keys=keys)
    ready = asyncio.Event()
    running = asyncio.create_task(serves.run(lambda _: ready.set()))
    async with asyncio.timeout(60):
        await ready.wait()
        try:
            yield serves, keys, robot
        finally:
            serves.end()
            await running


async def test_a_program_of_this_machine_is_let_in_as_the_settings_say(tmp_path: Path) -> None:
    for word in ("manage", "watch"):
        settings = TrustSettings(local_role=word)  # type: ignore[arg-type]
        async with (
            serving(tmp_path / word, settings=settings) as (serves, _, _),
            connected(serves) as client,
        ):
            me = await client.call("/people/me", GetMeRequest(), GetMeResponse)
        assert (me.role, me.proven, me.id) == (word, False, "")


async def test_a_hello_claims_the_certificate(tmp_path: Path) -> None:
    async with serving(tmp_path) as (_, keys, _):
        assert own_certificate(tmp_path).fingerprint.startswith(keys.claim)
        assert len(keys.claim) == 32


async def test_the_command_line_opens_pairing_on_the_running_robot(tmp_path: Path) -> None:
    async with serving(tmp_path) as (serves, keys, _):
        answer = await asyncio.to_thread(ask, tmp_path, PairRequest("watch"))
        guest = await asyncio.to_thread(ask, tmp_path, PairRequest("drive", 3600.0))
        with pytest.raises(NoRobot, match="watches or drives"):
            await asyncio.to_thread(ask, tmp_path, PairRequest("manage", 3600.0))
        offer = keys.pairing.offer
        assert offer is not None
        assert (offer.role, offer.code) == (Role.WATCH, answer.code)
        link = PairLink.read(answer.link)
        assert (link.port, link.fingerprint) == (serves.addresses.port, own_certificate(tmp_path).fingerprint)
        assert len(guest.code) == 8
        await asyncio.get_running_loop().shutdown_default_executor()


async def test_a_driver_who_is_removed_by_another_program_stops_within_a_second(tmp_path: Path) -> None:
    made, token = make_person("script", Role.DRIVE, TOKEN, now=time.time())
    PeopleFile(tmp_path).change(lambda people: added(people, made))
    async with serving(tmp_path) as (serves, _, robot):
        driver = serves.door.join("192.0.2.9:1", way="rosbridge", secure=True, token=token)
        cut = asyncio.Event()
        driver.on_expelled = cut.set
        answer = serves.door.call(driver, "/control/acquire", CommandRequest(client_id="d"))
        assert isinstance(answer, CommandResponse)
        assert answer.success
        removing = threading.Thread(
            target=PeopleFile(tmp_path).change, args=(lambda people: removed(people, made.id)[0],)
        )
        removing.start()
        while not cut.is_set():
            driver.last_heard = serves.station.clock()
            if serves.door.connected:
                serves.door.publish(driver, "/cmd_vel", Twist.planar(0.3, 0.0), None)
            await asyncio.sleep(0.02)
        removing.join()
        assert serves.station.controls.driver is None
        assert robot.commands[-1] is None
        assert serves.door.connected == set()


async def asked(url: str, paired: Paired) -> GetMeResponse:
    """Who the robot takes a handheld for that was paired."""
    arrived = asyncio.Event()

    def note(state: LinkState) -> None:
        if state.phase is Phase.CONNECTED:
            arrived.set()

    client = BridgeClient(url, on_state=note, credentials=Credentials(paired.fingerprint, paired.token))
    running = asyncio.create_task(client.run())
    await arrived.wait()
    me = await client.call("/people/me", GetMeRequest(), GetMeResponse)
    await client.close()
    await running
    return me


async def test_a_handheld_pairs_by_link_and_is_known_from_then_on(tmp_path: Path) -> None:
    async with serving(tmp_path, settings=TrustSettings(local_role="none")) as (serves, keys, _):
        link = PairLink.read(keys.pairing.link(keys.pairing.open(Role.DRIVE)))
        paired = await pair_by_link(link, "tablet-A")
        me = await asked(f"wss://127.0.0.1:{serves.addresses.port}", paired)
        assert (me.id, me.name, me.role, me.proven, me.secure) == (
            paired.id,
            "tablet-A",
            "manage",
            True,
            True,
        )
        with pytest.raises(PairingFailed, match="Pairing is not open"):
            await pair_by_link(link, "tablet-B")


async def test_a_handheld_pairs_by_code_and_a_wrong_one_does_not(tmp_path: Path) -> None:
    async with serving(tmp_path, settings=TrustSettings(local_role="none")) as (serves, keys, _):
        url = f"wss://127.0.0.1:{serves.addresses.port}"
        offer = keys.pairing.open(Role.DRIVE)
        with pytest.raises(PairingFailed, match="code is wrong"):
            await pair_by_code(url, f"{(int(offer.code) + 1) % 1_000_000:06d}", "tablet-A")
        assert keys.trust.people == ()
        paired = await pair_by_code(url, offer.code, "tablet-A")
        assert (await asked(url, paired)).id == paired.id


async def test_who_stands_between_with_another_certificate_gets_nothing(tmp_path: Path) -> None:
    other = own_certificate(tmp_path / "other").context()
    async with serving(tmp_path / "robot") as (serves, keys, _):
        trusting = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        trusting.check_hostname, trusting.verify_mode = False, ssl.CERT_NONE
        seen: list[bytes] = []

        async def pass_on(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            while data := await reader.read(65_536):
                seen.append(data)
                writer.write(data)
            writer.close()

        async def stand_between(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            to_robot = await asyncio.open_connection("127.0.0.1", serves.addresses.port, ssl=trusting)
            await asyncio.gather(
                pass_on(reader, to_robot[1]), pass_on(to_robot[0], writer), return_exceptions=True
            )

        middle = await asyncio.start_server(stand_between, "127.0.0.1", 0, ssl=other)
        url = f"wss://127.0.0.1:{middle.sockets[0].getsockname()[1]}"
        offer = keys.pairing.open(Role.DRIVE)
        with pytest.raises(PairingFailed, match="another computer answers"):
            await pair_by_code(url, offer.code, "tablet-A")
        assert offer.digits.encode() not in b"".join(seen)
        assert keys.trust.people == ()
        link = PairLink.read(keys.pairing.link(offer))
        seen.clear()
        with pytest.raises(PairingFailed):
            await pair_by_link(replace(link, port=middle.sockets[0].getsockname()[1]), "tablet-A")
        assert seen == []
        middle.close()
        await middle.wait_closed()


@pytest.mark.parametrize(
    ("host", "plain", "welcome"),
    [
        ("127.0.0.1", None, True),
        ("::1", None, True),
        ("::ffff:127.0.0.1", None, True),
        ("192.0.2.9", None, False),
        ("fe80::1%eth0", None, False),
        ("unknown", None, False),
        ("192.0.2.9", Role.WATCH, True),
    ],
)
def test_who_may_speak_without_tls(tmp_path: Path, host: str, plain: Role | None, welcome: bool) -> None:
    station = Station(
        FakeRobot(), records_at(tmp_path), now=0.0, clock=lambda: 0.0, rng=random.Random(1), name="Rex"
    )
    keys = StationKeys(tmp_path, station, own_certificate(tmp_path), TrustSettings(), plain=plain)
    keys.close()
    assert keys.plain_from(host) is welcome


@pytest.mark.parametrize("allowed", [True, False])
async def test_pages_of_others_press_stop_unless_the_settings_say_no(tmp_path: Path, allowed: bool) -> None:
    async with serving(tmp_path, settings=TrustSettings(stop_from_pages=allowed)) as (serves, _, _):
        async with visitor(serves.addresses.http) as web:
            await web.post("/stop", headers={"Origin": "https://page.example"})
        assert serves.station.controls.stopped is allowed


OPEN_TO_ALL = ("warn", "Everybody in the network may drive without a key.")


@pytest.mark.parametrize(("plain", "told"), [(None, []), (Role.DRIVE, [OPEN_TO_ALL])])
async def test_an_event_tells_that_everybody_is_let_in_without_a_key(
    tmp_path: Path, plain: Role | None, told: list[tuple[str, str]]
) -> None:
    async with serving(tmp_path, plain=plain) as (serves, _, _):
        events = serves.station.events.since(0, "")
        assert [(each.level, each.text) for each in events if each.code == Code.TRUST_PLAIN] == told
