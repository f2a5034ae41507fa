"""Who publishes and subscribes what: asked a few at a time, only while somebody looks, bounded whatever a robot tells."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.link.capabilities import NO_CAPABILITIES, Capabilities
from app.link.channels import ANSWER, LINK, Answer
from app.link.feeds import Post
from app.screens.topics.ros_graph import (
    DETAILS,
    MAX_AT_ONCE,
    MAX_NODES,
    NODES,
    REFRESH_PERIOD,
    ROUND_TIMEOUT,
    GraphWatch,
)
from bridge.msgs.rosapi_msgs import NodeDetailsRequest, NodeDetailsResponse, NodesResponse

OFFER = Capabilities.of({"/scan": "sensor_msgs/LaserScan"}, frozenset())


class Robot:
    """A session whose questions the test answers."""

    def __init__(self) -> None:
        self.time, self.connected = 50.0, True
        self.robot = SimpleNamespace(capabilities=OFFER)
        self.open: list[tuple[str, Any]] = []
        self.link = SimpleNamespace(ask=lambda service, request, _: self.open.append((service, request)))
        self.watch = GraphWatch(self)  # type: ignore[arg-type]
        self.watch.look(True)

    def now(self) -> float:
        return self.time

    def answer(self, message: Any, problem: str = "") -> bool:
        service, request = self.open.pop(0)
        return self.watch.on_post(ANSWER, Post(Answer(service, message, problem, request), self.time, 1))

    def tell(self, told: dict[str, tuple[list[str], list[str]]]) -> None:
        """One whole round: what each node publishes and subscribes."""
        self.watch.tick()
        self.answer(NodesResponse(list(told)))
        while self.open:
            publishes, subscribes = told[self.open[0][1].node]
            self.answer(NodeDetailsResponse(subscribing=subscribes, publishing=publishes))


@pytest.fixture
def robot() -> Robot:
    return Robot()


def test_what_the_nodes_tell_of_themselves_makes_the_graph(robot: Robot) -> None:
    robot.tell({"/slam": (["/map"], ["/scan"]), "/laser": (["/scan"], []), "/nav": ([], ["/scan", "/map"])})
    graph = robot.watch.graph
    assert graph is not None
    assert graph.nodes == ("/laser", "/nav", "/slam")
    assert graph.publishes == {"/scan": ("/laser",), "/map": ("/slam",)}
    assert graph.subscribes == {"/scan": ("/nav", "/slam"), "/map": ("/nav",)}
    assert robot.watch.sentence == ""


def test_only_a_few_questions_wait_at_once(robot: Robot) -> None:
    robot.watch.tick()
    robot.answer(NodesResponse([f"/n{number}" for number in range(20)]))
    most = asked = 0
    while robot.open:
        most = max(most, len(robot.open))
        asked += 1
        robot.answer(NodeDetailsResponse())
    assert (most, asked) == (MAX_AT_ONCE, 20)


def test_of_too_many_nodes_as_many_are_asked_as_there_is_time_for_and_that_is_said(robot: Robot) -> None:
    robot.tell({f"/n{number:03}": ([f"/t{number}"], []) for number in range(MAX_NODES + 3)})
    assert robot.watch.graph is not None
    assert len(robot.watch.graph.publishes) == MAX_NODES
    assert robot.watch.sentence == "3 nodes told nothing."


def test_a_node_that_does_not_answer_is_said_and_the_others_are_shown(robot: Robot) -> None:
    robot.watch.tick()
    robot.answer(NodesResponse(["/dead", "/laser"]))
    robot.answer(None, "No reply.")
    assert robot.answer(NodeDetailsResponse(publishing=["/scan"]))
    assert robot.watch.graph is not None
    assert robot.watch.graph.publishes == {"/scan": ("/laser",)}
    assert robot.watch.sentence == "1 node told nothing."


def test_a_robot_without_rosapi_is_asked_nothing_and_says_so(robot: Robot) -> None:
    robot.robot.capabilities = NO_CAPABILITIES
    robot.watch.tick()
    assert robot.open == []
    assert robot.watch.sentence == "This robot tells nothing of its nodes: it runs no rosapi."


def test_a_robot_that_refuses_says_why_and_is_asked_again_later(robot: Robot) -> None:
    robot.watch.tick()
    assert robot.answer(None, "There is no service /rosapi/nodes.")
    assert robot.watch.sentence.endswith("There is no service /rosapi/nodes.")
    robot.watch.tick()
    assert robot.open == []
    robot.time += REFRESH_PERIOD
    robot.tell({"/laser": (["/scan"], [])})
    assert robot.watch.sentence == ""


def test_it_is_asked_anew_after_a_while_and_at_once_where_that_is_wanted(robot: Robot) -> None:
    robot.tell({"/laser": ([], [])})
    robot.watch.tick()
    assert robot.open == []
    robot.watch.refresh()
    robot.watch.tick()
    assert [service for service, _ in robot.open] == [NODES]


def test_when_nobody_looks_any_more_the_rest_is_left_unasked(robot: Robot) -> None:
    robot.watch.tick()
    robot.answer(NodesResponse([f"/n{number}" for number in range(20)]))
    robot.watch.look(False)
    while robot.open:
        robot.answer(NodeDetailsResponse())
    robot.time += 60.0
    robot.watch.tick()
    assert robot.open == []
    assert robot.watch.graph is None


@pytest.mark.parametrize("lost", ["the link", "the answer"])
def test_a_round_that_was_lost_does_not_end_the_asking(robot: Robot, lost: str) -> None:
    robot.watch.tick()
    late = robot.open.pop()
    if lost == "the link":
        robot.connected = False
        robot.watch.on_post(LINK, Post(None, robot.time, 1))
        robot.connected = True
    else:
        robot.time += ROUND_TIMEOUT + 0.1
        robot.watch.tick()
    robot.time += REFRESH_PERIOD
    robot.tell({"/laser": (["/scan"], [])})
    assert robot.watch.graph is not None
    robot.open.append(late)
    assert not robot.answer(NodesResponse(["/other"])), "an answer of the round that was given up"
    assert robot.watch.graph.nodes == ("/laser",)


def test_an_answer_that_nobody_waits_for_and_a_name_that_is_none_are_passed_over(robot: Robot) -> None:
    robot.watch.tick()
    robot.answer(NodesResponse(["/laser", "", "/" + "x" * 500]))
    robot.open.append((DETAILS, NodeDetailsRequest("/stranger")))
    robot.open.reverse()
    assert not robot.answer(NodeDetailsResponse(publishing=["/secret"]))
    robot.answer(NodeDetailsResponse(publishing=["/scan", "/" + "y" * 500]))
    assert robot.watch.graph is not None
    assert robot.watch.graph.nodes == ("/laser",)
    assert list(robot.watch.graph.publishes) == ["/scan"]


def test_a_round_in_which_no_node_answered_leaves_what_was_known(robot: Robot) -> None:
    robot.tell({"/laser": (["/scan"], [])})
    known = robot.watch.graph
    robot.time += REFRESH_PERIOD
    robot.watch.tick()
    robot.answer(NodesResponse(["/laser", "/slam"]))
    assert not robot.answer(None, "No reply.")
    assert not robot.answer(None, "No reply.")
    assert robot.watch.graph is known
    assert robot.watch.told("/scan") == "Published by /laser. Subscribed to by nobody."


def test_many_nodes_of_a_topic_are_counted(robot: Robot) -> None:
    robot.tell({f"/n{number}": (["/tf"], []) for number in range(9)})
    assert (
        robot.watch.told("/tf")
        == "Published by /n0, /n1, /n2, /n3, /n4, /n5 and 3 more. Subscribed to by nobody."
    )
