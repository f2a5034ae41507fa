"""What of a robot's graph is drawn: alike topics as one box, what joins all with all left out, and never more than there is room for."""

from __future__ import annotations

from widgets.graph.graph_model import FOLD, GROUP, MAX_BOXES, NODE, TOPIC, shown

LASER, SLAM = "node /laser", "node /slam"


def test_an_arrow_goes_from_who_tells_over_the_topic_to_who_listens() -> None:
    found = shown(["/laser", "/slam"], {"/scan": ["/laser"]}, {"/scan": ["/slam"]})
    assert {name: box.kind for name, box in found.boxes.items()} == {
        LASER: NODE,
        SLAM: NODE,
        "topic /scan": TOPIC,
    }
    assert found.edges == ((LASER, "topic /scan"), ("topic /scan", SLAM))


def test_a_node_and_a_topic_of_one_name_are_two_boxes() -> None:
    assert set(shown(["/camera"], {"/camera": ["/camera"]}, {}).boxes) == {"node /camera", "topic /camera"}


def test_topics_that_are_alike_are_one_box_until_it_is_unfolded() -> None:
    publishes = {f"/t{number}": ["/laser"] for number in range(FOLD)} | {"/other": ["/slam"]}
    folded = shown(["/laser", "/slam"], publishes, {})
    group = next(box for box in folded.boxes.values() if box.kind == GROUP)
    assert group.topics == tuple(f"/t{number}" for number in range(FOLD))
    assert folded.edges.count((LASER, group.name)) == 1
    assert folded.box_of("/t3") == group.name
    opened = shown(["/laser", "/slam"], publishes, {}, unfolded={group.name})
    assert opened.box_of("/t3") == "topic /t3"
    assert len(shown(["/laser", "/slam"], publishes, {}, fold=False).boxes) == FOLD + 3


def test_what_joins_every_node_is_hidden_with_the_nodes_that_have_nothing_else() -> None:
    publishes = {"/rosout": ["/laser", "/quiet"], "/scan": ["/laser"]}
    assert set(shown(["/laser", "/quiet"], publishes, {}).boxes) == {LASER, "topic /scan"}
    whole = shown(["/laser", "/quiet", "/alone"], publishes, {}, hide=False)
    assert {"topic /rosout", "node /quiet", "node /alone"} <= set(whole.boxes)


def test_the_neighbours_of_a_box_and_what_a_search_finds() -> None:
    publishes = {"/scan": ["/laser"], **{f"/cam/{number}": ["/laser"] for number in range(FOLD)}}
    found = shown(["/laser", "/slam"], publishes, {"/scan": ["/slam"]})
    assert found.beside("topic /scan") == {LASER, SLAM, "topic /scan"}
    assert found.found("SCAN") == {"topic /scan"}
    assert found.found("cam 3") == {found.box_of("/cam/3")}
    assert found.found("node") == frozenset(), "kinds are no names"
    assert found.found(" ") == frozenset()


def test_of_a_graph_that_is_too_large_the_rest_is_counted() -> None:
    found = shown(
        [f"/n{number}" for number in range(MAX_BOXES)], {"/t": ["/n0"]}, {"/t": ["/n1"]}, hide=False
    )
    assert (len(found.boxes), found.left_out, found.edges) == (MAX_BOXES, 1, ())
