"""The nodes of `examples.ros_nodes`: their arithmetic and their frames. `tests/clients/test_suites.py` uses them over the socket."""

from __future__ import annotations

import math

import pytest

from bridge.core.errors import Refused
from bridge.msgs.geometry_msgs import Quaternion, Transform, TransformStamped, Vector3
from bridge.msgs.std_msgs import Header, Time
from examples.ros_nodes import nodes
from examples.ros_nodes.nodes import MAX_ORDER, fibonacci
from examples.ros_nodes.transforms import MAX_FRAMES, Frames, composed, inverse

QUARTER = Quaternion.from_yaw(math.pi / 2)


def frame(parent: str, child: str, x: float = 0.0, y: float = 0.0, turn: Quaternion | None = None):
    return TransformStamped(
        Header(Time(), parent), child, Transform(Vector3(x, y, 0.0), turn or Quaternion())
    )


def at(transform: Transform) -> tuple[float, float, float]:
    """Place and direction in the plane, rounded."""
    place = transform.translation
    return round(place.x, 6) + 0.0, round(place.y, 6) + 0.0, round(transform.rotation.yaw, 6) + 0.0


def tree() -> Frames:
    frames = Frames()
    for each in (
        frame("map", "odom", 1.0, 0.0, QUARTER),
        frame("odom", "base_link", 2.0, 0.0),
        frame("/base_link", "/laser", 0.0, 0.5),
        frame("map", "dock", 0.0, 4.0),
    ):
        frames.add(each)
    return frames


@pytest.mark.parametrize(
    ("target", "source", "found"),
    [
        ("map", "base_link", (1.0, 2.0, math.pi / 2)),
        ("/map", "laser", (0.5, 2.0, math.pi / 2)),
        ("base_link", "laser", (0.0, 0.5, 0.0)),
        ("laser", "base_link", (0.0, -0.5, 0.0)),
        ("base_link", "dock", (2.0, 1.0, -math.pi / 2)),
        ("anything", "anything", (0.0, 0.0, 0.0)),
    ],
)
def test_a_frame_is_found_in_any_other_of_its_tree(target, source, found):
    assert at(tree().lookup(target, source)) == pytest.approx(found)


def test_a_frame_of_another_tree_is_not_found():
    assert tree().lookup("map", "moon") is None


def test_a_circle_ends():
    frames = Frames()
    frames.add(frame("a", "b"))
    frames.add(frame("b", "a"))
    assert at(frames.lookup("a", "b")) == (0.0, 0.0, 0.0)


def test_frames_are_bounded_and_those_that_are_known_move_on():
    frames = Frames()
    for number in range(MAX_FRAMES):
        frames.add(frame("map", f"f{number}"))
    frames.add(frame("map", "one_more"))
    frames.add(frame("map", "f0", 3.0))
    assert frames.lookup("map", "one_more") is None
    assert at(frames.lookup("map", "f0")) == (3.0, 0.0, 0.0)


def test_a_transform_and_its_inverse_are_nothing():
    there = Transform(Vector3(1.0, 2.0, 0.0), QUARTER)
    assert at(composed(inverse(there), there)) == at(composed(there, inverse(there))) == (0.0, 0.0, 0.0)


async def test_the_numbers_are_fibonacci_s_and_each_step_is_told(monkeypatch):
    monkeypatch.setattr(nodes, "STEP_PERIOD", 0.0)
    steps: list[list[int]] = []
    assert await fibonacci(3, steps.append) == [0, 1, 1, 2, 3]
    assert steps == [[0, 1, 1], [0, 1, 1, 2], [0, 1, 1, 2, 3]]
    assert (await fibonacci(MAX_ORDER, lambda _: None))[-1] < 2**31


@pytest.mark.parametrize("order", [-1, MAX_ORDER + 1])
async def test_an_order_that_cannot_be_done_is_refused(order):
    with pytest.raises(Refused, match=f"order must be from 0 to {MAX_ORDER}, not {order}"):
        await fibonacci(order, lambda _: None)
