"""Story."""

from __future__ import annotations

from examples.demo.scene import Scene, Wait

__all__ = ["TOPICS", "play"]

TOPICS = ()


def play(scene: Scene) -> Wait:
    """Play."""
    yield from ()
