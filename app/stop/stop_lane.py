"""STOP's way to one robot over a socket of its own, whoever else is connected to what.

A robot of ours is asked until it says that STOP is pressed and that it rests. One that has no STOP is sent zero speed for
as long as the lane lasts. Everything here lives in the network thread; `StopLane.report` may be read in any.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Protocol, TypeVar

from app.link.capabilities import DRIVE, NO_CAPABILITIES, Capabilities, ask_capabilities
from app.link.commands import Commands, Outcome
from app.stop.local_stop import LocalStop
from app.stop.stop_state import StopState
from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.client.credentials import Credentials
from bridge.core.errors import BridgeError
from bridge.core.identity import public_id
from bridge.core.topic_choice import drive_message
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import ControlStatus, RobotInfo
from bridge.msgs.std_msgs import Time

__all__ = ["Client", "Report", "StopLane"]

M = TypeVar("M", bound=Msg)

TICK = 0.1
"""Between two looks at how it goes, and between two commands to rest [s]."""
RETRY_DELAY = 1.0
"""To a robot that took STOP and moves it is sent anew after this [s]."""
BACKOFF = (0.5, 2.0)
"""First and longest wait between two attempts to reach it [s]."""


@dataclass(frozen=True, slots=True)
class Report:
    """What is known of one robot's STOP."""

    phase: str
    """As of `stop_state.Verdict`."""
    sentence: str = ""
    """The same for the operator; empty where the phase says it all."""
    name: str = ""
    """What the robot calls itself; empty until it said so."""
    reached: bool = False
    """The connection stands."""
    foreign: bool = False
    """It has no STOP of its own: zero speed is sent for as long as the lane lasts."""
    identity: tuple[str, str, Time] | None = None
    """Alike for the same robot under two addresses; None while that is not known."""
    proven: str = ""
    """Fingerprint of the key by which the robot proved who it is; empty until then, and for one that is not paired."""


class Client(Protocol):
    """What is needed of `bridge.client.client.BridgeClient`."""

    @property
    def foreign(self) -> bool:
        """The server is none of ours."""

    async def call(
        self, service: str, request: Msg | None, response: type[M], /, *, timeout: float = 2.0
    ) -> M:
        """Ask for something to be done once."""

    def publish(self, topic: str, msg: Msg, /, *, even_late: bool = False) -> bool:
        """Send a message at once."""

    def subscribe(
        self, topic: str, kind: type[M], callback: Callable[[M, float], object], /
    ) -> Callable[[], None]:
        """Have `callback(msg, received)` called for each message."""

    def advertise(self, topic: str, kind: type[Msg], /) -> None:
        """Say that it is published here."""

    def robot_time(self) -> float:
        """The robot's clock [s]; NaN until it is known."""

    async def run(self) -> None:
        """Connect again and again until `close`."""

    async def close(self) -> None:
        """End the link for good."""


