"""The dialogue, answered by keys: what Enter takes, what is offered, and what of it is kept."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from prompt_toolkit.application import create_app_session
from prompt_toolkit.input import create_pipe_input
from prompt_toolkit.output import DummyOutput

from robotside.bringing_up import dialogue
from robotside.bringing_up.dialogue import NotAnswered, Simulated, ask, chosen
from robotside.bringing_up.robot_file import Choice
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import Config, GatewaySettings, ServeSettings, load
from robotside.gateways import discovery
from sim.catalogue import catalogue

ENTER, DOWN, UP, SPACE, CLEAR = "\r", "\x1b[B", "\x1b[A", " ", "\x15"
CTRL_C = "\x03"


@pytest.fixture(scope="module")
def simulated() -> Simulated:
    found = catalogue()
    return Simulated(tuple(found["robots"]), tuple(found["worlds"]))


@pytest.fixture(autouse=True)
def mqtt_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """The protocols that others add change nothing here."""
    only = {"mqtt": discovery.adapters()["mqtt"]}
    monkeypatch.setattr(discovery, "adapters", lambda: only)


@contextmanager
def keys(*pressed: str) -> Iterator[None]:
    """A terminal at which these keys are pressed."""
    with create_pipe_input() as pipe, create_app_session(input=pipe, output=DummyOutput()):
        pipe.send_text("".join(pressed))
        yield


def test_enter_takes_the_robot_that_is_served_without_a_question(simulated: Simulated) -> None:
    with keys(*ENTER * 7):
        choice = chosen(simulated, Config())
    assert choice == Choice("sim:patrol", "parking_lot")


def test_a_robot_of_the_network_with_payloads_and_a_broker(simulated: Simulated) -> None:
    to_scout, to_office = DOWN + ENTER, ENTER
    with keys(
        to_scout,
        to_office,
        SPACE + DOWN + SPACE + DOWN * 6 + SPACE + ENTER,
        DOWN + ENTER,
        CLEAR + "0" + ENTER,
        ENTER,
        SPACE + ENTER,
        CLEAR + "mqtt://broker/lab" + ENTER,
        "rex" + ENTER,
        "s3cret" + ENTER,
        DOWN * 2 + ENTER,
    ):
        choice = chosen(simulated, Config())
    gateway = GatewaySettings(url="mqtt://broker/lab", user="rex", password="s3cret", role="drive")
    everywhere = "0.0.0.0"
    wanted = Choice(
        "sim:scout", "office", ("laser", "arm"), ("camera",), everywhere, 0, 8080, True, {"mqtt": gateway}
    )
    assert choice == wanted


def test_the_old_answers_are_the_defaults(simulated: Simulated) -> None:
    old = Config(
        serve=ServeSettings(
            "sim:scout", "orchard", ("arm",), ("camera", "imu"), "192.0.2.7", 7001, 7002, pair=True
        ),
        gateways={
            "mqtt": GatewaySettings(url="mqtt://b", user="rex", password="old", role="drive", rate=2.0)
        },
    )
    with keys(*ENTER * 11):
        choice = chosen(simulated, old)
    kept = replace(
        Choice("sim:scout", "orchard", ("arm",), ("imu", "camera"), "192.0.2.7", 7001, 7002, True),
        gateways=old.gateways,
    )
    assert choice == kept


def test_a_gateway_that_is_not_chosen_again_is_off_and_not_forgotten(simulated: Simulated) -> None:
    old = Config(gateways={"mqtt": GatewaySettings(url="mqtt://b", password="old")})
    with keys(*ENTER * 6, SPACE + ENTER):
        choice = chosen(simulated, old)
    assert choice.gateways == {"mqtt": GatewaySettings(on=False, url="mqtt://b", password="old")}


def test_another_robot_is_named_by_its_address_and_a_wrong_one_is_not_taken() -> None:
    with keys(ENTER, CLEAR + "nowhere" + ENTER, CLEAR + "ws://192.0.2.7:9090" + ENTER, *ENTER * 4):
        choice = chosen(Simulated(), Config())
    assert (choice.robot, choice.world, choice.payloads) == ("ros:ws://192.0.2.7:9090", "", ())


def test_a_wrong_port_or_url_is_not_taken(simulated: Simulated) -> None:
    with keys(
        *ENTER * 4,
        CLEAR + "70000" + ENTER,
        CLEAR + "7000" + ENTER,
        ENTER,
        SPACE + ENTER,
        CLEAR + "http://x" + ENTER,
        CLEAR + "own://127.0.0.1:0" + ENTER,
        ENTER,
    ):
        choice = chosen(simulated, Config())
    assert (choice.port, choice.gateways["mqtt"].url) == (7000, "own://127.0.0.1:0")


def test_the_port_of_rosbridge_is_not_taken_again_for_the_web_site(simulated: Simulated) -> None:
    ports = (CLEAR + "7000" + ENTER, CLEAR + "7000" + ENTER, CLEAR + "7001" + ENTER, ENTER)
    with keys(*ENTER * 4, *ports):
        choice = chosen(simulated, Config())
    assert (choice.port, choice.http_port) == (7000, 7001)
    with keys(*ENTER * 4, CLEAR + "0" + ENTER, CLEAR + "0" + ENTER, ENTER):
        choice = chosen(simulated, Config())
    assert (choice.port, choice.http_port) == (0, 0), "each a free one"


def test_a_protocol_whose_library_is_missing_cannot_be_chosen(
    simulated: Simulated, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(discovery, "missing_package", lambda _: "aiomqtt")
    with keys(*ENTER * 6):
        choice = chosen(simulated, Config(gateways={"mqtt": GatewaySettings(url="mqtt://b")}))
    assert choice.gateways == {"mqtt": GatewaySettings(on=False, url="mqtt://b")}


def test_answers_are_kept(simulated: Simulated, tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    with keys(*ENTER * 7):
        ask(file, simulated)
    assert load(file).serve.robot == "sim:patrol"


def test_who_leaves_in_the_middle_leaves_nothing(simulated: Simulated, tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    for pressed in (0, 2, 6):
        with keys(*ENTER * pressed, CTRL_C), pytest.raises(NotAnswered):
            ask(file, simulated)
    assert list(tmp_path.iterdir()) == []


def test_without_the_library_it_says_what_brings_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(dialogue, "can_ask", lambda: False)
    with pytest.raises(UserMistake, match="needs questionary: make setup brings it"):
        ask(tmp_path / "robot.toml", Simulated())


def test_every_folder_of_a_protocol_is_offered(simulated: Simulated, monkeypatch: pytest.MonkeyPatch) -> None:
    offered: list[Any] = []
    monkeypatch.undo()
    monkeypatch.setattr(dialogue, "_checkbox", lambda _, items: offered.extend(items) or [])
    with keys(*ENTER * 5):
        chosen(replace(simulated, robots=()), Config(serve=ServeSettings("ros:ws://192.0.2.7:9090")))
    assert [item.value for item in offered] == list(discovery.adapters())
