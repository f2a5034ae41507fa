"""How a layout is handed on and taken in: exported whole or not at all, chosen by the system's own dialogue, looked at first."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from app.device.file_picking import Picked
from app.screens.panels.sharing.share_dialog import ShareDialog
from tests.app.glass import Glass


class Picking:
    """The system's dialogue, answered by the test."""

    takes_paths = True
    into: Path
    done: Picked

    def pick(self, into: Path, done: Picked) -> None:
        self.into, self.done = into, done


@pytest.fixture
def picking(monkeypatch: pytest.MonkeyPatch) -> Picking:
    made = Picking()
    monkeypatch.setattr("app.screens.panels.sharing.share_dialog.file_picking", lambda: made)
    return made


@pytest.fixture
def sharing(driving: Glass) -> Any:
    app = driving.app
    dialog = ShareDialog(app.profiles, app.session.robot.info, None, lambda: None)
    app.root.add_widget(dialog)
    driving.stage.frames(2)
    return dialog


def test_what_is_exported_is_read_again(sharing: Any) -> None:
    sharing.save()
    (path,) = (sharing._profiles.store.folder / "exported").iterdir()
    assert path.suffix == ".toml"
    sharing.read(str(path))
    assert sharing.usable


def test_an_export_to_a_full_disk_is_said_and_leaves_nothing(
    sharing: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    sharing.save()
    assert sharing.told == "The file could not be written: No space left on device."
    assert list((sharing._profiles.store.folder / "exported").iterdir()) == []


def test_a_file_that_is_chosen_is_looked_at_and_a_copy_made_for_that_is_deleted(
    sharing: Any, picking: Picking
) -> None:
    sharing.ids.browse.dispatch("on_release")
    picking.into.mkdir(parents=True)
    copy = picking.into / "night.toml"
    copy.write_text(sharing.text)
    picking.done([copy], "")
    assert sharing.usable
    assert not copy.exists()
    own = picking.into.parent / "own.toml"
    own.write_text("title = 3")
    picking.done([own], "")
    assert not sharing.usable
    assert own.exists()


def test_a_dialogue_that_there_is_not_is_said_and_one_answered_too_late_says_nothing(
    sharing: Any, picking: Picking
) -> None:
    sharing.ids.browse.dispatch("on_release")
    picking.done([], "This desktop has no file dialogue; type the file's path.")
    assert (sharing.found, sharing.wrong) == (
        "This desktop has no file dialogue; type the file's path.",
        True,
    )
    sharing.close()
    sharing.found = ""
    picking.done([], "Too late.")
    assert sharing.found == ""
