"""A handheld keeps its identity over every day, and no two have the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.core.client_identity import client_identity
from app.core.settings_store import Settings


def identity(folder: Path) -> str:
    settings = Settings(folder)
    try:
        return client_identity(settings)
    finally:
        settings.close()


def test_it_is_the_same_on_another_day(tmp_path: Path) -> None:
    first = identity(tmp_path)
    assert first
    assert identity(tmp_path) == first


def test_two_handhelds_have_two(tmp_path: Path) -> None:
    folders = tmp_path / "one", tmp_path / "other"
    for folder in folders:
        folder.mkdir()
    assert len({identity(folder) for folder in folders}) == 2


@pytest.mark.parametrize("spoilt", [None, 7, ["x"]])
def test_one_that_is_no_text_is_replaced(tmp_path: Path, spoilt: object) -> None:
    settings = Settings(tmp_path)
    settings.set("client_id", spoilt)
    assert isinstance(client_identity(settings), str)
    settings.close()
