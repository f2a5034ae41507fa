"""The bar above the robots on a narrow glass."""

from __future__ import annotations

from typing import Any

import pytest

from tests.app.glass import Glass

WAYS = ("voice", "shake", "tilt", "switches", "gamepad", "keyboard")


@pytest.mark.parametrize("wide", [412, 360])
def test_the_name_of_the_app_stays_on_one_line_whatever_is_armed(
    glass: Glass, monkeypatch: pytest.MonkeyPatch, wide: int
) -> None:
    app: Any = glass.app
    standing = [(name, True) for name in WAYS]
    monkeypatch.setattr(app.methods, "standing", lambda: standing)
    monkeypatch.setattr(app.methods, "idle", list)
    app.root.size = app.connect.size = wide, 892
    glass.until(lambda: app.connect.ids.inputs.methods, "no method is shown")
    glass.stage.frames(3)
    title = app.connect.ids.title
    assert title.text_size[0] < 200, "it is given what is left"
    assert title.texture_size[1] < 1.6 * title.font_size
