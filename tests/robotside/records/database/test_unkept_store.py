"""A robot on a file system where nothing can be written: it is served, and every answer says so."""

from __future__ import annotations

import errno
import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import Event, Place
from robotside.records import Records
from robotside.records.database.files import DatabaseFiles
from robotside.records.database.unkept_store import UnkeptStore
from robotside.records.opening import open_records
from tests.lacking import lacking
from tests.robotside.records.test_damage import keep, opened, until

OFFICE = Place(name="Office 12", x=4.0)


def _mounted(*words: str | Path) -> bool:
    """Whether `mount` did it; without the right to it, it does not."""
    mount = shutil.which("mount")
    return (
        mount is not None and not subprocess.run([mount, *words], check=False, capture_output=True).returncode
    )


@contextmanager
def read_only(directory: Path) -> Iterator[None]:
    """Nothing in `directory` can be written, not even by root."""
    bound = _mounted("--bind", directory, directory)
    if bound and not _mounted("-o", "remount,ro,bind", directory):
        subprocess.run(["umount", directory], check=True)
        bound = False
    if not bound and os.getuid() == 0:
        lacking("mount")
    if not bound:
        directory.chmod(0o500)
    try:
        yield
    finally:
        if bound:
            subprocess.run(["umount", "--lazy", directory], check=True)
        else:
            directory.chmod(0o700)


async def served(state: Path) -> tuple[Records, str]:
    """The records and the sentence about them."""
    records = await opened(state)
    (said,) = records.problems
    return records, said


async def test_a_read_only_state_directory_is_served_with_what_it_has_and_every_change_is_refused(
    tmp_path: Path,
) -> None:
    state = tmp_path / "state"
    records = await opened(state)
    assert await keep(records, OFFICE) == ""
    records.note_stop("Anna")
    records.close()
    with read_only(state):
        records, said = await served(state)
        assert said.startswith(f"Nothing can be stored in '{state}' (")
        assert said.endswith("; mend that and start the robot side again.")
        assert records.places.named("Office 12") is not None
        assert records.stopped_by == "Anna", "a STOP is not forgotten for it"
        assert await keep(records, Place(name="Lab")) == said
        assert records.places.named("Lab") is None
        heard: list[Event] = []
        records.events.add(Event(text="happened"), heard.append)
        await until(lambda: heard)
        records.close()
    records = await opened(state)
    assert records.problems == []
    assert [place.name for place in records.places.all()] == ["Office 12"]
    records.close()


async def test_what_was_written_last_is_read_though_the_robot_was_killed_before(tmp_path: Path) -> None:
    """It is in the log beside the file, which SQLite reads only where it may write."""
    records = await opened(tmp_path / "state")
    assert await keep(records, OFFICE) == ""
    killed = shutil.copytree(tmp_path / "state", tmp_path / "killed")
    records.close()
    with read_only(killed):
        records, _ = await served(killed)
        assert records.places.named("Office 12") is not None
        records.close()


async def test_a_damaged_database_on_a_read_only_file_system_gives_way_to_its_backup(tmp_path: Path) -> None:
    state = tmp_path / "state"
    records = await opened(state)
    assert await keep(records, OFFICE) == ""
    records.close()
    DatabaseFiles(state / "records.sqlite3").back_up()
    (state / "records.sqlite3").write_bytes(b"no database" * 100)
    with read_only(state):
        records = await opened(state)
        assert any("was put in its place" in problem for problem in records.problems)
        assert records.places.named("Office 12") is not None
        records.close()


async def test_a_directory_that_cannot_be_made_costs_no_robot() -> None:
    records, said = await served(Path("/proc/pilothouse"))
    assert said.startswith("Nothing can be stored in '/proc/pilothouse' (")
    assert await keep(records, OFFICE) == said
    records.close()


async def test_where_not_even_a_copy_can_be_made_it_starts_empty(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("tempfile.TemporaryDirectory", full)
    opened = UnkeptStore(tmp_path / "records.sqlite3", 0.1, "no space left on device").open()
    assert opened.problems == ["What was stored cannot be read, so it starts empty."]


async def test_what_happens_meanwhile_takes_no_more_and_more_memory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.records.eventlog.MAX_EVENTS", 20)
    records = open_records(Path("/proc/pilothouse"), None, lambda call, *given: call(*given), patience=0.1)
    for number in range(200):
        heard: list[Event] = []
        records.events.add(Event(text=f"{number}"), heard.append)
        await until(lambda heard=heard: heard)  # type: ignore[misc]
    assert len(records._ledger.memory.dirty) < 40
    records.close()
