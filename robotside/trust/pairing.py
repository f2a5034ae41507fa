"""Pairing: for ten minutes and one use the robot takes a handheld that shows the link's secret or proves the code.

The code is six digits: few enough to guess, so it is never sent. SPAKE2 has each side prove that it knows the code, gives
who sits between one guess for each try, and binds both sides to the certificate between them.
"""

from __future__ import annotations

import hmac
import math
import secrets
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

from spake2 import SPAKE2_B, SPAKEError
from spake2.ed25519_basic import NotOnCurve

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.trust.pairing import CODE_DIGITS, TAG_DIGITS, PairLink, confirmations, sides
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.trust.attempt_limit import AttemptLimit, host_of
from robotside.trust.people import GUEST, HANDHELD

__all__ = ["OPEN_TIME", "Offer", "Pairing"]

OPEN_TIME = 600.0
"""How long pairing is open [s]."""
MAX_TRIES = 5
"""Wrong codes until there is another code."""
FIRST_PAUSE, MAX_PAUSE = 10.0, 3600.0
"""Without codes after so many wrong ones [s]; each pause is twice the one before."""
MAX_BEGUN, BEGUN_PERIOD = 10, 60.0
"""Tries of one host in as many seconds, right or wrong."""
MAX_SESSIONS, MAX_SESSIONS_OF_HOST = 16, 2
"""Tries that have begun and not ended."""
SESSION_TIMEOUT = 60.0
"""A try that has begun ends within this [s]."""
MAX_GUESTS = 8
"""Guests that are invited and not yet there."""
MIN_GUEST_TIME, MAX_GUEST_TIME = 60.0, 86400.0
"""How long a guest's role may last [s]."""

_MESSAGE_LENGTH = 33
"""Bytes of a message of SPAKE2."""
_CLOSED = (
    "Pairing is not open here, or this link or code was used: open pairing on the robot and take the new one."
)


@dataclass(slots=True)
class Offer:
    """Somebody may be paired."""

    role: Role
    kind: str
    """`handheld` or `guest`."""
    open_until: float
    """[s], operators' clock."""
    ends: float = math.inf
    """When the role ends [s], operators' clock."""
    tag: str = ""
    """Two digits before the code of a guest; empty for the code of six."""
    secret: str = field(default_factory=lambda: secrets.token_urlsafe(16), repr=False)
    """Of the link."""
    digits: str = field(default_factory=lambda: _digits(CODE_DIGITS), repr=False)
    wrong: int = 0
    """Wrong codes since the code is this one."""

    @property
    def code(self) -> str:
        """As people type it."""
        return f"{self.tag}{self.digits}"


@dataclass(slots=True)
class _Session:
    """A try that has begun."""

    host: str
    until: float
    offer: Offer
    digits: str
    key: bytes = field(repr=False)


def _ignore() -> None:
    """Nobody shows it."""


