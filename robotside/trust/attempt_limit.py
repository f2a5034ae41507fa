"""A limit on attempts of each address, or of each client behind one, in a table that strangers cannot make grow."""

from __future__ import annotations

import ipaddress
from collections import OrderedDict, deque
from collections.abc import Hashable

__all__ = ["AttemptLimit", "host_of"]

MAX_HOSTS = 1024
"""Hosts whose attempts are counted; of more, those that have not tried for longest are forgotten."""


def host_of(address: str) -> str:
    """The host of `HOST:PORT`; of IPv6 the network of it, in which one machine has as many addresses as it likes."""
    host = address.rpartition(":")[0].strip("[]").partition("%")[0]
    try:
        found = ipaddress.ip_address(host)
    except ValueError:
        return host
    if isinstance(found, ipaddress.IPv4Address):
        return host
    if found.ipv4_mapped:
        return str(found.ipv4_mapped)
    return str(ipaddress.ip_network((found, 64), strict=False))


class AttemptLimit:
    """Counts the attempts of hosts, or of what else they are told apart by; a host that made too many waits until the oldest of them is old enough."""

    def __init__(self, most: int, period: float) -> None:
        """At most `most` attempts in any `period` [s]."""
        self._most, self._period = most, period
        self._hosts: OrderedDict[Hashable, deque[float]] = OrderedDict()

    def is_reached(self, host: Hashable, now: float) -> bool:
        """`host` has no attempt left at `now` [s]."""
        tries = self._hosts.get(host)
        return tries is not None and len(tries) == self._most and now - tries[0] < self._period

    def note(self, host: Hashable, now: float) -> None:
        """`host` made an attempt at `now` [s]."""
        self._hosts.setdefault(host, deque(maxlen=self._most)).append(now)
        self._hosts.move_to_end(host)
        while len(self._hosts) > MAX_HOSTS:
            self._hosts.popitem(last=False)
