"""What each method may do, one method at a time: what is done there concerns the one that is seen."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.intents.method_permits import MethodPermits
from app.screens.inputs.panes.permit_table import TablePane
from tests.app.inputs.pushing import Settings


@pytest.fixture
def pane(stage: Any) -> Any:
    app = SimpleNamespace(intents=SimpleNamespace(table=MethodPermits(Settings())))
    pane = TablePane(app=app)
    stage.show(pane, (412, 700))
    return pane


def test_as_usual_again_is_said_and_done_of_the_method_that_is_shown_alone(pane: Any) -> None:
    table = pane.app.intents.table
    table.allow("voice", "patrol", False)
    table.allow("shake", "pause", False)
    pane.choice.choose("shake")
    assert (pane.usual.text, pane.usual.disabled) == ("Shake: reset to default", False)
    pane.usual.dispatch("on_release")
    assert table.allowed("shake", "pause")
    assert not table.allowed("voice", "patrol")
    assert pane.usual.disabled
    pane.choice.choose("voice")
    assert not pane.usual.disabled
