"""The people of a robot as its gate: who a connection is, what each may do, and the end of a role."""

from __future__ import annotations

import asyncio
import hashlib
import hmac
import ipaddress
import logging
import math
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import NoReturn, TypeVar

from msgspec.structs import replace

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import STRANGER, Identity, Role
from robotside.core.config import TrustSettings
from robotside.core.notice import Notice
from robotside.trust.attempt_limit import AttemptLimit, host_of
from robotside.trust.people import HANDHELD, MAX_TOKEN, Person, added, make_person, removed
from robotside.trust.people_file import PeopleFile, Unkept
from robotside.trust.permissions import needed_role

__all__ = ["CHECK_PERIOD", "Trust", "is_own_machine"]

log = logging.getLogger(__name__)

A = TypeVar("A")
R = TypeVar("R")

MAX_WRONG, WRONG_PERIOD = 5, 60.0
"""Wrong keys of one host in as many seconds; after them no further one is looked at."""
MAX_WRONG_BEHIND = 30
"""Wrong keys of all clients behind one broker in `WRONG_PERIOD`: each name there has its own, and names can be made up."""
MAX_LOGGED, LOG_PERIOD = 20, 60.0
"""Lines about wrong keys in as many seconds, whoever shows them."""
CHECK_PERIOD = 0.5
"""Between two calls of `Trust.step` [s]."""
SEEN_PERIOD = 60.0
"""Between two writes of who was seen when [s]."""

_WRONG = "This robot does not accept the key: pair again, or ask who manages the robot."
_ALL = "all"


def _ignore(_: Iterable[str]) -> None:
    """Nobody has to be told."""


