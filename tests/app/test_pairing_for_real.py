"""The handheld's pairing against the robot side as people start it, by TLS and with its own file of people."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from pathlib import Path

import pytest

from app.discovery.simulator_process import Simulator, command
from app.link.feeds import Mailbox
from app.link.link import Link
from bridge.client import BridgeClient
from bridge.client.client import Phase
from bridge.client.credentials import Credentials
from bridge.client.pairing import PairingFailed, pair_by_code, pair_by_link
from bridge.core.identity import Role
from bridge.core.link_state import LinkFault
from bridge.core.network_thread import NetworkThread
from bridge.msgs.pilothouse_msgs import (
    ControlStatus,
    GetMeRequest,
    GetMeResponse,
    InvitePersonRequest,
    InvitePersonResponse,
    RemovePersonRequest,
    RemovePersonResponse,
)
from bridge.trust.pairing import PairLink

PATIENCE = 60.0


@pytest.fixture
def served(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Simulator]:
    import queue

    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    told: queue.Queue[str] = queue.Queue()
    simulator = Simulator(command(), told.put, told.put)
    simulator.start()
    said = told.get(timeout=PATIENCE)
    assert said.startswith("ws://"), said
    yield simulator
    simulator.close()


class Connected:
    """A client with a key, until the end of the block."""

    def __init__(self, url: str, credentials: Credentials) -> None:
        self._arrived: asyncio.Future[LinkFault | None] = asyncio.get_running_loop().create_future()
        self.client = BridgeClient(url, on_state=self._note, credentials=credentials)

    def _note(self, state) -> None:
        if state.phase is not Phase.CONNECTING and not self._arrived.done():
            self._arrived.set_result(None if state.phase is Phase.CONNECTED else state.fault)

    async def __aenter__(self) -> tuple[BridgeClient, LinkFault | None]:
        self._running = asyncio.create_task(self.client.run())
        async with asyncio.timeout(PATIENCE):
            return self.client, await self._arrived

    async def __aexit__(self, *_: object) -> None:
        await self.client.close()
        await self._running


async def test_a_robot_pairs_by_link_then_by_code_and_forgets(served: Simulator) -> None:
    link = PairLink.read(served.links[0])
    first = await pair_by_link(link, "tablet-A")
    assert first.role is Role.MANAGE, "the first one manages"
    with pytest.raises(PairingFailed):
        await pair_by_link(link, "somebody else")
    key = Credentials(first.fingerprint, first.token, first.robot)
    async with Connected(served.url, key) as (client, fault):
        assert fault is None
        assert client.fingerprint == link.fingerprint
        me = await client.call("/people/me", GetMeRequest(), GetMeResponse)
        assert (me.id, me.name, me.proven, me.secure) == (first.id, "tablet-A", True, True)
        invited = await client.call("/people/invite", InvitePersonRequest(role="drive"), InvitePersonResponse)
        wrong = f"{(int(invited.code) + 1) % 1_000_000:06d}"
        with pytest.raises(PairingFailed):
            await pair_by_code(first.url, wrong, "tablet-B")
        second = await pair_by_code(first.url, invited.code, "tablet-B")
        assert (second.role, second.fingerprint) == (Role.DRIVE, link.fingerprint)
        await client.call("/people/remove", RemovePersonRequest(id=second.id), RemovePersonResponse)
    async with Connected(served.url, Credentials(second.fingerprint, second.token)) as (_, fault):
        assert fault is LinkFault.NOT_ACCEPTED
    await stop_without_a_key(served.url, Credentials(second.fingerprint, second.token), key)


async def stop_without_a_key(url: str, removed: Credentials, manager: Credentials) -> None:
    """Who was removed and stands beside the robot presses STOP: it is anybody's."""
    stopped, woken, loop = asyncio.Event(), asyncio.Event(), asyncio.get_running_loop()
    box = Mailbox(lambda: loop.call_soon_threadsafe(woken.set))

    def note(status: ControlStatus, _: float) -> None:
        if status.stopped:
            stopped.set()

    network = NetworkThread()
    left = Link(url, box, network, client_id="b", client_name="B", credentials=removed)
    async with Connected(url, manager) as (client, _):
        client.subscribe("/control/status", ControlStatus, note)
        left.start()
        try:
            async with asyncio.timeout(PATIENCE):
                while left.state.fault is not LinkFault.NOT_ACCEPTED:
                    await woken.wait()
                    woken.clear()
                    box.drain()
                assert not stopped.is_set()
                left.stop()
                await stopped.wait()
        finally:
            left.close()
            network.close()
