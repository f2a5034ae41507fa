"""Of this ring the summary at the end tells what was seen, of all processes that it ran in."""

from __future__ import annotations

import pytest

SEEN = "seen"
"""The property of a test by which it tells what it saw, as one line."""


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print it."""
    for report in terminalreporter.getreports("passed"):
        for name, said in report.user_properties:
            if name == SEEN:
                terminalreporter.write_line(str(said))
