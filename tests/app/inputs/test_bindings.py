"""What is kept of keys and gamepads: by the gamepad's name, over a restart, and what is wrong in it is said."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from app.inputs.bindings import Bindings
from app.inputs.gamepad.pad_map import Profile
from app.inputs.keys.key_table import KeyTable


class Settings(dict[str, Any]):
    def set(self, name: str, value: Any) -> None:
        self[name] = value


def test_each_kind_of_gamepad_has_its_own_profile_and_keeps_it() -> None:
    settings = Settings()
    mapped = Bindings(settings)
    mapped.set_profile("Red", Profile(dead_zone=0.3))
    again = Bindings(settings)
    assert again.profile("Red").dead_zone == 0.3
    assert again.profile("Blue") == Profile()
    assert (again.changed("Red"), again.changed("Blue")) == (True, False)


def test_put_back_it_is_as_at_first_and_nothing_is_kept_of_it() -> None:
    settings = Settings()
    mapped = Bindings(settings)
    mapped.set_profile("Red", Profile(dead_zone=0.3))
    mapped.reset_profile("Red")
    assert mapped.profile("Red") == Profile()
    assert settings["gamepads"]["profiles"] == {}


def test_keys_and_whether_gamepads_count_are_kept() -> None:
    settings = Settings()
    mapped = Bindings(settings)
    mapped.set_keys(replace(KeyTable(), drives=False))
    mapped.use_pads(False)
    again = Bindings(settings)
    assert (again.keys.drives, again.pads_on) == (False, False)


def test_what_is_wrong_is_said_once_it_is_looked_at() -> None:
    mapped = Bindings(Settings(keys={"rise": -1}, gamepads={"profiles": {"Red": {"expo": 7}}}))
    assert mapped.problems == ["The keys' rise is from 0.0 to 2.0, not -1: 0.3 is used."]
    mapped.profile("Red")
    mapped.profile("Red")
    assert mapped.problems[1:] == ["The gamepad's expo is from 0.0 to 1.0, not 7: 0.3 is used."]


def test_what_is_no_table_at_all_is_as_at_first() -> None:
    mapped = Bindings(Settings(gamepads="all"))
    assert mapped.problems == [
        "In the settings of gamepads the stored value is no table but 'all': reset to default."
    ]
    assert mapped.pads_on
