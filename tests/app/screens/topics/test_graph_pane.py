"""The graph on the topics screen: what a tap looks at, what is folded and hidden, and what is said."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.screens.topics.graph_pane import GraphPane
from app.screens.topics.ros_graph import RosGraph

GRAPH = RosGraph(
    ("/laser", "/slam"),
    {"/scan": ("/laser",), "/rosout": ("/laser", "/slam"), **{f"/t{n}": ("/slam",) for n in range(6)}},
    {"/scan": ("/slam",)},
)


@pytest.fixture
def pane(stage: Any) -> GraphPane:
    watch: Any = SimpleNamespace(graph=GRAPH, sentence="")
    made = stage.show(GraphPane(watch), size=(800, 500))
    made.show()
    return made  # type: ignore[no-any-return]


def test_a_topic_that_is_looked_at_can_be_opened(stage: Any, pane: GraphPane) -> None:
    opened: list[str] = []
    pane.bind(on_open=lambda _, topic: opened.append(topic))
    pane.pick("topic /scan")
    assert pane.about == "/scan: published by 1, subscribed to by 1"
    stage.frames(2)
    stage.tap(*pane.ids.open.center)
    assert opened == ["/scan"]
    pane.pick("topic /scan")
    assert (pane.about, pane.openable, pane.ids.open.disabled) == ("", "", True)


def test_a_node_counts_every_topic_of_a_group(pane: GraphPane) -> None:
    pane.pick("node /slam")
    assert pane.about == "/slam: subscribes to 1, publishes 6"
    assert pane.openable == ""


def test_a_tap_on_a_group_unfolds_it_and_the_button_folds_all_again(pane: GraphPane) -> None:
    group = pane.view.shown.box_of("/t3")
    pane.pick(group)
    assert pane.view.shown.box_of("/t3") == "topic /t3"
    pane.turn_fold()
    pane.turn_fold()
    assert pane.view.shown.box_of("/t3") == group


def test_logs_are_hidden_until_they_are_wanted(pane: GraphPane) -> None:
    assert pane.view.shown.box_of("/rosout") == ""
    pane.ids.hide.dispatch("on_release")
    assert pane.view.shown.box_of("/rosout")


def test_a_robot_that_tells_nothing_has_a_sentence_and_no_boxes(pane: GraphPane) -> None:
    pane._watch.graph, pane._watch.sentence = None, "It runs no rosapi."  # type: ignore[misc]
    pane.show()
    assert not pane.view.shown.boxes
    assert pane.sentence == "It runs no rosapi."


def test_what_the_table_opened_is_looked_at(pane: GraphPane) -> None:
    pane.look_at("/scan")
    assert pane.view.selected == "topic /scan"
    pane.look_at("/gone")
    assert pane.view.selected == ""
