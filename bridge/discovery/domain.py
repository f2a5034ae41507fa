"""The discovery domain: robots and handhelds find each other only within one.

Several teams, a demo or a test on one network give each its own name, so that none of them lists, and none of them stops,
a robot of another. It is no protection: whoever knows an address may ask there.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping

from bridge.core.errors import BridgeError

__all__ = ["DOMAIN", "VARIABLE", "check_domain", "discovery_domain"]

VARIABLE = "PILOTHOUSE_DOMAIN"
"""Environment variable with the name of the domain; not set, or empty, it is that of everybody who names none."""
DOMAIN = re.compile(r"[A-Za-z0-9_-]{0,32}")
"""A name of a domain; the empty one is that of everybody who names none."""


def check_domain(name: str) -> str:
    """The `name` of a domain. BridgeError, in one sentence, for what is none."""
    if not DOMAIN.fullmatch(name):
        raise BridgeError(
            f"A discovery domain has at most 32 letters, digits, _ and -, which {name[:50]!r} is not."
        )
    return name


def discovery_domain(environment: Mapping[str, str] = os.environ) -> str:
    """The domain of this process. BridgeError when `environment` names one that is none."""
    try:
        return check_domain(environment.get(VARIABLE, ""))
    except BridgeError as fault:
        raise BridgeError(f"{VARIABLE}: {fault}") from None
