"""The rings of `scripts/test.sh`: what they name, and what the script says after them."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from scripts.sum_up import count

ROOT = Path(__file__).parents[2]
ARRAYS = 'eval "$(sed -n "/^pure=(/,/^)/p; /^costly=(/p" scripts/test.sh)"; printf "%s\\n" "${pure[@]}" "${costly[@]#--ignore=}"'
REPORT = '<testsuite tests="5" failures="1" errors="0" skipped="1"><skipped message="This machine lacks Xvfb."/></testsuite>'


@pytest.fixture
def pytest_says(tmp_path: Path):
    """Run the script with a pytest that only notes its words and writes a report, or none, and ends with a code."""

    def run(report: str, code: int, *which: str, reports: str = "") -> subprocess.CompletedProcess[str]:
        stand_in = tmp_path / "python"
        write = f"""for word; do case $word in --junitxml=*) echo '{report}' >"${{word#*=}}";; esac; done"""
        stand_in.write_text(
            f'#!/bin/sh\n[ "$1" = -m ] || exec {sys.executable} "$@"\n'
            f'echo "$*" >>{tmp_path}/words\n{write if report else ""}\nexit {code}\n'
        )
        stand_in.chmod(0o755)
        return subprocess.run(
            ["bash", "scripts/test.sh", *which],
            cwd=ROOT,
            env={**os.environ, "PYTHON": str(stand_in), "REPORTS": reports},
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )

    return run


def test_what_the_fast_ring_names_is_there():
    named = subprocess.run(
        ["bash", "-c", ARRAYS], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split()
    assert len(named) > 20
    assert [name for name in named if not (ROOT / name).exists()] == []


def slow_files() -> set[str]:
    mark = re.compile(r"pytest\.mark\.slow\b")
    return {
        str(path.relative_to(ROOT))
        for path in (ROOT / "tests").rglob("test_*.py")
        if mark.search(path.read_text())
    }


def test_what_is_slow_runs_in_a_ring_of_its_own_and_in_no_other(pytest_says, tmp_path):
    for which in ((), ("fast",), ("slow",)):
        pytest_says(REPORT, 0, *which)
    *daily, slow = [
        line for line in (tmp_path / "words").read_text().splitlines() if "slow-drawn.xml" not in line
    ]
    assert len(daily) == 4
    assert all(" -m not slow" in line for line in daily)
    assert " -m slow " in slow
    undrawn = {name for name in slow_files() if not name.startswith(("tests/pixels/", "tests/e2e/"))}
    assert {word for word in slow.split() if word.startswith("tests/")} == undrawn
    assert "tests/slow/test_explored.py" in undrawn


def test_reports_of_several_runs_are_summed_up_by_who_asks_for_them(pytest_says, tmp_path):
    folder = tmp_path / "reports"
    for which in ((), ("slow",)):
        pytest_says(REPORT, 1, *which, reports=str(folder))
    rings = {path.stem for path in folder.rglob("*.xml")}
    assert rings >= {"logic", "pixels", "e2e", "slow"}
    assert count(folder) == (3 * len(rings), len(rings))
    assert (folder / "daily/logic.xml").exists()


def test_a_ring_says_how_long_it_took_and_the_last_line_sums_up(pytest_says):
    done = pytest_says(REPORT, 1, "fast")
    first, took, last = done.stdout.splitlines()
    assert first == "== fast"
    assert re.fullmatch(r"== fast took \d+ s", took)
    assert (last, done.returncode) == ("3 passed, 1 failed, 1 skipped (1 lacking Xvfb)", 1)


def test_a_ring_that_does_not_start_is_a_failure(pytest_says):
    done = pytest_says("", 4, "fast")
    assert (done.stdout.splitlines()[-1], done.returncode) == ("0 passed, 1 failed", 1)
