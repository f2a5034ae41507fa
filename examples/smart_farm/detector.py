"""Finds the oranges in a robot's pictures, which come over a WebSocket, and sends their places back on the topic `/oranges`.

python -m examples.smart_farm.detector --robot ws://127.0.0.1:9090

Any program on any computer can take its place: it needs the pictures and one topic.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
from collections.abc import Callable, Sequence

from bridge.client import RemoteRobot
from bridge.client.camera_stream import CameraStream
from bridge.core.camera_frames import Frame
from bridge.msgs.geometry_msgs import Point, Pose, PoseArray
from bridge.msgs.std_msgs import Header, Time
from examples.smart_farm.oranges import oranges

__all__ = ["TOPIC", "detect"]

TOPIC = "/oranges"
"""A `geometry_msgs/PoseArray` in `base_link` for each picture."""
CAMERA = (0.08, 0.0, 0.36)
"""Where the camera of a patrol robot sits in `base_link`, looking straight ahead [m]."""
FIELD_OF_VIEW = 1.2
"""Across its picture [rad]."""


async def detect(url: str, send: Callable[[PoseArray], object]) -> None:
    """Send what is seen in each picture, until it is cancelled."""

    def on_frame(frame: Frame, _: float) -> None:
        found = [Pose(position=Point(*place)) for place in oranges(frame.jpeg, FIELD_OF_VIEW, CAMERA)]
        send(PoseArray(Header(Time.at(frame.stamp), "base_link"), found))

    stream = CameraStream(f"{url.rstrip('/')}/camera/front", on_frame)
    try:
        await stream.run()
    finally:
        await stream.close()


def main(arguments: Sequence[str] | None = None) -> None:
    """Detect until Ctrl+C."""
    parser = argparse.ArgumentParser(
        prog="python -m examples.smart_farm.detector",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--robot", default="ws://127.0.0.1:9090", metavar="URL", help="the robot's socket")
    url = parser.parse_args(arguments).robot
    with RemoteRobot(url) as robot, contextlib.suppress(KeyboardInterrupt):
        robot.advertise(TOPIC, PoseArray)
        asyncio.run(detect(url, lambda found: robot.publish(TOPIC, found)))


if __name__ == "__main__":
    main()
