"""`python -m bridge.generate` as a user meets it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from bridge.generate.__main__ import main


@pytest.fixture
def boat(tmp_path: Path) -> Path:
    path = tmp_path / "Boat.msg"
    path.write_text("float64 depth  # [m]\n")
    return path


def test_it_writes_a_module_and_says_which(boat, tmp_path, capsys):
    out = tmp_path / "made"
    assert main([str(boat), "--package", "boat_msgs", "--out", str(out)]) == 0
    assert capsys.readouterr().out.splitlines() == [str(out / "__init__.py"), str(out / "boat_msgs.py")]
    assert 'MSGTYPE: ClassVar[str] = "boat_msgs/Boat"' in (out / "boat_msgs.py").read_text()


def test_a_package_is_told_by_the_folders_or_by_name(boat, tmp_path, capsys):
    assert main([str(boat), "--out", str(tmp_path / "made")]) == 2
    assert (
        capsys.readouterr().err == f"{boat} lies in no PACKAGE/msg folder; say its package with --package.\n"
    )


def test_without_the_parser_it_says_what_brings_it(boat, tmp_path):
    """As after `make setup`, which does not install it."""
    run = (
        "import runpy, sys; sys.modules['rosbags'] = None;"
        "runpy.run_module('bridge.generate', run_name='__main__')"
    )
    command = [
        sys.executable,
        "-c",
        run,
        str(boat),
        "--package",
        "boat_msgs",
        "--out",
        str(tmp_path / "made"),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "rosbags is not installed; it comes with the dev extra: make setup-test.\n"


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            ["{boat}", "--package", "Boat-Msgs"],
            "A package is called by small letters, digits and _, not 'Boat-Msgs'.",
        ),
        (["gone.msg"], "gone.msg cannot be read: No such file or directory."),
        (["nowhere/msg/Gone.msg"], "nowhere/msg/Gone.msg cannot be read: No such file or directory."),
        (["{folder}/boat.txt"], "boat.txt ends neither in .msg nor in .srv nor in .action."),
        (["{folder}/empty"], "empty holds no .msg, .srv or .action file."),
        (["{folder}/bad/msg/Bad.msg"], "Bad.msg cannot be read: no UTF-8."),
        (["{folder}/bad/msg/My-Boat.msg"], "a type is called by letters, digits and _, not 'My-Boat'."),
    ],
)
def test_a_mistake_is_one_sentence_and_exit_code_2(boat, tmp_path, capsys, arguments, sentence):
    (tmp_path / "empty").mkdir()
    (tmp_path / "bad" / "msg").mkdir(parents=True)
    (tmp_path / "bad" / "msg" / "Bad.msg").write_bytes(b"\xff\xfe\xff")
    (tmp_path / "bad" / "msg" / "My-Boat.msg").write_text("")
    given = [each.format(boat=boat, folder=tmp_path) for each in arguments]
    assert main([*given, "--out", str(tmp_path / "made")]) == 2
    said = capsys.readouterr()
    assert sentence in said.err
    assert said.err.count("\n") == 1
    assert not said.out


def test_a_place_that_cannot_be_written_is_said(boat, capsys):
    assert main([str(boat), "--package", "boat_msgs", "--out", str(boat)]) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_help_shows_how(capsys):
    with pytest.raises(SystemExit) as left:
        main(["--help"])
    assert left.value.code == 0
    said = capsys.readouterr().out
    assert "python -m bridge.generate boat_msgs/msg/Boat.msg --out generated" in said
    assert "--package NAME" in said


def test_without_files_it_says_what_is_missing(capsys):
    with pytest.raises(SystemExit) as left:
        main(["--out", "x"])
    assert left.value.code == 2
