"""The card of a panel: what it shows keeps to its place, however small the card is."""

from __future__ import annotations

import pytest

from app.screens.panels.panel_card import PanelCard
from tests.headless import Stage
from widgets import Battery, Readout


@pytest.mark.parametrize("size", [(64, 60), (90, 72), (120, 110), (200, 200)])
@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_a_figure_is_below_the_name_and_within_the_card(
    stage: Stage, size: tuple[int, int], scale: float
) -> None:
    from kivy.metrics import Metrics

    Metrics.fontscale = scale
    try:
        card = stage.show(PanelCard(title="Speed"), size)
        figure = Readout(fitted=False, unit="m/s", value=12.25, decimals=2, state="live")
        figure.own_height = True
        card.put(figure)
        stage.frames(4)
        row, place = figure.ids.row, card.ids.place
        assert row.height > 0
        assert row.y >= card.y
        assert row.top <= place.top + 1.5
        assert row.right <= card.right
    finally:
        Metrics.fontscale = 1.0


@pytest.mark.parametrize("size", [(64, 60), (90, 72), (120, 110), (200, 200)])
def test_a_battery_is_below_the_name_and_within_the_card(stage: Stage, size: tuple[int, int]) -> None:
    card = stage.show(PanelCard(title="Battery"), size)
    battery = Battery(state="live", share=0.42)
    card.put(battery)
    stage.frames(4)
    for part in battery.children:
        if part.opacity and part.height > 1 and hasattr(part, "texture_size"):
            assert part.top <= card.ids.place.top + 1.5
            assert part.y >= card.y
            assert part.texture_size[0] <= card.width
