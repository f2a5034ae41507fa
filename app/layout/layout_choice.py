"""The drive screen of a robot: the one that the user insists on, or the one that is made for its model or kind."""

from __future__ import annotations

from collections.abc import Iterable

from app.layout.layout import Layout, choose, load, load_all

__all__ = ["LayoutChoice"]


class LayoutChoice:
    """Every layout there is, read once."""

    def __init__(self, widgets: Iterable[str], name: str | None = None) -> None:
        """`widgets` are the names that a layout may use; `name` is the layout that is shown of every robot.

        Raises LayoutError for a layout that cannot be shown.
        """
        names = list(widgets)
        self._all = load_all(names)
        self._chosen = load(name, names) if name is not None else None

    def of(self, model: str, kind: str) -> Layout:
        """The layout for a robot of that model and kind."""
        return self._chosen or choose(self._all, model, kind)
