"""Messages to text and back.

CPU time of one call. The scan has 360 beams; the standard library's `json` is given the same message as dicts and
lists, already made.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bridge.codec import from_cbor, from_json, to_cbor, to_json
from bridge.msgs import Msg, nav_msgs, sensor_msgs
from bridge.msgs.arrays import Float32Array

JSON = "standard library json"
DICTS = "standard library json, unchecked dicts"
FIGURES = (
    Figure("odom_encode", "µs", "an Odometry to JSON", against=JSON),
    Figure("odom_decode", "µs", "an Odometry from JSON, checked and typed", against=DICTS),
    Figure("scan_encode", "µs", "a LaserScan to JSON", against=JSON),
    Figure("scan_decode", "µs", "a LaserScan from JSON, checked and typed", against=DICTS),
    Figure("scan_to_cbor", "µs", "a LaserScan to CBOR", against=JSON),
    Figure("scan_from_cbor", "µs", "a LaserScan's numbers from CBOR", against=JSON),
)
REPEATS = 3

TIMING_TIME = 0.1
"""Time for which each codec row is repeated [s]."""

SCAN = sensor_msgs.LaserScan(
    angle_min=-math.pi,
    angle_increment=math.tau / 360,
    range_min=0.1,
    range_max=12.0,
    ranges=Float32Array([5 + 3 * math.sin(beam / 9) for beam in range(360)]),
)
ODOM = nav_msgs.Odometry()


def plain(msg: Msg) -> dict[str, object]:
    """The message as dicts and lists only."""
    return json.loads(to_json(msg))


def ours() -> dict[str, float]:
    """One sample of every figure, our way."""
    scan, odom, binary = to_json(SCAN), to_json(ODOM), to_cbor(SCAN)
    return {
        "odom_encode": micros(partial(to_json, ODOM)),
        "odom_decode": micros(partial(from_json, odom, nav_msgs.Odometry)),
        "scan_encode": micros(partial(to_json, SCAN)),
        "scan_decode": micros(partial(from_json, scan, sensor_msgs.LaserScan)),
        "scan_to_cbor": micros(partial(to_cbor, SCAN)),
        "scan_from_cbor": micros(partial(from_cbor, binary)),
    }


def peer() -> dict[str, float]:
    """One sample of every figure, the other way."""
    scan, odom = plain(SCAN), plain(ODOM)
    encode, decode = micros(partial(json.dumps, scan)), micros(partial(json.loads, json.dumps(scan)))
    return {
        "odom_encode": micros(partial(json.dumps, odom)),
        "odom_decode": micros(partial(json.loads, json.dumps(odom))),
        "scan_encode": encode,
        "scan_decode": decode,
        "scan_to_cbor": encode,
        "scan_from_cbor": decode,
    }


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing to set up."""
    yield Sides(ours, peer)


def micros(work: Callable[[], object]) -> float:
    """CPU time of one call [µs]."""
    calls, started = 0, time.thread_time()
    while time.thread_time() - started < TIMING_TIME:
        for _ in range(20):
            work()
        calls += 20
    return (time.thread_time() - started) / calls * 1e6
