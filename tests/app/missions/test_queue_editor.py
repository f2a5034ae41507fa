"""The queue as it is edited: shown at once, one change under way at a time, undone without bringing back what began."""

from __future__ import annotations

import math

import pytest

from app.missions.queue_editor import QueueEditor
from bridge.msgs.pilothouse_msgs import TaskOrder, TaskQueue

A, B, C = (TaskOrder(id=number, task="go_to", places=[name]) for number, name in enumerate("ABC", 1))


class Robot:
    """Answers when the test says so."""

    def __init__(self, *orders: TaskOrder) -> None:
        self.asked: list[tuple[int, tuple[TaskOrder, ...]]] = []
        self.revision, self.next = 1, 10
        self.editor = QueueEditor(send=lambda revision, orders: self.asked.append((revision, orders)))
        self.tell(*orders)

    def tell(self, *orders: TaskOrder) -> None:
        self.revision += 1
        self.editor.robot_has(TaskQueue(revision=self.revision, orders=list(orders)))

    def names(self) -> str:
        return "".join(order.places[0] for order in self.editor.orders)


@pytest.fixture
def robot() -> Robot:
    return Robot(A, B, C)


def test_an_edit_shows_at_once_and_names_the_revision_it_was_made_from(robot: Robot) -> None:
    robot.editor.move(0, 2)
    assert robot.names() == "BCA"
    assert robot.editor.waits
    assert robot.asked == [(robot.revision, (B, C, A))]


@pytest.mark.parametrize("topic_first", [True, False])
def test_it_is_settled_by_the_answer_and_the_queue_in_either_order(robot: Robot, topic_first: bool) -> None:
    robot.editor.remove(1)
    steps = [lambda: robot.tell(A, C), lambda: robot.editor.answered(True)]
    for step in steps if topic_first else reversed(steps):
        assert robot.editor.waits
        step()
    assert (robot.names(), robot.editor.waits, len(robot.asked)) == ("AC", False, 1)


def test_a_second_edit_waits_for_the_first_and_is_made_from_its_revision(robot: Robot) -> None:
    robot.editor.remove(0)
    robot.editor.remove(0)
    assert (robot.names(), len(robot.asked)) == ("C", 1)
    robot.editor.answered(True)
    robot.tell(B, C)
    assert robot.asked[1:] == [(robot.revision, (C,))]
    assert robot.names() == "C"


def test_a_refusal_brings_back_what_the_robot_says(robot: Robot) -> None:
    robot.editor.remove(0)
    robot.editor.answered(False)
    assert (robot.names(), robot.editor.waits, robot.editor.can_undo) == ("ABC", False, False)


def test_what_the_robot_wrote_otherwise_is_not_sent_again(robot: Robot) -> None:
    robot.editor.add(TaskOrder(task="deliver", places=["A", "B"], message="two\nlines"))
    robot.editor.answered(True)
    robot.tell(A, B, C, TaskOrder(id=10, task="deliver", places=["A", "B"], message="two lines"))
    assert (len(robot.asked), robot.editor.waits) == (1, False)


def test_an_order_with_nothing_said_about_its_speed_is_the_same_as_itself(robot: Robot) -> None:
    assert math.isnan(A.speed)
    robot.editor.move(1, 1)
    assert robot.asked == []


def test_a_deletion_is_taken_back_as_a_new_order(robot: Robot) -> None:
    robot.editor.remove(1)
    robot.editor.answered(True)
    robot.tell(A, C)
    robot.editor.undo()
    assert robot.names() == "ABC"
    assert [order.id for order in robot.asked[-1][1]] == [1, 0, 3]


def test_an_undo_does_not_bring_back_what_has_begun(robot: Robot) -> None:
    robot.editor.move(2, 1)
    robot.editor.answered(True)
    robot.tell(A, C, B)
    robot.tell(C, B)  # A has begun
    robot.editor.undo()
    assert robot.names() == "BC"


def test_before_the_robot_told_its_queue_nothing_is_sent() -> None:
    asked: list[object] = []
    editor = QueueEditor(send=lambda *what: asked.append(what))
    editor.add(A)
    assert asked == []
    editor.robot_has(TaskQueue(revision=7))
    assert asked[0][0] == 7


def test_a_task_that_is_not_there_is_said(robot: Robot) -> None:
    with pytest.raises(IndexError, match="There is no task 4 in the queue; there are 3"):
        robot.editor.remove(3)
