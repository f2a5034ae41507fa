"""A way in that is switched on or off is so again after a restart."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.core.settings_store import Settings
from app.inputs.base.toggleable_method import ToggleableMethod


class Method(ToggleableMethod):
    """One that is switched and has one thing more that it goes by."""

    name = "method"

    def __init__(self, settings: Settings) -> None:
        self._app = SimpleNamespace(settings=settings)
        kept = settings.get(self.name, {})
        self._on, self.share = bool(kept.get("on")), 0.25

    def _kept(self) -> dict[str, Any]:
        return {"on": self._on, "share": self.share}


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    return Settings(tmp_path)


@pytest.mark.parametrize("on", [True, False])
def test_what_was_switched_is_so_after_a_restart(settings: Settings, on: bool) -> None:
    method = Method(settings)
    method.on = not on
    method.on = on
    settings.close()
    again = Settings(settings.path.parent)
    assert Method(again).on is on
    again.close()


def test_everything_it_goes_by_is_kept_under_its_own_name_and_can_be_read(settings: Settings) -> None:
    method = Method(settings)
    method.on = True
    assert settings.get("method") == method.set_to == {"on": True, "share": 0.25}
    settings.close()


def test_what_nobody_switched_leaves_no_trace(settings: Settings) -> None:
    method = Method(settings)
    assert (method.on, settings.get("method")) == (False, None)
    settings.close()
