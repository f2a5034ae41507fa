"""How the packages of speech are installed here."""

from __future__ import annotations

from pathlib import Path

__all__ = ["install_command"]

ROOT = Path(__file__).parents[4]


def install_command(extra: str, root: Path = ROOT) -> str:
    """What brings that extra of pilothouse: the sources have a command for all of speech, an installed package has pip."""
    return "make voice" if (root / "Makefile").is_file() else f"pip install pilothouse[{extra}]"
