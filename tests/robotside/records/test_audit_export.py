"""The audit log as CSV."""

from __future__ import annotations

import csv

from robotside.records.audit_export import HEADINGS, csv_lines
from robotside.records.database.audit_rows import Audited

ROW = Audited(
    7,
    1_795_279_047_123_456_789,
    "id-7",
    "Ann, a",
    "drive",
    "http",
    "192.0.2.1",
    "call /stop",
    "done",
    'x="1"',
)


def test_a_row_is_a_line_that_any_reader_of_csv_takes_apart() -> None:
    heading, row = csv.reader(csv_lines([ROW]))
    assert tuple(heading) == HEADINGS
    assert row[:4] == ["7", "2026-11-21T16:37:27.123+00:00", "id-7", "Ann, a"]
    assert row[9] == 'x="1"'


def test_a_name_is_no_formula_to_a_spreadsheet() -> None:
    for name in ("=1+1", "+1", "-1", "@x"):
        row = list(csv.reader(csv_lines([Audited(1, 0, "", name, "", "", "", "", "", "")])))[1]
        assert row[3] == f"'{name}"
