"""TLS as pairing uses it: no authority vouches for a robot, its certificate is known by its fingerprint."""

from __future__ import annotations

import asyncio
import functools
import ssl

from bridge.client.credentials import fingerprint_of

__all__ = ["TlsError", "context", "fingerprint"]

TlsError = ssl.SSLError
"""Raised when the other end does not speak TLS."""


@functools.cache
def context() -> ssl.SSLContext:
    """Options of every TLS connection. Whose certificate it is, the fingerprint decides: nothing else is checked."""
    made = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    made.minimum_version = ssl.TLSVersion.TLSv1_2
    made.check_hostname = False
    made.verify_mode = ssl.CERT_NONE
    return made


def fingerprint(transport: asyncio.BaseTransport) -> str:
    """Fingerprint of the certificate at the other end; empty without TLS."""
    found = transport.get_extra_info("ssl_object")
    certificate = found.getpeercert(binary_form=True) if found is not None else None
    return fingerprint_of(certificate) if certificate else ""
