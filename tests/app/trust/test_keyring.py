"""The keyring: whom it knows, where it expects them, and a file that nobody else reads."""

from __future__ import annotations

import json
import math
import stat
from pathlib import Path

import pytest

from app.trust.keyring import MAX_ADDRESSES, Keyring
from bridge.client.pairing import Paired
from bridge.core.identity import Role

PATROL, SCOUT = "ab" * 32, "cd" * 32


def paired(
    fingerprint: str = PATROL, name: str = "Patrol-1", url: str = "wss://10.0.0.12:9090", **more
) -> Paired:
    given = {"token": "anna.secret", "id": "anna", "role": Role.DRIVE, "ends": math.nan, **more}
    return Paired(url=url, fingerprint=fingerprint, robot=name, **given)


def test_a_paired_robot_is_known_by_its_address_whatever_the_scheme(tmp_path):
    ring = Keyring(tmp_path)
    key = ring.add(paired())
    assert ring.find("ws://10.0.0.12:9090") == ring.find("wss://10.0.0.12:9090") == key
    assert ring.find("ws://10.0.0.12:9091") is None
    assert key.credentials.fingerprint == PATROL
    assert (key.credentials.token, key.credentials.name) == ("anna.secret", "Patrol-1")
    assert (key.id, key.role, key.ends) == ("anna", "drive", None)


def test_a_claim_finds_it_at_an_address_where_it_was_never_met(tmp_path):
    """It got another address by DHCP; whether it is the one, its certificate proves."""
    ring = Keyring(tmp_path)
    key = ring.add(paired())
    assert ring.find("ws://10.0.0.99:9090", PATROL[:32]) == key
    assert ring.find("ws://10.0.0.99:9090", SCOUT[:32]) is None
    assert ring.claims == {"Patrol-1": PATROL[:32]}


def test_a_robot_that_claims_another_key_is_not_taken_for_the_one_that_was_there(tmp_path):
    ring = Keyring(tmp_path)
    ring.add(paired())
    assert ring.find("ws://10.0.0.12:9090", SCOUT[:32]) is None


def test_an_address_belongs_to_who_proved_itself_there_last(tmp_path):
    ring = Keyring(tmp_path)
    ring.add(paired())
    scout = ring.add(paired(SCOUT, "Scout", "wss://10.0.0.12:9090"))
    assert ring.find("wss://10.0.0.12:9090") == scout
    ring.met(PATROL, "wss://10.0.0.12:9090")
    assert ring.find("wss://10.0.0.12:9090").fingerprint == PATROL


def test_the_newest_addresses_are_kept(tmp_path):
    ring = Keyring(tmp_path)
    ring.add(paired())
    for host in range(20, 40):
        ring.met(PATROL, f"wss://10.0.0.{host}:9090")
    places = ring.get(PATROL).places
    assert len(places) == MAX_ADDRESSES
    assert places[0] == "10.0.0.39:9090"


def test_pairing_again_keeps_where_it_was_met_and_takes_the_new_token(tmp_path):
    ring = Keyring(tmp_path)
    ring.add(paired())
    ring.add(paired(url="wss://10.0.0.13:9090", token="anna.other"))
    assert ring.get(PATROL).places == ("10.0.0.13:9090", "10.0.0.12:9090")
    assert ring.get(PATROL).token == "anna.other"


def test_a_robot_is_forgotten_and_taken_back(tmp_path):
    ring = Keyring(tmp_path)
    key = ring.add(paired())
    assert ring.forget(PATROL) == key
    assert not list(Keyring(tmp_path))
    ring.restore(key)
    assert list(Keyring(tmp_path)) == [key]


def test_the_file_is_for_its_owner_alone_and_survives(tmp_path):
    ring = Keyring(tmp_path)
    ring.add(paired(ends=12345.0))
    assert stat.S_IMODE(ring.path.stat().st_mode) == 0o600
    again = Keyring(tmp_path)
    assert list(again) == list(ring)
    assert again.get(PATROL).ends == 12345.0
    assert not again.problem


def test_what_shows_in_a_log_gives_no_token_away(tmp_path):
    assert "anna.secret" not in repr(Keyring(tmp_path).add(paired()))


KEPT = {
    "fingerprint": PATROL,
    "name": "x",
    "id": "x",
    "role": "drive",
    "token": "t",
    "places": ["10.0.0.12:9090"],
    "ends": None,
}
DAMAGED = [
    "",
    "{",
    "{}",
    "[1]",
    "[" * 100_000,
    '[{"fingerprint": "ab"}]',
    *(
        json.dumps([KEPT | wrong])
        for wrong in (
            {"fingerprint": ""},
            {"name": 7},
            {"role": "king"},
            {"token": ""},
            {"token": "with a space"},
            {"places": 1},
            {"places": [1]},
            {"ends": "now"},
            {"ends": math.nan},
        )
    ),
]


def test_a_file_whose_every_field_is_right_is_read(tmp_path: Path):
    (tmp_path / "keys.json").write_text(json.dumps([KEPT]))
    ring = Keyring(tmp_path)
    assert (ring.problem, [key.places for key in ring]) == ("", [("10.0.0.12:9090",)])


@pytest.mark.parametrize("text", DAMAGED, ids=range(len(DAMAGED)))
def test_a_damaged_file_is_put_aside_and_said(tmp_path: Path, text):
    (tmp_path / "keys.json").write_text(text)
    ring = Keyring(tmp_path)
    assert not list(ring)
    assert "pair again" in ring.problem
    assert (tmp_path / "keys.unreadable.json").read_text() == text
    ring.add(paired())
    assert len(list(Keyring(tmp_path))) == 1


def test_a_disk_that_takes_nothing_is_said_and_the_key_works_until_the_end(tmp_path):
    (tmp_path / "no folder").write_text("")
    ring = Keyring(tmp_path / "no folder")
    ring.add(paired())
    assert "could not be saved" in ring.problem
    assert ring.find("wss://10.0.0.12:9090") is not None
