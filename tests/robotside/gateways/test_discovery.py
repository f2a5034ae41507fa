"""Discovery of adapters: by their folders, without the library of any."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import robotside.gateways
from bridge.core.identity import Role
from robotside.gateways.discovery import adapters, missing_package, read_wish

FOLDERS = sorted(path.parent.name for path in Path(robotside.gateways.__path__[0]).glob("*/adapter.py"))
LOOKS = """
import sys
import robotside.__main__, robotside.serving.station_server
print(*sys.modules)
from robotside.gateways.discovery import adapters, missing_package, read_wish
for name in adapters():
    read_wish(name)
    missing_package(adapters()[name])
print(*sys.modules)
"""
"""What is loaded for a robot without gateways, and after a look at all of them."""


def test_each_folder_with_an_adapter_is_one_of_its_name() -> None:
    found = adapters()
    assert list(found) == FOLDERS
    assert "mqtt" in found
    for name, adapter in found.items():
        assert adapter.name == name
        assert read_wish(name) == read_wish(f"{name}={adapter.default}")


def test_a_robot_without_gateways_loads_none_and_a_look_at_them_loads_no_library() -> None:
    done = subprocess.run([sys.executable, "-c", LOOKS], capture_output=True, text=True, check=True)
    bare, looked = (set(line.split()) for line in done.stdout.splitlines())
    libraries = {adapter.package for adapter in adapters().values()} - {""} | {"paho", "confluent_kafka"}
    rooms = {
        f"robotside.gateways.{name}"
        for name in (*FOLDERS, "plain.visitor", "plain.strict_json", "payloads", "discovery", "gateway_url")
    }
    assert not bare & (libraries | rooms)
    assert not looked & libraries


def test_options_alone_are_those_of_the_usual_url() -> None:
    adapter, url = read_wish("mqtt=?role=drive&rate=2")
    assert url == replace(read_wish("mqtt")[1], role=Role.DRIVE, rate=2.0)
    assert adapter.name == "mqtt"


def test_what_is_not_there_is_named_with_what_is() -> None:
    with pytest.raises(ValueError, match="There is no gateway 'carrier pigeon'; there are .*mqtt"):
        read_wish("carrier pigeon=coop://roof")
    with pytest.raises(ValueError, match="mqtt= needs a URL, as mqtt=own://"):
        read_wish("mqtt=")


@pytest.mark.parametrize(
    "wish",
    [
        "coap=coap://u:secret@127.0.0.1:5683",
        "websocket=ws://u:secret@127.0.0.1:9190",
        "websocket=ws://:secret@127.0.0.1:9190",
        "mqtt=own://u:secret@127.0.0.1:1883",
        "kafka=own://u@127.0.0.1",
    ],
)
def test_a_password_that_nobody_would_ask_for_is_refused(wish: str) -> None:
    with pytest.raises(ValueError, match="asks nobody for a user and a password: leave them out") as fault:
        read_wish(wish)
    assert "secret" not in str(fault.value)


def test_a_path_that_nothing_would_use_is_refused() -> None:
    for wish in ("coap=coap://127.0.0.1:5683/pre", "websocket=ws://127.0.0.1:9190/pre"):
        with pytest.raises(ValueError, match="has no path: leave out /pre"):
            read_wish(wish)


@pytest.mark.parametrize(
    "wish",
    [
        "mqtt=mqtts://u:p@h/lab",
        "mqtt=own://h:1/lab",
        "kafka=kafkas://u:p@h/lab",
        "rest=site:/api/v2",
        "coap=coap://h/",
    ],
)
def test_parts_that_are_used_are_taken(wish: str) -> None:
    assert read_wish(wish)[0].name == wish.partition("=")[0]


def test_a_library_that_is_not_installed_is_named() -> None:
    mqtt = adapters()["mqtt"]
    assert missing_package(replace(mqtt, package="no_such_library")) == "no_such_library"
    assert missing_package(replace(mqtt, package="")) == ""
