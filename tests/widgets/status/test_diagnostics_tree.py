"""The tree of diagnostics on the glass: lines, a finger that folds, and parts that grow old with nobody telling of them."""

from __future__ import annotations

import pytest

from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus, KeyValue
from widgets.status.diagnostics import STALE_TIMEOUT
from widgets.status.diagnostics_tree import DiagnosticLine, DiagnosticsTree


@pytest.fixture
def tree(stage):
    return stage.show(DiagnosticsTree(state="live"), size=(400, 500))


def show(stage, tree, *parts):
    tree.show(DiagnosticArray(status=[DiagnosticStatus(level, name, text) for level, name, text in parts]))
    stage.run_for(0.5)


def lines(tree):
    found = [line for line in tree.walk() if isinstance(line, DiagnosticLine)]
    return {line.name: line for line in found}


def test_before_the_first_message_it_says_so(stage, tree):
    tree.refresh()
    assert tree.summary == "No diagnostics yet"


def test_each_part_has_a_line_with_its_sign_and_what_it_says(stage, tree):
    show(stage, tree, (2, "/motors/right", "hot"), (0, "/battery", "87 %"))
    found = lines(tree)
    assert {name: line.icon for name, line in found.items()} == {
        "motors": "error_fill",
        "right": "error_fill",
        "battery": "check_circle",
    }
    assert (found["right"].text, found["motors"].text) == ("hot", "1 not well")
    assert tree.summary == "1 error"


def test_a_finger_opens_a_part_and_its_readings_are_there(stage, tree):
    status = DiagnosticStatus(0, "/battery", "87 %", values=[KeyValue("voltage", "24.1 V")])
    tree.show(DiagnosticArray(status=[status]))
    stage.run_for(0.5)
    line = lines(tree)["battery"]
    finger = stage.touch(*line.to_window(*line.center))
    finger.touch_down()
    stage.run_for(0.2)
    finger.touch_up()
    stage.run_for(0.3)
    assert lines(tree)["voltage"].text == "24.1 V"


def test_many_messages_between_two_drawings_are_drawn_once(stage, tree, monkeypatch):
    show(stage, tree, (0, "/a", ""))
    drawn = []
    monkeypatch.setattr(tree.model, "rows", lambda now, rows=tree.model.rows: drawn.append(now) or rows(now))
    for _ in range(200):
        tree.show(DiagnosticArray(status=[DiagnosticStatus(0, "/a", "")]))
    stage.run_for(0.3)
    assert len(drawn) <= 2


def test_what_falls_silent_is_said_to_be_without_any_message(stage, tree):
    show(stage, tree, (0, "/a", "fine"))
    stage.run_for(STALE_TIMEOUT + 2.0)
    line = lines(tree)["a"]
    assert line.icon == "schedule"
    assert "s old" in line.text
    assert tree.summary == "1 silent"


def test_off_the_glass_nothing_goes_on(stage, tree):
    show(stage, tree, (0, "/a", "fine"))
    stage.window.remove_widget(tree)
    stage.run_for(3.0)
    before = list(tree.ids.view.data)
    stage.run_for(STALE_TIMEOUT + 5.0)
    assert list(tree.ids.view.data) == before
