"""Settings survive restarts, damage and a full disk."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.core.settings_store import Settings


def test_values_survive_a_restart(tmp_path: Path) -> None:
    settings = Settings(tmp_path / "new")
    settings.set("theme", "sunlight")
    settings.set("robots", ["ws://10.0.0.3:9090"])
    settings.close()
    again = Settings(tmp_path / "new")
    assert again.get("theme") == "sunlight"
    assert again.get("robots") == ["ws://10.0.0.3:9090"]
    assert again.get("nothing", 5) == 5


def test_a_damaged_file_is_put_aside_and_said(tmp_path: Path) -> None:
    (tmp_path / "settings.json").write_text("{half")
    settings = Settings(tmp_path)
    assert settings.get("theme") is None
    assert "put aside as settings.unreadable.json" in settings.problem
    assert (tmp_path / "settings.unreadable.json").read_text() == "{half"


def test_a_file_that_nests_too_deep_is_put_aside(tmp_path: Path) -> None:
    (tmp_path / "settings.json").write_text("[" * 200_000)
    assert "put aside" in Settings(tmp_path).problem


def test_a_file_that_is_no_table_is_put_aside(tmp_path: Path) -> None:
    (tmp_path / "settings.json").write_text("[1]")
    assert "put aside" in Settings(tmp_path).problem


def test_a_folder_that_cannot_be_written_is_said_and_nothing_is_lost_in_memory(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    settings = Settings(tmp_path / "file")
    settings.set("theme", "dark")
    settings.close()
    assert settings.get("theme") == "dark"
    assert settings.problem.startswith("The settings could not be")


def test_a_full_disk_is_told_once_until_a_write_goes_well_and_leaves_no_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = Settings(tmp_path)
    full = OSError(28, "No space left on device")

    def sync(_: int) -> None:
        raise full

    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", sync)
        told = [settings.news()]
        for text in ("{}", "{}"):
            settings._write(text)
            told += [settings.news(), settings.news()]
    sentence = "The settings could not be saved: No space left on device."
    assert told == ["", sentence, "", "", ""]
    assert list(tmp_path.iterdir()) == []
    settings._write("{}")
    assert (settings.problem, settings.news()) == ("", "")


def test_what_was_saved_before_the_disk_was_full_is_still_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = Settings(tmp_path)
    settings._write('{"theme": "dark"}')

    def sync(_: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", sync)
        settings._write('{"theme": "light"}')
    settings.close()
    again = Settings(tmp_path)
    assert (again.get("theme"), again.problem) == ("dark", "")
    again.close()


def test_no_half_written_file_is_left(tmp_path: Path) -> None:
    settings = Settings(tmp_path)
    for number in range(20):
        settings.set("number", number)
    settings.close()
    assert Settings(tmp_path).get("number") == 19
    assert [path.name for path in tmp_path.iterdir()] == ["settings.json"]