class Pairing:
    """What a robot offers to handhelds that it does not know yet; belongs to one thread."""

    def __init__(self, fingerprint: str, name: str, now: Callable[[], float]) -> None:
        """`fingerprint` is that of the robot's certificate, `name` the robot's for people, `now` the operators' clock [s]."""
        self._fingerprint, self._name, self._now = fingerprint, name, now
        self.host, self.port = "", 0
        """Where handhelds reach the rosbridge socket; set once it listens."""
        self.on_change: Callable[[], None] = _ignore
        """The offer for a handheld is open, has another code or is closed."""
        self._open: Offer | None = None
        self._guests: dict[str, Offer] = {}
        """By tag."""
        self._sessions: OrderedDict[Hashable, _Session] = OrderedDict()
        """By connection, oldest first."""
        self._begun = AttemptLimit(MAX_BEGUN, BEGUN_PERIOD)
        self._pause, self._paused_until = FIRST_PAUSE, -math.inf

    @property
    def offer(self) -> Offer | None:
        """The one that is open for a handheld; None when there is none."""
        self._forget_old()
        return self._open

    def open(self, role: Role) -> Offer:
        """Open for one handheld from now on; an offer that was open before is closed."""
        if role is Role.NONE:
            raise Refusal(
                Notice(Code.TRUST_ROLE_INVALID, "A handheld watches, drives or manages.", role="none")
            )
        self._open = Offer(role, HANDHELD, self._now() + OPEN_TIME)
        self.on_change()
        return self._open

    def invite(self, role: Role, duration: float) -> Offer:
        """Open for one guest, whose role ends after `duration` [s] whenever it comes; Refusal for what is not allowed."""
        if role not in (Role.WATCH, Role.DRIVE):
            said = f"A guest watches or drives, not {role.word}."
            raise Refusal(Notice(Code.TRUST_ROLE_INVALID, said, role=role.word))
        if not MIN_GUEST_TIME <= duration <= MAX_GUEST_TIME:
            said = f"A guest stays {MIN_GUEST_TIME:g} to {MAX_GUEST_TIME:g} s, not {duration:g} s."
            raise Refusal(Notice(Code.TRUST_DURATION_INVALID, said, duration=duration))
        self._forget_old()
        while len(self._guests) >= MAX_GUESTS:
            del self._guests[next(iter(self._guests))]
        tag = _digits(TAG_DIGITS)
        while tag in self._guests:
            tag = _digits(TAG_DIGITS)
        ends = self._now() + duration
        self._guests[tag] = offer = Offer(role, GUEST, ends, ends, tag)
        return offer

    def close(self) -> None:
        """Nobody is paired from now on, guests included."""
        self._guests.clear()
        self._sessions.clear()
        if self._open is not None:
            self._open = None
            self.on_change()

    def link(self, offer: Offer) -> str:
        """The link of an offer, for its QR code."""
        return PairLink(self.host, self.port, self._fingerprint, offer.secret, self._name).text

    def scan(self, secret: str, address: str) -> Offer:
        """The offer whose link has that secret, which is used up by this. Raises Refused."""
        host, now = host_of(address), self._now()
        self._check_host(host, now)
        shown = secret.encode(errors="replace")
        found = [each for each in self._offers() if hmac.compare_digest(each.secret.encode(), shown)]
        if not found:
            self._begun.note(host, now)
            raise Refused(Notice(Code.TRUST_PAIRING_CLOSED, _CLOSED))
        self._use_up(found[0])
        return found[0]

    def begin(self, connection: Hashable, address: str, tag: str, message: str) -> str:
        """Begin a try with the code with that `tag`: the robot's message for the handheld's, both in hex. Raises Refused."""
        host, now = host_of(address), self._now()
        self._check_host(host, now)
        self._begun.note(host, now)
        offer = next((each for each in self._offers() if each.tag == tag), None)
        if offer is None:
            raise Refused(Notice(Code.TRUST_PAIRING_CLOSED, _CLOSED))
        if now < self._paused_until:
            raise _paused(self._paused_until - now)
        handheld, robot = sides(self._fingerprint)
        spake = SPAKE2_B(offer.digits.encode(), idA=handheld, idB=robot)
        try:
            own, theirs = spake.start(), bytes.fromhex(message[: 2 * _MESSAGE_LENGTH + 1])
            if len(theirs) != _MESSAGE_LENGTH:
                raise ValueError("wrong length")
            key = spake.finish(theirs)
        except (ValueError, NotOnCurve, SPAKEError) as error:
            raise Refused("The message is none of SPAKE2.") from error
        self._keep(connection, _Session(host, now + SESSION_TIMEOUT, offer, offer.digits, key))
        sent: str = own.hex()
        return sent

    def finish(self, connection: Hashable, confirmation: str) -> tuple[Offer, str]:
        """End a try: the offer, which is used up by this, and the robot's own confirmation. Raises Refused.

        `confirmation` shows that the handheld has the code and sees the robot's own certificate.
        """
        session = self._sessions.pop(connection, None)
        offers = self._offers()
        fits = session is not None and any(session.offer is each for each in offers)
        if (
            session is None
            or not fits
            or session.digits != session.offer.digits
            or self._now() >= session.until
        ):
            raise Refused(Notice(Code.TRUST_PAIRING_CLOSED, _CLOSED))
        if self._now() < self._paused_until:
            raise _paused(self._paused_until - self._now())
        theirs, own = confirmations(session.key)
        if not hmac.compare_digest(theirs.encode(), confirmation.encode(errors="replace")):
            self._count_wrong(session.offer)
            said = "The code is wrong, or another computer answers in place of the robot."
            raise Refused(Notice(Code.TRUST_CODE_WRONG, said))
        self._use_up(session.offer)
        return session.offer, own

    def restore(self, offer: Offer) -> None:
        """Have `offer` open again: who used it up could not be kept."""
        if offer.kind == GUEST:
            self._guests.setdefault(offer.tag, offer)
        elif self._open is None:
            self._open = offer
            self.on_change()

    def _offers(self) -> list[Offer]:
        self._forget_old()
        return [*([self._open] if self._open else []), *self._guests.values()]

    def _forget_old(self) -> None:
        now = self._now()
        for tag in [tag for tag, offer in self._guests.items() if now >= offer.open_until]:
            del self._guests[tag]
        if self._open is not None and now >= self._open.open_until:
            self._open = None
            self.on_change()

    def _use_up(self, offer: Offer) -> None:
        if offer is self._open:
            self._open, self._pause = None, FIRST_PAUSE
            self.on_change()
        else:
            self._guests.pop(offer.tag, None)

    def _keep(self, connection: Hashable, session: _Session) -> None:
        """Keep a try; the oldest of its host, or of all, goes when there are too many."""
        self._sessions.pop(connection, None)
        of_host = [each for each, kept in self._sessions.items() if kept.host == session.host]
        for old in of_host[: len(of_host) - MAX_SESSIONS_OF_HOST + 1]:
            del self._sessions[old]
        while len(self._sessions) >= MAX_SESSIONS:
            self._sessions.popitem(last=False)
        self._sessions[connection] = session

    def _count_wrong(self, offer: Offer) -> None:
        offer.wrong += 1
        if offer.wrong < MAX_TRIES:
            return
        self._paused_until = self._now() + self._pause
        self._pause = min(2.0 * self._pause, MAX_PAUSE)
        if offer.kind == GUEST:  # who invited it does not see another code
            self._guests.pop(offer.tag, None)
            return
        offer.wrong, offer.digits = 0, _digits(CODE_DIGITS)
        self.on_change()

    def _check_host(self, host: str, now: float) -> None:
        if self._begun.is_reached(host, now):
            said = f"Too many tries came from your address: try again in {BEGUN_PERIOD:.0f} s."
            raise Refused(Notice(Code.TRUST_ATTEMPTS, said, seconds=BEGUN_PERIOD))


def _paused(left: float) -> Refused:
    said = (
        f"Too many wrong codes were given: try again in {left:.0f} s with the new code, or scan the QR code."
    )
    return Refused(Notice(Code.TRUST_PAIRING_PAUSED, said, seconds=left))


def _digits(count: int) -> str:
    return f"{secrets.randbelow(10**count):0{count}d}"
