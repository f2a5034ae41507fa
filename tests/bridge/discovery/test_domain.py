"""Robots and handhelds find each other only within one discovery domain."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest

from bridge.core.errors import BridgeError
from bridge.discovery.beacon import Listener
from bridge.discovery.domain import VARIABLE, discovery_domain
from bridge.discovery.hello import Hello, read_hello, write_hello

SOURCE = "192.0.2.9"


def heard(own: str, of_robot: str) -> list[Hello]:
    """What a listener of the domain `own` passes on of a robot in the domain `of_robot`."""
    found: list[Hello] = []
    listener = Listener(lambda hello, _: found.append(hello), domain=own)
    hello = Hello(name="Patrol-1", url=f"ws://{SOURCE}:9090", domain=of_robot)
    listener._receive(write_hello(hello), SOURCE, 40000)
    assert listener.refused == 0
    return found


@pytest.mark.parametrize(
    ("own", "of_robot"), [("", "demo"), ("demo", ""), ("demo", "Demo"), ("demo", "demo-2")]
)
def test_a_robot_of_another_domain_is_not_heard(own: str, of_robot: str) -> None:
    assert heard(own, of_robot) == []


@pytest.mark.parametrize("domain", ["", "demo", "a" * 32])
def test_a_robot_of_the_own_domain_is_heard(domain: str) -> None:
    assert [hello.domain for hello in heard(domain, domain)] == [domain]


def test_a_robot_that_knows_no_domains_is_in_that_of_all() -> None:
    old = json.dumps({"name": "Patrol-1", "url": f"ws://{SOURCE}:9090"}).encode()
    assert read_hello(old, SOURCE).domain == ""


@pytest.mark.parametrize("name", ["two words", "a" * 33, "käfig", "a/b", "\n"])
def test_a_name_that_is_none_is_refused_with_the_value(name: str) -> None:
    with pytest.raises(BridgeError, match="at most 32 letters") as refused:
        discovery_domain({VARIABLE: name})
    assert str(refused.value).startswith(f"{VARIABLE}: ")
    assert repr(name)[1:10] in str(refused.value)


@pytest.mark.parametrize(
    ("environment", "domain"), [({}, ""), ({VARIABLE: ""}, ""), ({VARIABLE: "team_2"}, "team_2")]
)
def test_the_environment_names_the_domain(environment: dict[str, str], domain: str) -> None:
    assert discovery_domain(environment) == domain


def test_a_hello_with_a_domain_that_is_none_is_refused() -> None:
    found: list[Any] = []
    listener = Listener(lambda *hello: found.append(hello))
    bad = {"name": "Patrol-1", "url": f"ws://{SOURCE}:9090", "domain": "a b"}
    listener._receive(json.dumps(bad).encode(), SOURCE, 40000)
    assert (found, listener.refused) == ([], 1)


def test_tests_are_in_a_domain_of_their_own() -> None:
    assert re.fullmatch("test-[0-9a-f]{16}", discovery_domain())
