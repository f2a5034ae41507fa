"""The app itself, started with nothing but what the phone has: the files of the package and the spec's modules, without their dependencies.

It is run twice: from its sources with `-OO`, and from compiled files alone, as they are packed. A module that the building machine has a
compiled wheel of is put in with the library of another processor, which on a phone lies in its way as well.
"""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path

from scripts.android.failure import Failed, run
from scripts.android.recipes import Resolved

__all__ = ["check_runs", "environment", "newest_python", "requirements", "site"]

OF_THE_PHONE = frozenset(
    {
        "python3",
        "hostpython3",
        "android",
        "pyjnius",
        "openssl",
        "sqlite3",
        "libffi",
        "setuptools",
        "genericndkbuild",
    }
)
"""Recipes that a desktop's Python has by itself, or that are Android's own."""
PYTHONS = ("python3.13", "python3.12", "python3.11")
"""The newest is nearest to the phone's; the phone's Kivy has no wheel for a desktop's 3.14."""
OTHER = {"x86_64": "aarch64", "aarch64": "x86_64"}
SHOWS = 1.5
"""So long the app shows its first screen [s]."""
BEGIN = f"""
import logging, os, runpy, sys, threading, time
def end():
    while True:
        time.sleep(0.05)
        kivy = sys.modules.get("kivy.app")
        app = kivy and getattr(kivy, "App", None) and kivy.App.get_running_app()
        if app is not None and getattr(app, "root_window", None):
            break
    time.sleep({SHOWS})
    from kivy.clock import Clock
    def stop(_):
        from kivy.base import EventLoop
        print("FRAMES", Clock.frames_displayed, "WIDGETS", sum(1 for _ in app.root.walk()), flush=True)
        app.stop()
    Clock.schedule_once(stop)
threading.Thread(target=end, daemon=True).start()
sys.path.insert(0, os.getcwd())
sys.argv = [sys.argv[1]]
runpy.run_path(sys.argv[0], run_name="__main__")
"""


def newest_python() -> str:
    """The first of PYTHONS that runs here."""
    for name in PYTHONS:
        found = shutil.which(name)
        if found and not subprocess.run([found, "-c", ""], check=False, capture_output=True).returncode:
            return found
    return sys.executable


def requirements(found: Resolved) -> Iterator[str]:
    """What the package has beside the app, as pip understands it: recipes in their own versions, modules in their pins."""
    for recipe in found.recipes:
        name = recipe.name
        if name not in OF_THE_PHONE and not name.startswith("sdl"):
            yield f"{name}=={recipe.version.removeprefix('v')}"
    for module in found.modules:
        yield f"{module.name}=={module.pin}" if module.pin else module.name


def site(python: Path) -> Path:
    """Where a Python keeps what pip installs."""
    return Path(
        run(
            str(python), "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", where=Path("/")
        ).strip()
    )


def environment(folder: Path, found: Resolved) -> Path:
    """The Python of a new environment that has only the package's modules; `folder` is kept for the next time."""
    wanted = sorted(requirements(found))
    python, stamp = folder / "bin/python", folder / "made-for"
    first = newest_python()
    text = "\n".join((first, *wanted))
    if stamp.is_file() and stamp.read_text() == text:
        return python
    shutil.rmtree(folder, ignore_errors=True)
    run(first, "-m", "venv", str(folder), where=folder.parent)
    pip = (
        str(python),
        "-m",
        "pip",
        "install",
        "-q",
        "--no-input",
        "--disable-pip-version-check",
        "--no-deps",
    )
    run(*pip, *wanted, where=folder, limit=900.0)
    for module in found.modules:
        if "-any.whl" not in module.host and module.host:
            _put_strange(pip, f"{module.name}=={module.pin}" if module.pin else module.name, site(python))
    stamp.write_text(text)
    return python


def _put_strange(pip: tuple[str, ...], named: str, into: Path) -> None:
    """The wheel of another processor, its libraries named as python-for-android names them, beside the module's own Python."""
    other = OTHER.get(platform.machine(), "aarch64")
    with tempfile.TemporaryDirectory() as folder:
        tags = (f"manylinux_2_28_{other}", f"manylinux_2_17_{other}", f"manylinux2014_{other}")
        platforms = (f"--platform={tag}" for tag in tags)
        try:
            run(*pip, "--only-binary=:all:", "--target", folder, *platforms, named, where=into)
        except Failed:  # there is none of that release for this Python: nothing lies in the way
            return
        for library in Path(folder).rglob("*.so"):
            to = into / library.relative_to(folder).with_name(f"{library.name.partition('.')[0]}.so")
            for own in to.parent.glob(f"{to.stem}.*.so"):
                own.unlink()
            shutil.copyfile(library, to)


def check_runs(python: Path, tree: Path, folder: Path) -> str:
    """Starts the staged tree as source and as compiled files; Failed with what it said where it did not come up or end."""
    compiled = folder / "compiled"
    shutil.copytree(tree, compiled)
    run(str(python), "-OO", "-m", "compileall", "-q", "-b", "-f", ".", where=compiled)
    for source in compiled.rglob("*.py"):
        source.unlink()
    for cache in compiled.rglob("__pycache__"):
        shutil.rmtree(cache)
    drawn = [
        _start(python, tree, "main.py", folder / "home-source"),
        _start(python, compiled, "main.pyc", folder / "home-compiled"),
    ]
    version = run(str(python), "-V", where=folder).split()[-1]
    return f"run: on Python {version} with the package's modules alone, {drawn[0]} widgets from sources (-OO), {drawn[1]} from compiled files"


def _start(python: Path, tree: Path, main: str, home: Path) -> int:
    """How many widgets its first screen has."""
    home.mkdir()
    told = run(
        str(python),
        "-OO",
        "-I",
        "-c",
        BEGIN,
        main,
        where=tree,
        limit=120.0,
        environment=_variables(home, os.environ),
    )
    if problem := re.search(r"^.*(CRITICAL|Traceback).*$", told, re.MULTILINE):
        raise Failed(f"the app said: {problem[0].strip()}")
    drawn = re.search(r"^FRAMES (\d+) WIDGETS (\d+)", told, re.MULTILINE)
    if not drawn or not int(drawn[1]) or not int(drawn[2]):
        raise Failed(f"{main} drew nothing.")
    return int(drawn[2])


def _variables(home: Path, inherited: Mapping[str, str]) -> dict[str, str]:
    kept = {name: inherited[name] for name in ("PATH", "LANG", "LD_LIBRARY_PATH") if name in inherited}
    return kept | {"HOME": str(home), "SDL_VIDEODRIVER": "offscreen", "SDL_AUDIODRIVER": "dummy", "LIBGL_ALWAYS_SOFTWARE": "1",
                   "PYTHONDONTWRITEBYTECODE": "1"}  # fmt: skip
