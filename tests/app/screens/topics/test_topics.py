"""The topics screen over a robot: its table, its graph, and the way from a topic to a panel."""

from __future__ import annotations

from typing import Any

import pytest
from kivy.metrics import sp

from app.screens.topics.panel_adding import AddDialog
from app.screens.topics.ros_graph import RosGraph
from app.screens.topics.topic_parts import TopicRow
from app.screens.topics.topic_table import WIDE
from tests.app.glass import Glass
from widgets.parts.labels import Text


@pytest.fixture
def topics(driving: Glass) -> Any:
    driving.app.show("topics")
    screen = driving.app.screens["topics"]
    driving.until(lambda: screen.list.table.data, "no topics")
    return screen


def told(screen: Any, graph: RosGraph) -> None:
    """Show that graph, whatever the robot itself answers."""
    screen.graph.look(False)
    screen.graph.graph = graph


def names(screen: Any) -> list[str]:
    return [row["name"] for row in screen.list.table.data]


def test_a_tap_on_a_head_puts_the_lines_in_its_order_and_another_turns_it_round(
    driving: Glass, topics: Any
) -> None:
    told(topics, RosGraph(("/a", "/b"), {}, {names(topics)[-1]: ("/a", "/b"), names(topics)[2]: ("/a",)}))
    first, second = names(topics)[-1], names(topics)[2]
    driving.tap(topics.list.heads["subscribers"])
    assert names(topics)[:2] == [first, second]
    assert topics.list.heads["subscribers"].direction == 1
    driving.tap(topics.list.heads["subscribers"])
    assert names(topics)[-2:] == [second, first]
    driving.tap(topics.list.heads["name"])
    assert names(topics) == sorted(names(topics))


def test_a_finger_opens_the_topic_that_it_was_laid_on_though_its_row_is_given_to_another(
    driving: Glass, topics: Any
) -> None:
    driving.stage.frames(2)
    row = next(one for one in topics.list.table.walk(restrict=True) if isinstance(one, TopicRow))
    meant = row.name
    row.dispatch("on_press")
    row.name = "/another"
    row.dispatch("on_release")
    assert topics.topics.opened == meant != "/another"


def test_the_table_has_all_room_until_a_topic_is_open(driving: Glass, topics: Any) -> None:
    assert topics.list.wide
    assert topics.detail.parent is None
    topics.open("/odom")
    driving.stage.frames(2)
    assert topics.detail.parent is not None
    assert topics.list.right <= topics.detail.x
    topics.close()
    assert topics.detail.parent is None


@pytest.mark.parametrize(
    ("share", "wide", "alone"),
    [(1.0, True, False), (0.8, True, True), (0.6, False, False), (0.5, False, True)],
)
def test_each_head_stands_above_its_column_and_the_name_has_its_line_where_there_is_little_room(
    driving: Glass, topics: Any, share: float, wide: bool, alone: bool
) -> None:
    table = topics.list
    table.size_hint_x, table.width = None, sp(WIDE) * share
    driving.stage.frames(3)
    row = next(one for one in table.table.walk(restrict=True) if isinstance(one, TopicRow))
    assert (table.wide, row.stacked) == (wide, alone)
    if wide:
        cells = [one for one in row.walk(restrict=True) if hasattr(one, "column")]
        for cell in cells:
            head = table.heads[cell.column]
            assert abs(head.to_window(head.right, 0)[0] - cell.to_window(cell.right, 0)[0]) <= 1
    assert all(
        bool(one["type"]) and (not alone or not one["use"] + one["pace"] + one["ties"])
        for one in table.table.data
    )


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_a_row_is_as_high_as_its_two_lines(driving: Glass, topics: Any, scale: float) -> None:
    driving.app.preferences.choose("text", scale)
    try:
        driving.stage.frames(4)
        table = driving.app.screens["topics"].list.table
        row = next(one for one in table.walk(restrict=True) if isinstance(one, TopicRow))
        texts = [one for one in row.walk(restrict=True) if isinstance(one, Text)]
        assert [one.height >= one.font_size * 1.2 for one in texts] == [True, True]
    finally:
        driving.app.preferences.choose("text", 1.0)


def test_the_graph_takes_the_tables_place_and_lights_up_what_is_searched_for(
    driving: Glass, topics: Any
) -> None:
    told(topics, RosGraph(("/laser",), {"/scan": ("/laser",), "/odom": ("/laser",)}, {}))
    topics.list.ids.form.choose("graph")
    driving.stage.frames(2)
    assert topics.list.table.parent is None
    assert "topic /scan" in topics.graph_pane.view.shown.boxes
    topics.list.ids.search.text = "sca"
    assert topics.graph_pane.view.shown.found(topics.graph_pane.view.search) == {"topic /scan"}
    topics.graph_pane.dispatch("on_open", "/odom")
    assert topics.topics.opened == "/odom"
    assert topics.detail.nodes == "Published by /laser. Subscribed to by nobody."
    topics.list.ids.form.choose("table")
    assert topics.list.table.parent is not None
    assert topics.graph_pane.parent is None


def dialog(glass: Glass, topics: Any) -> Any:
    topics.open("/odom")
    glass.stage.frames(2)
    glass.tap(topics.detail.ids.add)
    return next(one for one in glass.app.shell.parent.children if isinstance(one, AddDialog))


@pytest.mark.slow
def test_an_open_topic_goes_on_the_view_that_is_chosen_or_a_new_one_and_that_can_be_undone(
    driving: Glass, topics: Any
) -> None:
    asked = dialog(driving, topics)
    best = next(iter(asked.ways.values()))
    best.dispatch("on_release")
    panels = driving.app.screens["panels"]
    assert driving.app.pages.screen == "panels"
    assert panels.editing
    added = panels.views[int(panels.view)].panels[-1]
    assert added.topic == "/odom"
    count = len(panels.views[int(panels.view)].panels)
    panels.editor.undo()
    assert len(panels.views[int(panels.view)].panels) == count - 1
    panels.editor.redo()
    panels.editor.done()
    assert driving.app.profiles.of(driving.app.session.robot.info).views[int(panels.view)].panels[-1] == added
    before = len(panels.views)
    driving.app.show("topics")
    again = dialog(driving, topics)
    driving.tap(again.rows[None])
    next(iter(again.ways.values())).dispatch("on_release")
    assert [panel.topic for panel in panels.views[before].panels] == ["/odom"]


def test_what_is_cancelled_changes_nothing(driving: Glass, topics: Any) -> None:
    asked = dialog(driving, topics)
    driving.tap(asked.ids.cancel)
    assert driving.app.pages.screen == "topics"
    assert not driving.app.screens["panels"].editing
