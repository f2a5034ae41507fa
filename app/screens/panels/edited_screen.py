"""The panels screen, as its editor knows it, and what may not be together on one view."""

from __future__ import annotations

from typing import Any, Protocol

from app.layout.layout import LayoutError
from app.layout.layout_faults import check_apart
from app.layout.view_checks import says
from app.layout.views import View
from app.profiles.profile_choice import ProfileChoice
from app.screens.panels.side_pane import SidePane
from app.screens.panels.view_show import ViewShow
from app.session.session import Session
from widgets.core.language import tr

__all__ = ["EditedScreen", "view_fault"]


def view_fault(view: View) -> str:
    """Why the panels of a view cannot be together, in one sentence; empty where they can."""
    hands = [
        (panel.stack or f"panel {number}", panel.title or f"{panel.widget} {number}", said)
        for number, panel in enumerate(view.panels, 1)
        if (said := says(panel))
    ]
    try:
        check_apart(tr("This view"), hands)
    except LayoutError as error:
        return str(error)
    return ""


class EditedScreen(Protocol):
    """The screen, as far as editing needs it."""

    app: Any
    session: Session
    profiles: ProfileChoice
    pane: SidePane
    shows: ViewShow
    view: float
    editing: bool

    @property
    def views(self) -> tuple[View, ...]:
        """As they are now."""

    def choose(self, index: int) -> None:
        """Put another view on the glass."""

    def show(self) -> None:
        """Bring the glass up to date."""

    def edit(self, on: bool) -> None:
        """Begin or end to edit."""

    def take(self, views: tuple[View, ...]) -> None:
        """Keep these views."""

    def reload(self) -> None:
        """Take the profile as it is now."""

    def make_room(self) -> None:
        """The pane came or went."""

    def settle(self) -> None:
        """Have STOP put where it goes now."""

    def add_widget(self, widget: Any) -> None:
        """Put something on the glass."""

    def remove_widget(self, widget: Any) -> None:
        """Take it away."""
