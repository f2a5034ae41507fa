"""A centre goes to robots of ours with the keys that they gave it."""

from __future__ import annotations

import asyncio
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import pytest

from bridge.client.credentials import Credentials
from bridge.core.identity import Role
from bridge.core.toml_files import FileFault
from robotside.core.config import TrustSettings
from robotside.foreign.foreign_link import ForeignLink
from robotside.foreign.foreign_robot import ForeignRobot
from robotside.foreign.robot_keys import key_for, read_keys
from robotside.trust.certificate import own_certificate
from robotside.trust.people import TOKEN, added, make_person
from robotside.trust.people_file import PeopleFile
from tests.robotside.serving.test_station_keys import serving

GOOD = '["192.168.1.7:9090"]\nfingerprint = "' + "ab" * 32 + '"\ntoken = "id.secret"\n'


def kept(folder: Path, text: str, mode: int = 0o600) -> Path:
    file = folder / "keys.toml"
    file.write_text(text)
    file.chmod(mode)
    return file


def test_a_robot_is_met_with_the_key_for_its_address_and_no_other(tmp_path):
    keys = read_keys(kept(tmp_path, GOOD))
    assert key_for("ws://192.168.1.7:9090", keys) == Credentials("ab" * 32, "id.secret")
    assert key_for("ws://192.168.1.7:9091", keys) is None


@pytest.mark.parametrize(
    ("text", "mode", "said"),
    [
        (GOOD, 0o644, "keys.toml: others may read these keys; chmod 600"),
        (GOOD.replace("ab" * 32, "ab"), 0o600, "A fingerprint is 64 hex digits, not 'ab'."),
        (GOOD + 'name = "x"\n', 0o600, "name"),
        ("[[", 0o600, "keys.toml"),
    ],
)
def test_a_mistake_in_the_file_is_one_sentence_and_shows_no_key(tmp_path, text, mode, said):
    with pytest.raises(FileFault) as found:
        read_keys(kept(tmp_path, text, mode))
    assert said in str(found.value)
    assert "secret" not in str(found.value)
    assert "\n" not in str(found.value)


async def reached(url: str, key: Credentials) -> str:
    """The trouble with a robot once it was reached or refused."""
    connect = partial(ForeignLink, credentials=key)
    with ThreadPoolExecutor(1) as thread:
        run = asyncio.get_running_loop().run_in_executor
        robot = await run(thread, partial(ForeignRobot, url, patience=20.0, connect=connect))
        try:
            return robot.trouble
        finally:
            await run(thread, robot.close)


async def test_a_robot_that_lets_nobody_in_without_a_key_is_driven_with_one(tmp_path):
    made, token = make_person("centre", Role.DRIVE, TOKEN, now=time.time(), ends=time.time() + 60)
    PeopleFile(tmp_path).change(lambda people: added(people, made))
    fingerprint = own_certificate(tmp_path).fingerprint
    async with serving(tmp_path, settings=TrustSettings(local_role="none")) as (serves, _, _):
        url = serves.addresses.bridge
        assert "does not know" in await reached(url, Credentials(fingerprint, "nobody.wrong"))
        assert await reached(url, Credentials(fingerprint, token)) == ""
        assert await reached(url, Credentials("00" * 32, token)) != ""
