"""What the help tells of the switches."""

from __future__ import annotations

from app.inputs.bindings import Bindings
from app.inputs.switch_access.scan.settings import Options
from app.screens.shell.key_help import help_groups
from tests.app.inputs.pushing import Settings


def test_the_keys_that_are_switches_are_told_with_the_stop_that_they_hold() -> None:
    rows = dict(help_groups(Bindings(Settings()), [], Options()))["Switches"]
    assert rows == [
        (["Tab"], "Next on the screen"),
        (["Enter"], "Do it, when let go"),
        (["Tab"], "Back, held 0.6 s"),
        (["Enter"], "STOP, held 0.8 s"),
        (["Tab", "Enter"], "STOP, both together"),
    ]
    assert "Switches" not in dict(help_groups(Bindings(Settings()), [], Options(on=False)))


def test_of_one_switch_only_what_it_does_is_told_and_how_long_it_is_held() -> None:
    rows = dict(help_groups(Bindings(Settings()), [], Options(one=True, acceptance=1.0)))["Switches"]
    assert rows == [(["Enter"], "Do it, when let go"), (["Enter"], "STOP, held 1.3 s")]
