"""What `serve` goes by: an option before the environment, that before robot.toml, that before the default; and when it asks."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from robotside.__main__ import main
from robotside.bringing_up.robot_file import kept_at
from robotside.bringing_up.settling import VARIABLES, settle
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import BadConfig
from robotside.gateway_options import wishes
from robotside.options import One, check_reach, read, robots
from tests.looped import looped

FILE = """[serve]
robot = "sim:scout"
world = "office"
payloads = ["lights"]
without = ["camera"]
host = "127.0.0.2"
port = 7001
http_port = 0
[limits]
max_speed = 0.4
[gateways.mqtt]
url = "mqtt://in.file:99/lab"
user = "rex"
password = "s%/@cret"
role = "drive"
payloads = ["wheels"]
rate = 2
"""


@pytest.fixture(autouse=True)
def nothing_around(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    for variable in (*VARIABLES.values(), "PILOTHOUSE_GATEWAYS", "PILOTHOUSE_CONFIG", "PILOTHOUSE_NO_ASK"):
        monkeypatch.delenv(variable, raising=False)


@pytest.fixture
def kept() -> Path:
    file = kept_at(None)
    file.parent.mkdir(parents=True)
    file.write_text(FILE)
    return file


def test_the_kept_file_says_what_is_served_with_all_its_limits(kept: Path) -> None:
    options = read(["serve"])
    assert robots(options) == [One("scout", ("lights",), "")]
    assert (options.world, options.host, options.port, options.http_port) == ("office", "127.0.0.2", 7001, 0)
    assert (options.config, options.without) == ([kept], ("camera",))
    (adapter, url), *others = options.gateways
    assert (adapter.name, url.shown, url.user, url.password) == (
        "mqtt",
        "mqtt://in.file:99/lab",
        "rex",
        "s%/@cret",
    )
    assert (url.role.word, url.keys, url.rate, others) == ("drive", {"wheels", "robot"}, 2.0, [])


def test_without_anything_the_defaults_count() -> None:
    options = read(["serve"])
    assert robots(options) == [One("patrol", (), "")]
    assert (options.world, options.host, options.port, options.http_port) == ("", "127.0.0.1", 9090, 8080)
    assert (options.gateways, options.config) == ([], [])


def test_an_option_counts_before_the_environment_and_that_before_the_file(
    kept: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PILOTHOUSE_PORT", "7002")
    monkeypatch.setenv("PILOTHOUSE_HTTP_PORT", "7003")
    monkeypatch.setenv("PILOTHOUSE_GATEWAYS", "mqtt=mqtt://in.environment")
    options = read(["serve", "--http-port", "7004"])
    assert (options.host, options.port, options.http_port) == ("127.0.0.2", 7002, 7004)
    assert [url.shown for _, url in options.gateways] == ["mqtt://in.environment:1883"]
    options = read(["serve", "--gateway", "mqtt=mqtt://in.option"])
    assert [url.shown for _, url in options.gateways] == ["mqtt://in.option:1883"]


def test_protocols_by_name_have_the_address_of_the_file_and_leave_out_the_others(kept: Path) -> None:
    assert [url.shown for _, url in read(["serve", "--protocols", "mqtt"]).gateways] == [
        "mqtt://in.file:99/lab"
    ]
    assert read(["serve", "--protocols", "http"]).gateways == []
    kept.write_text(FILE + "on = false\n")
    assert read(["serve"]).gateways == []
    assert [url.shown for _, url in read(["serve", "--protocols", "mqtt"]).gateways] == [
        "mqtt://in.file:99/lab"
    ]


def test_another_robot_is_not_that_of_the_kept_file(kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    options = read(["serve", "--robot", "sim:patrol"])
    assert (options.config, options.gateways, options.port) == ([], [], 9090)
    monkeypatch.setenv("PILOTHOUSE_ROBOT", "sim:minnow")
    options = read(["serve"])
    assert (options.robot, options.config, options.world) == ("sim:minnow", [], "")


def test_a_file_that_is_named_counts_for_another_robot_too_but_for_where_that_is_and_what_it_carries(
    kept: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PILOTHOUSE_CONFIG", str(kept))
    options = read(["serve", "--robot", "sim:patrol"])
    assert (robots(options), options.world) == ([One("patrol", (), "")], "")
    assert (options.config, options.port, len(options.gateways)) == ([kept], 7001, 1)


def test_a_state_directory_has_a_file_of_its_own(kept: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    assert read(["serve", "--state", str(other)]).config == []
    other.mkdir()
    (other / "robot.toml").write_text("[serve]\nport = 7010\n")
    assert read(["serve", "--state", str(other)]).port == 7010


@looped(
    ("text", "said"),
    [
        (
            "[serve]\nrobot = 'dog'",
            "{file}: [serve]: There is no robot 'dog'; write simulated ones as sim:patrol",
        ),
        (
            "[serve]\nrobot = 'ros:ws://h:1'\nworld = 'office'",
            "{file}: [serve]: --world is for simulated robots",
        ),
        (
            "[serve]\nwithout = ['leg']",
            "{file}: [serve]: --without: There is no payload leg; there are robot, ",
        ),
        ("[gateways.pigeon]", "{file}: gateways.pigeon: There is no gateway 'pigeon'; there are "),
        ("[gateways.mqtt]\nurl = 'http://h'", "{file}: gateways.mqtt.url: A URL is written as mqtt://HOST"),
        (
            "[gateways.mqtt]\npayloads = ['leg']",
            "{file}: gateways.mqtt.payloads: There is no payload leg; there are ",
        ),
        ("[gateways.mqtt]\nrate = 51", "{file}: gateways.mqtt.rate must be a number at most 50, not 51."),
        (
            "[gateways.mqtt]\nrole = 'manage'",
            "{file}: gateways.mqtt.role must be one of drive, none, watch, not 'manage'.",
        ),
        (
            "[gateways.coap]\nuser = 'rex'\npassword = 'p'",
            "{file}: gateways.coap: coap at coap://127.0.0.1:5683 asks nobody for a user and a password",
        ),
        ("[gateways]\nmqtt = 5", "{file}: gateways.mqtt must be a table, not 5."),
        ("[serve]\nport = 70000", "{file}: serve.port must be a whole number at most 65535, not 70000."),
        ("[serve]\npot = 1", "{file}: serve has no 'pot'; there are robot, world,"),
    ],
)
def test_a_mistake_in_the_file_is_a_sentence_with_file_setting_value_and_what_is_allowed(
    tmp_path: Path, text: str, said: str
) -> None:
    file = tmp_path / "robot.toml"
    file.write_text(text)
    with pytest.raises((UserMistake, BadConfig)) as problem:
        robots(read(["serve", "--config", str(file)]))
    assert said.format(file=file) in str(problem.value)


@looped(
    ("variable", "text"),
    [("PILOTHOUSE_PORT", "65536"), ("PILOTHOUSE_HTTP_PORT", "x"), ("PILOTHOUSE_PORT", "٣")],
)
def test_a_mistake_in_the_environment_names_the_variable(variable: str, text: str) -> None:
    options = read(["serve"])
    options.port = options.http_port = None
    with pytest.raises(UserMistake, match=f"{variable} is a port, 0 to 65535, not '{text}'"):
        settle(options, {variable: text})


def test_a_password_is_in_no_sentence(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text("[gateways.mqtt]\nurl = 'mqtt://rex:secret@h:1:2'\n")
    with pytest.raises(UserMistake) as problem:
        read(["serve", "--config", str(file)])
    assert "secret" not in str(problem.value)


def test_pairing_opens_by_the_file_while_nobody_is_paired(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text("[serve]\nhost = '0.0.0.0'\npair = true\n")
    options = read(["serve", "--config", str(file)])
    check_reach(options, [tmp_path / "state"])
    assert options.pair == "drive"
    file.write_text("[serve]\nhost = '0.0.0.0'\n")
    with pytest.raises(UserMistake, match="Nobody is paired"):
        check_reach(read(["serve", "--config", str(file)]), [tmp_path / "state"])


class Terminal:
    """Standard input or output that is a terminal, or is none."""

    def __init__(self, real: bool) -> None:
        self.real = real

    def isatty(self) -> bool:
        return self.real


def asked(monkeypatch: pytest.MonkeyPatch, words: str, *, stdin: bool = True, stdout: bool = True) -> bool:
    """Whether `serve` with these words asks."""
    questions: list[Path] = []
    with monkeypatch.context() as patch:
        patch.setattr(sys, "stdin", Terminal(stdin))
        patch.setattr(sys, "stdout", Terminal(stdout))
        read(["serve", *words.split()], questions.append)
    return bool(questions)


def test_it_asks_at_a_terminal_where_nothing_says_what_to_serve(monkeypatch: pytest.MonkeyPatch) -> None:
    assert asked(monkeypatch, "")
    assert asked(monkeypatch, "--port 0 --name Rex")
    assert not asked(monkeypatch, "", stdin=False)
    assert not asked(monkeypatch, "", stdout=False)
    for words in (
        "--robot sim:scout",
        "--payloads arm",
        "--gateway mqtt",
        "--protocols http",
        "--no-ask",
        "--with-parent",
    ):
        assert not asked(monkeypatch, words), words
    for variable, value in {
        "ROBOT": "sim:scout",
        "GATEWAYS": "mqtt",
        "PROTOCOLS": "http",
        "NO_ASK": "1",
    }.items():
        with monkeypatch.context() as patch:
            patch.setenv(f"PILOTHOUSE_{variable}", value)
            assert not asked(monkeypatch, ""), variable


def test_a_second_start_asks_nothing_unless_it_is_told_to(
    kept: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert not asked(monkeypatch, "")
    assert not asked(monkeypatch, f"--config {kept}")
    assert asked(monkeypatch, "--ask")
    assert asked(monkeypatch, "--ask --robot sim:patrol")


def test_to_ask_without_a_terminal_is_a_mistake(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(UserMistake, match="--ask needs a terminal"):
        asked(monkeypatch, "--ask", stdin=False)


def test_the_answers_count_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    def answer(file: Path) -> None:
        file.parent.mkdir(parents=True)
        file.write_text(FILE)

    monkeypatch.setattr(sys, "stdin", Terminal(True))
    monkeypatch.setattr(sys, "stdout", Terminal(True))
    assert robots(read(["serve"], answer)) == [One("scout", ("lights",), "")]


def test_the_help_says_what_counts_before_what(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        read(["serve", "--help"])
    said = " ".join(capsys.readouterr().out.split())
    assert "An option counts before the environment, that before robot.toml, that before the default." in said
    assert "PILOTHOUSE_ROBOT" in said


def test_gateways_in_the_environment_that_are_given_count_alone(kept: Path) -> None:
    options = read(["serve"])
    found = wishes(options, {"PILOTHOUSE_GATEWAYS": "mqtt=mqtt://given"})
    assert [url.shown for _, url in found] == ["mqtt://given:1883"]


@pytest.mark.parametrize("option", ["--state", "--config"])
def test_a_start_that_a_kept_file_makes_fail_says_what_asks_again(
    option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = kept_at(tmp_path)
    file.write_text("[serve]\nrobot = 'sim:nobody'\n")
    where = tmp_path if option == "--state" else file
    assert main(["serve", "--state", str(tmp_path / "other"), option, str(where)]) == 2
    said = capsys.readouterr().err
    assert "nobody" in said
    assert said.endswith(" `serve --ask` asks again.\n") is (option == "--state"), (
        "a file of the user's own is theirs to mend"
    )
