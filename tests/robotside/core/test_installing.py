"""What brings a library that is not installed."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path

import pytest

from robotside.core.installing import ROOT, how_to_install, is_installed


@pytest.mark.parametrize(
    ("extra", "command"), [("video", "make video"), ("gateways", "make setup"), ("mdns", "make setup")]
)
def test_in_a_clone_it_is_a_command_of_the_makefile_that_installs_that_extra(
    extra: str, command: str
) -> None:
    assert how_to_install(extra) == command
    step = command.split()[1]
    assert f"\n{step}: ##" in (ROOT / "Makefile").read_text()
    script = (ROOT / "scripts/setup.sh").read_text()
    function = script.split(f"\nset_up_{'run' if step == 'setup' else step}() {{")[1].split("}")[0]
    assert extra in function.replace(";", " ").split()
    assert extra in tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]


def test_elsewhere_it_is_pip_with_the_sources_and_not_with_a_name_that_may_be_anothers(
    tmp_path: Path,
) -> None:
    assert how_to_install("video", tmp_path) == "pip install '.[video]' in the folder of its sources"


def test_nothing_tells_a_user_to_install_by_a_name_that_may_be_anothers() -> None:
    said = "pip install " + "'pilothouse["
    texts = [*(ROOT / "robotside").rglob("*.py"), *(ROOT / "docs").glob("*.md"), ROOT / "README.md"]
    assert [str(each) for each in texts if said in each.read_text()] == []


def test_a_library_is_there_when_all_of_its_parts_are(monkeypatch: pytest.MonkeyPatch) -> None:
    assert is_installed("json", "ast")
    monkeypatch.setitem(sys.modules, "ast", None)
    assert not is_installed("json", "ast")
