"""Attempts are counted for each host, in a table of bounded size."""

from __future__ import annotations

from robotside.trust.attempt_limit import MAX_HOSTS, AttemptLimit, host_of


def test_a_host_waits_after_too_many_and_another_does_not() -> None:
    limit = AttemptLimit(3, 60.0)
    for moment in (0.0, 10.0, 20.0):
        assert not limit.is_reached("a", moment)
        limit.note("a", moment)
    assert limit.is_reached("a", 20.0)
    assert limit.is_reached("a", 59.9)
    assert not limit.is_reached("b", 20.0)
    assert not limit.is_reached("a", 60.0)
    limit.note("a", 60.0)
    assert limit.is_reached("a", 60.0)
    assert not limit.is_reached("a", 70.0)


def test_strangers_cannot_make_the_table_grow() -> None:
    limit = AttemptLimit(1, 60.0)
    for number in range(MAX_HOSTS + 1):
        limit.note(str(number), 0.0)
    assert not limit.is_reached("0", 0.0)
    assert limit.is_reached("1", 0.0)


def test_one_machine_is_one_host_however_many_addresses_it_takes() -> None:
    assert host_of("192.168.1.7:50001") == host_of("::ffff:192.168.1.7:50002") == "192.168.1.7"
    assert host_of("2001:db8::1:80") == host_of("[2001:db8::ffff]:81") != host_of("2001:db8:0:1::1:80")
    assert host_of("fe80::1%eth0:80") == host_of("fe80::2%eth0:80")
    assert host_of("unknown:0") == "unknown"