class StopLane:
    """STOP to one robot from `run` until that is cancelled."""

    def __init__(
        self,
        url: str,
        *,
        now: Callable[[], float],
        new_id: Callable[[], str],
        client_id: str,
        client_name: str,
        credentials: Credentials | None = None,
        connect: Callable[..., Client] = BridgeClient,
    ) -> None:
        """`now` is our clock [s]; `client_id` and `client_name` are who this handheld is to the robot.

        With `credentials` only the robot with that key is asked, and what another machine says at `url` counts for nothing.
        One that does not know this handheld any more is stopped all the same: STOP is anybody's.
        """
        self._now = now
        self._credentials = credentials
        self._proven = ""
        self._client = connect(
            url,
            on_state=self._on_state,
            now=now,
            backoff=BACKOFF,
            credentials=credentials,
            even_unknown=True,
        )
        self._commands = Commands(
            self._client.call,
            self._on_outcome,
            now=now,
            robot_time=self._client.robot_time,
            new_id=new_id,
            client_id=client_id,
            client_name=client_name,
        )
        self._zero = LocalStop(now)
        self._wanted, self._done = asyncio.Event(), asyncio.Event()
        self._identity: tuple[str, str, Time] | None = None
        self._stopping = StopState(now, (credentials.id if credentials else "") or public_id(client_id))
        self._stopping.reach(False)
        self._reached = False
        self._offer: Capabilities | None = None
        self._status: ControlStatus | None = None
        self._info = RobotInfo()
        self._listening: dict[str, Callable[[], None]] = {}
        self._learning: asyncio.Task[None] | None = None
        self.report = Report("sent")
        """What is known now."""
        self.press()

    # what it is told

    def press(self) -> None:
        """STOP was pressed; again while it is being sent changes nothing, after a release it begins anew."""
        self._stopping.press()
        self._done.clear()
        self._wanted.set()
        self._zero.press()
        self._look()

    async def run(self) -> None:
        """Reach the robot and stop it, until cancelled; ends within 0.5 s then."""
        link = asyncio.create_task(self._client.run())
        work = [asyncio.create_task(part) for part in (self._send_stop(), self._keep_zero())]
        try:
            await asyncio.wait({link, *work}, return_when=asyncio.FIRST_EXCEPTION)
        finally:
            for task in [*work, *([self._learning] if self._learning else [])]:
                task.cancel()
            await self._client.close()  # and not by cancelling it, which twice would leave its socket open
            await asyncio.gather(link, *work, return_exceptions=True)

    # what goes out

    async def _send_stop(self) -> None:
        while True:
            await self._wanted.wait()
            if not self._only_zero:
                await self._commands.stop()
                with suppress(TimeoutError):
                    async with asyncio.timeout(RETRY_DELAY):
                        await self._done.wait()
            if self._done.is_set() or self._only_zero:
                self._wanted.clear()

    async def _keep_zero(self) -> None:
        while True:
            if self._has_none and self._reached and self._zero.latched and self._drive is not None:
                zero = drive_message(Twist(), self._client.robot_time(), stamped=self._stamped)
                self._client.publish(self._drive, zero, even_late=True)
            self._look()
            await asyncio.sleep(TICK)

    # what comes in

    def _on_state(self, state: LinkState) -> None:
        self._reached = state.phase is Phase.CONNECTED
        if self._reached and self._credentials is not None:
            self._proven = self._credentials.fingerprint
        hopeless = state.phase is Phase.CLOSED and bool(state.sentence)  # such an address can never work
        self._stopping.reach(self._reached, state.sentence, hopeless=hopeless)
        if self._learning is not None:
            self._learning.cancel()
        if self._reached:
            self._learning = asyncio.get_running_loop().create_task(self._learn())
            self._heed()
        self._look()

    async def _learn(self) -> None:
        """Listen to what tells of STOP; of a server that is not ours, find out first what there is."""
        if not self._client.foreign:
            self._follow()
            return
        while self._offer is None or not self._offer.ours:
            with suppress(BridgeError):
                self._offer = await ask_capabilities(self._client.call, self._offer)
                self._follow()
            await asyncio.sleep(RETRY_DELAY)

    def _follow(self) -> None:
        if self._only_zero:
            self._commands.void_stop()
            self._listen((self._offer or NO_CAPABILITIES).source("/odom"), Odometry, self._zero.on_odometry)
            if self._drive is not None:
                self._client.advertise(self._drive, TwistStamped if self._stamped else Twist)
            return
        self._listen("/control/status", ControlStatus, self._on_status)
        self._listen("/robot/info", RobotInfo, self._on_info)

    def _listen(self, topic: str | None, kind: type[Msg], hear: Callable[[Any, float], object]) -> None:
        if topic is not None and topic not in self._listening:
            self._listening[topic] = self._client.subscribe(topic, kind, hear)

    def _on_info(self, info: RobotInfo, _: float) -> None:
        self._info = info
        self._recognise()

    def _on_status(self, status: ControlStatus, received: float) -> None:
        self._status = status
        self._stopping.on_status(status, received)
        if self._reached:
            self._heed()

    def _heed(self) -> None:
        """Ask for nothing more where it says that it rests."""
        if self._stopping.rests:
            self._done.set()
            self._commands.confirm_stop()
        self._recognise()

    def _recognise(self) -> None:
        """Note what is alike for one robot at two addresses: who it is, and what it says of control to the nanosecond."""
        info, status = self._info, self._status
        if info.name and status is not None and status.stamp != Time():
            self._identity = (info.name, info.model, status.stamp)
        self._look()

    def _on_outcome(self, outcome: Outcome) -> None:
        self._stopping.on_outcome(outcome)
        if outcome.phase == "accepted" and self._stopping.rests:
            self._done.set()
        self._look()

    # what is known

    @property
    def _has_none(self) -> bool:
        """It has no STOP of its own, as far as is known."""
        if self._offer is not None:
            return not self._offer.ours
        return self._client.foreign

    @property
    def _only_zero(self) -> bool:
        """It is known to have no STOP of its own."""
        return self._offer is not None and not self._offer.ours

    @property
    def _drive(self) -> str | None:
        return DRIVE if self._offer is None else self._offer.drive

    @property
    def _stamped(self) -> bool:
        return self._offer is not None and self._offer.stamped

    def _look(self) -> None:
        phase, sentence = self._judged()
        self.report = Report(
            phase,
            sentence,
            self._info.name,
            self._reached,
            self._has_none,
            self._identity,
            self._proven,
        )

    def _judged(self) -> tuple[str, str]:
        if self._reached and self._has_none:
            drives = self._drive is not None
            phase = self._zero.phase if drives else "no_answer"
            return phase, self._zero.sentence(drives)
        verdict = self._stopping.verdict
        return verdict.phase, verdict.sentence
