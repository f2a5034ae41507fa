"""What a check that does not hold says, and how programs are run that may say so."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping
from pathlib import Path

__all__ = ["Failed", "run"]

LAST_LINES = 8
"""Of what a program printed before it failed, so many are shown."""


class Failed(Exception):
    """A check did not hold; its text is the sentence to print."""


def run(
    *command: str, where: Path, limit: float = 180.0, environment: Mapping[str, str] | None = None
) -> str:
    """What a program prints; Failed with its last lines where it fails or takes longer than `limit` [s]."""
    try:
        done = subprocess.run(
            command, cwd=where, capture_output=True, text=True, check=False, timeout=limit, env=environment,
            stdin=subprocess.DEVNULL,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise Failed(f"{Path(command[0]).name} took longer than {limit:.0f} s.") from None
    if done.returncode:
        last = (done.stdout + done.stderr).strip().splitlines()[-LAST_LINES:]
        raise Failed("\n".join(last) or f"{Path(command[0]).name} ended with {done.returncode}.")
    return done.stdout
