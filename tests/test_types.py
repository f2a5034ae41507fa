"""Ordinary mistakes, planted in product files: the type checker of `make lint` finds each."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
MISTAKES = {
    "a wrong field of a message": (
        "app/session/check_list.py",
        'all(check.state == "ok" for check in told.checks)',
        'all(check.state == "ok" for check in told.cheks)',
        "attr-defined",
    ),
    "a missing argument": (
        "widgets/core/base.py",
        "text_texture(self.badge, sp(12), theme.font)",
        "text_texture(self.badge)",
        "call-arg",
    ),
    "a wrong type": (
        "robotside/control/command_expiry.py",
        "self._newest: dict[str, float] = {}",
        "self._newest: dict[str, float] = []",
        "assignment",
    ),
}
"""What it is to the file, its text as it is, as it would be with the mistake, and the code of the error."""


@pytest.fixture(scope="module")
def errors(tmp_path_factory, pytestconfig):
    """File, line and code of each error that mypy finds in the files with their mistakes."""
    place = tmp_path_factory.mktemp("planted")
    command = [sys.executable, "-m", "mypy", "--cache-dir", str(pytestconfig.cache.mkdir("mypy"))]
    for number, (file, was, planted, _) in enumerate(MISTAKES.values()):
        text = (ROOT / file).read_text()
        assert text.count(was) == 1, f"{file} has changed: plant the mistake elsewhere"
        shadow = place / f"{number}.py"
        shadow.write_text(text.replace(was, planted))
        command += ["--shadow-file", file, str(shadow), "-m", file.removesuffix(".py").replace("/", ".")]
    said = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout
    return set(re.findall(r"^([\w/]+\.py):(\d+): error: .*\[([\w-]+)\]$", said, re.MULTILINE))


@pytest.mark.slow
@pytest.mark.parametrize("mistake", MISTAKES)
def test_the_type_checker_finds(errors, mistake):
    file, was, _, code = MISTAKES[mistake]
    line = (ROOT / file).read_text().partition(was)[0].count("\n") + 1
    assert (file, str(line), code) in errors


def test_lint_checks_every_package_with_the_type_checker():
    recipe = (ROOT / "Makefile").read_text().partition("\nlint:")[2].partition("\n\n")[0]
    assert "\t@$(PYTHON) -m mypy\n" in recipe + "\n"
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["mypy"]
    assert settings["strict"]
    assert {"app", "bridge", "robotside", "sim", "widgets"} <= set(settings["packages"])
