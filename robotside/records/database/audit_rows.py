"""Rows of the audit log: chained by their hashes, written and never kept in memory.

Each row's hash is made of the one before and of its own text, so that a row that is changed, added or taken out shows. Name and address
go into it as a salted digest only: they can be erased, and the chain still holds.
"""

from __future__ import annotations

import hashlib
import re
import secrets
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import TypeAlias

import msgspec
from sqlalchemy import delete, func, select, update
from sqlalchemy.orm import Session

from robotside.records.database.tables import AuditRow

__all__ = [
    "AUDIT",
    "ERASED",
    "PRUNED",
    "UNPROVEN",
    "Audited",
    "Erase",
    "Prune",
    "chained",
    "erased",
    "first_bad",
    "head",
    "read_file",
    "salvage",
    "sound_hash",
    "write_audit",
]

AUDIT = "audit"
"""The table."""
ERASED = "erased"
"""Stands for the name of a person that was erased."""
UNPROVEN = " (not proven)"
"""Behind a name that somebody only says to have."""
PRUNED = "pruned"
"""The operation of the row that stands for all before it, which were let go of; its hash is that of the last of them."""
_HASH = re.compile(r"[0-9a-f]{64}")


class Audited(msgspec.Struct, frozen=True):
    """One row; texts are those of `robotside.records.audit.Entry`."""

    id: int
    """Its number, from 1 on, without a gap."""
    stamp: int
    """When it was [ns since the epoch], operators' clock."""
    person_id: str
    name: str
    role: str
    way: str
    address: str
    operation: str
    outcome: str
    parameters: str
    salt: str = ""
    """Of the digest; empty once name and address are erased."""
    digest: str = ""
    """Of name and address."""
    hash: str = ""
    """Of the row before and of this one, name and address by their digest."""


class Prune(msgspec.Struct, frozen=True):
    """In the place of a row: all before it are let go of, and it says so."""


class Erase(msgspec.Struct, frozen=True):
    """In the place of a row: name and address of a person are erased in all rows."""

    name: str


Change: TypeAlias = Audited | Prune | Erase


def chained(row: Audited, before: str) -> Audited:
    """The row with a fresh salt, its digest and its hash; `before` is the hash of the one before, empty for none."""
    salt = secrets.token_hex(16)
    row = msgspec.structs.replace(row, salt=salt, digest=_digest(salt, row))
    return msgspec.structs.replace(row, hash=_hash(row, before))


def erased(row: Audited) -> Audited:
    """The row without name and address."""
    return msgspec.structs.replace(row, name=ERASED, address="", salt="")


def first_bad(rows: Iterable[Audited]) -> int | None:
    """The number of the first row that is not as it was written, or after which rows are missing; None when all are whole."""
    before: Audited | None = None
    for row in rows:
        begins = before is None and (row.id == 1 or row.operation == PRUNED)
        if before is None and not begins:
            return row.id
        if before is not None and row.id != before.id + 1:
            return before.id + 1
        whole = _hash(row, before.hash if before else "") == row.hash and _named(row)
        if not whole and not (begins and row.operation == PRUNED):
            return row.id
        before = row
    return None


def _named(row: Audited) -> bool:
    """Name and address are those that were written, or erased."""
    if not row.salt:
        return (row.name, row.address) == (ERASED, "")
    return _digest(row.salt, row) == row.digest


def _digest(salt: str, row: Audited) -> str:
    return _of(salt, row.name, row.address)


def _hash(row: Audited, before: str) -> str:
    said = (row.person_id, row.role, row.way, row.operation, row.outcome, row.parameters, row.digest)
    return _of(before, row.id, row.stamp, *said)


def _of(*parts: str | int) -> str:
    return hashlib.sha256(msgspec.json.encode(parts)).hexdigest()


def sound_hash(text: object) -> str:
    """A hash that was read; empty when it is none."""
    return text if isinstance(text, str) and _HASH.fullmatch(text) else ""


def head(session: Session) -> dict[int | str, str]:
    """The hash of the newest row by its number; nothing when there is none."""
    newest = session.scalar(select(func.max(AuditRow.id)))
    if newest is None:
        return {}
    return {int(newest): sound_hash(session.scalar(select(AuditRow.hash).where(AuditRow.id == newest)))}


def write_audit(session: Session, number: int | str, change: Change) -> None:
    """Write one row, or change those that are there; the caller commits."""
    if isinstance(change, Audited):
        session.merge(AuditRow(**msgspec.structs.asdict(change)))
        return
    session.flush()
    if isinstance(change, Erase):
        named = update(AuditRow).where(AuditRow.name.in_((change.name, change.name + UNPROVEN)))
        session.execute(named.values(name=ERASED, address="", salt=""))
        return
    session.execute(delete(AuditRow).where(AuditRow.id < number))
    gone = dict.fromkeys(("person_id", "name", "role", "way", "address", "outcome", "parameters", "salt"), "")
    session.execute(update(AuditRow).where(AuditRow.id == number).values(operation=PRUNED, digest="", **gone))


_COLUMNS = Audited.__struct_fields__
_ALL = f"SELECT {', '.join(_COLUMNS)} FROM {AUDIT} ORDER BY id"  # noqa: S608 - names of our own


def read_file(path: Path) -> Iterator[Audited]:
    """All rows of a SQLite file, oldest first, while others write; raises sqlite3.Error when it cannot be read."""
    with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as database:
        for row in database.execute(_ALL):
            yield Audited(*row)


def salvage(source: Path) -> list[Audited]:
    """The rows of a broken file as far as they can be read and their chain holds."""
    found: list[Audited] = []
    with suppress(sqlite3.Error, UnicodeDecodeError):  # those before it are worth having
        found.extend(read_file(source))
    bad = first_bad(found)
    return found if bad is None else [row for row in found if row.id < bad]
