"""One robot's identity and abilities, as it introduces itself."""

from __future__ import annotations

from app.discovery.known_robots import address
from app.link.capabilities import Capabilities
from app.link.feeds import Feeds
from bridge.msgs.pilothouse_msgs import RobotInfo
from widgets.core.task_words import known

__all__ = ["RobotProfile"]


class RobotProfile:
    """Everything here is read in the UI thread and may change whenever the robot introduces itself anew."""

    def __init__(self, feeds: Feeds, url: str) -> None:
        """`url` is the robot's address, which stands for its name until it gives one."""
        self._feeds = feeds
        self.url = url
        self.capabilities: Capabilities | None = None
        """Topics and services of the robot; None until they are known."""

    @property
    def info(self) -> RobotInfo:
        """What `/robot/info` says; all fields empty before the first message."""
        return self._feeds.latest("/robot/info") or RobotInfo()

    @property
    def introduced(self) -> bool:
        """A message of `/robot/info` has come."""
        return self._feeds.latest("/robot/info") is not None

    @property
    def name(self) -> str:
        """The robot's name, or its address while the name is not known."""
        return self.info.name or address(self.url)

    @property
    def foreign(self) -> bool:
        """The robot is known to have no Pilothouse services."""
        return self.capabilities is not None and not self.capabilities.ours

    @property
    def lacks_tasks(self) -> bool:
        """The robot is known to store no missions and to offer no tasks."""
        return not (self.offers("/task/start") or self.offers("/mission/set"))

    def offers(self, service: str) -> bool:
        """The robot has that service, or its services are not known yet."""
        return self.capabilities is None or self.capabilities.serves(service)

    def knows(self, task: str) -> bool:
        """The robot can be asked for that task, as `task_words.known` decides."""
        return task in known(self.info)
