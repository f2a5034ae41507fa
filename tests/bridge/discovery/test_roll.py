"""The roll of a robot side: who is there, wherever the list comes from."""

from __future__ import annotations

import json

import pytest

from bridge.core.errors import ProtocolError
from bridge.discovery.hello import Hello
from bridge.discovery.roll import MAX_ROBOTS, MAX_ROLL, read_roll, write_roll

HERE = Hello(name="Patrol-1", url="ws://192.168.1.7:9090", http="http://192.168.1.7:8080", battery=0.5)


def test_the_robots_are_reached_where_their_roll_came_from_whatever_it_says():
    (found,) = read_roll(write_roll([HERE]), "10.0.0.3")
    assert (found.name, found.battery) == ("Patrol-1", 0.5)
    assert (found.url, found.http) == ("ws://10.0.0.3:9090", "http://10.0.0.3:8080")


def test_an_ipv6_address_stands_in_brackets():
    (found,) = read_roll(write_roll([HERE]), "fd00::7")
    assert found.url == "ws://[fd00::7]:9090"


def test_all_robots_of_a_robot_side_are_on_it():
    second = Hello(name="Scout-1", url="ws://192.168.1.7:9091")
    assert [each.name for each in read_roll(write_roll([HERE, second]), "10.0.0.3")] == [
        "Patrol-1",
        "Scout-1",
    ]


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"{}",
        b"[1]",
        b"[{}]",
        b"<html>",
        b"[" * 100_000,
        b" " * (MAX_ROLL + 1),
        b'[{"name": "x", "url": "ftp://h"}]',
    ],
)
def test_what_is_no_roll_is_an_error(text):
    with pytest.raises(ProtocolError):
        read_roll(text, "10.0.0.3")


def test_a_roll_that_does_not_end_is_cut():
    line = json.loads(write_roll([HERE]))[0]
    assert len(read_roll(json.dumps([line] * (MAX_ROBOTS + 5)).encode(), "10.0.0.3")) == MAX_ROBOTS
