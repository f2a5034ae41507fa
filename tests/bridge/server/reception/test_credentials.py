"""Credentials in the headers of a request."""

from __future__ import annotations

import pytest

from bridge.core.errors import Refused
from bridge.core.identity import Identity, Role
from bridge.core.robot_catalogue import Operator
from bridge.server.reception.credentials import bearer, cookie, introduce
from bridge.server.reception.places import Limits, Places, Standing


@pytest.mark.parametrize(
    ("headers", "token"),
    [
        ([], ""),
        (["Bearer id.secret"], "id.secret"),
        (["bearer  id.secret "], "id.secret"),
        (["Basic aWQ6c2VjcmV0"], ""),
        (["Bearer"], ""),
        ([""], ""),
    ],
)
def test_the_token_is_that_of_the_scheme_bearer(headers: list[str], token: str) -> None:
    assert bearer(headers) == token


def test_two_tokens_are_refused() -> None:
    with pytest.raises(Refused, match="one token"):
        bearer(["Bearer a", "Bearer b"])


def test_a_cookie_is_found_by_its_whole_name() -> None:
    headers = ["x=1; pilothouse_80801=b", "pilothouse_8080=a.b; y"]
    assert cookie(headers, "pilothouse_8080") == "a.b"
    assert cookie(headers, "pilothouse") == ""
    assert cookie([], "x") == ""


@pytest.mark.parametrize(
    ("identity", "standing"),
    [
        (Identity("", "", Role.NONE), Standing.STRANGER),
        (Identity("", "", Role.WATCH), Standing.KNOWN),
        (Identity("a", "Ann", Role.WATCH, proven=True), Standing.PROVEN),
        (Identity("a", "Ann", Role.MANAGE, ends=99.0, proven=True), Standing.STRANGER),
    ],
)
def test_a_connection_has_the_standing_of_the_role_that_it_has_now(
    identity: Identity, standing: Standing
) -> None:
    place = Places(Limits()).arrive("192.0.2.7", lambda: None)
    introduce(Operator("1", "192.0.2.7:5", 0.0, identity=identity), place, 100.0)
    assert place.standing is standing
    introduce(Operator("1", "192.0.2.7:5", 0.0, identity=identity), None, 100.0)
