"""The audit log as CSV, for people, spreadsheets and other programs."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime

from robotside.records.database.audit_rows import Audited

__all__ = ["HEADINGS", "csv_lines"]

HEADINGS = (
    "number",
    "time",
    "person_id",
    "name",
    "role",
    "way",
    "address",
    "operation",
    "outcome",
    "parameters",
    "hash",
)
_FORMULA = ("=", "+", "-", "@")
"""With these a text would be a formula to a spreadsheet."""


def csv_lines(rows: Iterable[Audited]) -> Iterator[str]:
    """A line of headings and one for each row, with its line end; times in UTC."""
    yield _line(HEADINGS)
    for row in rows:
        time = datetime.fromtimestamp(row.stamp // 1_000_000_000, UTC).replace(
            microsecond=row.stamp % 1_000_000_000 // 1000
        )
        texts = (getattr(row, name) for name in HEADINGS[2:])
        yield _line((str(row.id), time.isoformat(timespec="milliseconds"), *map(_harmless, texts)))


def _harmless(text: str) -> str:
    return f"'{text}" if text.startswith(_FORMULA) else text


def _line(fields: Iterable[str]) -> str:
    written = io.StringIO()
    csv.writer(written).writerow(fields)
    return written.getvalue()
