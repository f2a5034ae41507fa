"""The sum of pytest's reports in a folder and in those within it, printed as one line: `N passed, N failed`, and how many were skipped and why."""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree as ET

LACKS = re.compile(r"This machine lacks ([\w-]+)")
"""What `tests.lacking` says of a test that cannot run here."""
OTHERWISE = "for another system"


def count(folder: Path) -> tuple[int, int]:
    """Tests that passed, and tests that failed, could not run or belong to a ring that did not start."""
    passed = failed = 0
    for suite in _all(folder, "testsuite"):
        bad = int(suite.get("failures", 0)) + int(suite.get("errors", 0))
        failed += bad
        passed += int(suite.get("tests", 0)) - bad - int(suite.get("skipped", 0))
    broken = [ring for names in folder.rglob("broken") for ring in names.read_text().split()]
    return passed, failed + len(broken)


def skipped(folder: Path) -> Counter[str]:
    """Skipped tests by what this machine lacks, and those that are none of this system's."""
    found: Counter[str] = Counter()
    for skip in _all(folder, "skipped"):
        lacks = LACKS.search(f"{skip.get('message', '')} {skip.text or ''}")
        found[f"lacking {lacks[1]}" if lacks else OTHERWISE] += 1
    return found


def line(folder: Path) -> str:
    """The line that closes `make test`, `make test-fast` and `make test-slow`, and all of them together."""
    said = "{} passed, {} failed".format(*count(folder))
    reasons = skipped(folder)
    if not reasons:
        return said
    words = ", ".join(f"{reasons[reason]} {reason}" for reason in sorted(reasons))
    return f"{said}, {reasons.total()} skipped ({words})"


def _all(folder: Path, tag: str) -> list[ET.Element]:
    reports = sorted(folder.rglob("*.xml"))
    return [found for report in reports for found in ET.parse(report).getroot().iter(tag)]  # noqa: S314 - pytest's own


if __name__ == "__main__":
    print(line(Path(sys.argv[1])))
