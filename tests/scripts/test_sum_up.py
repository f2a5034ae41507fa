"""The line that closes `make test`."""

from __future__ import annotations

from scripts.sum_up import count, line

REPORT = '<testsuites><testsuite tests="{}" failures="{}" errors="{}" skipped="{}"/></testsuites>'


def test_rings_are_added_up(tmp_path):
    (tmp_path / "logic.xml").write_text(REPORT.format(10, 1, 1, 2))
    (tmp_path / "pixels.xml").write_text(REPORT.format(5, 0, 0, 0))
    assert count(tmp_path) == (11, 2)


def test_a_ring_that_did_not_start_counts_as_failed(tmp_path):
    (tmp_path / "logic.xml").write_text(REPORT.format(3, 0, 0, 0))
    (tmp_path / "broken").write_text("pixels\n")
    assert count(tmp_path) == (3, 1)


def test_what_was_skipped_is_counted_by_the_name_of_what_lacks(tmp_path):
    (tmp_path / "logic.xml").write_text(
        '<testsuite tests="6" failures="0" errors="0" skipped="5">'
        '<skipped message="This machine lacks Xvfb.">tests/sim/test_main.py:149: This machine lacks Xvfb.</skipped>'
        '<skipped message="This machine lacks PostgreSQL: root runs the tests.">...</skipped>'
        '<skipped message="This machine lacks PostgreSQL.">...</skipped>'
        "<skipped message=\"collection skipped\">('l.py', 28, 'Skipped: This machine lacks hama.')</skipped>"
        '<skipped message="there are no signals">...</skipped>'
        "</testsuite>"
    )
    assert line(tmp_path) == (
        "1 passed, 0 failed, 5 skipped"
        " (1 for another system, 2 lacking PostgreSQL, 1 lacking Xvfb, 1 lacking hama)"
    )


def test_where_nothing_was_skipped_the_line_is_short(tmp_path):
    (tmp_path / "logic.xml").write_text(REPORT.format(10, 0, 0, 0))
    assert line(tmp_path) == "10 passed, 0 failed"
