"""The interfaces of this machine."""

from __future__ import annotations

from bridge.discovery.interfaces import LOOPBACK, broadcast_addresses, interfaces


def test_loopback_comes_first_and_once():
    found = interfaces()
    assert found[0] == LOOPBACK
    assert sum(interface.address.startswith("127.") for interface in found) == 1
    assert len(set(found)) == len(found)


def test_each_has_an_address_and_one_of_all_on_its_network():
    assert all(
        interface.address.count(".") == interface.broadcast.count(".") == 3 for interface in interfaces()
    )
    assert broadcast_addresses() == sorted({interface.broadcast for interface in interfaces()})
