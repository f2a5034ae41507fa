"""The card of a panel: what it shows keeps to its place, however small the card is."""

from __future__ import annotations

import pytest
from kivy.metrics import dp, mm

from app.screens.panels.panel_card import PanelCard
from tests.headless import Stage
from widgets import Battery, Readout
from widgets.core.theme import theme


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


@pytest.mark.parametrize("gloves", [False, True])
@pytest.mark.parametrize("width", [90, 150, 240, 520])
def test_every_card_that_is_edited_can_be_hidden_and_removed_by_signs_that_a_finger_meets(
    stage: Stage, width: int, gloves: bool
) -> None:
    theme.gloves = gloves
    try:
        card = stage.show(PanelCard(editing=True, title="Laser scan"), (int(dp(width)), int(dp(200))))
        stage.frames(2)
        shown = [sign for sign in (card.ids.eye, card.ids.close, card.ids.more) if not sign.disabled]
        assert shown in ([card.ids.eye, card.ids.close], [card.ids.more])
        least = mm(20 if gloves else 10)
        assert all(sign.width >= least and sign.height >= least for sign in shown)
        assert sum(sign.width for sign in card.ids.buttons.children) <= card.width or len(shown) == 1
        card.let_go()
    finally:
        theme.gloves = False
