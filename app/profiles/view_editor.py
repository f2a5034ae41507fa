"""Editor of a profile's views: every change makes new views of the old ones, and each can be undone and done again."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import msgspec

from app.layout.panel_grid import FORMS, Place, clamped, free_place, settled, usual_size
from app.layout.views import MAX_PANELS, MAX_VIEWS, Panel, View, places_of, stacks_of
from widgets.core.language import tr

__all__ = ["MAX_UNDO", "EditError", "ViewEditor"]

MAX_UNDO = 200
"""Changes that can be undone."""


class EditError(ValueError):
    """A change that cannot be made; the text is one sentence that says why."""


class ViewEditor:
    """The views under change, and the one that is looked at."""

    def __init__(self, views: Sequence[View], check: Callable[[View], str] = lambda _: "") -> None:
        """`check` gives what is wrong with a changed view as a sentence, empty for nothing."""
        self._views = self._saved = tuple(views)
        self._check = check
        self._undo: list[tuple[View, ...]] = []
        self._redo: list[tuple[View, ...]] = []

    @property
    def views(self) -> tuple[View, ...]:
        """As they are now."""
        return self._views

    @property
    def changed(self) -> bool:
        """They are not as they were at the beginning."""
        return self._views != self._saved

    @property
    def can_undo(self) -> bool:
        """There is a change to undo."""
        return bool(self._undo)

    @property
    def can_redo(self) -> bool:
        """There is an undone change to do again."""
        return bool(self._redo)

    def undo(self) -> None:
        """Take back the last change; nothing where there is none."""
        if self._undo:
            self._redo.append(self._views)
            self._views = self._undo.pop()

    def redo(self) -> None:
        """Make the change again that was taken back last; nothing where there is none."""
        if self._redo:
            self._undo.append(self._views)
            self._views = self._redo.pop()

    def replace(self, views: Sequence[View]) -> None:
        """Put others in the place of all of them, as a reset or an import does."""
        self._take(tuple(views))

    # views

    def add_view(self, title: str) -> int:
        """Append an empty view; its index. EditError where there are too many."""
        if len(self._views) >= MAX_VIEWS:
            raise EditError(tr("A profile has at most {max_views} views.").format(max_views=MAX_VIEWS))
        self._take((*self._views, View(title)))
        return len(self._views) - 1

    def remove_view(self, view: int) -> None:
        """Take a view away with all its panels."""
        self._take(self._views[:view] + self._views[view + 1 :])

    def rename_view(self, view: int, title: str) -> None:
        """EditError for a name that is empty or too long."""
        self._put(view, View(_titled(title), self._views[view].panels))

    # panels

    def add(self, view: int, panel: Panel) -> int:
        """Append a panel in the first place that is free; its index. EditError where it cannot be there."""
        panels = self._views[view].panels
        if len(panels) >= MAX_PANELS:
            raise EditError(tr("A view has at most {max_panels} panels.").format(max_panels=MAX_PANELS))
        for form in FORMS:
            if any(one.place(form) is not None for one in panels):
                taken = places_of(panels, form)
                place = free_place(usual_size(panel.widget, form), taken, form)
                panel = msgspec.structs.replace(panel, **{form: tuple(place)})
        self._put(view, View(self._views[view].title, (*panels, panel)))
        return len(panels)

    def remove(self, view: int, panel: int) -> None:
        """Take a panel away; the others of its stack stay in its place."""
        panels = self._inherited(view, panel)
        self._put(view, View(self._views[view].title, tuple(panels[:panel] + panels[panel + 1 :])))

    def place(self, view: int, panel: int, form: str, place: Place) -> None:
        """Move or resize a panel, and its stack with it, in windows of that form; what lies there makes room downwards.

        Every panel of the view has a place by hand in that form from then on.
        """
        panels = list(self._views[view].panels)
        groups = stacks_of(panels)
        places = places_of(panels, form)
        moved = next(number for number, group in enumerate(groups) if panel in group)
        wanted = [places[group[0]] for group in groups]
        wanted[moved] = clamped(place, form)
        for group, found in zip(groups, settled(wanted, moved), strict=True):
            for index in group:
                panels[index] = msgspec.structs.replace(panels[index], **{form: tuple(found)})
        self._put(view, View(self._views[view].title, tuple(panels)))

    def arrange(self, view: int, form: str) -> None:
        """Forget the places set by hand in windows of that form."""
        panels = [msgspec.structs.replace(one, **{form: None}) for one in self._views[view].panels]
        self._put(view, View(self._views[view].title, tuple(panels)))

    def change(self, view: int, panel: int, **keys: object) -> None:
        """Set keys of a panel, as its title or its topic; EditError where that is wrong."""
        if "title" in keys:
            keys["title"] = _titled(str(keys["title"]), panel=True)
        self._set(view, panel, msgspec.structs.replace(self._views[view].panels[panel], **keys))

    def stack(self, view: int, panel: int, other: int) -> None:
        """Lay a panel into the place of another, behind it and what is stacked with that."""
        panels = self._inherited(view, panel)
        name = panels[other].stack or _unused(one.stack for one in panels)
        places = {form: getattr(panels[other], form) for form in FORMS}
        panels[other] = msgspec.structs.replace(panels[other], stack=name)
        panels[panel] = msgspec.structs.replace(panels[panel], stack=name, **places)
        first = panels.pop(panel)
        panels.insert(other if panel < other else other + 1, first)
        self._put(view, View(self._views[view].title, tuple(panels)))

    def unstack(self, view: int, panel: int) -> None:
        """Lay a panel of a stack beside the others, in the first place that is free."""
        panels = self._inherited(view, panel)
        alone = msgspec.structs.replace(panels[panel], stack="")
        panels[panel] = msgspec.structs.replace(alone, **dict.fromkeys(FORMS))
        others = panels[:panel] + panels[panel + 1 :]
        for form in FORMS:
            if any(one.place(form) is not None for one in others):
                place = free_place(usual_size(alone.widget, form), places_of(others, form), form)
                panels[panel] = msgspec.structs.replace(panels[panel], **{form: tuple(place)})
        self._put(view, View(self._views[view].title, tuple(panels)))

    def _inherited(self, view: int, panel: int) -> list[Panel]:
        """The panels, the places of `panel` handed on to the next of its stack, for it leaves it."""
        panels = list(self._views[view].panels)
        group = next(group for group in stacks_of(panels) if panel in group)
        if group[0] == panel and len(group) > 1:
            places = {form: getattr(panels[panel], form) for form in FORMS}
            panels[group[1]] = msgspec.structs.replace(panels[group[1]], **places)
        return panels

    def _set(self, view: int, panel: int, made: Panel) -> None:
        panels = list(self._views[view].panels)
        panels[panel] = made
        self._put(view, View(self._views[view].title, tuple(panels)))

    def _put(self, view: int, made: View) -> None:
        if problem := self._check(made):
            raise EditError(problem)
        self._take((*self._views[:view], made, *self._views[view + 1 :]))

    def _take(self, views: tuple[View, ...]) -> None:
        if views == self._views:
            return
        self._undo = [*self._undo, self._views][-MAX_UNDO:]
        self._redo.clear()
        self._views = views


def _titled(title: str, *, panel: bool = False) -> str:
    """The title of a view, or of a `panel`, without spaces round it; EditError where it is too long, or that of a view empty."""
    title = title.strip()
    if not title and not panel:
        raise EditError(tr("Enter a name for the view."))
    if len(title) > 60:
        raise EditError(
            tr("The name of a panel has at most 60 letters.")
            if panel
            else tr("The name of a view has at most 60 letters.")
        )
    return title


def _unused(names: Iterable[str]) -> str:
    taken = set(names)
    return next(f"stack {number}" for number in range(1, MAX_PANELS + 2) if f"stack {number}" not in taken)
