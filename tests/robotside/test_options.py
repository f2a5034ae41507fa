"""The command line of the robot side: several robots, where each keeps its things, and what is wrong with what was typed."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import pytest

from bridge.core.identity import Role
from bridge.discovery.domain import VARIABLE, discovery_domain
from robotside.__main__ import main
from robotside.core.config import BadConfig
from robotside.options import (
    MAX_ROBOTS,
    One,
    UserMistake,
    check_reach,
    configs,
    ports,
    read,
    robots,
    state,
)
from robotside.trust.people import HANDHELD, added, make_person
from robotside.trust.people_file import PeopleFile
from sim.world.world_files import WORLDS


def named(words: str) -> list[One]:
    return robots(read(words.split()))


@pytest.mark.parametrize(
    ("words", "around", "domain"),
    [
        ("", "", ""),
        ("", "team_1", "team_1"),
        ("--domain team_2", "", "team_2"),
        ("--domain team_2", "team_1", "team_2"),
        ("--domain=", "team_1", ""),
    ],
)
def test_the_discovery_domain_is_that_of_the_option_else_of_the_environment(
    monkeypatch: pytest.MonkeyPatch, words: str, around: str, domain: str
) -> None:
    monkeypatch.setenv(VARIABLE, around)
    read(["serve", *words.split()])
    assert discovery_domain() == domain


def test_a_domain_of_the_environment_that_is_none_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, "a/b")
    with pytest.raises(UserMistake, match=f"^{VARIABLE}: A discovery domain has at most 32 letters"):
        read(["serve"])


def test_one_robot_is_what_is_served_when_nothing_is_said() -> None:
    assert robots(read(["serve"])) == [One("patrol", (), "")]


def test_several_robots_are_named_with_commas_and_what_each_carries_with_a_plus() -> None:
    found = named("--robot sim:patrol,scout+arm+lights,sim:patrol --name Rex,Max,Ada")
    assert found == [
        One("patrol", (), "Rex"),
        One("scout", ("arm", "lights"), "Max"),
        One("patrol", (), "Ada"),
    ]


def test_payloads_of_the_only_robot_may_be_an_option_of_their_own() -> None:
    assert named("--robot sim:patrol+arm --payloads lights,laser") == [
        One("patrol", ("arm", "lights", "laser"), "")
    ]


def test_another_robot_is_served_alone_and_its_name_may_have_a_comma() -> None:
    options = read(["--robot", "ros:ws://192.0.2.7:9090", "--name", "Rex, the first"])
    assert robots(options) == [One("ros:ws://192.0.2.7:9090", (), "Rex, the first")]


def test_several_robots_of_others_are_served_side_by_side():
    options = read(["--robot", "ros:ws://192.0.2.7:9090, ros:ws://192.0.2.8:9090", "--name", "North, South"])
    assert robots(options) == [
        One("ros:ws://192.0.2.7:9090", (), "North"),
        One("ros:ws://192.0.2.8:9090", (), "South"),
    ]


def test_a_robot_of_others_is_served_once():
    options = read(["--robot", "ros:ws://192.0.2.7:9090,ws://192.0.2.7:9090"])
    with pytest.raises(
        UserMistake, match=r"^--robot names ws://192\.0\.2\.7:9090 twice; a robot is served once\.$"
    ):
        robots(options)


def test_each_robot_has_the_next_ports_and_free_ones_stay_free() -> None:
    options = read(["--port", "9090", "--http-port", "0"])
    assert [ports(options, number) for number in (0, 1, 2)] == [(9090, 0), (9091, 0), (9092, 0)]


def test_each_robot_keeps_its_own_whether_it_is_alone_or_with_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", "/kept")
    options = read(["serve"])
    both = [state(options, ["patrol", "patrol"], number, "office") for number in (0, 1)]
    assert both == [Path("/kept/pilothouse/sim-patrol-office"), Path("/kept/pilothouse/sim-patrol-2-office")]
    assert state(options, ["patrol"], 0, "office") == both[0]
    assert state(options, ["patrol"], 0, "/far/my field.toml").name == "sim-patrol--far-my-field.toml"
    assert state(options, ["ros:ws://192.0.2.7:9090"], 0, "").name == "ros-ws-192.0.2.7-9090"


def test_a_directory_that_is_named_is_that_of_the_only_robot_and_holds_those_of_several() -> None:
    options = read(["--state", "/my"])
    assert state(options, ["scout"], 0, "office") == Path("/my")
    names = ["scout", "patrol", "scout"]
    assert [state(options, names, number, "office").name for number in range(3)] == [
        "scout",
        "patrol",
        "scout-2",
    ]


def test_settings_are_one_file_for_all_or_one_each(tmp_path: Path) -> None:
    files = []
    for number in (1, 2):
        files.append(tmp_path / f"{number}.toml")
        files[-1].write_text(f"[limits]\nmax_speed = 0.{number}\n")
    one, two = (("--config", str(file)) for file in files)
    assert [each.limits.max_speed for each in configs(read(one), 3)] == [0.1, 0.1, 0.1]
    assert [each.limits.max_speed for each in configs(read([*one, *two]), 2)] == [0.1, 0.2]
    with pytest.raises(UserMistake, match="Give --config once, or 3 times for 3 robots, not 2 times"):
        configs(read([*one, *two]), 3)


@pytest.mark.parametrize(
    ("text", "what"),
    [("[robot]\nname = 'Rex'", "name"), ("[database]\nurl = 'sqlite:///kept.db'", "database")],
)
def test_what_two_robots_cannot_share_is_refused(tmp_path: Path, text: str, what: str) -> None:
    file = tmp_path / "robot.toml"
    file.write_text(text)
    options = read(["--config", str(file)])
    assert len(configs(options, 1)) == 1
    with pytest.raises(
        UserMistake, match=f"2 robots cannot share its {what}; give each a --config of its own"
    ):
        configs(options, 2)


def test_a_wrong_file_among_several_is_named(tmp_path: Path) -> None:
    for name, text in (("a", ""), ("b", "[limits]\nmax_speed = -1")):
        (tmp_path / name).write_text(text)
    with pytest.raises(BadConfig, match="b: limits.max_speed must be a number above 0, not -1"):
        configs(read(["--config", str(tmp_path / "a"), "--config", str(tmp_path / "b")]), 2)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--robot sim:patrol,,scout", "There is no robot 'sim:patrol,,scout'; write simulated ones as"),
        (
            f"--robot sim:{','.join(['patrol'] * 33)}",
            f"One robot side serves at most {MAX_ROBOTS} robots, not 33.",
        ),
        (
            "--robot sim:patrol,scout --payloads arm",
            "--payloads is for one robot. For 2 robots give each its payloads",
        ),
        (
            "--robot sim:patrol,scout --name Rex",
            "--name must have 2 names separated by commas, not 1: 'Rex'.",
        ),
        (
            "--robot sim:patrol,scout --name Rex,Rex",
            "--name gives 'Rex' to 2 robots; each robot needs its own name.",
        ),
        (
            "--robot ros:ws://192.0.2.7:9 --world lake",
            "--world is for simulated robots only.",
        ),
        ("--gui", "--gui needs a display, and DISPLAY is not set."),
        ("--domain a/b", "A discovery domain has at most 32 letters, digits, _ and -, which 'a/b' is not."),
    ],
)
def test_what_cannot_be_is_one_sentence(monkeypatch: pytest.MonkeyPatch, words: str, said: str) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    with pytest.raises(UserMistake) as problem:
        named(words)
    assert str(problem.value).startswith(said)
    assert "\n" not in str(problem.value)


def test_ports_end_where_there_are_no_more() -> None:
    with pytest.raises(UserMistake, match="Robot 2 would have port 65536"):
        ports(read(["--port", "65535"]), 1)


def test_what_can_be_simulated_is_told_to_people_and_to_programs(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["offer"]) == 0
    told = capsys.readouterr().out
    assert "minnow       Boat with rudder and throttle; at home in lake" in told
    assert "for minnow, aqua, ardrone" in told
    assert main(["offer", "--json"]) == 0
    assert [world["name"] for world in json.loads(capsys.readouterr().out)["worlds"]] == list(WORLDS)


class Greeting:
    """A command, as a module of `robotside.commands` is one."""

    def add(self, commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
        parser = commands.add_parser("greet")
        parser.add_argument("--times", type=int, default=1)
        parser.set_defaults(run=self.run)

    def run(self, options: argparse.Namespace) -> int:
        if options.times < 1:
            raise UserMistake("Once at least.")
        sys.stdout.write("Hello. " * options.times)
        return 3


def test_a_command_has_its_options_and_its_exit_code(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("robotside.options.COMMANDS", (Greeting(),))
    assert main(["greet", "--times", "2"]) == 3
    assert capsys.readouterr().out.startswith("Hello. Hello.")
    assert main(["greet", "--times", "0"]) == 2
    assert capsys.readouterr().err == "robotside: Once at least.\n"


def test_a_wrong_option_names_the_help_of_its_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["offer", "--colour"]) == 2
    assert "see python -m robotside" in capsys.readouterr().err


class TestReach:
    """Who listens beyond this machine says first how people are let in."""

    def refused(self, state: Path, *words: str) -> str:
        with pytest.raises(UserMistake) as mistake:
            check_reach(read(["serve", *words]), [state])
        return str(mistake.value)

    @pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.168.1.7", "robot.local", ""])
    def test_without_anybody_who_is_paired_it_is_refused_with_the_way_out(
        self, tmp_path: Path, host: str
    ) -> None:
        said = self.refused(tmp_path, "--host", host)
        assert "add --pair" in said
        assert "or --plain" in said

    def test_this_machine_alone_needs_nothing(self, tmp_path: Path) -> None:
        for host in ("127.0.0.1", "localhost", "::1", "127.0.0.2"):
            check_reach(read(["serve", "--host", host]), [tmp_path])

    def test_pairing_or_plain_or_somebody_who_is_paired_lets_it_start(self, tmp_path: Path) -> None:
        check_reach(read(["serve", "--host", "0.0.0.0", "--pair"]), [tmp_path])
        check_reach(read(["serve", "--host", "0.0.0.0", "--plain", "watch"]), [tmp_path])
        made, _ = make_person("Anna", Role.DRIVE, HANDHELD, now=1.0)
        PeopleFile(tmp_path).change(lambda people: added(people, made))
        check_reach(read(["serve", "--host", "0.0.0.0"]), [tmp_path])
        assert str(tmp_path / "other") in self.refused(tmp_path / "other", "--host", "0.0.0.0")

    def test_a_damaged_list_counts_as_nobody_and_that_is_said(self, tmp_path: Path) -> None:
        PeopleFile(tmp_path).path.write_bytes(b"{")
        said = self.refused(tmp_path, "--host", "0.0.0.0")
        assert "Nobody is paired" in said
        assert "The list of people was damaged and is at" in said

    def test_roles_and_files_are_checked(self) -> None:
        for words in (["--pair", "king"], ["--plain", "none"], ["--certificate", "x"], ["--key", "x"]):
            with pytest.raises(UserMistake):
                read(["serve", *words])
        options = read(["serve", "--pair", "--plain"])
        assert (options.pair, options.plain) == ("drive", "drive")
