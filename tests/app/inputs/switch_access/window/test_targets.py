"""What can be undone for a while waits for a mark that is on its way to it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from kivy.uix.floatlayout import FloatLayout

from app.inputs.switch_access.scan.target import Mark, Target
from app.inputs.switch_access.window.targets import WindowTargets
from tests.headless import Stage
from widgets.parts.cards import ActionToast


def test_an_offer_stays_until_the_mark_has_been_on_it_and_gone_on(stage: Stage) -> None:
    root = stage.show(FloatLayout(), (412, 892))
    toast = ActionToast(text="Deleted.", stay=2.0)
    root.add_widget(toast)
    corner = SimpleNamespace(button=SimpleNamespace(parent=None))
    shell: Any = SimpleNamespace(notices=root, stop=FloatLayout(size=(1, 1)))
    glass = WindowTargets(SimpleNamespace(root=root, shell=shell, corner=corner))

    def mark(step: int, widget: Any) -> None:
        glass.mark(Mark((Target("one", "One", lambda: None, key=widget),), "item", "One", step=step))

    mark(1, None)
    stage.run_for(3.0)
    assert toast.parent is root, "longer than it stays for a finger"
    mark(2, toast)
    stage.run_for(3.0)
    assert toast.parent is root
    mark(3, None)
    stage.run_for(1.0)
    assert toast.parent is root
    stage.run_for(1.5)
    assert toast.parent is None
    glass.close()
