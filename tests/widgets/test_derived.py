"""What a widget derives from its properties is right after every change, not only after the changes somebody thought of."""

from __future__ import annotations

from typing import Any

import pytest
from kivy.properties import AliasProperty

from widgets.gallery import all_samples

FIRST = {title: (state, build) for title, state, build in reversed(list(all_samples()))}
"""One sample of each widget."""


def derived(widget: Any) -> dict[str, AliasProperty]:
    """Derived properties of a widget by name; those of Kivy's own classes are Kivy's to keep right."""
    found: dict[str, AliasProperty] = {}
    for kind in reversed(type(widget).__mro__):
        if not kind.__module__.startswith("kivy"):
            found |= {name: one for name, one in vars(kind).items() if isinstance(one, AliasProperty)}
    return found


@pytest.mark.parametrize("title", FIRST)
def test_after_a_change_of_size_it_is_what_it_would_be_if_asked_for_the_first_time(
    stage: Any, title: str
) -> None:
    widget = stage.show(FIRST[title][1]())
    known = derived(widget)
    for size in ((376, 242), (242, 242), (242, 376), (376, 376)):
        for name in known:
            getattr(widget, name)
        widget.size = size
        for name, one in known.items():
            before = repr(getattr(widget, name))  # NaN equals nothing
            one.trigger_change(widget, None)
            assert repr(getattr(widget, name)) == before, f"{name} at {size}"
