"""Layout files: a mistake is one sentence that says where it is and what is allowed."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.layout import LayoutError, load, names, parse
from widgets import CATALOGUE

WIDGETS = ["Compass", "LaserScanView", "Readout"]


def one(**changes: object) -> str:
    entry: dict[str, object] = {"slot": "top", "widget": "Compass", "topic": "/pose", **changes}
    return "[[instrument]]\n" + "\n".join(
        f"{key} = {value!r}" for key, value in entry.items() if value is not None
    )


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("title = ", "Layout x is no TOML"),
        ("instrument = 3", r"\[\[instrument\]\] tables"),
        (
            one(slot="middle"),
            "instrument 1: slot is one of top_left, top, top_right, readouts, senses, not 'middle'",
        ),
        (one(slot=None), "slot is one of .*, not None"),
        (one(widget="Compas"), "widget is one of Compass, LaserScanView, Readout, not 'Compas'"),
        (one(topic="/cmd_vel"), "topic is one of .*/scan.*, not '/cmd_vel'"),
        (one(colour="red"), "key is one of .*, not 'colour'"),
        (one(title=3), "title is a text, not 3"),
        (one(widget="Readout", digits="two"), "digits is a number, not 'two'"),
        (
            one(widget="Readout", topic="/odom", field="twist.speed"),
            "nav_msgs/Odometry has no number 'twist.speed'",
        ),
        (one(widget="Readout", topic="/odom", field="twist.twist"), "has no number 'twist.twist'"),
        (one(widget="Readout", topic="/odom"), "has no number ''"),
        (one() + "\n" + one(), "2 instruments into top, where 1 fit"),
    ],
)
def test_a_mistake_is_one_sentence(text: str, sentence: str) -> None:
    with pytest.raises(LayoutError, match=sentence):
        parse("x", text, WIDGETS)


def test_an_unknown_layout_names_those_there_are(tmp_path: Path) -> None:
    (tmp_path / "patrol.toml").write_text("")
    (tmp_path / "boat.toml").write_text("")
    with pytest.raises(LayoutError, match="There is no layout 'car'; there are: boat, patrol."):
        load("car", WIDGETS, tmp_path)


@pytest.mark.parametrize("name", names())
def test_every_layout_that_is_shipped_can_be_loaded(name: str) -> None:
    assert load(name, CATALOGUE).instruments
