"""The robot's certificate: its identity to handhelds, which know it by its fingerprint and trust no authority.

certificate = own_certificate(state)
server = await loop.create_server(..., ssl=certificate.context())
"""

from __future__ import annotations

import base64
import hashlib
import ipaddress
import socket
import ssl
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from robotside.trust.private_file import write_private

__all__ = ["BadCertificate", "Certificate", "own_certificate", "users_certificate"]

FILE_NAME = "certificate.pem"
"""In the state directory: certificate and key in one file, so that no crash leaves one without the other."""

_BEGINS, _ENDS = datetime(2020, 1, 1, tzinfo=UTC), datetime(9999, 12, 31, 23, 59, 59, tzinfo=UTC)
"""A handheld trusts this one certificate until it is unpaired, and a robot without a network does not know the date: an
end would lock everybody out on one day and protect nobody."""


class BadCertificate(Exception):
    """The certificate cannot be used; the text is one sentence."""


@dataclass(frozen=True, slots=True)
class Certificate:
    """A certificate with its key."""

    pem: bytes
    """The certificate, and those of its authority if there are any."""
    key: bytes
    """Private, in PEM."""
    fingerprint: str
    """SHA-256 of the certificate in DER, 64 lower-case hex digits."""
    problem: str = ""
    """Why it is gone after a restart, as one sentence; empty when it is kept."""

    @property
    def names(self) -> tuple[str, ...]:
        """The DNS names that it is for."""
        first = x509.load_pem_x509_certificate(self.pem)
        try:
            found = first.extensions.get_extension_for_class(x509.SubjectAlternativeName)
        except x509.ExtensionNotFound:
            return ()
        return tuple(found.value.get_values_for_type(x509.DNSName))

    @property
    def pin(self) -> str:
        """SHA-256 of its public key in base64, as curl's `--pinnedpubkey` takes it behind `sha256//`."""
        public = x509.load_pem_x509_certificate(self.pem).public_key()
        form = serialization.PublicFormat.SubjectPublicKeyInfo
        der = public.public_bytes(serialization.Encoding.DER, form)
        return base64.b64encode(hashlib.sha256(der).digest()).decode()

    def context(self) -> ssl.SSLContext:
        """For a server's socket; BadCertificate when certificate and key do not belong together."""
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.minimum_version = ssl.TLSVersion.TLSv1_2
        try:
            with tempfile.NamedTemporaryFile(prefix="pilothouse-") as file:  # 0600; ssl reads files only
                file.write(self.pem + self.key)
                file.flush()
                context.load_cert_chain(file.name, password="")
        except ssl.SSLError as error:
            raise BadCertificate(f"Certificate and key cannot be used: {error.reason or error}.") from error
        except OSError as error:
            why = (error.strerror or str(error)).lower()
            raise BadCertificate(f"There is no room for the certificate's temporary file: {why}.") from error
        return context


def own_certificate(state: Path) -> Certificate:
    """The certificate in the directory `state`, made and kept there the first time.

    One that is damaged is moved aside and made anew: every handheld that was paired has to pair again. One that cannot be
    kept lasts until the next start, as its `problem` says.
    """
    path = state / FILE_NAME
    try:
        pem = path.read_bytes()
    except FileNotFoundError:
        return _kept(path, "")
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        return _made(f"The robot's certificate cannot be read ({why}): it has another one until it can.")
    with suppress(OSError):  # a read-only disk leaves it as it is; the robot goes on as the one that it was
        path.chmod(0o600)
    try:
        return _read(pem, pem, str(path))
    except BadCertificate:
        aside = path.with_suffix(".damaged.pem")
        try:
            path.replace(aside)
        except OSError:
            aside = path
        said = f"The robot's certificate was damaged and is at {aside}; it has a new one: pair every handheld again."
        return _kept(path, said)


def users_certificate(certificate: Path, key: Path) -> Certificate:
    """A user's own certificate, in PEM; BadCertificate with one sentence when it cannot be used."""
    pem, secret = _contents(certificate, "certificate"), _contents(key, "key")
    found = _read(pem, secret, f"{certificate} with {key}")
    found.context()
    return found


def _contents(path: Path, what: str) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        raise BadCertificate(f"The {what} cannot be read from {str(path)!r}: {why}.") from error


def _read(pem: bytes, key: bytes, name: str) -> Certificate:
    """The certificate of a file's contents; BadCertificate whose sentence begins with `name`."""
    try:
        first = x509.load_pem_x509_certificate(pem)
    except ValueError as error:
        raise BadCertificate(f"{name}: there is no certificate in PEM.") from error
    try:
        private = serialization.load_pem_private_key(key, None)
    except TypeError as error:
        raise BadCertificate(f"{name}: the key has a password; give one without.") from error
    except ValueError as error:
        raise BadCertificate(f"{name}: there is no private key in PEM.") from error
    if _public(private.public_key()) != _public(first.public_key()):
        raise BadCertificate(f"{name}: the key is not that of the certificate.")
    secret = private.private_bytes(
        serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )
    chain = b"".join(
        each.public_bytes(serialization.Encoding.PEM) for each in x509.load_pem_x509_certificates(pem)
    )
    return Certificate(chain, secret, _fingerprint(first))


def _public(key: object) -> bytes:
    public_bytes = getattr(key, "public_bytes", None)
    if public_bytes is None:
        raise BadCertificate("The key is of a kind that TLS does not know.")
    found: bytes = public_bytes(serialization.Encoding.DER, serialization.PublicFormat.SubjectPublicKeyInfo)
    return found


def _fingerprint(certificate: x509.Certificate) -> str:
    return hashlib.sha256(certificate.public_bytes(serialization.Encoding.DER)).hexdigest()


def _kept(path: Path, said: str) -> Certificate:
    """A new certificate, kept at `path`."""
    made = _made(said)
    try:
        write_private(path, made.pem + made.key)
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        unkept = f"The robot's certificate cannot be kept ({why}): after a restart every handheld has to pair again."
        return Certificate(made.pem, made.key, made.fingerprint, unkept)
    return made


def _made(problem: str) -> Certificate:
    key = ec.generate_private_key(ec.SECP256R1())
    host = socket.gethostname() or "robot"
    subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, host[:64])])
    certificate = (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(subject)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(_BEGINS)
        .not_valid_after(_ENDS)
        .add_extension(x509.SubjectAlternativeName(list(_names(host))), critical=False)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.SERVER_AUTH]), critical=False)
        .sign(key, hashes.SHA256())
    )
    secret = key.private_bytes(
        serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )
    pem = certificate.public_bytes(serialization.Encoding.PEM)
    return Certificate(pem, secret, _fingerprint(certificate), problem)


def _names(host: str) -> Iterable[x509.GeneralName]:
    """Names by which browsers reach the robot at its first start; handhelds do not look at them."""
    for name in dict.fromkeys((host, f"{host}.local", "localhost")):
        if name.isascii():
            yield x509.DNSName(name)
    found = {"127.0.0.1", "::1"}
    with suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:  # without a network
        probe.connect(("192.0.2.1", 9))  # sends nothing; the system chooses its own address
        found.add(str(probe.getsockname()[0]))
    for address in sorted(found):
        yield x509.IPAddress(ipaddress.ip_address(address))
