"""The numbers of a vehicle have bounds, and a fault in its file names the line."""

from __future__ import annotations

from pathlib import Path

import pytest

from sim.payloads import load as load_payloads
from sim.vehicles.parameters import load as load_parameters
from sim.vehicles.patrol import PatrolParameters


@pytest.mark.parametrize("mass", ["inf", "1e300"])
def test_a_figure_of_a_vehicle_has_an_end(tmp_path: Path, mass: str) -> None:
    own = Path(__file__).parents[3] / "sim/vehicles/patrol/patrol.toml"
    text = own.read_text(encoding="utf-8")
    line = text[: text.index("mass = 6.3")].count("\n") + 1
    file = tmp_path / "patrol.toml"
    file.write_text(text.replace("mass = 6.3", f"mass = {mass}"), encoding="utf-8")
    with pytest.raises(
        ValueError, match=rf"patrol\.toml, line {line}: body\.mass: must be a number at most 1e\+06"
    ):
        load_parameters(file, PatrolParameters)


def test_figures_of_vehicles_and_payloads_name_the_line_too(tmp_path: Path) -> None:
    own = Path(__file__).parents[3] / "sim"
    for source, old, new, read_it, said in (
        (
            "vehicles/patrol/patrol.toml",
            "speed = ",
            "speed = -",
            lambda p: load_parameters(p, PatrolParameters),
            "limits",
        ),
        ("payloads/payloads.toml", "power = ", "power = -", load_payloads, "laser"),
    ):
        text = (own / source).read_text(encoding="utf-8")
        file = tmp_path / Path(source).name
        file.write_text(text.replace(old, new, 1))
        line = text[: text.index(old)].count("\n") + 1
        with pytest.raises(
            ValueError, match=rf"{file.name}, line {line}: {said}\.\w+: must be a number above 0, not -"
        ):
            read_it(file)
