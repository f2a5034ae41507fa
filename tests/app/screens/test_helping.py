"""What the help tells of the switches."""

from __future__ import annotations

from app.mapped import Mapped
from app.scanning.settings import Options
from app.screens.helping import help_groups
from tests.app.pushing import Settings


def test_the_keys_that_are_switches_are_told_with_the_stop_that_they_hold() -> None:
    rows = dict(help_groups(Mapped(Settings()), [], Options()))["Switches"]
    assert rows == [(["Tab"], "Next on the glass"), (["Enter"], "Do it"), (["Enter"], "STOP, held 0.8 s")]
    assert "Switches" not in dict(help_groups(Mapped(Settings()), [], Options(on=False)))
