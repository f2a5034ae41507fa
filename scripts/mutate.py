"""Mutation test: each fault of a table is put into the code, and the tests that the table names must notice it.

    python scripts/mutate.py                     every mutant of scripts/mutants/*.toml
    python scripts/mutate.py --only STOP         those whose name, file or table has the word
    python scripts/mutate.py --touched [REV]     those whose file, tests or entry changed since REV

An entry of a table:

    [[mutant]]
    name = "the reset keeps the old order"      # what is broken, as a short sentence
    file = "robotside/control/guarded_robot.py"
    old = '''            self._order = None'''    # exact text, once in the file
    new = '''            pass'''
    tests = ["tests/robotside/control/test_guarded_robot.py"]  # paths or node ids

No source is written. The compiled mutant lies in a bytecode cache of its own (PYTHONPYCACHEPREFIX) under the name of the one
module, marked as not to be compared with its source, so that every Python of the tests loads it: the pytest process, its
forks, and what it starts through any number of shells. Out of reach are a Python that ignores its environment (-I, -E), a
process that is given an environment without that variable, another version of Python, and a file that is run by its path.

A mutant is killed when a test fails or the tests take longer than five times the unmutated run and 10 s. It is broken when
its text is not there exactly once, it does not compile, it cannot be imported, or the tests fail without it. The exit code
is 1 when fewer than 95 % are killed or one is broken.
"""

from __future__ import annotations

import argparse
import fcntl
import importlib.util
import marshal
import os
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from queue import SimpleQueue
from typing import Any

__all__ = ["Mutant", "Outcome", "faults", "mutants", "touched"]

ROOT = Path(__file__).resolve().parents[1]
TABLES = "scripts/mutants"
CACHE = "out/mutate"
"""Bytecode of all that the tests import, kept from run to run: a folder for each worker."""
MIN_SHARE = 0.95
"""Share of the mutants that must be killed."""
TIME_FACTOR, TIME_ALLOWANCE = 5.0, 10.0
"""A mutant may take as many times the unmutated run, and so much longer [s]."""
MAX_BASE_TIME = 300.0
"""The unmutated tests of one entry may take so long [s]."""

_UNCHECKED = 1
"""Flag of bytecode that is loaded without a look at its source (PEP 552)."""
_FAILED = 1
"""Exit code of pytest when tests failed; others mean that they did not run."""
_OPTIMISED = {"": 0, ".opt-1": 1, ".opt-2": 2}
"""By a bytecode file's suffix, the level of optimisation."""


@dataclass(frozen=True)
class Mutant:
    """One fault, and the tests that must notice it."""

    table: str
    name: str
    file: str
    old: str
    new: str
    tests: tuple[str, ...]

    def source(self, root: Path) -> str:
        """The file's text with the fault in it; ValueError with one sentence when it does not fit."""
        path = root / self.file
        if not path.is_file():
            raise ValueError(f"There is no file {self.file}.")
        text = path.read_text(encoding="utf-8")
        found = text.count(self.old)
        if found != 1 or not self.old:
            raise ValueError(f"`old` must be in {self.file} exactly once; it is there {found} times.")
        return text.replace(self.old, self.new)


@dataclass
class Outcome:
    """What became of a mutant."""

    mutant: Mutant
    state: str
    """killed, survived or broken"""
    reason: str = ""
    seconds: float = 0.0

    def line(self) -> str:
        """This outcome as one line, with what was the matter behind it."""
        why = f" [{self.reason}]" if self.reason else ""
        return f"{self.state:8} {self.seconds:6.1f} s  {self.mutant.file}: {self.mutant.name}{why}"


@dataclass
class _Ran:
    code: int | None
    """Exit code; None when time was up."""
    seconds: float
    said: str = field(repr=False, default="")


def _entries(table: str, text: str) -> Iterator[Mutant]:
    for entry in tomllib.loads(text).get("mutant", []):
        yield Mutant(table, **{**entry, "tests": tuple(entry["tests"])})


def mutants(root: Path = ROOT) -> list[Mutant]:
    """Every entry of every table, in order; TypeError or KeyError when one lacks a field or has another."""
    return [
        mutant
        for path in sorted((root / TABLES).glob("*.toml"))
        for mutant in _entries(path.stem, path.read_text(encoding="utf-8"))
    ]


def fault(mutant: Mutant, root: Path = ROOT) -> str:
    """Why an entry is not fit for a run, as one sentence; empty when it is."""
    try:
        compile(mutant.source(root), mutant.file, "exec")
    except (ValueError, SyntaxError) as error:
        return str(error)
    if mutant.old == mutant.new:
        return "It changes nothing."
    if not mutant.tests:
        return "It names no test."
    for test in mutant.tests:
        name, _, within = test.partition("::")
        path = root / name
        if not path.exists():
            return f"There is no {name}."
        parts = [part.partition("[")[0] for part in within.split("::") if part]
        text = path.read_text(encoding="utf-8") if parts else ""
        missing = [part for part in parts if f"def {part}(" not in text and f"class {part}" not in text]
        if missing:
            return f"There is no {missing[0]} in {name}."
    return ""


