"""The robot's certificate: made once, kept for its owner alone, and known by its fingerprint."""

from __future__ import annotations

import errno
import hashlib
import ssl
import stat
from pathlib import Path

import pytest
from cryptography import x509
from cryptography.hazmat.primitives import serialization
from cryptography.hazmat.primitives.asymmetric import ec

from robotside.trust.certificate import BadCertificate, Certificate, own_certificate, users_certificate


def der(pem: bytes) -> bytes:
    return x509.load_pem_x509_certificate(pem).public_bytes(serialization.Encoding.DER)


def shaken(server: Certificate) -> bytes:
    """The certificate that a client sees in a handshake, in DER."""
    to_server, to_client = ssl.MemoryBIO(), ssl.MemoryBIO()
    trusting = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    trusting.check_hostname, trusting.verify_mode = False, ssl.CERT_NONE
    client = trusting.wrap_bio(to_client, to_server)
    robot = server.context().wrap_bio(to_server, to_client, server_side=True)
    for _ in range(4):
        for side in (client, robot):
            try:
                side.do_handshake()
            except ssl.SSLWantReadError:
                continue
    seen = client.getpeercert(binary_form=True)
    assert seen is not None
    return seen


def test_a_client_sees_the_certificate_of_the_fingerprint(tmp_path: Path) -> None:
    own = own_certificate(tmp_path)
    assert hashlib.sha256(shaken(own)).hexdigest() == own.fingerprint
    assert len(own.fingerprint) == 64


def test_it_is_the_same_after_a_restart_and_another_in_another_directory(tmp_path: Path) -> None:
    first, again = own_certificate(tmp_path / "one"), own_certificate(tmp_path / "one")
    assert (first.fingerprint, first.problem) == (again.fingerprint, again.problem)
    assert first.problem == ""
    assert own_certificate(tmp_path / "two").fingerprint != first.fingerprint


def test_only_its_owner_may_read_the_key(tmp_path: Path) -> None:
    own_certificate(tmp_path)
    (file,) = tmp_path.iterdir()
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    file.chmod(0o644)
    own_certificate(tmp_path)
    assert stat.S_IMODE(file.stat().st_mode) == 0o600


def test_it_is_the_same_on_a_disk_that_has_become_read_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Else every handheld would take the robot for another one, and not even STOP it."""
    before = own_certificate(tmp_path)

    def refuse(*_: object, **__: object) -> None:
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr(Path, "chmod", refuse)
    monkeypatch.setattr(Path, "replace", refuse)
    assert own_certificate(tmp_path) == before


def test_browsers_on_this_machine_find_their_name_in_it(tmp_path: Path) -> None:
    own = x509.load_pem_x509_certificate(own_certificate(tmp_path).pem)
    names = own.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    assert "localhost" in names.get_values_for_type(x509.DNSName)
    assert "127.0.0.1" in {str(each) for each in names.get_values_for_type(x509.IPAddress)}
    assert isinstance(own.public_key(), ec.EllipticCurvePublicKey)
    assert own.not_valid_after_utc.year == 9999


@pytest.mark.parametrize("damage", [b"", b"\x00" * 500, b"-----BEGIN CERTIFICATE-----\nAAAA\n"])
def test_a_damaged_one_is_moved_aside_and_said(tmp_path: Path, damage: bytes) -> None:
    before = own_certificate(tmp_path).fingerprint
    (tmp_path / "certificate.pem").write_bytes(damage)
    after = own_certificate(tmp_path)
    assert after.fingerprint != before
    assert "pair every handheld again" in after.problem
    assert (tmp_path / "certificate.damaged.pem").read_bytes() == damage
    assert own_certificate(tmp_path).problem == ""


def test_where_nothing_can_be_kept_it_serves_all_the_same_and_says_so(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    own = own_certificate(tmp_path / "file" / "state")
    assert hashlib.sha256(shaken(own)).hexdigest() == own.fingerprint
    assert (
        "after a restart every handheld has to pair again" in own.problem or "cannot be read" in own.problem
    )


class TestAUsersOwn:
    def files(self, tmp_path: Path) -> tuple[Path, Path, Certificate]:
        made = own_certificate(tmp_path / "made")
        certificate, key = tmp_path / "c.pem", tmp_path / "k.pem"
        certificate.write_bytes(made.pem)
        key.write_bytes(made.key)
        return certificate, key, made

    def test_is_taken_from_two_files(self, tmp_path: Path) -> None:
        certificate, key, made = self.files(tmp_path)
        assert users_certificate(certificate, key).fingerprint == made.fingerprint

    def test_is_refused_in_one_sentence_when_a_file_is_missing(self, tmp_path: Path) -> None:
        certificate, key, _ = self.files(tmp_path)
        with pytest.raises(BadCertificate, match="certificate cannot be read from .*no such file"):
            users_certificate(tmp_path / "none", key)
        with pytest.raises(BadCertificate, match="key cannot be read from .*no such file"):
            users_certificate(certificate, tmp_path / "none")

    def test_is_refused_when_it_is_something_else(self, tmp_path: Path) -> None:
        certificate, key, _ = self.files(tmp_path)
        with pytest.raises(BadCertificate, match="no certificate in PEM"):
            users_certificate(key, key)
        with pytest.raises(BadCertificate, match="no private key in PEM"):
            users_certificate(certificate, certificate)

    def test_is_refused_with_the_key_of_another(self, tmp_path: Path) -> None:
        certificate, key, _ = self.files(tmp_path)
        key.write_bytes(own_certificate(tmp_path / "other").key)
        with pytest.raises(BadCertificate, match="not that of the certificate"):
            users_certificate(certificate, key)

    def test_is_refused_with_a_key_that_has_a_password(self, tmp_path: Path) -> None:
        certificate, key, made = self.files(tmp_path)
        locked = serialization.BestAvailableEncryption(b"word")
        private = serialization.load_pem_private_key(made.key, None)
        key.write_bytes(
            private.private_bytes(serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, locked)
        )
        with pytest.raises(BadCertificate, match="has a password"):
            users_certificate(certificate, key)


def test_it_tells_the_names_it_is_for(tmp_path: Path) -> None:
    assert "localhost" in own_certificate(tmp_path).names
