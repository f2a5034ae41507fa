"""A HELLO is checked in one place: whatever a stranger sends is a proper one within its bounds, or none."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from bridge.core.errors import ProtocolError
from bridge.discovery.hello import (
    MAX_DATAGRAM,
    MAX_TEXT,
    NAMELESS,
    Hello,
    host_of,
    port_of,
    read_hello,
    write_hello,
)

ROBOT = "10.0.0.3"
GOOD: dict[str, Any] = {
    "name": "Patrol-1",
    "url": "ws://10.0.0.3:9090",
    "http": "http://10.0.0.3:8080",
    "battery": 0.75,
}


def datagram(**fields: Any) -> bytes:
    return json.dumps({**GOOD, **fields}).encode()


def test_a_proper_hello_is_read_as_it_was_written():
    hello = Hello(
        name="Patrol-1",
        kind="wheels",
        model="patrol",
        description="Differential drive",
        icon="agriculture",
        url="wss://10.0.0.3:9090/bridge",
        http="https://10.0.0.3:8080",
        battery=0.5,
        driver="tablet",
        boot="0b1c-2",
        key="0123456789abcdef" * 2,
    )
    assert read_hello(write_hello(hello), ROBOT) == hello


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"http": "http://10.0.0.3:99999999"}, "http is as in"),
        ({"url": "ws://[x"}, "url is as in"),
        ({"url": "ws://[x]"}, "url is as in"),
        ({"url": "ws://[::g::]:9090"}, "url is as in"),
        ({"url": "ws://[1:2]:9090"}, "no valid address in brackets"),
        ({"url": "ws://10.0.0.3:0"}, "url is as in"),
        ({"url": "ws://10.0.0.3:65536"}, "url is as in"),
        ({"url": "ws://10.0.0.3:09090"}, "url is as in"),
        ({"url": "ws://10.0.0.3:9090\n"}, "url is as in"),
        ({"url": "ws://10.0.0.3:9090/?a=1"}, "url is as in"),
        ({"url": "ws://me@10.0.0.3:9090"}, "url is as in"),
        ({"url": "http://10.0.0.3:9090"}, "url is as in"),
        ({"url": "file:///etc/passwd"}, "url is as in"),
        ({"http": "javascript://10.0.0.3"}, "http is as in"),
        ({"url": "ws://10.0.0.3:9090/" + "a" * 300}, "url is as in"),
        ({"url": ""}, "url is as in"),
        ({"url": "ws://10.0.0.4:9090"}, "names 10.0.0.4, and the HELLO came from 10.0.0.3"),
        ({"url": "ws://robot.example:9090"}, "names robot.example"),
        ({"http": "http://10.0.0.4:22"}, "names 10.0.0.4"),
        ({"url": "ws://127.0.0.1:9090"}, "names 127.0.0.1"),
        ({"name": ""}, "needs a name"),
        ({"name": "\u202e\u200b\x07"}, "needs a name"),
        ({"name": 5}, "name"),
        ({"battery": 1.5}, "battery is 0 to 1"),
        ({"battery": -0.1}, "battery is 0 to 1"),
        ({"battery": "full"}, "battery"),
        ({"boot": "a b"}, "boot has"),
        ({"boot": "x" * 65}, "boot has"),
        ({"key": "ff"}, "key is empty or 32"),
        ({"key": "F" * 32}, "key is empty or 32"),
        ({"description": "x" * MAX_DATAGRAM}, "at most 4096 bytes"),
    ],
)
def test_what_is_no_hello_is_refused_in_one_sentence(fields, sentence):
    with pytest.raises(ProtocolError, match=sentence):
        read_hello(datagram(**fields), ROBOT)


@pytest.mark.parametrize("number", [b"1e999", b"-1e999", b"Infinity"])
def test_a_battery_is_never_infinite(number):
    with pytest.raises(ProtocolError):
        read_hello(datagram(battery="%").replace(b'"%"', number), ROBOT)


def test_a_battery_that_is_not_known_is_nan():
    assert math.isnan(read_hello(datagram(battery=None), ROBOT).battery)


def test_words_are_on_one_line_without_signs_that_turn_or_hide_text():
    hello = read_hello(
        datagram(name=" Patrol\n\t1\u202e\u2066\u200b\x00 ", driver="\u200f", description="é 图"), ROBOT
    )
    assert (hello.name, hello.driver, hello.description) == ("Patrol 1", NAMELESS, "é 图")


def test_words_are_cut_to_their_bounds_on_both_ways():
    long = Hello(url="ws://10.0.0.3:9090", **dict.fromkeys(MAX_TEXT, "w" * 500))
    read = read_hello(write_hello(long), ROBOT)
    assert {field: len(getattr(read, field)) for field in MAX_TEXT} == MAX_TEXT


def test_who_has_control_is_told_by_name_only():
    assert read_hello(datagram(driver="tablet", driver_id="secret"), ROBOT).driver_id == ""


def test_this_machine_may_name_any_address():
    read = read_hello(datagram(url="ws://Robot.example:9090/", http="http://[fe80:0::1]:80"), "127.0.0.1")
    assert (read.url, read.http) == ("ws://robot.example:9090", "http://[fe80::1]:80")


texts = st.text(max_size=300)
urls = st.builds(
    "{}://{}{}{}".format,
    st.sampled_from(["ws", "wss", "http", "https", "javascript", ""]),
    st.sampled_from([ROBOT, "localhost", "[::1]", "[", "[x]", "", "..", "a..b", "xn--", "-", "é"])
    | st.text(max_size=8),
    st.sampled_from(["", ":", ":9090", ":0", ":65536", ":99999999", ":٣"]) | st.text(max_size=4),
    st.sampled_from(["", "/", "/a/b", "?", "#", "/\n"]) | st.text(max_size=8),
)
fields = st.fixed_dictionaries(
    {},
    optional={
        **{field: texts | st.none() | st.integers() for field in (*MAX_TEXT, "boot", "key", "driver_id")},
        "url": urls,
        "http": urls,
        "battery": st.floats() | st.integers() | st.booleans() | texts,
    },
)
datagrams = st.binary(max_size=200) | st.builds(
    lambda made: json.dumps(made).encode("utf-8", "replace"), fields
)


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(datagrams, st.sampled_from([ROBOT, "127.0.0.1", "", "::1"]))
@example(b'{"name":"\\ud800","url":"ws://10.0.0.3"}', ROBOT)
@example(b"[" * 4000, ROBOT)
@example(b'{"name":"a","url":"ws://10.0.0.3","battery":' + b"9" * 4000 + b"}", ROBOT)
def test_whatever_comes_is_a_proper_hello_or_none(raw, source):
    try:
        hello = read_hello(raw, source)
    except ProtocolError:
        return
    assert all(len(getattr(hello, field)) <= most for field, most in MAX_TEXT.items())
    assert all(getattr(hello, field).isprintable() for field in MAX_TEXT)
    assert math.isnan(hello.battery) or 0 <= hello.battery <= 1
    for url in filter(None, (hello.url, hello.http)):
        assert host_of(url)
        assert port_of(url) != 0
        assert source == "127.0.0.1" or source == "::1" or host_of(url) == source
    assert read_hello(write_hello(hello), source) == hello or math.isnan(hello.battery)
