"""Which key means what: STOP stays, what drives is not given away, and each meaning has one key that was chosen for it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.inputs.binding_actions import MEANINGS
from app.inputs.keys.key_table import MEANT, KeyTable, key_words, read


def test_every_key_means_something_that_there_is() -> None:
    assert set(MEANT.values()) <= set(MEANINGS)
    assert not {"w", "a", "s", "d", "up", "down", "left", "right"} & set(MEANT), "these drive"


def test_escape_is_stop_whatever_the_table_says() -> None:
    assert KeyTable(keys={"escape": "lights"}).meaning("escape") == "stop"
    with pytest.raises(ValueError, match="Esc is STOP and stays it"):
        KeyTable().with_key("escape", "lights")


def test_space_is_stop_until_it_is_set_free() -> None:
    table = KeyTable()
    assert table.keys_of("stop") == ["escape", "spacebar"]
    with pytest.raises(ValueError, match="Space is STOP"):
        table.with_key("spacebar", "lights")
    free = replace(table, space_stops=False).with_key("spacebar", "lights")
    assert (free.meaning("spacebar"), free.keys_of("stop")) == ("lights", ["escape"])


def test_a_key_that_drives_means_nothing_else_while_it_does() -> None:
    with pytest.raises(ValueError, match="W drives"):
        KeyTable().with_key("w", "lights")
    assert replace(KeyTable(), drives=False).with_key("w", "lights").meaning("w") == "lights"


def test_a_key_is_given_from_one_meaning_to_another_and_a_meaning_can_have_none() -> None:
    table = KeyTable().with_key("p", "lights")
    assert (table.meaning("p"), table.meaning("l")) == ("lights", "")
    assert table.keys_of("pause_resume") == []
    assert table.with_key("", "lights").keys_of("lights") == []


def test_keys_of_the_number_pad_mean_what_their_twins_mean() -> None:
    assert KeyTable().meaning("numpadadd") == "faster"
    assert KeyTable().with_key("numpadadd", "lights").meaning("numpadadd") == "lights"


def test_what_was_kept_comes_back_as_it_was() -> None:
    table = replace(KeyTable(), rise=0.5, slow=0.2, drives=False).with_key("f5", "go_home")
    assert read(table.kept(), MEANINGS) == (table, [])
    assert read(None) == (KeyTable(), [])


@pytest.mark.parametrize(
    ("kept", "said"),
    [
        (3, "The keys are not a table but 3."),
        ({"on": "yes"}, "The keys' on is true or false, not 'yes': true is used."),
        ({"rise": 9}, "The keys' rise is from 0.0 to 2.0, not 9: 0.3 is used."),
        ({"slow": 0}, "The keys' slow is from 0.1 to 1.0, not 0: 0.35 is used."),
        ({"keys": [1]}, "The meanings of the keys are not a table but [1]."),
        ({"keys": {**MEANT, "x": "jump"}}, "No key 'x' can mean 'jump'."),
        ({"keys": {**MEANT, "escape": "lights"}}, "No key 'escape' can mean 'lights'."),
    ],
)
def test_what_cannot_be_is_as_at_first_and_said(kept: object, said: str) -> None:
    assert read(kept, MEANINGS) == (KeyTable(), [said])


def test_what_is_printed_on_a_key() -> None:
    assert [key_words(key) for key in ("w", "f1", "pageup", "capslock")] == ["W", "F1", "Page Up", "Capslock"]