def faults(root: Path = ROOT) -> list[str]:
    """What is wrong with the tables, one line each."""
    found = mutants(root)
    said = [(mutant, fault(mutant, root)) for mutant in found]
    wrong = [f"{mutant.table}.toml: {mutant.name}: {why}" for mutant, why in said if why]
    names = [(mutant.file, mutant.name) for mutant in found]
    return wrong + [f"{name} is there twice." for name in sorted({n for n in names if names.count(n) > 1})]


def _git(root: Path, *arguments: str) -> str | None:
    done = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=False)  # noqa: S607
    return done.stdout if done.returncode == 0 else None


def _base(root: Path) -> str:
    """Where a branch left main; on main the commit before."""
    base, head = _git(root, "merge-base", "HEAD", "main"), _git(root, "rev-parse", "HEAD")
    return base.strip() if base and base != head else "HEAD~1"


def touched(found: Iterable[Mutant], root: Path = ROOT, revision: str = "") -> list[Mutant]:
    """Those whose file, tests or entry changed since `revision`; ValueError when git does not know it."""
    revision = revision or _base(root)
    changed = _git(root, "diff", "--name-only", "--relative", revision)
    if changed is None:
        raise ValueError(f"git does not know the revision {revision}.")
    files = {*changed.splitlines(), *(_git(root, "ls-files", "-o", "--exclude-standard") or "").splitlines()}

    def has_changed(mutant: Mutant) -> bool:
        if mutant.file in files or any(_lies_in(file, test) for file in files for test in mutant.tests):
            return True
        table = f"{TABLES}/{mutant.table}.toml"
        return table in files and mutant not in before(table, mutant.table)

    tables: dict[str, list[Mutant]] = {}

    def before(table: str, name: str) -> list[Mutant]:
        if table not in tables:
            tables[table] = list(_entries(name, _git(root, "show", f"{revision}:./{table}") or ""))
        return tables[table]

    return [mutant for mutant in found if has_changed(mutant)]


def _lies_in(file: str, test: str) -> bool:
    path = test.partition("::")[0].rstrip("/")
    return file == path or file.startswith(f"{path}/")


