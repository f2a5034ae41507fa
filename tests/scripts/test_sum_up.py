"""The line that closes `make test`."""

from __future__ import annotations

from scripts.sum_up import count

REPORT = '<testsuites><testsuite tests="{}" failures="{}" errors="{}" skipped="{}"/></testsuites>'


def test_rings_are_added_up(tmp_path):
    (tmp_path / "logic.xml").write_text(REPORT.format(10, 1, 1, 2))
    (tmp_path / "pixels.xml").write_text(REPORT.format(5, 0, 0, 0))
    assert count(tmp_path) == (11, 2)


def test_a_ring_that_did_not_start_counts_as_failed(tmp_path):
    (tmp_path / "logic.xml").write_text(REPORT.format(3, 0, 0, 0))
    (tmp_path / "broken").write_text("pixels\n")
    assert count(tmp_path) == (3, 1)
