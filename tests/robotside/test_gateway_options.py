"""Gateways as users ask for them: by option, by protocol, by the environment."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from robotside.commands.user_mistake import UserMistake
from robotside.core.config import GatewaySettings, load
from robotside.gateway_options import VARIABLE, for_robot, keeper, required, wishes
from robotside.gateways.discovery import read_wish
from robotside.options import read


def asked(words: str, environment: str = "") -> list[str]:
    options = read(["serve", *words.split()])
    return [f"{adapter.name} {url.shown}" for adapter, url in wishes(options, {VARIABLE: environment})]


def test_nothing_is_asked_for_where_nothing_is_said() -> None:
    assert asked("") == []
    assert asked("--protocols rosbridge,http") == []


def test_all_three_ways_ask_for_the_same() -> None:
    usual = ["mqtt own://127.0.0.1:1883"]
    assert asked("--gateway mqtt") == asked("--protocols http,mqtt") == asked("", "mqtt") == usual
    assert asked("--gateway mqtt=mqtt://h:99/lab --protocols mqtt") == ["mqtt mqtt://h:99/lab"]


def test_only_what_this_very_command_asks_for_is_required() -> None:
    options = read(["serve", "--gateway", "mqtt=mqtt://h", "--gateway", "coap", "--protocols", "http,rest"])
    assert required(options) == {"mqtt", "coap", "rest"}
    assert required(read(["serve"])) == set()


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("--gateway pigeon", "There is no gateway 'pigeon'"),
        ("--gateway mqtt=http://h", "A URL is written as mqtt://HOST"),
        ("--gateway mqtt --gateway mqtt=mqtt://h", "asks for mqtt twice"),
        ("--protocols http,pigeon", "There is no protocol pigeon; there are rosbridge, http, "),
    ],
)
def test_a_mistake_is_one_sentence(words: str, why: str) -> None:
    with pytest.raises(UserMistake, match=why):
        read(["serve", *words.split()])


def test_a_broker_is_the_same_for_all_robots_and_a_listener_has_the_next_port() -> None:
    own, broker = read_wish("mqtt"), read_wish("mqtt=mqtt://127.0.0.1")
    free = own[0], replace(own[1], port=0)
    assert [each.port for _, each in for_robot([broker, own, free], 2)] == [1883, 1885, 0]
    with pytest.raises(UserMistake, match="Robot 3 would have port 65537 for mqtt"):
        for_robot([(own[0], replace(own[1], port=65535))], 2)


def test_what_clients_bring_up_is_kept_where_one_robot_has_one_file(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    assert keeper([], 1) is keeper([file], 2) is keeper([file, file], 1) is None
    keep = keeper([file], 1)
    assert keep is not None
    assert keep("mqtt", "own://127.0.0.1:7") == ""
    assert load(file).gateways == {"mqtt": GatewaySettings(url="own://127.0.0.1:7")}
    file.write_text("gateways = { mqtt = { on = false } }\n")
    assert "do so by hand" in keep("mqtt", None)
    file.write_text("[limits")
    assert keep("mqtt", "")
