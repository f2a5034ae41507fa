from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import TaskOrder, TaskQueue
from widgets.parts.buttons import IconButton
from widgets.parts.rows import DragHandle, ListRow
from widgets.tasks.order_queue import THREE, OrderQueue, details


@pytest.fixture
def queue(stage):
    queue = OrderQueue(size_hint=(None, None), size=(388, 300))
    queue.show(TaskQueue(orders=THREE))
    stage.show(queue)
    stage.frames(3)
    queue.asked = []
    queue.bind(on_command=lambda _, *what: queue.asked.append(what))
    return queue


def rows(queue):
    return sorted((one for one in queue.walk() if isinstance(one, ListRow)), key=lambda row: -row.y)


def grip(queue, index):
    (handle,) = (one for one in rows(queue)[index].walk(restrict=True) if isinstance(one, DragHandle))
    return handle.to_window(*handle.center)


@pytest.mark.parametrize(
    ("index", "steps", "target"), [(0, 1, 1), (0, 9, 2), (2, -1, 1), (2, -9, 0), (1, 1, 2)]
)
def test_a_row_is_dragged_to_another_place(stage, queue, index, steps, target):
    x, y = grip(queue, index)
    stage.drag([(x, y), (x, y - 30 * steps), (x, y - 66 * steps)])
    assert queue.asked == [("move", index, target)]


def test_a_row_that_comes_back_is_not_moved(stage, queue):
    x, y = grip(queue, 1)
    stage.drag([(x, y), (x, y - 66), (x, y - 10)])
    assert queue.asked == []
    assert [row.title for row in rows(queue)] == ["Deliver: Office 12 → Lab", "Patrol", "Dock: Charger"]


def test_the_others_make_room_while_one_is_dragged(stage, queue):
    x, y = grip(queue, 0)
    touch = stage.touch(x, y)
    touch.touch_down()
    touch.touch_move(x, y - 80)
    assert rows(queue)[0].title == "Patrol"
    queue.show(TaskQueue(orders=THREE[1:]))  # what the robot says waits for the finger
    assert len(rows(queue)) == 3
    touch.touch_up()


def test_a_tap_takes_a_row_out(stage, queue):
    (delete,) = (one for one in rows(queue)[1].walk(restrict=True) if isinstance(one, IconButton))
    stage.tap(*delete.to_window(*delete.center))
    stage.run_for(0.4)
    assert queue.asked == [("remove", 1, -1)]


def test_nothing_waiting_is_said(stage, queue):
    queue.show(TaskQueue())
    stage.frames(3)
    assert rows(queue) == []
    assert any(getattr(part, "text", "").startswith("No tasks are waiting.") for part in queue.walk())


def test_what_the_robot_has_not_confirmed_is_faded(queue):
    queue.waits = True
    assert all(row.faded for row in rows(queue))


def test_rows_and_sentence_follow_a_queue_that_grows(stage, queue):
    for orders in (THREE, []):
        queue.show(TaskQueue(orders=orders))
        for height in (300, 420):
            queue.height = height
            stage.frames(4)
            top = max(part.top for part in queue.ids.column.children)
            assert queue.ids.column.top - top < 12


def test_a_queue_that_is_held_does_not_say_next(stage):
    queue = stage.show(OrderQueue())
    queue.show(TaskQueue(orders=[TaskOrder(task="hold", message="For Ann"), TaskOrder(task="dock")]))
    assert [row.detail for row in queue._rows] == ["Next · For Ann", ""]
    queue.show(TaskQueue(orders=queue.orders, held="the task before it was canceled"))
    assert [row.detail for row in queue._rows] == ["Waits until resumed · For Ann", ""]
    assert details(TaskOrder(task="hold"), first=False, held=True) == ""
