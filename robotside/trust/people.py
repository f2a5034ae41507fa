"""People: who keeps a key of the robot, each with a role, and how a key is proven.

A key is a token `ID.SECRET`: the id is public, the secret is 32 random bytes that nobody but its owner keeps.
"""

from __future__ import annotations

import base64
import binascii
import hashlib
import hmac
import math
import secrets
from collections.abc import Sequence

import msgspec

from bridge.core.codes import Code
from bridge.core.identity import Identity, Role
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal

__all__ = [
    "GUEST",
    "HANDHELD",
    "MAX_NAME",
    "MAX_PEOPLE",
    "TOKEN",
    "Person",
    "added",
    "checked_name",
    "make_person",
    "read_people",
    "removed",
    "renamed",
]

MAX_PEOPLE = 200
MAX_NAME = 40
"""Characters of a name."""
MAX_TOKEN = 200
"""Characters of a token that is looked at."""
HANDHELD, TOKEN, GUEST = KINDS = ("handheld", "token", "guest")
"""What a person is: a paired handheld, a program with a token of its own, or a guest."""

_SECRET_BYTES = 32
_SALT_BYTES = 16
_COST = 2**10
"""Of scrypt, 3 ms: a secret of 256 random bits cannot be guessed whatever one guess costs, and the robot's loop, in which
STOP may wait, is held up no longer than that."""


class Person(msgspec.Struct, frozen=True):
    """Somebody whom the robot knows, as it is kept."""

    id: str
    """Public."""
    name: str
    """For people; several may have the same one."""
    role: str
    """`watch`, `drive` or `manage`."""
    kind: str
    """One of `KINDS`."""
    created: float
    """When it became known [s], operators' clock."""
    salt: str
    """Of its key's hash, in base64."""
    key: str
    """Hash of its secret, in base64."""
    ends: float | None = None
    """When its role ends [s], operators' clock; None when it does not."""
    last_seen: float | None = None
    """When it last proved who it is [s], operators' clock; None for never."""

    @property
    def identity(self) -> Identity:
        """Who it is to the robot's door."""
        return Identity(self.id, self.name, Role.read(self.role), self.end, proven=True)

    @property
    def end(self) -> float:
        """When its role ends [s], operators' clock; infinite when it does not."""
        return math.inf if self.ends is None else self.ends

    def has(self, secret: str) -> bool:
        """`secret` is that of its key; takes 3 ms and the same time for every wrong one."""
        salt, key = base64.b64decode(self.salt), base64.b64decode(self.key)
        return hmac.compare_digest(_hashed(secret, salt), key)


def make_person(
    name: str, role: Role, kind: str, *, now: float, ends: float = math.inf
) -> tuple[Person, str]:
    """A person that becomes known `now`, and its token, which is kept nowhere; Refusal for a name that is none.

    Its role ends at `ends`; both [s], operators' clock.
    """
    id, secret = secrets.token_hex(8), secrets.token_urlsafe(_SECRET_BYTES)
    salt = secrets.token_bytes(_SALT_BYTES)
    made = Person(
        id=id,
        name=checked_name(name),
        role=role.word,
        kind=kind,
        created=now,
        salt=base64.b64encode(salt).decode(),
        key=base64.b64encode(_hashed(secret, salt)).decode(),
        ends=ends if math.isfinite(ends) else None,
    )
    return made, f"{id}.{secret}"


def checked_name(name: str) -> str:
    """`name` without spaces round it; Refusal when it is empty, too long or cannot be shown on one line."""
    name = name.strip()
    if not name or len(name) > MAX_NAME or not name.isprintable():
        said = f"A name has 1 to {MAX_NAME} characters on one line, not {name[: MAX_NAME + 10]!r}."
        raise Refusal(Notice(Code.TRUST_NAME_INVALID, said, max=MAX_NAME))
    return name


def added(people: Sequence[Person], person: Person) -> tuple[Person, ...]:
    """With one more; Refusal when there is no room. Guests and tokens that have ended make room first."""
    if len(people) >= MAX_PEOPLE:
        people = [each for each in people if each.end > person.created]
    if len(people) >= MAX_PEOPLE:
        said = f"This robot knows {MAX_PEOPLE} people and no more: remove one first."
        raise Refusal(Notice(Code.TRUST_FULL, said, max=MAX_PEOPLE))
    return (*people, person)


def removed(people: Sequence[Person], who: str) -> tuple[tuple[Person, ...], Person]:
    """Without `who`, an id or a name that only one has, and who that was; Refusal for nobody and for several."""
    gone = _found(people, who)
    return tuple(each for each in people if each is not gone), gone


def renamed(people: Sequence[Person], who: str, name: str) -> tuple[tuple[Person, ...], Person]:
    """With another name for `who`, an id or a name that only one has, and who that is now; Refusal as `removed`."""
    before = _found(people, who)
    after = msgspec.structs.replace(before, name=checked_name(name))
    return tuple(after if each is before else each for each in people), after


def read_people(content: bytes) -> tuple[Person, ...]:
    """The people of a file's content; ValueError when it is damaged."""
    people = msgspec.json.decode(content, type=_Content).people
    for each in people:
        if Role.read(each.role) is Role.NONE or each.kind not in KINDS or not each.id:
            raise ValueError(f"{each.name!r} cannot be a person.")
        try:
            base64.b64decode(each.salt, validate=True), base64.b64decode(each.key, validate=True)
        except binascii.Error as error:
            raise ValueError(f"The key of {each.name!r} is damaged.") from error
    if len({each.id for each in people}) < len(people) or len(people) > MAX_PEOPLE:
        raise ValueError("An id is there twice, or there are too many.")
    return people


def written(people: Sequence[Person]) -> bytes:
    """The content of a file with these people."""
    return msgspec.json.format(msgspec.json.encode(_Content(tuple(people))), indent=1) + b"\n"


class _Content(msgspec.Struct, frozen=True):
    """What the file has."""

    people: tuple[Person, ...]


def _found(people: Sequence[Person], who: str) -> Person:
    found = [each for each in people if each.id == who] or [each for each in people if each.name == who]
    if len(found) == 1:
        return found[0]
    shown = who[:MAX_NAME]
    if found:
        ids = ", ".join(each.id for each in found)
        said = f"{len(found)} people are called {shown!r}; say which by its id: {ids}."
    else:
        said = f"This robot knows nobody called {shown!r}."
    raise Refusal(Notice(Code.TRUST_PERSON_UNKNOWN, said, name=shown))


def _hashed(secret: str, salt: bytes) -> bytes:
    return hashlib.scrypt(secret.encode(), salt=salt, n=_COST, r=8, p=1)
