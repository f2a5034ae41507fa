"""What stands over a small sensor's picture."""

from __future__ import annotations

import pytest
from kivy.metrics import sp

from widgets.parts.sensor_card import wide
from widgets.sensors.encoders import EncodersView
from widgets.sensors.ultrasound import UltrasoundView


@pytest.mark.parametrize("kind", [UltrasoundView, EncodersView])
@pytest.mark.parametrize("width", [90, 160, 420])
def test_a_long_name_stays_on_its_card(stage, kind, width):
    name = "Ultrasound · /fleet/robot_7/sensors/sonar_left"
    card = stage.show(kind(title=name), size=(width, 120))
    stage.frames(2)
    word = next(one for one in card.texts if one.startswith("U"))
    assert wide(word, sp(11.5)) <= width
    assert word == name.upper() if width == 420 else word.endswith("…")


def test_a_name_that_fits_is_whole(stage):
    card = stage.show(UltrasoundView(title="Ultrasound"), size=(300, 120))
    assert "ULTRASOUND" in card.texts
