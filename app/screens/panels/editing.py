"""Editing of the panels screen: what its buttons, cards, keys and pane do to the views, and when they are kept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from app.inputs.base.text_focus import is_typing
from app.layout.panel_grid import Place
from app.layout.sensible_view import panel_of, sensible_view
from app.layout.views import Panel, View, places_of
from app.profiles.view_editor import EditError, ViewEditor
from app.screens.panels.edit_dialogs import share
from app.screens.panels.edit_keys import press
from app.screens.panels.edit_pane import edit_acts, fill, view_acts
from app.screens.panels.edited_screen import EditedScreen, view_fault
from app.screens.panels.offers import Offer, control_panel
from app.screens.panels.view_tabs import Act
from widgets.core.language import tr

__all__ = ["Editing"]


class Editing:
    """Made once for the screen."""

    def __init__(self, screen: Any) -> None:
        self._screen: EditedScreen = screen
        self._editor = ViewEditor((), view_fault)
        self._selected: int | None = None
        self._listed = False
        """The list of topics lies over a phone's board."""
        self._form = "wide"
        self._shown: object = None

    @property
    def views(self) -> tuple[View, ...]:
        """Those under change."""
        return self._editor.views

    def acts(self, form: str) -> list[Act]:
        """What the buttons offer now."""
        if not self._screen.editing:
            return view_acts(able=self._screen.session.robot.capabilities is not None)
        return edit_acts(form, undo=self._editor.can_undo, redo=self._editor.can_redo)

    def act(self, what: str) -> None:
        """A button was pressed."""
        acts: dict[str, Callable[[], object]] = {
            "edit": self.begin,
            "done": self.done,
            "undo": self.undo,
            "redo": self.redo,
            "share": self.share,
            "list": self._toggle_list,
        }
        acts[what]()

    # begin and end

    @property
    def selected(self) -> int | None:
        """Index of the panel that is selected; None for none."""
        return self._selected

    @property
    def view(self) -> View:
        """The one on the glass."""
        return self.views[int(self._screen.view)]

    @property
    def places(self) -> list[Place]:
        """Where every panel of the view lies in this form of the window."""
        return places_of(self.view.panels, self._form)

    @property
    def kept(self) -> ViewEditor:
        """What is under change, for another screen that goes on with it."""
        return self._editor

    def begin(self, kept: ViewEditor | None = None) -> None:
        """Edit the views that are on the glass, or go on with what was `kept`."""
        screen = self._screen
        self._editor = kept if kept is not None else ViewEditor(screen.views, view_fault)
        if not self._editor.views:
            self._editor.add_view(tr("View 1"))
        self._selected, self._listed, self._shown = None, False, None
        screen.session.link.ask_offer()
        screen.edit(True)
        screen.settle()

    def done(self) -> None:
        """Keep what was changed, and let the panels live again; where it cannot be written the editor stays open."""
        screen = self._screen
        if self._editor.changed:
            try:
                screen.take(self._editor.views)
            except OSError as error:
                self._say(
                    tr("The profile could not be saved: {reason}.").format(reason=error.strerror or error)
                )
                return
        self._end()

    def _end(self) -> None:
        screen = self._screen
        self._selected, self._listed = None, False
        screen.edit(False)
        screen.settle()

    def back(self) -> bool:
        """One step back; False where there is none."""
        if not self._screen.editing:
            return False
        if self._listed or self._selected is not None:
            self.close_pane()
        else:
            self.done()
        return True

    def undo(self) -> None:
        """Take back the last change."""
        self._editor.undo()
        self._changed()

    def redo(self) -> None:
        """Make it again."""
        self._editor.redo()
        self._changed()

    def share(self) -> None:
        """Show how the profile is handed on and taken in."""
        share(self._screen, self.views if self._screen.editing else None, self.imported)

    def imported(self) -> None:
        """Another profile was taken in for the robot."""
        if self._screen.editing:
            self._end()
        self._screen.reload()

    # changes

    def add_view(self) -> None:
        """Append a view and go there."""
        self._try(lambda: self._editor.add_view(tr("View {number}").format(number=len(self.views) + 1)))
        self._screen.choose(len(self.views) - 1)

    def add(self, topic: str, offer: Offer) -> None:
        """Put a topic on the view."""
        self._add(panel_of(topic, offer))

    def add_control(self, widget: str) -> None:
        """Put a control on the view."""
        self._add(control_panel(widget))

    def _add(self, panel: Panel) -> None:
        view = int(self._screen.view)
        if self._try(lambda: self._editor.add(view, panel)):
            self._listed = False
            self.select(len(self.views[view].panels) - 1, keep_pane=self._form == "wide")

    def select(self, index: int | None, *, keep_pane: bool = False) -> None:
        """Open the inspector of a panel; None, or with `keep_pane`, leaves the list of topics."""
        if not self._screen.editing:
            return
        self._selected = None if keep_pane else index
        self._listed = False
        self._screen.shows.select(index)
        self.show_pane(self._form)

    def place(self, index: int, place: Place) -> None:
        """Put a panel there."""
        self._try(lambda: self._editor.place(int(self._screen.view), index, self._form, place))
        self._screen.shows.select(index)

    def act_on(self, index: int, what: str, other: int = -1) -> None:
        """What a card or the inspector asks for: `hide`, `remove`, `stack` with another, `unstack`."""
        view = int(self._screen.view)
        if index >= len(self.views[view].panels):
            return
        editor, panel = self._editor, self.views[view].panels[index]
        acts = {
            "hide": lambda: editor.change(view, index, hidden=not panel.hidden),
            "remove": lambda: editor.remove(view, index),
            "stack": lambda: editor.stack(view, index, other),
            "unstack": lambda: editor.unstack(view, index),
        }
        if what != "hide":
            self._selected = None
        self._try(acts[what])

    def change(self, index: int, **keys: object) -> None:
        """Set keys of a panel."""
        self._try(lambda: self._editor.change(int(self._screen.view), index, **keys))

    def act_on_view(self, what: str, text: str = "") -> None:
        """What the pane asks for of the view: `rename`, `remove`, `arrange`; `reset` is of the whole profile."""
        view = int(self._screen.view)
        if what == "remove" and len(self.views) < 2:
            self._say(tr("The last view stays; take its panels away instead."))
            return
        acts = {
            "rename": lambda: self._editor.rename_view(view, text),
            "remove": lambda: self._editor.remove_view(view),
            "arrange": lambda: self._editor.arrange(view, self._form),
            "reset": self._reset,
        }
        self._try(acts[what])

    def _reset(self) -> None:
        screen = self._screen
        offer = screen.session.robot.capabilities
        built_in = screen.profiles.built_in(screen.session.robot.info)
        self._editor.replace(built_in.views or ((sensible_view(offer),) if offer is not None else ()))

    def _try(self, change: Any) -> bool:
        """Make a change; one that cannot be made is said."""
        try:
            change()
        except EditError as error:
            self._say(str(error))
            return False
        self._changed()
        return True

    def _changed(self) -> None:
        view = self.views[min(int(self._screen.view), len(self.views) - 1)]
        if self._selected is not None and self._selected >= len(view.panels):
            self._selected = None
        self._shown = None
        self._screen.show()
        self._screen.shows.select(self._selected)

    def _say(self, sentence: str) -> None:
        if (shell := self._screen.app.shell) is not None:
            shell.say(sentence, "warn")

    # the pane

    def on_offer(self) -> None:
        """The robot said which topics it has."""
        self._shown = None
        self.show_pane(self._form)

    def _toggle_list(self) -> None:
        self._listed, self._selected = not self._listed, None
        self._screen.shows.select(None)
        self.show_pane(self._form)

    def close_pane(self) -> None:
        """Back from the inspector, or from a phone's list."""
        self._listed = False
        self.select(None)

    def show_pane(self, form: str) -> None:
        """Bring the pane up to date: the inspector, the list of topics, or nothing on a phone."""
        screen, self._form = self._screen, form
        wanted = screen.editing and (form == "wide" or self._listed or self._selected is not None)
        pane = screen.pane
        if wanted != (pane.parent is not None):
            (screen.add_widget if wanted else screen.remove_widget)(pane)
            screen.make_room()
        shown = (self._selected, int(screen.view), form, self.views) if wanted else None
        if not wanted:
            self._shown = None
        elif shown != self._shown:
            self._shown = shown
            fill(pane, self, screen.session, form)

    def on_key(self, key: int, modifiers: list[str]) -> bool:
        """What a key does while panels are edited and no text is typed; whether it did anything."""
        return self._screen.editing and not is_typing() and press(self, key, modifiers)
