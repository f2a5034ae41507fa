"""The services by which handhelds are paired, and people are listed, invited and removed.

Those of pairing are for strangers, and none of them is kept by `CommandService`: an answer has a key in it. A call that is
sent again pairs nobody again, since links and codes are for one use.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import (
    GetMeRequest,
    GetMeResponse,
    GetPeopleRequest,
    GetPeopleResponse,
    InviteGuestRequest,
    InviteGuestResponse,
    InvitePersonRequest,
    InvitePersonResponse,
    PairBeginRequest,
    PairBeginResponse,
    PairFinishRequest,
    PairFinishResponse,
    PairScanRequest,
    PairScanResponse,
    Person,
    RemovePersonRequest,
    RemovePersonResponse,
)
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.records.events import Say
from robotside.trust.pairing import Offer, Pairing
from robotside.trust.people import Person as Kept
from robotside.trust.people import checked_name
from robotside.trust.people_file import Unkept
from robotside.trust.qr import as_rows
from robotside.trust.trust import Trust

__all__ = ["people_services"]


def people_services(
    trust: Trust,
    pairing: Pairing,
    *,
    robot: str,
    now: Callable[[], float],
    say: Say,
    connected: Callable[[], set[str]],
) -> Iterable[Service]:
    """The services of `robot`, its name; `now` is the operators' clock [s], `connected` gives the ids of who is there."""
    pair, people = _Pair(trust, pairing, robot, say), _People(trust, pairing, now, say, connected)
    yield Service("/pair/scan", "pilothouse_msgs/PairScan", PairScanRequest, PairScanResponse, pair.scan)
    yield Service("/pair/begin", "pilothouse_msgs/PairBegin", PairBeginRequest, PairBeginResponse, pair.begin)
    yield Service(
        "/pair/finish", "pilothouse_msgs/PairFinish", PairFinishRequest, PairFinishResponse, pair.finish
    )
    yield Service("/people/me", "pilothouse_msgs/GetMe", GetMeRequest, GetMeResponse, people.me)
    yield Service(
        "/people/list", "pilothouse_msgs/GetPeople", GetPeopleRequest, GetPeopleResponse, people.all
    )
    yield Service(
        "/people/remove",
        "pilothouse_msgs/RemovePerson",
        RemovePersonRequest,
        RemovePersonResponse,
        people.remove,
    )
    yield Service(
        "/people/guest",
        "pilothouse_msgs/InviteGuest",
        InviteGuestRequest,
        InviteGuestResponse,
        people.guest,
    )
    yield Service(
        "/people/invite",
        "pilothouse_msgs/InvitePerson",
        InvitePersonRequest,
        InvitePersonResponse,
        people.invite,
    )


class _Pair:
    """What strangers may ask."""

    def __init__(self, trust: Trust, pairing: Pairing, robot: str, say: Say) -> None:
        self._trust, self._pairing, self._robot, self._say = trust, pairing, robot, say

    async def scan(self, client: Operator, asked: PairScanRequest) -> PairScanResponse:
        """Pair with a link's secret."""
        _need_tls(client)
        _checked(asked.name)
        offer = self._pairing.scan(asked.secret, client.address)
        person, token = await self._add(offer, asked.name)
        return PairScanResponse(person.id, token, person.role, _none_as_nan(person.ends), self._robot)

    def begin(self, client: Operator, asked: PairBeginRequest) -> PairBeginResponse:
        """Begin to pair with a code."""
        _need_tls(client)
        return PairBeginResponse(self._pairing.begin(client.id, client.address, asked.tag, asked.message))

    async def finish(self, client: Operator, asked: PairFinishRequest) -> PairFinishResponse:
        """Pair with a code whose proof is right."""
        _need_tls(client)
        _checked(asked.name)
        offer, confirmation = self._pairing.finish(client.id, asked.confirmation)
        person, token = await self._add(offer, asked.name)
        ends = _none_as_nan(person.ends)
        return PairFinishResponse(confirmation, person.id, token, person.role, ends, self._robot)

    async def _add(self, offer: Offer, name: str) -> tuple[Kept, str]:
        try:
            person, token = await self._trust.add(name, offer.role, offer.kind, offer.ends)
        except Unkept as problem:
            self._pairing.restore(offer)
            raise Refused(Notice(Code.TRUST_UNKEPT, f"Not paired: {problem}")) from problem
        except Refusal as refusal:
            self._pairing.restore(offer)
            raise Refused(refusal.notice) from refusal
        said = f"{person.name} was paired and may {person.role}."
        paired = Notice(Code.PERSON_PAIRED, said, actor_id=person.id, name=person.name, role=person.role)
        self._say("control", paired)
        return person, token


