"""Rows of the audit log: chained, pruned, and erased without a break."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import msgspec
import pytest

from robotside.records.database.audit_rows import Audited, chained, erased, first_bad, read_file, salvage
from robotside.records.opening import open_records


def chain(count: int) -> list[Audited]:
    rows: list[Audited] = []
    for number in range(1, count + 1):
        row = Audited(
            number, number * 10, "id-7", "Anna", "drive", "rosbridge", "192.0.2.1", "call /stop", "done", ""
        )
        rows.append(chained(row, rows[-1].hash if rows else ""))
    return rows


def changed(row: Audited, **what: object) -> Audited:
    return msgspec.structs.replace(row, **what)  # type: ignore[arg-type]


def test_a_whole_chain_has_no_bad_row() -> None:
    assert first_bad(chain(5)) is None
    assert first_bad([]) is None


@pytest.mark.parametrize(
    "what",
    [
        {"stamp": 31},
        {"person_id": "id-8"},
        {"name": "Ben"},
        {"role": "manage"},
        {"way": "http"},
        {"address": "192.0.2.2"},
        {"operation": "call /stop/release"},
        {"outcome": "refused trust_role"},
        {"parameters": "x"},
        {"salt": ""},
        {"digest": "0" * 64},
        {"hash": "0" * 64},
    ],
)
def test_a_row_that_was_changed_is_found(what: dict[str, object]) -> None:
    rows = chain(5)
    rows[2] = changed(rows[2], **what)
    assert first_bad(rows) == 3


def test_a_chain_that_was_made_anew_without_its_beginning_is_found() -> None:
    """Whoever can write the file can chain anew, but not say what stands for the rows before."""
    rows: list[Audited] = []
    for row in chain(5)[2:]:
        rows.append(chained(row, rows[-1].hash if rows else ""))
    assert first_bad(rows) == 3


def test_a_row_that_was_taken_out_is_found_and_so_is_one_at_the_beginning() -> None:
    rows = chain(5)
    assert first_bad([*rows[:2], *rows[3:]]) == 3
    assert first_bad(rows[1:]) == 2


def test_a_row_that_was_changed_with_its_own_hash_is_found_by_the_next_one() -> None:
    rows = chain(5)
    rows[2] = chained(changed(rows[2], operation="call /mode/set"), rows[1].hash)
    assert first_bad(rows) == 4


def test_a_name_that_is_erased_breaks_no_chain_and_cannot_be_put_back() -> None:
    rows = chain(5)
    rows[2] = erased(rows[2])
    assert (rows[2].name, rows[2].address, rows[2].salt) == ("erased", "", "")
    assert first_bad(rows) is None
    rows[2] = changed(rows[2], name="Ben")
    assert first_bad(rows) == 3


async def test_of_a_broken_file_as_much_is_saved_as_can_be_trusted(tmp_path: Path) -> None:
    (tmp_path / "x.sqlite3").write_bytes(b"no database" * 100)
    assert salvage(tmp_path / "x.sqlite3") == []
    open_records(tmp_path, None, lambda *_: None).close()
    path = tmp_path / "records.sqlite3"
    with closing(sqlite3.connect(path)) as database:
        for row in chain(5):
            values = msgspec.structs.astuple(row)
            database.execute(f"INSERT INTO audit VALUES ({', '.join('?' * len(values))})", values)
        database.commit()
        assert [row.id for row in salvage(path)] == [1, 2, 3, 4, 5]
        database.execute("UPDATE audit SET name = 'Ben' WHERE id = 4")
        database.commit()
    assert [row.id for row in salvage(path)] == [1, 2, 3]
    assert [row.id for row in read_file(path)] == [1, 2, 3, 4, 5]