class Trust:
    """The gate of one robot; belongs to one thread, in which it never waits for the disk but at the start."""

    def __init__(
        self,
        file: PeopleFile,
        now: Callable[[], float],
        settings: TrustSettings,
        *,
        plain: Role | None = None,
    ) -> None:
        """`now` is the operators' clock [s]. Who comes without a key from elsewhere has the role `plain`, None for a stranger."""
        self._file, self._now, self._plain = file, now, plain
        self._local, self._stop_role = Role.read(settings.local_role), Role.read(settings.stop_role)
        self.on_lost: Callable[[Iterable[str]], None] = _ignore
        """Takes the ids of people who may less than before, or nothing any more."""
        self._people: dict[str, Person] = {}
        self._verified: dict[str, tuple[str, bytes]] = {}
        """By id, the kept hash and that of the token that has proven it: reconnecting costs no scrypt."""
        self._wrong = AttemptLimit(MAX_WRONG, WRONG_PERIOD)
        self._wrong_forgeable = AttemptLimit(MAX_WRONG, WRONG_PERIOD)
        """Of addresses that nothing proves, by UDP: they lock out nobody who connects."""
        self._wrong_behind = AttemptLimit(MAX_WRONG_BEHIND, WRONG_PERIOD)
        self._logged = AttemptLimit(MAX_LOGGED, LOG_PERIOD)
        self._seen: dict[str, float] = {}
        """Who was seen when [s], not yet written."""
        self._ended: frozenset[str] = frozenset()
        self._removed: set[str] = set()
        """Who is gone whatever the file says, should it be impossible to write."""
        self._signature, self._is_stale = file.signature, False
        self._worker = ThreadPoolExecutor(1, "people")
        self._next_write = now() + SEEN_PERIOD
        self._load()

    @property
    def people(self) -> tuple[Person, ...]:
        """Everybody who is known, oldest first, with when each was last seen."""
        return tuple(self._with_last_seen(self._people.values()))

    @property
    def plain_role(self) -> Role | None:
        """Of who comes from elsewhere without a key, by TLS or not; None where nobody has one."""
        return self._plain

    def admit(self, address: str, *, trusted: bool) -> Identity:
        """Who a client without a token is: somebody on this machine, anybody where that is allowed, or a stranger."""
        if not trusted:
            return STRANGER
        if is_own_machine(address.rpartition(":")[0].strip("[]")):
            return Identity("", "", self._local)
        # by TLS nobody may less than without it: a handheld that is not paired comes by the address of the HELLO
        return STRANGER if self._plain is None else Identity("", "", self._plain)

    def identify(self, token: str, address: str, client: str = "", *, forgeable: bool = False) -> Identity:
        """Whose token it is; raises Refused, with one sentence for unknown, wrong and ended ones: the log has which.

        `client` is the name of who shows it where `address` is that of a broker with many behind it.
        Wrong ones from a `forgeable` address, which nothing proves, are counted apart.
        """
        now, source = self._now(), (host_of(address), client)
        id, _, secret = token[: MAX_TOKEN + 1].partition(".")
        person = self._people.get(id)
        digest = hashlib.sha256(token.encode(errors="replace")).digest()
        if person is None or not self._has_proven(person, digest):
            wrong = self._wrong_forgeable if forgeable else self._wrong
            self._check_attempts(source, now, wrong)
            if person is None:
                self._note_wrong(source, now, wrong)
                self._refuse(address, "unknown", now)
            if not self._proves(person, token, secret, digest):
                self._note_wrong(source, now, wrong)
                self._refuse(address, f"not the key of {person.name}", now)
        if self._has_ended(person, now):
            self._refuse(address, f"of {person.name}, whose role has ended", now)
        self._seen[person.id] = now
        return person.identity

    def needed(self, verb: str, name: str) -> Role:
        """The role that an operation needs; of STOP what the settings say."""
        if (verb, name) in (("call", "/stop"), ("page", "/stop")):
            return self._stop_role
        return needed_role(verb, name)

    async def add(self, name: str, role: Role, kind: str, ends: float = math.inf) -> tuple[Person, str]:
        """A new person and its token, once it is kept; Refusal for a bad name, or where there is no room. Raises Unkept.

        A handheld of a robot that knows none is its owner: it has the role manage.
        """
        made, token = make_person(name, role, kind, now=self._now(), ends=ends)

        def add(people: Iterable[Person]) -> tuple[Person, ...]:
            nonlocal made
            known = tuple(people)
            if kind == HANDHELD and all(each.kind != HANDHELD for each in known):
                made = replace(made, role=Role.MANAGE.word)
            return added(known, made)

        self._take(await self._in_worker(self._file.change, add))
        return made, token

    async def remove(self, id: str) -> Person:
        """Forget a person: at once, and then on the disk. Refusal when nobody has that id; raises Unkept."""
        left, gone = removed(tuple(self._people.values()), id)
        self._removed.add(gone.id)
        self._take(left)
        self._take(await self._in_worker(self._file.change, partial(_without, id=gone.id)))
        return gone

    async def step(self) -> None:
        """Follow the file, end roles in time, and keep now and then who was seen; call it every `CHECK_PERIOD`."""
        self.update()
        if self._now() >= self._next_write:
            self._next_write = self._now() + SEEN_PERIOD
            seen = dict(self._seen)
            self._forget_seen(seen if await self._in_worker(self._write_seen, seen) else {})

    def update(self) -> None:
        """Take in what another program has changed in the file, and tell of those whose role has ended."""
        signature = self._file.signature
        if self._is_stale or signature != self._signature:
            self._signature, self._is_stale = signature, False
            self._load()
        now = self._now()
        ended = frozenset(id for id, person in self._people.items() if self._has_ended(person, now))
        fresh, self._ended = ended - self._ended, ended
        if fresh:
            self.on_lost(fresh)

    def close(self) -> None:
        """Write who was seen when, and let the worker thread end; waits for the disk."""
        self._worker.shutdown()
        self._write_seen(dict(self._seen))

    async def _in_worker(self, call: Callable[[A], R], argument: A) -> R:
        """What `call` gives; the file is other than it was known to be afterwards."""
        try:
            return await asyncio.get_running_loop().run_in_executor(self._worker, call, argument)
        finally:
            self._is_stale = True

    def _write_seen(self, seen: Mapping[str, float]) -> bool:
        """Keep who was seen when; False when that cannot be done now."""
        try:
            if seen:
                self._file.change(lambda people: [_seen_at(each, seen.get(each.id)) for each in people])
        except Unkept as problem:
            log.info("Who was seen is not kept: %s", problem)
            return False
        return True

    def _forget_seen(self, written: Mapping[str, float]) -> None:
        self._seen = {id: when for id, when in self._seen.items() if written.get(id) != when}

    def _load(self) -> None:
        """Read the file; nobody is known while it cannot be read."""
        try:
            people = self._file.read()
        except Unkept as problem:
            log.warning("%s This robot lets nobody in until it can.", problem)
            people = ()
        if self._file.problem:
            log.warning("%s", self._file.problem)
            self._file.problem = ""
        self._take(people)

    def _take(self, people: Iterable[Person]) -> None:
        """These are known from now on; tell of those who lost something by it."""
        before = self._people
        self._people = {each.id: each for each in people if each.id not in self._removed}
        self._verified = {
            id: proof
            for id, proof in self._verified.items()
            if id in self._people and self._people[id].key == proof[0]
        }
        self._seen = {id: when for id, when in self._seen.items() if id in self._people}
        lost = [each.id for each in before.values() if _has_lost(each, self._people.get(each.id))]
        if lost:
            self.on_lost(lost)

    def _with_last_seen(self, people: Iterable[Person]) -> Iterable[Person]:
        return (_seen_at(each, self._seen.get(each.id)) for each in people)

    def _has_proven(self, person: Person, digest: bytes) -> bool:
        """The token with that digest has proven it before."""
        _, known = self._verified.get(person.id, ("", b""))
        return hmac.compare_digest(known, digest)

    def _proves(self, person: Person, token: str, secret: str, digest: bytes) -> bool:
        if len(token) > MAX_TOKEN or not token.isascii() or not person.has(secret):
            return False
        self._verified[person.id] = person.key, digest
        return True

    def _has_ended(self, person: Person, now: float) -> bool:
        """Its role has ended. A clock that is behind what was seen before is wrong, as of a robot without a network."""
        seen = max(each.last_seen or each.created for each in self._people.values())
        return max(now, seen) >= person.end

    def _check_attempts(self, source: tuple[str, str], now: float, wrong: AttemptLimit) -> None:
        host, client = source
        if wrong.is_reached(source, now) or (client and self._wrong_behind.is_reached(host, now)):
            whose = "under your name or by your broker" if client else "from your address"
            said = f"Too many wrong keys came {whose}: try again in {WRONG_PERIOD:.0f} s."
            raise Refused(Notice(Code.TRUST_ATTEMPTS, said, seconds=WRONG_PERIOD))

    def _note_wrong(self, source: tuple[str, str], now: float, wrong: AttemptLimit) -> None:
        host, client = source
        wrong.note(source, now)
        if client:
            self._wrong_behind.note(host, now)

    def _refuse(self, address: str, why: str, now: float) -> NoReturn:
        if not self._logged.is_reached(_ALL, now):
            self._logged.note(_ALL, now)
            log.warning("%s showed a key that is %s", address, why)
        raise Refused(Notice(Code.TRUST_KEY, _WRONG))


def _without(people: Iterable[Person], *, id: str) -> list[Person]:
    return [each for each in people if each.id != id]


def _seen_at(person: Person, when: float | None) -> Person:
    return person if when is None else replace(person, last_seen=when)


def _has_lost(before: Person, after: Person | None) -> bool:
    """It may less than before, sooner ends, or has another key."""
    if after is None or before.key != after.key or after.end < before.end:
        return True
    return Role.read(after.role) < Role.read(before.role)


def is_own_machine(host: str) -> bool:
    """Whether a client from `host`, an IP address with or without its zone, runs on the robot's own computer."""
    try:
        found = ipaddress.ip_address(host.partition("%")[0])
    except ValueError:
        return False
    mapped = found.ipv4_mapped if isinstance(found, ipaddress.IPv6Address) else None
    return (mapped or found).is_loopback
