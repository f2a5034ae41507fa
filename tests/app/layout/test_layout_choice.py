"""The layout that is made for a robot, unless the user insists on another."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.layout.layout import DEFAULT, LayoutError
from app.layout.layout_choice import LayoutChoice
from widgets import CATALOGUE


@pytest.mark.parametrize(
    ("model", "kind", "name"),
    [("ardrone", "quadrotor", "ardrone"), ("nothing like it", "nor this", DEFAULT)],
)
def test_each_robot_has_the_one_that_is_made_for_it(model: str, kind: str, name: str) -> None:
    assert LayoutChoice(CATALOGUE).of(model, kind).name == name


def test_one_that_the_user_insists_on_is_shown_of_every_robot() -> None:
    assert LayoutChoice(CATALOGUE, "minnow").of("ardrone", "quadrotor").name == "minnow"


def test_one_of_views_alone_that_the_user_insists_on_has_the_drive_screen_of_each_robot(
    tmp_path: Path,
) -> None:
    (tmp_path / "mine.toml").write_text("[[view]]\ntitle = 'A'\n")
    choice = LayoutChoice(CATALOGUE, str(tmp_path / "mine.toml"))
    for model in ("minnow", "aqua"):
        shown, made = choice.of(model, ""), LayoutChoice(CATALOGUE).of(model, "")
        assert (shown.arrangement, shown.controls, shown.actions) == (
            made.arrangement,
            made.controls,
            made.actions,
        )
        assert [view.title for view in shown.views] == ["A"]


def test_one_that_there_is_not_cannot_be_insisted_on() -> None:
    with pytest.raises(LayoutError):
        LayoutChoice(CATALOGUE, "no such layout")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("boat", "patrol", "minnow"):
        (tmp_path / f"{name}.toml").write_text(f"for = ['{name}']")
    return tmp_path


def test_models_come_before_kinds_and_a_robot_of_neither_gets_the_usual_one(folder: Path) -> None:
    choice = LayoutChoice(CATALOGUE, folder=folder)
    assert choice.of("minnow", "boat").name == "minnow"
    assert choice.of("dory", "boat").name == "boat"
    assert choice.of("rover", "wheels").name == DEFAULT
    assert choice.of("", "").name == DEFAULT, "one that has not said yet what it is"
    assert choice.of("minnow", "boat") is choice.of("minnow", ""), "each is read once"


def test_without_the_usual_one_a_robot_that_none_is_made_for_has_none(folder: Path) -> None:
    (folder / f"{DEFAULT}.toml").unlink()
    with pytest.raises(LayoutError, match=f"no layout '{DEFAULT}'"):
        LayoutChoice(CATALOGUE, folder=folder).of("rover", "wheels")


def test_a_layout_with_a_mistake_is_said_and_the_usual_one_shown_until_another_robot_comes(
    folder: Path,
) -> None:
    (folder / "boat.toml").write_text(
        "for = ['boat']\n[[instrument]]\nslot = 'top'\nwidget = 'Compas'\ntopic = '/pose'"
    )
    choice = LayoutChoice(CATALOGUE, folder=folder)
    assert choice.of("", "boat").name == DEFAULT
    assert choice.mistake.startswith("Layout boat, instrument 1: widget is one of")
    assert choice.of("minnow", "boat").name == "minnow"
    assert choice.mistake == ""


@pytest.mark.parametrize("text", ["for = ", "for = ['patrol']", "for = 3"])
def test_a_file_that_cannot_be_sorted_in_leaves_every_robot_the_usual_one(folder: Path, text: str) -> None:
    (folder / "boat.toml").write_text(text)
    choice = LayoutChoice(CATALOGUE, folder=folder)
    assert choice.of("minnow", "boat").name == DEFAULT
    assert "boat" in choice.mistake
