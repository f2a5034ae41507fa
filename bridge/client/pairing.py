"""Pairing with a robot: by the secret of its link, or by the code that it shows.

Both need one connection by TLS. With a link the robot proves by its certificate that it is the one of the link before the
secret is sent. With a code the certificate is seen first and then required; SPAKE2 shows to both ends that the other has the
same code and sees the same certificate, and nobody in between learns the code from it.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import re
from collections.abc import AsyncIterator, Iterator
from dataclasses import dataclass, field

import spake2
from spake2.ed25519_basic import NotOnCurve

from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.client.connection import open_connection
from bridge.client.credentials import Credentials
from bridge.core.address import LinkLost, at_port
from bridge.core.errors import BridgeError, NoReply, NotConnected, ProtocolError, Refused
from bridge.core.identity import Role
from bridge.msgs.pilothouse_msgs import (
    PairBeginRequest,
    PairBeginResponse,
    PairFinishRequest,
    PairFinishResponse,
    PairScanRequest,
    PairScanResponse,
)
from bridge.trust.pairing import PairLink, confirmations, sides, split_code

__all__ = ["Paired", "PairingFailed", "pair_by_code", "pair_by_link"]

CONNECT_TIMEOUT = 6.0
"""Longest time until the robot answers on a connection [s]."""
ANSWER_TIMEOUT = 5.0
"""Longest time for an answer: the robot hashes the token slowly, on purpose [s]."""
MAX_SENTENCE, MAX_ROBOT_NAME = 200, 80
"""Characters of what a robot says."""
MESSAGE_BYTES = 33
"""Length of a message of SPAKE2 in this group: its side and one element."""
ID = re.compile("[0-9A-Za-z_.-]{1,64}")
"""Public id of a person."""
IN_BETWEEN = "Somebody between this handheld and the robot answered. Do not pair here; use the robot's link."


class PairingFailed(BridgeError):
    """The two are not paired; the text says why and what to do."""


@dataclass(frozen=True, slots=True)
class Paired:
    """What pairing left."""

    url: str
    """Address by which the robot was reached, `wss://HOST:PORT`."""
    fingerprint: str
    """Of the robot's certificate."""
    token: str = field(repr=False)
    """By which the robot knows this handheld."""
    id: str
    """Public id of this handheld at that robot."""
    role: Role
    """What this handheld may do there."""
    ends: float
    """When the role ends [s, operators' clock]; NaN when it does not."""
    robot: str
    """Name of the robot."""


async def pair_by_link(link: PairLink, name: str) -> Paired:
    """Pair as `name` with the robot of a link; PairingFailed when that fails."""
    url = f"wss://{at_port(link.host, link.port)}"
    async with _connected(url, Credentials(link.fingerprint, name=link.name)) as client:
        request = PairScanRequest(secret=link.secret, name=name)
        with _failing():
            answer = await client.call("/pair/scan", request, PairScanResponse, timeout=ANSWER_TIMEOUT)
    return _paired(url, link.fingerprint, answer)


async def pair_by_code(url: str, code: str, name: str) -> Paired:
    """Pair as `name` with the robot at `url` by the code that it shows; PairingFailed when that fails.

    BadPairing for a text that is no code.
    """
    tag, digits = split_code(code)
    fingerprint = await _certificate_at(url)
    handheld, robot = sides(fingerprint)
    exchange = spake2.SPAKE2_A(digits.encode(), idA=handheld, idB=robot)
    async with _connected(url, Credentials(fingerprint)) as client:
        begin = PairBeginRequest(tag=tag, message=exchange.start().hex())
        with _failing():
            begun = await client.call("/pair/begin", begin, PairBeginResponse, timeout=ANSWER_TIMEOUT)
        mine, its = confirmations(_key(exchange, begun.message))
        finish = PairFinishRequest(confirmation=mine, name=name)
        with _failing():
            answer = await client.call("/pair/finish", finish, PairFinishResponse, timeout=ANSWER_TIMEOUT)
    if not hmac.compare_digest(answer.confirmation.encode(), its.encode()):
        raise PairingFailed(IN_BETWEEN)
    return _paired(url, fingerprint, answer)


async def _certificate_at(url: str) -> str:
    """Fingerprint of the certificate at `url`, which proves nothing yet."""
    try:
        connection = await open_connection(url, CONNECT_TIMEOUT)
    except LinkLost as error:
        raise PairingFailed(str(error)) from error
    await connection.close()
    if not connection.fingerprint:
        raise PairingFailed(f"{url} is not protected, so nobody can pair there.")
    return connection.fingerprint


@contextlib.asynccontextmanager
async def _connected(url: str, credentials: Credentials) -> AsyncIterator[BridgeClient]:
    """A client that the robot with that certificate has answered; PairingFailed where none does."""
    arrived: asyncio.Future[str] = asyncio.get_running_loop().create_future()

    def note(state: LinkState) -> None:
        if state.phase is not Phase.CONNECTING and not arrived.done():
            arrived.set_result("" if state.phase is Phase.CONNECTED else state.sentence)

    client = BridgeClient(url, on_state=note, credentials=credentials)
    running = asyncio.create_task(client.run())
    try:
        try:
            async with asyncio.timeout(CONNECT_TIMEOUT):
                trouble = await arrived
        except TimeoutError:
            trouble = f"The robot at {client.place} did not answer."
        if trouble:
            raise PairingFailed(trouble)
        yield client
    finally:
        await client.close()
        await running


@contextlib.contextmanager
def _failing() -> Iterator[None]:
    """The robot's refusal, or its silence, as the failure of pairing."""
    try:
        yield
    except Refused as refusal:
        raise PairingFailed(str(refusal)[:MAX_SENTENCE]) from refusal
    except NoReply as silence:
        raise PairingFailed("The robot did not answer; try again.") from silence
    except NotConnected as cut:
        raise PairingFailed("The connection was cut while pairing; try again.") from cut
    except ProtocolError as fault:
        raise PairingFailed("What the robot answered is no pairing.") from fault


def _key(exchange: spake2.SPAKE2_A, message: str) -> bytes:
    """SPAKE2's key out of the robot's message; PairingFailed for one that no robot sends."""
    try:
        raw = bytes.fromhex(message)
        if len(raw) != MESSAGE_BYTES:
            raise ValueError(len(raw))
        return bytes(exchange.finish(raw))
    except (spake2.SPAKEError, NotOnCurve, ValueError) as error:
        raise PairingFailed(IN_BETWEEN) from error


def _paired(url: str, fingerprint: str, answer: PairScanResponse | PairFinishResponse) -> Paired:
    """What the answer says, checked: it is kept for good."""
    name = "".join(letter for letter in answer.robot if letter.isprintable())[:MAX_ROBOT_NAME].strip()
    try:
        Credentials(fingerprint, answer.token)
        role = Role.read(answer.role)
    except ValueError as error:
        raise PairingFailed("What the robot answered is no pairing.") from error
    if not answer.token or not ID.fullmatch(answer.id):
        raise PairingFailed("What the robot answered is no pairing.")
    return Paired(url, fingerprint, answer.token, answer.id, role, answer.ends, name)
