"""Roles have words, and an id that is published does not give away the one that counts."""

from __future__ import annotations

import math

import pytest

from bridge.core.identity import Identity, Role, public_id
from bridge.core.robot_catalogue import Operator


def test_roles_are_read_by_their_words() -> None:
    assert [Role.read(word) for word in ("none", "watch", "drive", "manage")] == list(Role)


def test_another_word_is_refused_with_what_there_is() -> None:
    with pytest.raises(ValueError, match="none, watch, drive, manage, not 'admin'"):
        Role.read("admin")


def test_each_role_includes_those_before_it() -> None:
    assert Role.NONE < Role.WATCH < Role.DRIVE < Role.MANAGE


def test_a_public_id_is_the_same_each_time_and_does_not_contain_the_secret_one() -> None:
    assert public_id("secret-id") == public_id("secret-id") != public_id("secret-ie")
    assert "secret" not in public_id("secret-id")
    assert public_id("") == ""


def test_an_operator_has_its_role_until_it_ends() -> None:
    guest = Operator("1", "192.0.2.9:1", 0.0, identity=Identity("g", "Guest", Role.WATCH, ends=60.0))
    assert guest.role(59.9) is Role.WATCH
    assert guest.role(60.0) is Role.NONE


def test_without_a_clock_only_a_role_that_ends_is_over() -> None:
    guest = Operator("1", "192.0.2.9:1", 0.0, identity=Identity("g", "Guest", Role.WATCH, ends=60.0))
    owner = Operator("2", "192.0.2.9:2", 0.0, identity=Identity("o", "Owner", Role.DRIVE))
    assert guest.role(math.nan) is Role.NONE
    assert owner.role(math.nan) is Role.DRIVE
