from __future__ import annotations

from typing import Any

import pytest


@pytest.fixture
def map_(stage: Any) -> Any:
    """A map of 400 x 300 px with the origin in its middle, ten pixels to a metre."""
    from tests.widgets.map.watched_map import Watched  # Kivy: not before tests/conftest.py has prepared it
    from widgets.core.geometry import View

    made = stage.show(Watched(), size=(400, 300))
    made.set_view(View.centred(0, 0, at=(200, 150), scale=10))
    return made
