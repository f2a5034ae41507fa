"""The public forge's workflow names what is there: programs, options of the spec, versions; and no secret leaves its job."""

from __future__ import annotations

import importlib.util
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from scripts.android.package import read_spec

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / ".github/workflows/android.yml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def jobs() -> dict[str, Any]:
    return YAML(typ="safe").load(TEXT)["jobs"]


def test_its_jobs_follow_each_other(jobs):
    order = {name: job.get("needs") for name, job in jobs.items()}
    assert order == {"check": None, "debug": "check", "emulator": "debug", "release": "emulator"}
    assert all(job["timeout-minutes"] <= 120 for job in jobs.values())


def test_every_program_and_make_target_is_there():
    assert {
        name for name in re.findall(r"python -m ([\w.]+)", TEXT) if not importlib.util.find_spec(name)
    } == set()
    makefile = (ROOT / "Makefile").read_text()
    assert all(f"\n{target}:" in makefile for target in re.findall(r"run: make ([\w-]+)", TEXT))


def test_an_option_of_the_spec_is_only_set_where_the_spec_has_it():
    spec = read_spec(ROOT / "buildozer.spec")
    for variable in set(re.findall(r"APP_(\w+):", TEXT)):
        assert variable.lower().replace("_", ".", 1) in spec, f"buildozer would not see APP_{variable}"


def test_it_builds_with_what_the_check_was_run_with():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    buildozer, p4a = project["optional-dependencies"]["android"]
    assert f"BUILDOZER: {buildozer}\n" in TEXT
    year, month, day = p4a.partition("==")[2].split(".")
    assert read_spec(ROOT / "buildozer.spec")["p4a.branch"] == f"v{year}.{int(month):02d}.{int(day):02d}"


def test_secrets_are_of_the_job_that_signs(jobs):
    assert [name for name, job in jobs.items() if "secrets." in str(job)] == ["release"]
    assert jobs["release"]["if"] == "startsWith(github.ref, 'refs/tags/v')"
