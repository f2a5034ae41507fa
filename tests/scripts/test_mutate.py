"""The table of mutants fits the code, and `scripts/mutate.py` tells who was noticed from who was not."""

from __future__ import annotations

import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from scripts import mutate

SCRIPT = Path(mutate.__file__)

SOURCE = """
import sys

def most(speed):
    return min(speed, 1.0)

def least(speed):
    return max(speed, -1.0)

if __name__ == "__main__":
    print(most(float(sys.argv[1])))
"""

TESTS = """
import os, subprocess, sys
from code import speeds

def test_most():
    assert speeds.most(3.0) == 1.0

def test_least():
    assert speeds.least(0.5) == 0.5

def test_process():
    shell = f"{sys.executable} -OO -m code.speeds 3.0"
    assert subprocess.run(["sh", "-c", shell], capture_output=True, text=True).stdout == "1.0\\\\n"

def test_fork():
    pid = os.fork()
    if pid == 0:
        os._exit(speeds.most(3.0) != 1.0)
    assert os.waitpid(pid, 0)[1] == 0

def test_fails():
    assert speeds.most(0.0) == 1.0
"""

NO_MOST = "'return min(speed, 1.0)'", "'return speed'"


def entry(name: str, old: str, new: str, *tests: str) -> str:
    return f"[[mutant]]\nname = '{name}'\nfile = 'drive/speeds.py'\nold = {old}\nnew = {new}\ntests = {list(tests)}\n"


