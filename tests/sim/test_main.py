from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from sim.__main__ import main
from sim.robot import ROBOTS
from sim.shapes import Shape
from sim.vehicles.model import Model
from sim.vehicles.patrol import PARAMETERS, Patrol


def test_without_arguments_it_says_what_stands_in_the_world(capsys):
    assert main([]) == 0
    assert capsys.readouterr().out == "parking_lot: 40 x 30 m; 14 cars, 6 cones, 6 lamp posts, 11 trees.\n"


def test_a_picture_of_the_world_is_written_where_it_is_asked_for(tmp_path, capsys):
    file = tmp_path / "lot.png"
    assert main(["--picture", str(file)]) == 0
    with Image.open(file) as picture:
        assert picture.size == (1600, 1252)
        assert picture.getpixel((20, 20))[1] > picture.getpixel((20, 20))[2]
    assert "north up" in capsys.readouterr().out


def test_the_picture_shows_the_robot_that_is_asked_for(tmp_path, monkeypatch):
    def tower(parameters, position, rotation):
        return (
            Shape("cylinder", (2.0, 2.0, 3.0), (0.0, 0.0, 1.5), colour=(1.0, 0.0, 0.0), glow=1.0).at(
                position, rotation
            ),
        )

    monkeypatch.setitem(ROBOTS, "tower", Model(Patrol, PARAMETERS, tower))
    red = []
    for name in ("patrol", "tower"):
        assert main(["--robot", name, "--picture", str(tmp_path / f"{name}.png")]) == 0
        with Image.open(tmp_path / f"{name}.png") as picture:
            parts = np.asarray(picture.convert("RGB")).astype(int)
        red.append(((parts[..., 0] > 200) & (parts[..., 1] < 60)).sum())
    assert red[1] > red[0] + 1000


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--world", "moon"], "sim: There is no world 'moon'; there is lake"),
        (["--wrold", "moon"], "sim: Unrecognized arguments: --wrold moon.\n"),
        (["--robot", "foo"], "sim: There is no simulated robot 'foo'; there is patrol, scout"),
        (["--picture", "lot.xyz"], "sim: lot.xyz has no ending of a picture; use .png or .jpg."),
        (["--gui"], "sim: --gui needs a display, and DISPLAY is not set."),
    ],
)
def test_a_mistake_is_told_in_one_sentence_with_exit_code_2(arguments, sentence, capsys, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    assert main(arguments) == 2
    assert capsys.readouterr().err.startswith(sentence)


def test_a_picture_that_cannot_be_written_is_a_mistake(tmp_path, capsys):
    assert main(["--picture", str(tmp_path / "no" / "lot.png")]) == 2
    assert "No such file or directory" in capsys.readouterr().err
