"""A tree of coordinate frames, and where one lies in another."""

from __future__ import annotations

from bridge.msgs.geometry_msgs import Quaternion, Transform, TransformStamped, Vector3

__all__ = ["MAX_FRAMES", "Frames", "composed", "inverse"]

MAX_FRAMES = 1000
"""Most frames that are known at a time."""


class Frames:
    """The newest transform of each frame in its parent."""

    def __init__(self) -> None:
        self._parents: dict[str, tuple[str, Transform]] = {}

    def add(self, found: TransformStamped) -> None:
        """Note where a frame lies; a new one beyond `MAX_FRAMES` is left out."""
        child = found.child_frame_id.lstrip("/")
        if child in self._parents or len(self._parents) < MAX_FRAMES:
            self._parents[child] = found.header.frame_id.lstrip("/"), found.transform

    def lookup(self, target: str, source: str) -> Transform | None:
        """Where the frame `source` lies in `target`; None while that is not known."""
        ups, downs = self._way_up(source.lstrip("/")), self._way_up(target.lstrip("/"))
        common = next((frame for frame in ups if frame in downs), None)
        if common is None:
            return None
        return composed(inverse(downs[common]), ups[common])

    def _way_up(self, frame: str) -> dict[str, Transform]:
        """Where `frame` lies in itself, its parent, and so on, in this order."""
        found = {frame: Transform()}
        here = Transform()
        while frame in self._parents:
            parent, step = self._parents[frame]
            if parent in found:
                break  # a circle
            here = composed(step, here)
            found[parent] = here
            frame = parent
        return found


def composed(outer: Transform, inner: Transform) -> Transform:
    """First `inner`, then `outer`."""
    moved = _rotated(outer.rotation, inner.translation)
    at = outer.translation
    return Transform(
        Vector3(at.x + moved.x, at.y + moved.y, at.z + moved.z), _times(outer.rotation, inner.rotation)
    )


def inverse(transform: Transform) -> Transform:
    """The transform that undoes this one."""
    back = _conjugate(transform.rotation)
    moved = _rotated(back, transform.translation)
    return Transform(Vector3(-moved.x, -moved.y, -moved.z), back)


def _conjugate(turn: Quaternion) -> Quaternion:
    return Quaternion(0.0 - turn.x, 0.0 - turn.y, 0.0 - turn.z, turn.w)


def _times(a: Quaternion, b: Quaternion) -> Quaternion:
    return Quaternion(
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    )


def _rotated(turn: Quaternion, point: Vector3) -> Vector3:
    found = _times(_times(turn, Quaternion(point.x, point.y, point.z, 0.0)), _conjugate(turn))
    return Vector3(found.x + 0.0, found.y + 0.0, found.z + 0.0)
