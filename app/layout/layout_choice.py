"""The drive screen of a robot: the one that the user insists on, or the one that is made for its model or kind."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from app.layout.layout import DEFAULT, FOLDER, Layout, LayoutError, load, owners

__all__ = ["LayoutChoice"]


class LayoutChoice:
    """Every layout there is, each read and checked once, when a robot needs it: that imports the widgets that it names."""

    def __init__(self, widgets: Iterable[str], name: str | None = None, folder: Path = FOLDER) -> None:
        """`widgets` are the names that a layout may use; `name` is the layout that is shown of every robot.

        Raises LayoutError for a layout of that name that cannot be shown.
        """
        self._widgets, self._folder = list(widgets), folder
        self._owners: Mapping[str, str] | None = None
        self._read: dict[str, Layout] = {}
        self._chosen = load(name, self._widgets, folder) if name is not None else None
        self.mistake = ""
        """Why the layout that is made for the last robot is not shown, as a sentence; empty where it is."""

    def of(self, model: str, kind: str) -> Layout:
        """The layout for a robot of that model and kind: models come before kinds, and a robot of neither gets `DEFAULT`.

        So does one whose layout is wrong, which is a `mistake` then. Raises LayoutError where `DEFAULT` itself is wrong.
        The one that the user insists on has that robot's drive screen where it says nothing of any.
        """
        if self._chosen is not None and self._chosen.drives:
            return self._chosen
        made = self._made_for(model, kind)
        return made if self._chosen is None else self._chosen.with_drive_of(made)

    def _made_for(self, model: str, kind: str) -> Layout:
        self.mistake = ""
        try:
            if self._owners is None:
                self._owners = owners(self._folder)
            return self._load(self._owners.get(model) or self._owners.get(kind) or DEFAULT)
        except LayoutError as mistake:
            self.mistake = str(mistake)
            return self._load(DEFAULT)

    def _load(self, name: str) -> Layout:
        if name not in self._read:
            self._read[name] = load(name, self._widgets, self._folder)
        return self._read[name]
