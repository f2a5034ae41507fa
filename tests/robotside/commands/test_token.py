"""`robotside token`: a key that a robot takes, shown once."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from bridge.core.identity import Role
from robotside.__main__ import main
from robotside.core.config import TrustSettings
from robotside.trust.people_file import PeopleFile
from robotside.trust.trust import Trust


def test_the_key_that_is_printed_is_the_one_that_the_robot_takes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = time.time()
    assert main(["token", "script", "--role", "drive", "--days", "2", "--state", str(tmp_path)]) == 0
    token = capsys.readouterr().out.strip()
    trust = Trust(PeopleFile(tmp_path), lambda: before, TrustSettings())
    who = trust.identify(token, "192.0.2.9:1")
    trust.close()
    assert (who.name, who.role, who.proven) == ("script", Role.DRIVE, True)
    assert 0 <= who.ends - (before + 2 * 86400) < 60
    assert token.partition(".")[2] not in PeopleFile(tmp_path).path.read_text()


@pytest.mark.parametrize("days", ["0", "-1", "nan", "inf", "40000"])
def test_days_that_are_none_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], days: str
) -> None:
    assert main(["token", "script", f"--days={days}", "--state", str(tmp_path)]) == 2
    assert "more than 0 and at most 36500 days" in capsys.readouterr().err


def test_a_bad_name_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["token", "a\nb", "--state", str(tmp_path)]) == 2
    assert "1 to 40 characters" in capsys.readouterr().err
    assert PeopleFile(tmp_path).read() == ()
