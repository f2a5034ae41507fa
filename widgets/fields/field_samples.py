"""Sample messages for a tree of fields: from small to large, and one of a type that was unknown."""

from __future__ import annotations

import math
from typing import ClassVar

from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array
from bridge.msgs.diagnostic_msgs import DiagnosticArray, DiagnosticStatus, KeyValue
from bridge.msgs.geometry_msgs import Quaternion, Vector3
from bridge.msgs.sensor_msgs import BatteryState, CompressedImage, Imu, LaserScan
from bridge.msgs.std_msgs import Empty, Header, Time

__all__ = ["battery", "cells", "diagnostics", "imu", "log", "nothing", "picture", "scan"]

AT = Time(1763719271, 120_000_000)
"""When all of them were measured."""


class Cells(Msg, frozen=True, gc=False):
    """Stands for a type that was learned from the robot."""

    MSGTYPE: ClassVar[str] = "boat_msgs/Cells"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint32", "float64", "bool", "float32[]", "uint8[]")
    cycles: int = 0
    leak_rate: float = math.nan
    balanced: bool = False
    voltages: Float32Array = Float32Array()
    log: bytes = b""


class Log(Msg, frozen=True, gc=False):
    """Stands for a type that was learned from the robot, with long texts."""

    MSGTYPE: ClassVar[str] = "boat_msgs/Log"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8", "string", "string", "string")
    level: int = 0
    name: str = ""
    msg: str = ""
    file: str = ""


def log() -> Log:
    """Texts that are longer than a line."""
    told = (
        "The controller missed its desired loop rate of 20.0000 Hz.\n\n"
        "The last loop took 0.0913 s; the costmap had 412 obstacles, and the planner tried 3 ways round them."
    )
    where = "/opt/robot/navigation/controller/plugins/regulated_pure_pursuit_controller.cpp:412"
    return Log(30, "controller_server", told, where)


def nothing() -> Empty:
    """Without any field."""
    return Empty()


def cells() -> Cells:
    """Of a type of its own, with a number that is not known and bytes."""
    return Cells(
        18_204, math.nan, balanced=True, voltages=Float32Array([4.12, 4.11, 4.13, 4.02]), log=bytes(45_100)
    )


def imu() -> Imu:
    """As long as a screen."""
    return Imu(
        header=Header(AT, "imu_link"),
        orientation=Quaternion(0.0021, -0.0147, 0.7071, 0.7069),
        angular_velocity=Vector3(0.0013, -0.0004, 0.1208),
        linear_acceleration=Vector3(0.0812, -0.0277, 9.8064),
    )


def scan(beams: int = 360) -> LaserScan:
    """One long array, some of it unknown."""
    ranges = [2.0 + math.sin(index / 20.0) for index in range(beams)]
    ranges[: beams // 10] = [math.inf] * (beams // 10)
    turn = math.tau / beams
    return LaserScan(
        Header(AT, "laser"), -math.pi, math.pi - turn, turn, 0.0, 0.1, 0.12, 12.0, Float32Array(ranges)
    )


def diagnostics() -> DiagnosticArray:
    """Lists in lists, and sentences."""
    parts = [
        DiagnosticStatus(
            0,
            "Battery",
            "24.1 V, all cells within 20 mV of each other",
            "pack-7",
            [KeyValue("Voltage", "24.1"), KeyValue("Cycles", "212")],
        ),
        DiagnosticStatus(1, "Laser", "Mirror is dirty", "lds-02"),
        DiagnosticStatus(0, "Motors", "", "mc-33"),
    ]
    return DiagnosticArray(Header(AT), parts)


def battery() -> BatteryState:
    """Mostly not known."""
    return BatteryState(Header(AT), percentage=0.87, voltage=24.13)


def picture() -> CompressedImage:
    """Bytes without a meaning."""
    return CompressedImage(Header(AT, "camera"), "jpeg", bytes(48_230))
