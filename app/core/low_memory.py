"""What the app does when the system runs short of memory: it gives back what can be made again."""

from __future__ import annotations

import gc

from kivy.cache import Cache

__all__ = ["KEPT_BY_KIVY", "make_room"]

KEPT_BY_KIVY = ("kv.image", "kv.texture", "kv.loader")
"""Kivy's own stores of pictures; one that is on the glass stays with its widget."""


def make_room(*_: object) -> None:
    """Forget pictures that are not on the glass, and collect what nobody holds. Nothing on the glass changes."""
    for category in KEPT_BY_KIVY:
        Cache.remove(category)
    gc.collect()