class _People:
    """What those ask who are known already."""

    def __init__(
        self,
        trust: Trust,
        pairing: Pairing,
        now: Callable[[], float],
        say: Say,
        connected: Callable[[], set[str]],
    ) -> None:
        self._trust, self._pairing, self._now = trust, pairing, now
        self._say, self._connected = say, connected

    def me(self, client: Operator, _: GetMeRequest) -> GetMeResponse:
        """Who the caller is."""
        who = client.identity
        ends = who.ends if math.isfinite(who.ends) else math.nan
        return GetMeResponse(who.id, who.name, client.role(self._now()).word, ends, who.proven, client.secure)

    def all(self, _: Operator, __: GetPeopleRequest) -> GetPeopleResponse:
        """Everybody."""
        there = self._connected()
        return GetPeopleResponse([_told(each, each.id in there) for each in self._trust.people])

    async def remove(self, client: Operator, asked: RemovePersonRequest) -> RemovePersonResponse:
        """Forget a person; everybody may go, and who manages may send others away."""
        own = client.identity.proven and client.identity.id == asked.id
        if not own and client.role(self._now()) < Role.MANAGE:
            role = client.role(self._now()).word
            said = f"To remove others needs the role manage; you have {role}."
            operation = "call /people/remove"
            raise Refused(
                Notice(Code.TRUST_ROLE, said, operation=operation, role=role, needed=Role.MANAGE.word)
            )
        try:
            gone = await self._trust.remove(asked.id)
        except Unkept as problem:
            said = f"Removed until the next start only: {problem}"
            raise Refused(Notice(Code.TRUST_UNKEPT, said)) from problem
        except Refusal as refusal:
            raise Refused(refusal.notice) from refusal
        said = f"{gone.name} was removed: its key opens nothing any more."
        self._say("control", Notice(Code.PERSON_REMOVED, said, actor_id=gone.id, name=gone.name), "warn")
        return RemovePersonResponse(gone.name)

    def guest(self, client: Operator, asked: InviteGuestRequest) -> InviteGuestResponse:
        """Open pairing for a guest."""
        _need_tls(client)
        try:
            offer = self._pairing.invite(_role(asked.role or Role.WATCH.word), asked.duration)
        except Refusal as refusal:
            raise Refused(refusal.notice) from refusal
        self._opened(offer, "a guest")
        link = self._pairing.link(offer)
        return InviteGuestResponse(link, offer.code, offer.ends, as_rows(link))

    def invite(self, client: Operator, asked: InvitePersonRequest) -> InvitePersonResponse:
        """Open pairing for a handheld."""
        _need_tls(client)
        try:
            offer = self._pairing.open(_role(asked.role or Role.DRIVE.word))
        except Refusal as refusal:
            raise Refused(refusal.notice) from refusal
        self._opened(offer, "a handheld")
        link = self._pairing.link(offer)
        return InvitePersonResponse(link, offer.code, offer.open_until, as_rows(link))

    def _opened(self, offer: Offer, who: str) -> None:
        said = f"Pairing is open for {who} that may {offer.role.word}."
        self._say("control", Notice(Code.PAIRING_OPENED, said, role=offer.role.word))


def _need_tls(client: Operator) -> None:
    if not client.secure:
        said = "Keys are given over TLS only: connect by wss:// or https://."
        raise Refused(Notice(Code.TRUST_INSECURE, said))


def _checked(name: str) -> None:
    try:
        checked_name(name)
    except Refusal as refusal:
        raise Refused(refusal.notice) from refusal


def _role(word: str) -> Role:
    try:
        return Role.read(word)
    except ValueError as error:
        raise Refusal(Notice(Code.TRUST_ROLE_INVALID, str(error)[:200], role=word[:20])) from error


def _told(person: Kept, connected: bool) -> Person:
    ends, seen = _none_as_nan(person.ends), _none_as_nan(person.last_seen)
    return Person(person.id, person.name, person.role, person.kind, person.created, ends, seen, connected)


def _none_as_nan(moment: float | None) -> float:
    return math.nan if moment is None else moment
