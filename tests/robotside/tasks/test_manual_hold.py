"""MANUAL, chosen by somebody."""

from __future__ import annotations

from pathlib import Path

from robotside.tasks.manual_hold import ManualHold
from tests.robotside.scene import records_at


def test_whoever_chose_it_first_is_named_until_it_ends_over_restarts_too(tmp_path: Path) -> None:
    said: list[str] = []

    def start() -> ManualHold:
        return ManualHold(records_at(tmp_path), lambda kind, text, *_, **__: said.append(text))

    manual = start()
    assert (manual.by, manual.why, manual.end()) == ("", "", False)
    assert manual.choose("Anna")
    assert not manual.choose("Bert")
    assert said == ["Anna set the mode to MANUAL: nothing starts by itself until it is AUTO."]
    again = start()
    assert (again.by, again.why) == ("Anna", "Anna set the mode to MANUAL")
    assert again.end()
    assert (again.by, start().by) == ("", "")
