"""Values in a file that a person wrote: nothing else of it changes, or it is not touched."""

from __future__ import annotations

import tomllib

import pytest

from robotside.bringing_up.toml_edit import CannotEdit, edited
from tests.looped import looped

MINE = """# mine
[limits]   # slow
max_speed = 0.5  # by the porch

[serve]
# the old one
robot = "sim:scout # 2"   # in the hall
payloads = [
  "arm",  # the new one
]
[robot]
name = "Rex"
"""


def test_a_value_is_replaced_and_every_comment_around_it_stays() -> None:
    text = edited(MINE, {("serve", "robot"): "sim:patrol", ("serve", "port"): 9091})
    assert text == MINE.replace('"sim:scout # 2"', '"sim:patrol"').replace(
        "]\n[robot]", "]\nport = 9091\n[robot]"
    )


def test_a_list_of_several_lines_is_replaced_whole() -> None:
    text = edited(MINE, {("serve", "payloads"): ("lights",)})
    assert 'payloads = ["lights"]\n[robot]' in text
    assert tomllib.loads(text)["limits"] == {"max_speed": 0.5}


def test_a_table_that_is_not_there_comes_at_the_end() -> None:
    text = edited(MINE, {("gateways", "mqtt", "url"): "mqtt://b", ("gateways", "mqtt", "on"): False})
    assert text == MINE + '\n[gateways.mqtt]\nurl = "mqtt://b"\non = false\n'
    assert edited("", {("serve", "pair"): True}) == "[serve]\npair = true\n"


def test_what_is_none_is_taken_out_and_its_comment_stays() -> None:
    text = edited(MINE, {("serve", "robot"): None, ("serve", "none"): None, ("no", "table"): None})
    assert text == MINE.replace('robot = "sim:scout # 2"   # in the hall', "# in the hall")


@looped("value", ['"', "\\", "ä\u0000\u007f\n", "# no comment", "", 0.5, 7, True, ("a", "'")])
def test_any_value_is_read_back_as_it_was(value: object) -> None:
    said = tomllib.loads(edited(MINE, {("serve", "robot"): value}))["serve"]["robot"]  # type: ignore[dict-item]
    assert said == (list(value) if isinstance(value, tuple) else value)


@looped(
    "text", ["serve = {robot = 'sim:x'}", "serve.robot = 'sim:x'", "serve = 5", "[[serve]]\nrobot = 'sim:x'"]
)
def test_what_cannot_be_changed_without_loss_is_left(text: str) -> None:
    with pytest.raises(CannotEdit, match="table"):
        edited(text, {("serve", "robot"): "sim:y", ("serve", "port"): 1})
