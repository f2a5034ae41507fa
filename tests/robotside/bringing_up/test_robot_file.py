"""The choice in robot.toml: whole or not at all, for its owner alone, and nothing lost of what was there."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import msgspec
import pytest

from robotside.bringing_up.robot_file import Choice, before, keep, keep_gateway
from robotside.commands.user_mistake import UserMistake
from robotside.core.config import GatewaySettings, load

MQTT = GatewaySettings(url="mqtt://broker/lab", user="rex", password='p"\\w', role="drive")
CHOICE = Choice(
    "sim:scout", "office", ("arm", "lights"), ("camera",), "0.0.0.0", 0, 8081, True, {"mqtt": MQTT}
)


def test_what_is_kept_is_read_back_as_it_was_and_is_for_its_owner_only(tmp_path: Path) -> None:
    file = tmp_path / "deep" / "robot.toml"
    keep(file, CHOICE)
    config = load(file)
    serve = config.serve
    assert (serve.robot, serve.world, serve.payloads) == ("sim:scout", "office", ("arm", "lights"))
    assert serve.without == ("camera",)
    assert (serve.host, serve.port, serve.http_port, serve.pair) == ("0.0.0.0", 0, 8081, True)
    assert config.gateways == {"mqtt": MQTT}
    assert file.stat().st_mode & 0o777 == 0o600
    assert [each.name for each in file.parent.iterdir()] == ["robot.toml"]


def test_limits_and_comments_of_a_file_that_was_there_stay(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    mine = "# by me\n[limits]\nmax_speed = 0.3 # indoors\n\n[serve]\nport = 1 # old\n"
    file.write_text(mine)
    file.chmod(0o644)
    keep(file, CHOICE)
    assert file.read_text().startswith(mine.replace("port = 1", "port = 0"))
    assert load(file).limits.max_speed == 0.3
    assert file.stat().st_mode & 0o777 == 0o600


def test_a_gateway_that_is_not_wanted_any_more_keeps_its_address(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    keep(file, CHOICE)
    keep(file, replace(CHOICE, gateways={"mqtt": msgspec.structs.replace(MQTT, on=False)}))
    assert load(file).gateways["mqtt"].password == MQTT.password
    assert not load(file).gateways["mqtt"].on


def test_what_was_taken_back_does_not_stay_in_the_file(tmp_path: Path) -> None:
    """Else everybody at the broker might go on driving."""
    file = tmp_path / "robot.toml"
    keep(file, CHOICE)
    file.write_text(file.read_text().replace('role = "drive"', 'role = "drive" # in the lab'))
    plain = GatewaySettings(url="mqtt://other")
    keep(file, replace(CHOICE, gateways={"mqtt": plain}))
    assert load(file).gateways == {"mqtt": plain}
    assert "# in the lab" in file.read_text()
    assert "p\\" not in file.read_text()


def test_a_link_to_the_file_stays_one(tmp_path: Path) -> None:
    real, link = tmp_path / "real.toml", tmp_path / "robot.toml"
    real.write_text("")
    link.symlink_to(real)
    keep(link, CHOICE)
    assert link.is_symlink()
    assert load(real).serve.robot == "sim:scout"


def test_what_cannot_be_kept_is_a_sentence_and_leaves_the_file(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text("serve = {port = 1}\n")
    with pytest.raises(UserMistake, match=r"cannot be changed: .*\[serve\].*; do so by hand"):
        keep(file, CHOICE)
    assert file.read_text() == "serve = {port = 1}\n"
    (tmp_path / "file").write_text("")
    with pytest.raises(UserMistake, match=r"cannot be kept in .*: (not a directory|file exists)\."):
        keep(tmp_path / "file" / "robot.toml", CHOICE)


def test_without_a_file_all_is_usual(tmp_path: Path) -> None:
    assert before(tmp_path / "none.toml").serve.robot is None


def test_a_gateway_that_a_client_brings_up_is_kept_with_what_it_said_and_nothing_of_before(
    tmp_path: Path,
) -> None:
    """Else everybody might go on driving by a role that was said for another address."""
    file = tmp_path / "robot.toml"
    keep(file, CHOICE)
    file.write_text("# by me\n" + file.read_text())
    keep_gateway(file, "mqtt", "own://127.0.0.1:7?role=watch")
    keep_gateway(file, "kafka", "")
    config = load(file)
    assert config.gateways == {
        "mqtt": GatewaySettings(url="own://127.0.0.1:7?role=watch"),
        "kafka": GatewaySettings(),
    }
    assert config.serve == before(file).serve
    assert file.read_text().startswith("# by me\n")
    assert file.stat().st_mode & 0o777 == 0o600


def test_one_that_a_client_brings_down_is_down_at_the_next_start_and_keeps_its_address(
    tmp_path: Path,
) -> None:
    file = tmp_path / "robot.toml"
    keep(file, CHOICE)
    keep_gateway(file, "mqtt", None)
    assert load(file).gateways == {"mqtt": msgspec.structs.replace(MQTT, on=False)}
    keep_gateway(file, "kafka", None)
    assert not load(file).gateways["kafka"].on


def test_a_file_that_cannot_be_changed_is_left_as_it_is_with_a_sentence(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text("gateways = { mqtt = { on = false } }\n")
    with pytest.raises(UserMistake, match="do so by hand"):
        keep_gateway(file, "mqtt", "")
    assert file.read_text() == "gateways = { mqtt = { on = false } }\n"