@pytest.fixture(scope="module", autouse=True)
def bare_pytest():
    """The runs under test need no plugin, and start in a third of the time without."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
        yield


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    """One bytecode cache for all runs here."""
    return tmp_path_factory.mktemp("compiled")


@pytest.fixture
def project(tmp_path, compiled):
    files = {
        "drive/__init__.py": "",
        "drive/speeds.py": SOURCE,
        "tests/test_speeds.py": TESTS.replace("code", "drive").replace("\\\\", "\\"),
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / "scripts/mutants").mkdir(parents=True)
    (tmp_path / "out").mkdir()
    (tmp_path / "out/mutate").symlink_to(compiled)
    return tmp_path


def tabled(project, *entries: str):
    (project / "scripts/mutants/drive.toml").write_text("\n".join(entries))


def run(project, *options: str):
    command = [sys.executable, str(SCRIPT), "--root", str(project), "-n", "1", *options]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def states(said: str) -> list[str]:
    return [line.split()[0] for line in said.splitlines() if " s  drive/" in line]


def test_every_entry_fits_its_file_compiles_and_names_tests_that_are_there():
    assert mutate.faults() == []


def test_every_table_has_entries():
    assert {path.stem for path in (mutate.ROOT / mutate.TABLES).glob("*.toml")} == {
        mutant.table for mutant in mutate.mutants()
    }


def test_who_was_noticed_is_told_from_who_was_not_and_the_source_stays_as_it_was(project):
    """In this process, in a fork, and in a program that a shell starts."""
    tests = [f"tests/test_speeds.py::test_{name}" for name in ("most", "fork", "process")]
    noticed = [entry(f"no cap for {test}", *NO_MOST, test) for test in tests]
    tabled(
        project,
        *noticed,
        entry("no floor", "'max(speed, -1.0)'", "'speed'", "tests/test_speeds.py::test_least"),
    )
    files = {path: path.read_bytes() for path in project.rglob("*.py")}
    done = run(project)
    assert states(done.stdout) == ["killed", "killed", "killed", "survived"]
    assert "survived:\n  drive/speeds.py: no floor\n" in done.stdout
    assert (done.stdout.splitlines()[-1], done.returncode) == ("killed 3 of 4 (75 %)", 1)
    assert {path: path.read_bytes() for path in project.rglob("*.py")} == files


def test_only_what_the_pattern_finds_runs_and_all_killed_is_a_success(project):
    tabled(
        project,
        entry("no cap", *NO_MOST, "tests/test_speeds.py::test_most"),
        entry("no floor", "'max(speed, -1.0)'", "'speed'", "tests/test_speeds.py::test_least"),
    )
    assert run(project, "--only", "nothing of this name").returncode == 2
    done = run(project, "--only", "CAP")
    assert (done.stdout.splitlines()[-1], done.returncode) == ("killed 1 of 1 (100 %)", 0)


def test_an_entry_that_proves_nothing_is_broken_and_says_why(project):
    cases = [
        ("'speed'", "'x'", "tests/test_speeds.py", "exactly once; it is there 4 times"),
        ("'return min(speed, 1.0)'", "'return ('", "tests/test_speeds.py", "was never closed"),
        (*NO_MOST, "tests/test_speeds.py::test_gone", "no test_gone"),
        (*NO_MOST, "tests/test_gone.py", "no tests/test_gone.py"),
        (
            "'import sys'",
            "'import nothing_of_this_name'",
            "tests/test_speeds.py::test_most",
            "imported: ModuleNotFoundError",
        ),
        (*NO_MOST, "tests/test_speeds.py::test_fails", "fail without it"),
    ]
    tabled(project, *(entry(str(number), old, new, test) for number, (old, new, test, _) in enumerate(cases)))
    done = run(project)
    assert states(done.stdout) == ["broken"] * len(cases)
    reasons = done.stdout.splitlines()
    assert all(reason in said for said, (*_, reason) in zip(reasons, cases, strict=False)), done.stdout
    assert done.returncode == 1


def test_tests_that_do_not_end_have_noticed(project, compiled, monkeypatch):
    monkeypatch.setattr(mutate, "TIME_FACTOR", 1.0)
    monkeypatch.setattr(mutate, "TIME_ALLOWANCE", 0.0)
    tabled(project, entry("endless", NO_MOST[0], "'while True: pass'", "tests/test_speeds.py::test_most"))
    outcomes = mutate.Runner(project, compiled, 1).judge(mutate.mutants(project), print)
    assert [(outcome.state, outcome.reason) for outcome in outcomes] == [("killed", "time was up")]


def test_what_a_killed_run_left_is_removed_by_the_next(project, tmp_path):
    bench = mutate.Bench(project, tmp_path / "cache")
    with bench.mutated("drive/speeds.py", SOURCE.replace("1.0", "2.0")):
        left = list(tmp_path.glob("cache/**/speeds.*.pyc"))
        mutate.Bench(project, tmp_path / "cache")
        assert len(left) == 3
        assert not [path for path in left if path.exists()]


@pytest.mark.skipif(shutil.which("git") is None, reason="git is missing")
def test_touched_is_whose_file_tests_or_entry_changed(project):
    def git(*arguments: str) -> None:
        named = ("-c", "user.name=x", "-c", "user.email=x@example.org", *arguments)
        subprocess.run(["git", *named], cwd=project, check=True, capture_output=True)

    (project / "drive/other.py").write_text("A = 1\n")
    (project / "tests/test_other.py").write_text("")
    other = textwrap.dedent(
        """
        [[mutant]]
        name = "other"
        file = "drive/other.py"
        old = "A = 1"
        new = "A = 2"
        tests = ["tests/test_other.py"]
        """
    )
    tabled(project, entry("no cap", *NO_MOST, "tests/test_speeds.py::test_most"), other)
    git("init", "-q", "-b", "main")
    git("add", ".")
    git("commit", "-q", "-m", "x")

    def names() -> list[str]:
        return [mutant.name for mutant in mutate.touched(mutate.mutants(project), project, "HEAD")]

    assert names() == []
    (project / "drive/speeds.py").write_text(SOURCE + "\n")
    assert names() == ["no cap"]
    (project / "tests/test_other.py").write_text("\n")
    assert names() == ["no cap", "other"]
    git("commit", "-q", "-a", "-m", "y")
    tabled(project, entry("no cap at all", *NO_MOST, "tests/test_speeds.py::test_most"), other)
    assert names() == ["no cap at all"]
    with pytest.raises(ValueError, match="revision nowhere"):
        mutate.touched([], project, "nowhere")
