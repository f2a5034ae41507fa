from __future__ import annotations

import os
import runpy
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from PIL import Image

from bridge.core.toml_files import FileFault
from sim.__main__ import main, summary
from sim.core.shapes import Shape
from sim.robot import ROBOTS, WORLDS
from sim.vehicles.model import Model
from sim.vehicles.patrol import PARAMETERS, Patrol
from sim.world.world_files import load
from tests.lacking import lacking


def test_without_arguments_it_says_what_stands_in_the_world(capsys):
    assert main([]) == 0
    assert capsys.readouterr().out == (
        "parking_lot: 40 x 30 m; 14 cars, 6 cones, 6 lamp posts, 11 trees, 2 docks.\n"
    )


def test_it_counts_models_too_and_one_thing_is_called_one(tmp_path, capsys):
    yard = Path(__file__).parents[2] / "examples" / "yard"
    assert main(["--world", str(yard / "yard.toml")]) == 0
    assert capsys.readouterr().out == "yard: 24 x 16 m; 1 cone, 3 models.\n"
    shutil.copy(yard / "sign.urdf", tmp_path)
    things = '[[models]]\nfile = "sign.urdf"\nx = 2.0\ny = 0.0\nloose = true\n[[people]]\nx = 0.0\ny = 2.0\n'
    things += '[[barrels]]\nx = 1.0\ny = 2.0\n[[barrels]]\nx = 2.0\ny = 2.0\n[[docks]]\nname = "dock"\nkind = "contacts"\nx = -2.0\ny = 0.0\n'
    (tmp_path / "empty.toml").write_text(EMPTY + things)
    assert main(["--world", str(tmp_path / "empty.toml")]) == 0
    assert capsys.readouterr().out == "empty: 6 x 6 m; 2 barrels, 1 person, 1 model, 1 dock.\n"


@pytest.mark.parametrize("name", [*WORLDS, "examples/yard/yard.toml"])
def test_nothing_that_stands_in_a_world_is_left_out(name):
    world = load(name)
    counted = sum(int(part.split()[0]) for part in summary(world).rpartition("; ")[2].split(", "))
    assert counted == sum(prop.kind != "wall" for prop in world.props)


class _Faulty(ModuleType):
    """A module that reads a file with a fault as it is imported."""

    def __getattr__(self, name):
        raise FileFault("commander.toml, line 13: body.mass: must be a number above 0, not -3.")


def test_a_fault_in_the_file_of_a_vehicle_is_one_sentence(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "sim.robot", _Faulty("sim.robot"))
    monkeypatch.delitem(sys.modules, "sim.__main__")
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("sim", run_name="__main__")
    assert ended.value.code == 2
    assert capsys.readouterr().err.startswith("sim: commander.toml, line 13: body.mass: must be a number")


def test_a_picture_of_the_world_is_written_where_it_is_asked_for(tmp_path, capsys):
    file = tmp_path / "lot.png"
    assert main(["--picture", str(file)]) == 0
    with Image.open(file) as picture:
        assert picture.size == (1600, 1252)
        assert picture.getpixel((20, 20))[1] > picture.getpixel((20, 20))[2]
    assert "north up" in capsys.readouterr().out


@pytest.mark.slow
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


@pytest.mark.slow
def test_the_picture_shows_all_robots_that_are_asked_for_at_home(tmp_path, capsys):
    pictures = []
    for number, names in enumerate(("minnow", "minnow,aqua,ardrone")):
        file = tmp_path / f"{number}.png"
        assert main(["--robot", names, "--picture", str(file)]) == 0
        assert "lake from above" in capsys.readouterr().out
        with Image.open(file) as picture:
            pictures.append(np.asarray(picture.convert("RGB")).astype(int))
    assert (np.abs(pictures[0] - pictures[1]).sum(axis=2) > 60).sum() > 20


@pytest.mark.parametrize(
    ("robots", "sentence"),
    [
        (
            "patrol,minnow",
            "sim: There is no world for patrol and minnow together: some need dry land, some water.",
        ),
        ("patrol,rover", "sim: There is no simulated robot 'rover'; there is patrol"),
    ],
)
def test_robots_that_cannot_be_together_are_a_mistake(robots, sentence, capsys):
    assert main(["--robot", robots]) == 2
    assert capsys.readouterr().err.startswith(sentence)


EMPTY = """
name = "empty"
description = "Nothing"
ground = {length = 6.0, width = 6.0}
start = {x = 0.0, y = 0.0}
datum = {latitude = 45.0, longitude = 9.0}
"""


@pytest.fixture
def display() -> Iterator[str]:
    """A display that nobody sees."""
    server = shutil.which("Xvfb")
    if server is None:
        lacking("Xvfb")
    reads, writes = os.pipe()
    command = [server, "-displayfd", str(writes), "-screen", "0", "640x480x24", "-nolisten", "tcp"]
    process = subprocess.Popen(command, pass_fds=[writes], stderr=subprocess.DEVNULL)
    os.close(writes)
    with os.fdopen(reads) as told:
        number = told.readline().strip()
    try:
        yield f":{number}"
    finally:
        process.terminate()
        process.wait()


def test_the_engines_own_window_opens_and_closes(tmp_path, display):
    (tmp_path / "empty.toml").write_text(EMPTY)
    command = [
        sys.executable,
        "-m",
        "sim",
        "--gui",
        "--robot",
        "patrol,scout",
        "--world",
        str(tmp_path / "empty.toml"),
    ]
    environment = {**os.environ, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"}
    root = Path(__file__).parents[2]
    with subprocess.Popen(command, cwd=root, env=environment, stdout=subprocess.PIPE, text=True) as shown:
        try:
            assert shown.stdout is not None
            assert any("The window is open" in line for line in shown.stdout)
            shown.send_signal(signal.SIGINT)
            shown.communicate(timeout=30)
        finally:
            shown.kill()
    assert shown.returncode == 0
