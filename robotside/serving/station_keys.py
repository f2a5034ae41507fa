"""The keys of one station: its certificate, its people, and pairing."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from urllib.parse import urlsplit

from bridge.core.codes import Code
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Service
from robotside.core.config import TrustSettings
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.gateways.usage_sheet.pasted import RobotKey
from robotside.services.people_services import people_services
from robotside.station.station import Station
from robotside.trust.certificate import Certificate
from robotside.trust.pair_requests import PairAnswer, PairRequest, PairRequests
from robotside.trust.pairing import Offer, Pairing
from robotside.trust.people_file import PeopleFile
from robotside.trust.trust import CHECK_PERIOD, Trust, is_own_machine

__all__ = ["StationKeys"]

log = logging.getLogger(__name__)

CLAIM_LENGTH = 32
"""Hex digits of the fingerprint that a HELLO claims."""


def _ignore(_: Offer) -> None:
    """Nobody shows it."""


class StationKeys:
    """What a station needs to know people, and people to know it."""

    def __init__(
        self,
        state: Path,
        station: Station,
        certificate: Certificate,
        settings: TrustSettings,
        *,
        plain: Role | None = None,
    ) -> None:
        """`state` is the directory of the people; who comes from elsewhere without a key has the role `plain`, None for none.

        Of such a role everybody is told by an event: handhelds that are paired would not notice it.
        """
        self.context = certificate.context()
        """For its sockets."""
        self.names = certificate.names
        """By which browsers may call the robot."""
        self.stop_from_pages = settings.stop_from_pages
        """Every web page of the world may press STOP."""
        self.key = RobotKey(certificate.pin, certificate.fingerprint)
        """By what clients know it."""
        self.pin = self.key.pin
        """Hash of its public key, for curl."""
        self.claim = certificate.fingerprint[:CLAIM_LENGTH]
        """What its HELLO says of its certificate."""
        self.trust = Trust(PeopleFile(state), station.clock, settings, plain=plain)
        self.pairing = Pairing(certificate.fingerprint, station.info.name, station.clock)
        self.on_offer: Callable[[Offer], None] = _ignore
        """Shows the offer for a handheld when it is opened, or has another code."""
        self.pairing.on_change = self._show
        self._requests = PairRequests(state, self._answer)
        self._station = station
        self._ended, self._failed = asyncio.Event(), False
        if plain is not None:
            said = f"Everybody in the network may {plain.word} without a key."
            station.events.say("control", Notice(Code.TRUST_PLAIN, said, role=plain.word), "warn")

    def services(self, connected: Callable[[], set[str]]) -> Iterable[Service]:
        """Those of people; `connected` gives the ids of who is there."""
        station = self._station
        return people_services(
            self.trust,
            self.pairing,
            robot=station.info.name,
            now=station.clock,
            say=station.events.say,
            connected=connected,
        )

    def plain_from(self, host: str) -> bool:
        """Who comes from `host` may speak without TLS: programs of this machine, others where that was allowed."""
        return self.trust.plain_role is not None or is_own_machine(host)

    def reached_at(self, url: str) -> None:
        """The rosbridge socket listens at `url`; pairing links name it."""
        parts = urlsplit(url)
        self.pairing.host, self.pairing.port = parts.hostname or "", parts.port or 0

    async def run(self) -> None:
        """Follow the people and the requests of the command line until `end`."""
        while not self._ended.is_set():
            try:
                await self.trust.step()
                self._requests.update()
            except Exception:  # the robot is served all the same
                if not self._failed:
                    log.exception("The list of people is not followed")
                self._failed = True
            with suppress(TimeoutError):
                await asyncio.wait_for(self._ended.wait(), CHECK_PERIOD)

    def end(self) -> None:
        """Have `run` come to its end."""
        self._ended.set()

    def close(self) -> None:
        """Let go of the people; waits for the disk."""
        self.trust.close()

    def _show(self) -> None:
        if self.pairing.offer is not None:
            self.on_offer(self.pairing.offer)

    def _answer(self, request: PairRequest) -> PairAnswer:
        """Open pairing as the command line asks."""
        try:
            role = Role.read(request.role)
            guest = request.duration > 0
            offer = self.pairing.invite(role, request.duration) if guest else self.pairing.open(role)
        except (ValueError, Refusal) as problem:
            return PairAnswer(request.nonce, problem=str(problem))
        until = offer.ends if guest else offer.open_until
        return PairAnswer(request.nonce, self.pairing.link(offer), offer.code, until)
