"""The layout that is made for a robot, unless the user insists on another."""

from __future__ import annotations

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


def test_one_that_there_is_not_cannot_be_insisted_on() -> None:
    with pytest.raises(LayoutError):
        LayoutChoice(CATALOGUE, "no such layout")
