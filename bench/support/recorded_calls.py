"""The robot side that writes down when each call reached its services, `python -m bench.support.recorded_calls FILE serve …`.

A line of FILE is the way by which the call came, the service and when the door was asked, by the clock that all processes of a
machine share [s]; that of a STOP is when the robot had been told to stand, and its way is `-`. On SIGUSR1 a line `state` has the number of asyncio's tasks, and how many of
the adapters' libraries are loaded.
"""

from __future__ import annotations

import asyncio
import os
import signal
import sys
import time
from collections.abc import Awaitable
from typing import Any

from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from robotside.__main__ import main
from robotside.door.door import Door
from robotside.station.stop_control import StopControl

__all__: list[str] = []

LIBRARIES = (
    "fastapi",
    "pydantic",
    "lxml",
    "aiomqtt",
    "paho",
    "iotcore",
    "aiokafka",
    "confluent_kafka",
    "aiocoap",
    "av",
    "aiortc",
    "zeroconf",
    "questionary",
)
"""Of the adapters and their surroundings."""


def record(file: int) -> None:
    """Have every door write down its calls."""
    call, listen, press = Door.call, Door.subscribe, StopControl.press

    def recorded(
        self: Door, operator: Operator, service: str, request: Msg, timeout: float | None = None
    ) -> Msg | Awaitable[Msg]:
        os.write(file, f"{operator.way} {service} {time.monotonic()}\n".encode())
        return call(self, operator, service, request, timeout)

    def pressed(self: StopControl, *args: Any, **options: Any) -> None:
        press(self, *args, **options)
        os.write(file, f"- pressed {time.monotonic()}\n".encode())

    def state() -> None:
        loaded = sum(name in sys.modules for name in LIBRARIES)
        os.write(file, f"state {len(asyncio.all_tasks())} {loaded}\n".encode())

    def subscribed(self: Door, *args: Any, **options: Any) -> Any:
        loop = asyncio.get_running_loop()
        loop.add_signal_handler(signal.SIGUSR1, state)
        return listen(self, *args, **options)

    Door.call, Door.subscribe = recorded, subscribed  # type: ignore[method-assign]
    StopControl.press = pressed  # type: ignore[method-assign]


if __name__ == "__main__":
    record(os.open(sys.argv[1], os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600))
    sys.exit(main(sys.argv[2:]))
