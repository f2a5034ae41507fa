"""What becomes of a test whose machine lacks what it needs."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from tests.lacking import lacking, package

HERE = Path(__file__).parent


@pytest.fixture
def at_home(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CI", raising=False)
    monkeypatch.delenv("MAY_LACK", raising=False)


def test_somebody_who_develops_sees_a_skip_with_its_name(at_home):
    with pytest.raises(pytest.skip.Exception, match=r"^This machine lacks PostgreSQL: nobody runs it\.$"):
        lacking("PostgreSQL", "nobody runs it")


@pytest.mark.parametrize(("name", "value"), [("CI", "true"), ("MAY_LACK", ""), ("MAY_LACK", "mount Xvfb")])
def test_in_ci_it_fails(at_home, monkeypatch, name, value):
    monkeypatch.setenv(name, value)
    with pytest.raises(pytest.fail.Exception, match=r"^This machine lacks PostgreSQL\.$"):
        lacking("PostgreSQL")


def test_what_may_lack_is_skipped_in_ci_too(at_home, monkeypatch):
    monkeypatch.setenv("CI", "true")
    monkeypatch.setenv("MAY_LACK", "mount Xvfb")
    with pytest.raises(pytest.skip.Exception):
        lacking("Xvfb")


def test_a_package_that_is_there_is_given(at_home):
    assert package("colorsys").rgb_to_hsv(1.0, 1.0, 1.0) == (0.0, 0.0, 1.0)


def test_a_package_that_is_not_there_is_lacking(at_home):
    with pytest.raises(pytest.skip.Exception, match="lacks no_such_package"):
        package("no_such_package")


def test_a_package_whose_own_needs_are_not_there_is_broken_and_no_skip(at_home, monkeypatch, tmp_path):
    (tmp_path / "broken_package.py").write_text("import no_such_package")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ModuleNotFoundError, match="no_such_package"):
        package("broken_package")
    assert "broken_package" not in sys.modules


def test_no_test_goes_round_it():
    """Else what lacks in CI would be skipped there and nobody would see it."""
    word = re.compile(r"importor" + "skip")
    assert not [path.name for path in HERE.rglob("*.py") if word.search(path.read_text(encoding="utf-8"))]
