"""What one client does wrong, in the log: each kind once, and in the end how often."""

from __future__ import annotations

import logging
import re
from collections import Counter

from bridge.core.errors import ProtocolError

__all__ = ["ClientFaults"]

log = logging.getLogger(__name__)

_MAX_KINDS = 50
"""So many kinds are told apart for one client."""
_VARIES = re.compile(r"\"[^\"]*\"?|'[^']*'?|[\d.]+|/[\w/.~-]+")
"""What differs among complaints of one kind: quoted texts, numbers, names."""


class ClientFaults:
    """Counts what one client does wrong."""

    def __init__(self, client: str) -> None:
        """`client` is its name for the log."""
        self._client = client
        self._seen: Counter[str] = Counter()

    def note(self, error: ProtocolError) -> None:
        """Log it, unless one of its kind was before."""
        kind = f"{error.op} {_VARIES.sub('', str(error))}"[:200]
        if kind not in self._seen and len(self._seen) >= _MAX_KINDS:
            kind = "anything else"
        self._seen[kind] += 1
        if self._seen[kind] == 1:
            log.warning("%s: %s", self._client, error)

    def close(self) -> None:
        """Log how many were not logged."""
        silent = sum(self._seen.values()) - len(self._seen)
        if silent:
            log.warning("%s: %d more of the same", self._client, silent)
