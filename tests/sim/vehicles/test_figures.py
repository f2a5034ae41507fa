"""The figures of vehicles and payloads: where each one comes from."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

SIM = Path(__file__).parents[3] / "sim"
FILES = [*sorted(SIM.glob("vehicles/*/*.toml")), SIM / "payloads/payloads.toml"]


def sources(text: str) -> set[str]:
    """The marks that the head of a file explains."""
    head = text[: text.index("\n[")]
    return set(re.findall(r"\[([A-Z])\]", head))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_figure_names_its_source_or_is_marked_as_assumed(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    known = sources(text)
    unmarked = []
    for number, line in enumerate(text.splitlines(), 1):
        told, _, remark = line.partition("#")
        if re.match(r"\w+ = [-\[\d]", told) and not known & set(re.findall(r"\[([A-Z])\]", remark)):
            unmarked.append(f"{file.name}:{number} {told.strip()}")
    assert "A" in known
    assert not unmarked
