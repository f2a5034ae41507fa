from __future__ import annotations

import pytest
from kivy.uix.widget import Widget

from widgets.parts.column import Column, Grid


@pytest.mark.parametrize(("layout", "height"), [(Column(), 90), (Grid(cols=2), 60)])
def test_it_is_as_high_as_what_is_in_it(stage, layout, height):
    stage.show(layout)
    for _ in range(3):
        layout.add_widget(Widget(size_hint_y=None, height=30))
    stage.frames(2)
    assert layout.height == height
