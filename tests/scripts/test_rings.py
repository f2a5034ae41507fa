"""The rings of `scripts/test.sh`: what they name, and what the script says after them."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ARRAYS = 'eval "$(sed -n "/^pure=(/,/^)/p; /^costly=(/,/^)/p" scripts/test.sh)"; printf "%s\\n" "${pure[@]}" "${costly[@]}"'
REPORT = '<testsuite tests="5" failures="1" errors="0" skipped="1"><skipped message="This machine lacks Xvfb."/></testsuite>'


@pytest.fixture
def pytest_says(tmp_path: Path):
    """Run a ring with a pytest that only writes a report, or none, and ends with a code."""

    def run(report: str, code: int) -> subprocess.CompletedProcess[str]:
        stand_in = tmp_path / "python"
        write = f"""for word; do case $word in --junitxml=*) echo '{report}' >"${{word#*=}}";; esac; done"""
        stand_in.write_text(
            f'#!/bin/sh\n[ "$1" = -m ] || exec {sys.executable} "$@"\n{write if report else ""}\nexit {code}\n'
        )
        stand_in.chmod(0o755)
        return subprocess.run(
            ["bash", "scripts/test.sh", "fast"],
            cwd=ROOT,
            env={**os.environ, "PYTHON": str(stand_in)},
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )

    return run


def test_what_the_fast_ring_names_is_there():
    said = subprocess.run(["bash", "-c", ARRAYS], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    named = [
        line.removeprefix("--ignore=") for line in said.splitlines() if not line.startswith("--ignore-glob=")
    ]
    assert len(named) > 20
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_a_ring_says_how_long_it_took_and_the_last_line_sums_up(pytest_says):
    done = pytest_says(REPORT, 1)
    first, took, last = done.stdout.splitlines()
    assert first == "== fast"
    assert re.fullmatch(r"== fast took \d+ s", took)
    assert (last, done.returncode) == ("3 passed, 1 failed, 1 skipped (1 lacking Xvfb)", 1)


def test_a_ring_that_does_not_start_is_a_failure(pytest_says):
    done = pytest_says("", 4)
    assert (done.stdout.splitlines()[-1], done.returncode) == ("0 passed, 1 failed", 1)
