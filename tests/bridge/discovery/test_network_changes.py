"""A changed network is noticed."""

from __future__ import annotations

import pytest

from bridge.discovery.network_changes import ANYWHERE, NetworkChanges, SystemNetwork
from tests.bridge.wires import FakeNetwork

ROBOT = ("192.168.1.7", 9090)


def test_as_long_as_nothing_changes_nothing_is_seen():
    changes = NetworkChanges(FakeNetwork(), ROBOT)
    assert [changes.has_changed() for _ in range(3)] == [False, False, False]


def test_another_address_of_this_machine_on_the_way_there_is_seen_once():
    network = FakeNetwork()
    changes = NetworkChanges(network, ROBOT)
    network.address = "10.0.0.5"
    assert [changes.has_changed(), changes.has_changed()] == [True, False]


def test_a_way_that_is_gone_is_no_reason_to_hurry_but_its_return_is():
    network = FakeNetwork()
    changes = NetworkChanges(network, ROBOT)
    network.address = None
    assert not changes.has_changed()
    network.address = "192.168.1.20"
    assert changes.has_changed()


def test_waking_up_is_seen_once():
    network = FakeNetwork()
    changes = NetworkChanges(network, ROBOT)
    network.sleep = 30.0
    assert [changes.has_changed(), changes.has_changed()] == [True, False]


def test_a_clock_that_is_set_right_by_a_little_is_no_sleep():
    network = FakeNetwork()
    changes = NetworkChanges(network, ROBOT)
    network.sleep = 1.5
    assert not changes.has_changed()


def test_without_a_known_address_the_way_to_the_rest_of_the_world_counts():
    network = FakeNetwork()
    NetworkChanges(network, None)
    assert network.asked == [ANYWHERE]


@pytest.mark.parametrize("address", [("127.0.0.1", 9), ("::1", 9)])
def test_the_system_reaches_itself_from_itself(address):
    if SystemNetwork().has(address[0]):  # a machine without IPv6 has no ::1
        assert SystemNetwork().source(address) == address[0]


def test_the_system_knows_its_own_addresses():
    assert SystemNetwork().has("127.0.0.1")
    assert not SystemNetwork().has("192.0.2.1")
    assert SystemNetwork().has("fe80::1")


def test_the_system_counts_its_sleep(monkeypatch):
    slept = SystemNetwork().slept()
    assert SystemNetwork().slept() - slept < 2.0
    monkeypatch.delattr("time.CLOCK_BOOTTIME", raising=False)
    slept = SystemNetwork().slept()
    assert SystemNetwork().slept() - slept < 2.0
