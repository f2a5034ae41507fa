"""A widget that was thrown away and not collected yet, and a collector that comes in the middle of its rule."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator
from contextlib import contextmanager

from kivy.event import EventDispatcher
from kivy.lang import Builder, global_idmap
from kivy.properties import ObjectProperty, StringProperty
from kivy.uix.widget import Widget

__all__ = ["Lasting", "automatic", "make_much", "throw_away"]


def make_much(value: object) -> object:
    """Give `value` back, after what makes the collector come."""
    thresholds = gc.get_threshold()
    gc.set_threshold(1, 1, 1)
    _ = [[] for _ in range(100)]
    gc.set_threshold(*thresholds)
    return value


global_idmap.update(make_much=make_much)
Builder.load_string("""
<Thrown>:
    followed: make_much(self.source.name), self.x
""")


class Lasting(EventDispatcher):
    """Outlives the widgets that follow it, as the theme and the session do."""

    name = StringProperty("before")


class Thrown(Widget):
    """Its rule makes so many objects that Python's collector comes, if it is let, before the rule is through."""

    source = ObjectProperty(rebind=True)
    followed = ObjectProperty()


def throw_away(source: EventDispatcher) -> weakref.ref[Widget]:
    """A widget that nobody has any more, but that follows `source.name` as long as it is not collected."""
    enabled = gc.isenabled()
    gc.disable()  # the rule is computed here, too, and what outlives a collection is not looked at soon again
    thrown = Thrown(source=source)
    thrown.itself = thrown  # a cycle, as between a dialog and what its buttons call
    if enabled:
        gc.enable()
    return weakref.ref(thrown)


@contextmanager
def automatic() -> Iterator[None]:
    """Python's collector as a program finds it, but that it waits for `make_much`."""
    enabled, thresholds = gc.isenabled(), gc.get_threshold()
    gc.set_threshold(1_000_000, *thresholds[1:])
    gc.enable()
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
        (gc.enable if enabled else gc.disable)()
