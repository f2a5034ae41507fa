"""The small robot behind the server that is not ours: a disc on wheels in a square room, no Pilothouse services."""

from __future__ import annotations

import io
import math
from typing import Any

from PIL import Image, ImageDraw

WATCHDOG = 0.5
"""How long a speed counts [s]; then it stops by itself."""
ROOM = 6.0
"""Half the room's width [m]."""
BEAMS = 180

PERIODS = {
    "/odom": (0.05, "nav_msgs/Odometry"),
    "/imu/data": (0.02, "sensor_msgs/Imu"),
    "/scan": (0.1, "sensor_msgs/LaserScan"),
    "/battery_state": (1.0, "sensor_msgs/BatteryState"),
    "/camera/rgb/image_raw/compressed": (0.1, "sensor_msgs/CompressedImage"),
    "/gripper": (0.2, "acme_msgs/Gripper"),
}
"""Of each topic how often it is published [s] and its type."""


def _picture(step: int) -> bytes:
    image = Image.new("RGB", (160, 120), (40, 60, 80))
    ImageDraw.Draw(image).rectangle((step * 20, 40, step * 20 + 19, 79), fill=(240, 200, 60))
    out = io.BytesIO()
    image.save(out, "JPEG", quality=70)
    return out.getvalue()


def chart(cell: float = 0.1) -> dict[str, Any]:
    """The room as a nav_msgs/OccupancyGrid with cells of `cell` [m]; it is where odometry begins."""
    half = round(ROOM / cell)
    edge = [100] * (2 * half + 2)
    middle = [100, *[0] * (2 * half), 100]
    origin = {"position": {"x": -ROOM - cell, "y": -ROOM - cell}, "orientation": {"w": 1.0}}
    size = {"resolution": cell, "width": len(edge), "height": len(edge), "origin": origin}
    return {"header": {"frame_id": "map"}, "info": size, "data": [*edge, *middle * (2 * half), *edge]}


class ForeignRobot:
    """Where it is and how fast, and what it measures there; time is what `step` is told."""

    def __init__(self) -> None:
        self.x = self.y = self.yaw = 0.0
        self.speed = self.turn = 0.0
        self.motors = True
        self.heard = 0
        """How many speeds it was given."""
        self._left = 0.0
        self._now = 0.0
        self._pictures = [_picture(step) for step in range(8)]

    def command(self, twist: dict[str, Any]) -> None:
        """Take a geometry_msgs/Twist."""
        self.heard += 1
        if self.motors:
            self.speed, self.turn, self._left = twist["linear"]["x"], twist["angular"]["z"], WATCHDOG

    def step(self, dt: float) -> None:
        """Let `dt` seconds pass."""
        self._now += dt
        self._left -= dt
        if self._left <= 0 or not self.motors:
            self.speed = self.turn = 0.0
        self.yaw = math.remainder(self.yaw + self.turn * dt, math.tau)
        reach = ROOM - 0.3
        self.x = min(reach, max(-reach, self.x + self.speed * math.cos(self.yaw) * dt))
        self.y = min(reach, max(-reach, self.y + self.speed * math.sin(self.yaw) * dt))

    def measure(self, topic: str) -> dict[str, Any]:
        """The message of one of `PERIODS` now; what is missing in it takes its default."""
        return getattr(self, "_" + topic.strip("/").split("/")[0])()

    def _facing(self) -> dict[str, float]:
        return {"x": 0.0, "y": 0.0, "z": math.sin(self.yaw / 2), "w": math.cos(self.yaw / 2)}

    def _odom(self) -> dict[str, Any]:
        pose = {"position": {"x": self.x, "y": self.y}, "orientation": self._facing()}
        twist = {"linear": {"x": self.speed}, "angular": {"z": self.turn}}
        return {
            "header": {"frame_id": "odom"},
            "child_frame_id": "base_footprint",
            "pose": {"pose": pose},
            "twist": {"twist": twist},
        }

    def _imu(self) -> dict[str, Any]:
        return {
            "header": {"frame_id": "imu_link"},
            "orientation": self._facing(),
            "angular_velocity": {"z": self.turn},
            "linear_acceleration": {"z": 9.81},
        }

    def _scan(self) -> dict[str, Any]:
        increment = math.tau / BEAMS
        ranges = [self._wall(self.yaw - math.pi + n * increment) for n in range(BEAMS)]
        return {
            "header": {"frame_id": "laser"},
            "angle_min": -math.pi,
            "angle_max": math.pi - increment,
            "angle_increment": increment,
            "scan_time": 0.1,
            "range_min": 0.1,
            "range_max": 8.0,
            "ranges": ranges,
        }

    def _wall(self, bearing: float) -> float:
        """How far the wall is [m]; infinite beyond the laser's 8 m."""
        dx, dy = math.cos(bearing), math.sin(bearing)
        along_x = (math.copysign(ROOM, dx) - self.x) / dx if dx else math.inf
        along_y = (math.copysign(ROOM, dy) - self.y) / dy if dy else math.inf
        found = min(along_x, along_y)
        return found if found <= 8.0 else math.inf

    def _battery_state(self) -> dict[str, Any]:
        level = max(0.0, 0.8 - self._now / 36_000)
        return {
            "header": {},
            "voltage": 22.0 + 3.0 * level,
            "percentage": level,
            "current": math.nan,
            "present": True,
        }

    def _camera(self) -> dict[str, Any]:
        step = int(self._now / 0.1) % len(self._pictures)
        return {"header": {"frame_id": "camera"}, "format": "jpeg", "data": list(self._pictures[step])}

    def _gripper(self) -> dict[str, Any]:
        fingers = [
            {"name": name, "force": 1.5, "opening": 0.04, "touching": name == "left"}
            for name in ("left", "right")
        ]
        return {"header": {}, "mode": 1, "fingers": fingers, "limits": [0.0, 0.08, 40.0], "raw": [-3, 512]}