class Bench:
    """Runs tests with a bytecode cache of its own, one run at a time."""

    def __init__(self, root: Path, folder: Path) -> None:
        self._root, self._cache, self._note = root, folder / "cache", folder / "mutated"
        self._environment = {
            **{name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"},
            "PYTHONPATH": str(root),
            "PYTHONPYCACHEPREFIX": str(self._cache),
            "HYPOTHESIS_STORAGE_DIRECTORY": str(folder / "hypothesis"),
        }
        self._clean()

    def _clean(self) -> None:
        """Remove what a run that was killed has left."""
        if self._note.exists():
            for compiled in self._note.read_text(encoding="utf-8").splitlines():
                Path(compiled).unlink(missing_ok=True)
            self._note.unlink()

    def _mirrored(self, folder: Path) -> Path:
        return self._cache / folder.absolute().relative_to(folder.absolute().anchor)

    @contextmanager
    def mutated(self, file: str, source: str) -> Iterator[None]:
        """Every Python of a run loads `source` in place of `file`, until the end of this context."""
        path = self._root / file
        head = importlib.util.MAGIC_NUMBER + _UNCHECKED.to_bytes(4, "little")
        head += importlib.util.source_hash(source.encode())
        folder = self._mirrored(path.parent)
        folder.mkdir(parents=True, exist_ok=True)
        files = {
            folder / f"{path.stem}.{sys.implementation.cache_tag}{suffix}.pyc": level
            for suffix, level in _OPTIMISED.items()
        }
        self._note.write_text("".join(f"{compiled}\n" for compiled in files), encoding="utf-8")
        try:
            for compiled, level in files.items():
                code = compile(source, str(path), "exec", dont_inherit=True, optimize=level)
                compiled.write_bytes(head + marshal.dumps(code))
            yield
        finally:
            self._clean()

    def run(self, tests: Sequence[str], limit: float) -> _Ran:
        """Run `tests` up to the first failure, `limit` [s] at most."""
        command = [
            sys.executable,
            "-m",
            "pytest",
            "-x",
            "-q",
            "--no-header",
            "-p",
            "no:cacheprovider",
            *tests,
        ]
        begun = time.monotonic()
        with tempfile.TemporaryFile() as said:
            process = subprocess.Popen(
                command,
                cwd=self._root,
                env=self._environment,
                stdin=subprocess.DEVNULL,
                stdout=said,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            try:
                code: int | None = process.wait(limit)
            except subprocess.TimeoutExpired:
                code = None
            finally:
                _end(process)
            said.seek(0)
            return _Ran(code, time.monotonic() - begun, said.read().decode(errors="replace"))


def _end(process: subprocess.Popen[bytes]) -> None:
    """End the run, and what its tests left running."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


class Runner:
    """Judges mutants, several at a time."""

    def __init__(self, root: Path, folder: Path, workers: int) -> None:
        self._root = root
        self._benches: SimpleQueue[Bench] = SimpleQueue()
        for number in range(workers):
            self._benches.put(Bench(root, folder / str(number)))
        self._workers = workers
        self._base: dict[tuple[str, ...], _Ran] = {}

    def judge(self, found: Sequence[Mutant], tell: Callable[[Outcome], object]) -> list[Outcome]:
        """What becomes of each; `tell` is called with each as soon as it is known."""
        outcomes = [Outcome(mutant, "broken", why) for mutant in found if (why := fault(mutant, self._root))]
        for outcome in outcomes:
            tell(outcome)
        broken = {id(outcome.mutant) for outcome in outcomes}
        fit = [mutant for mutant in found if id(mutant) not in broken]
        with ThreadPoolExecutor(self._workers) as pool:
            lists = sorted({mutant.tests for mutant in fit})
            self._base = dict(zip(lists, pool.map(self._unmutated, lists), strict=True))
            for outcome in pool.map(self._judge, fit):
                tell(outcome)
                outcomes.append(outcome)
        return outcomes

    @contextmanager
    def _bench(self) -> Iterator[Bench]:
        bench = self._benches.get()
        try:
            yield bench
        finally:
            self._benches.put(bench)

    def _unmutated(self, tests: tuple[str, ...]) -> _Ran:
        with self._bench() as bench:
            return bench.run(tests, MAX_BASE_TIME)

    def _judge(self, mutant: Mutant) -> Outcome:
        base = self._base[mutant.tests]
        if base.code != 0:
            return Outcome(mutant, "broken", f"the tests fail without it: {_last(base)}", base.seconds)
        with self._bench() as bench, bench.mutated(mutant.file, mutant.source(self._root)):
            ran = bench.run(mutant.tests, TIME_FACTOR * base.seconds + TIME_ALLOWANCE)
        if ran.code is None:
            return Outcome(mutant, "killed", "time was up", ran.seconds)
        if ran.code < 0:
            return Outcome(mutant, "killed", f"signal {-ran.code}", ran.seconds)
        if ran.code == 0:
            return Outcome(mutant, "survived", "", ran.seconds)
        if ran.code != _FAILED:
            return Outcome(mutant, "broken", f"it cannot be imported: {_last(ran)}", ran.seconds)
        return Outcome(mutant, "killed", "", ran.seconds)


def _last(ran: _Ran) -> str:
    if ran.code is None:
        return f"they take longer than {MAX_BASE_TIME:.0f} s"
    lines = [line for line in ran.said.splitlines() if line.strip()]
    raised = [line[1:] for line in lines if line.startswith("E  ")]
    return (raised[:1] or lines[-1:] or [f"exit code {ran.code}"])[0].strip()


def _arguments(given: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description="Put faults into the code and see whether the tests notice them."
    )
    parser.add_argument("-n", type=int, default=os.cpu_count() or 1, metavar="WORKERS", help="runs at a time")
    parser.add_argument(
        "--only", default="", metavar="PATTERN", help="mutants whose name, file or table has this"
    )
    parser.add_argument(
        "--touched", nargs="?", const="", metavar="REV", help="mutants that changed since REV"
    )
    parser.add_argument("--root", type=Path, default=ROOT, help=argparse.SUPPRESS)
    return parser.parse_args(given)


def _chosen(options: Any) -> list[Mutant]:
    wanted = options.only.casefold()
    found = [
        mutant
        for mutant in mutants(options.root)
        if wanted in f"{mutant.table} {mutant.file} {mutant.name}".casefold()
    ]
    return found if options.touched is None else touched(found, options.root, options.touched)


def main(given: Sequence[str] | None = None) -> int:
    """Run what `given` asks for, and print the outcomes; the exit code."""
    options = _arguments(given)
    options.root = options.root.resolve()
    try:
        found = _chosen(options)
    except (ValueError, TypeError, KeyError) as error:
        print(f"mutate: {error}", file=sys.stderr)
        return 2
    if not found and options.touched is None:
        print(f"mutate: no mutant has {options.only!r}.", file=sys.stderr)
        return 2
    folder = options.root / CACHE
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as lock:
        try:  # two runs at a time would load each other's mutants
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print("mutate: waiting for another run in this folder to end", file=sys.stderr)
            fcntl.flock(lock, fcntl.LOCK_EX)
        runner = Runner(options.root, folder, max(1, min(options.n, len(found))))
        return _sum_up(runner.judge(found, lambda outcome: print(outcome.line(), flush=True)))


def _sum_up(outcomes: Sequence[Outcome]) -> int:
    by_state = {
        state: [each for each in outcomes if each.state == state]
        for state in ("survived", "broken", "killed")
    }
    for state in ("survived", "broken"):
        if by_state[state]:
            print(f"\n{state}:")
            for outcome in by_state[state]:
                print(f"  {outcome.mutant.file}: {outcome.mutant.name}")
    killed, share = len(by_state["killed"]), len(by_state["killed"]) / len(outcomes) if outcomes else 1.0
    print(f"killed {killed} of {len(outcomes)} ({100 * share:.0f} %)")
    return 1 if share < MIN_SHARE or by_state["broken"] else 0


if __name__ == "__main__":
    sys.exit(main())
