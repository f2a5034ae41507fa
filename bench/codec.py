"""Messages to text and back, against the plain way: the json module and dicts."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

from bench.figures import Figure, timed
from bridge import codec
from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu, LaserScan

__all__ = ["measure", "scan"]


def scan(beams: int = 360) -> LaserScan:
    """A sweep with some beams that met nothing."""
    ranges = [math.inf if beam % 11 == 0 else 2 + math.sin(beam / 20) for beam in range(beams)]
    return LaserScan(angle_min=-math.pi, angle_max=math.pi, range_max=12.0, ranges=Float32Array(ranges))


def _plain(value: Any) -> Any:
    """The same rules by hand: null for what JSON lacks, lists for arrays."""
    if isinstance(value, dict):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, int | str):
        return value
    return [_plain(part) for part in value]


def _pair(name: str, msg: Msg) -> Iterator[Figure]:
    kind, text = type(msg), codec.to_json(msg)
    fields = codec.to_builtins(msg)
    ours, plain = timed(lambda: codec.to_json(msg)), timed(lambda: json.dumps(_plain(fields)))
    yield Figure(f"{name} to JSON", "µs", tuple(s * 1e6 for s in ours), against=f"{len(text)} bytes")
    yield _times(f"{name} to JSON, gain", plain, ours, "times faster than json.dumps of a dict")
    ours, plain = timed(lambda: codec.from_json(text, kind)), timed(lambda: json.loads(text))
    yield Figure(f"{name} from JSON", "µs", tuple(s * 1e6 for s in ours), against="checked and typed")
    yield _times(f"{name} from JSON, gain", plain, ours, "times faster than json.loads, which checks nothing")


def _times(name: str, plain: tuple[float, ...], ours: tuple[float, ...], against: str) -> Figure:
    return Figure(
        name, "x", tuple(slow / fast for slow, fast in zip(plain, ours, strict=True)), against=against
    )


def measure() -> Iterator[Figure]:
    """Three messages that flow all the time."""
    yield from _pair("odometry", Odometry())
    yield from _pair("IMU", Imu())
    yield from _pair("scan of 360", scan())
    msg = scan()
    packed = codec.to_cbor(msg)
    writing, reading = timed(lambda: codec.to_cbor(msg)), timed(lambda: _from_cbor(packed))
    yield Figure("scan to CBOR", "µs", tuple(s * 1e6 for s in writing), against=f"{len(packed)} bytes")
    yield Figure("scan from CBOR", "µs", tuple(s * 1e6 for s in reading), against="checked and typed")


def _from_cbor(packed: bytes) -> LaserScan:
    return codec.from_builtins(codec.from_cbor(packed), LaserScan)
