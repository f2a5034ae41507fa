"""Credentials: which robot is expected, and the secret that must not show."""

from __future__ import annotations

import hashlib

import pytest

from bridge.client.credentials import Credentials, fingerprint_of

KEY = "0123456789abcdef" * 4


def test_a_fingerprint_is_the_sha256_of_the_certificate():
    assert fingerprint_of(b"der") == hashlib.sha256(b"der").hexdigest()


def test_the_token_does_not_show():
    """A log line or an error with credentials in it gives nothing away."""
    assert "secret" not in repr(Credentials(KEY, "id.secret", "Patrol-1"))


@pytest.mark.parametrize("wrong", ["", KEY[:-1], KEY.upper(), KEY + "0", "g" * 64])
def test_a_malformed_fingerprint_is_refused(wrong):
    """An empty one above all: it would match every robot."""
    with pytest.raises(ValueError, match="64 hex digits"):
        Credentials(wrong, "token")


@pytest.mark.parametrize("wrong", ["a b", "a\r\nX-Evil: 1", "é", "x" * 513])
def test_a_token_that_would_break_out_of_its_header_is_refused(wrong):
    with pytest.raises(ValueError, match="printable ASCII"):
        Credentials(KEY, wrong)


def test_the_public_id_of_a_client_is_in_its_token() -> None:
    assert Credentials("0" * 64, "f00d.secret").id == "f00d"
    assert Credentials("0" * 64).id == ""
