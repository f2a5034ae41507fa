"""The log of one client's faults: each kind once, and at the end the number of the rest."""

from __future__ import annotations

import logging
import re
from collections import Counter

from bridge.core.errors import ProtocolError
from bridge.server.reception.log_limit import STRANGERS

__all__ = ["ClientFaults"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

_MAX_KINDS = 50
"""Most kinds of faults that are distinguished for one client."""
_VARIES = re.compile(r"\"[^\"]*\"?|'[^']*'?|[\d.]+|/[\w/.~-]+")
"""Parts of a sentence that differ among faults of one kind: quoted texts, numbers, names."""


class ClientFaults:
    """Counts the faults of one client."""

    def __init__(self, client: str) -> None:
        """`client` is its name for the log."""
        self._client = client
        self._seen: Counter[str] = Counter()

    def note(self, error: ProtocolError) -> None:
        """Log a fault, unless one of its kind was logged before."""
        kind = f"{error.op} {_VARIES.sub('', str(error))}"[:200]
        if kind not in self._seen and len(self._seen) >= _MAX_KINDS:
            kind = "anything else"
        self._seen[kind] += 1
        if self._seen[kind] == 1:
            log.warning("%s: %s", self._client, error)

    def close(self) -> None:
        """Log the number of faults that were not logged."""
        silent = sum(self._seen.values()) - len(self._seen)
        if silent:
            log.warning("%s: %d more of the same", self._client, silent)
