"""The nodes: a service, an action, a publisher, and transforms for web pages."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

from bridge.client.client import BridgeClient
from bridge.core.async_tasks import cancel_all
from bridge.core.errors import Refused
from bridge.msgs import TYPES, Msg
from bridge.msgs.std_msgs import String
from examples.ros_nodes.actionlib import ActionlibServer
from examples.ros_nodes.republisher import Republisher

__all__ = ["MAX_ORDER", "STEP_PERIOD", "Nodes", "bring_up", "fibonacci"]

LISTENER_PERIOD = 1.0
"""Time between two messages on /listener [s]."""
STEP_PERIOD = 0.1
"""Time between two numbers of a sequence [s]."""
MAX_ORDER = 44
"""Longest sequence; its numbers have 32 bits."""


class Nodes:
    """What runs for a client, to be closed at the end."""

    def __init__(self) -> None:
        self.tasks: set[asyncio.Task[Any]] = set()

    def begin(self, work: Coroutine[Any, Any, Any]) -> asyncio.Task[Any]:
        """Run `work` until it ends or the nodes are closed."""
        task = asyncio.create_task(work)
        self.tasks.add(task)
        task.add_done_callback(self.tasks.discard)
        return task

    async def close(self) -> None:
        """End all work."""
        await cancel_all(self.tasks)


def bring_up(client: BridgeClient) -> Nodes:
    """Bring the nodes up on `client`, whose connection they survive; to be called in its event loop."""
    nodes = Nodes()
    _add_two_ints(client)
    for package in ("example_interfaces", "actionlib_tutorials"):
        run = _fibonacci_of(f"{package}/Fibonacci")
        if package == "example_interfaces":
            client.provide_action("/fibonacci", f"{package}/Fibonacci", run)
        else:
            ActionlibServer(client, nodes.begin, "/fibonacci", f"{package}/Fibonacci", run)
    nodes.begin(_say_hello(client))
    Republisher(client, nodes.begin).bring_up()
    return nodes


def _add_two_ints(client: BridgeClient) -> None:
    answer = TYPES["rospy_tutorials/AddTwoIntsResponse"]
    client.serve("/add_two_ints", "rospy_tutorials/AddTwoInts", lambda asked: answer(asked.a + asked.b))


async def _say_hello(client: BridgeClient) -> None:
    client.advertise("/listener", String, latch=True)
    while True:
        client.publish("/listener", String("Hello, World"))
        await asyncio.sleep(LISTENER_PERIOD)


def _fibonacci_of(kind: str) -> Callable[[Any, Callable[[Msg], None]], Coroutine[Any, Any, Msg]]:
    result, feedback = TYPES[f"{kind}Result"], TYPES[f"{kind}Feedback"]

    async def run(goal: Any, on_feedback: Callable[[Msg], None]) -> Msg:
        sequence = await fibonacci(goal.order, lambda numbers: on_feedback(feedback(numbers)))
        return result(sequence)

    return run


async def fibonacci(order: int, on_step: Callable[[list[int]], None]) -> list[int]:
    """The first `order` + 2 numbers; `on_step` gets what there is after each further one. Raises Refused."""
    if not 0 <= order <= MAX_ORDER:
        raise Refused(f"order must be from 0 to {MAX_ORDER}, not {order}.")
    numbers = [0, 1]
    for _ in range(order):
        numbers.append(numbers[-1] + numbers[-2])
        on_step(list(numbers))
        await asyncio.sleep(STEP_PERIOD)
    return numbers
