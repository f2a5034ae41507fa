"""A gateway within the program: objects in the place of bytes, to show how little a gateway has to do."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping

from bridge.core.robot_door import RobotDoor
from bridge.msgs import Msg

__all__ = ["MemoryClient", "MemoryGateway"]


class MemoryGateway:
    """A `Gateway` whose clients are made by `connect`."""

    def __init__(self, door: RobotDoor, now: Callable[[], float]) -> None:
        """`now` is the operators' clock [s]."""
        self.door, self.now = door, now
        self.clients: list[MemoryClient] = []

    async def start(self) -> None:
        """Nothing has to be opened."""

    async def stop(self) -> None:
        """End all connections."""
        for client in list(self.clients):
            client.leave()

    def endpoints(self) -> Mapping[str, str]:
        """There is no URL; the name is all."""
        return {"memory": "memory:"}

    def connect(self, name: str) -> MemoryClient:
        """A client that calls itself so."""
        self.clients.append(MemoryClient(self, name))
        return self.clients[-1]


class MemoryClient:
    """One client, whose commands arrive at once; nothing measures its link."""

    def __init__(self, gateway: MemoryGateway, name: str) -> None:
        self._gateway, self._door = gateway, gateway.door
        self.operator = self._door.join(f"memory:{name}")
        self.operator.asked_time = True  # it has the robot's own clock

    def publish(self, topic: str, msg: Msg, stamp: float | None = None) -> None:
        self._heard()
        self._door.publish(self.operator, topic, msg, stamp)

    def call(self, service: str, request: Msg, timeout: float | None = None) -> Msg | Awaitable[Msg]:
        self._heard()
        return self._door.call(self.operator, service, request, timeout)

    async def run(self, action: str, goal: Msg, on_feedback: Callable[[Msg], None]) -> Msg:
        self._heard()
        return await self._door.run(self.operator, action, goal, on_feedback)

    def subscribe(self, topic: str, callback: Callable[[str, Msg], None]) -> Callable[[], None]:
        self._heard()
        return self._door.subscribe(self.operator, topic, callback)

    def leave(self) -> None:
        self._gateway.clients.remove(self)
        self._door.leave(self.operator)

    def _heard(self) -> None:
        self.operator.last_heard = self.operator.answered = self._gateway.now()
