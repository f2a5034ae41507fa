"""Dialogs of the panels screen: the faults of the robot's own profile, and how a profile is handed on and taken in."""

from __future__ import annotations

from collections.abc import Callable

from app.layout.views import View
from app.screens.panels.edited_screen import EditedScreen
from app.screens.panels.sharing.fault_dialog import FaultDialog
from app.screens.panels.sharing.share_dialog import ShareDialog

__all__ = ["share", "tell_faults"]


def share(screen: EditedScreen, views: tuple[View, ...] | None, on_import: Callable[[], object]) -> None:
    """Show how the robot's profile is shared; `views` are those under change, None for those that are kept."""
    shell = screen.app.shell
    if shell is not None and shell.parent is not None:
        shell.parent.add_widget(ShareDialog(screen.profiles, screen.session.robot.info, views, on_import))


def tell_faults(screen: EditedScreen) -> None:
    """Show all that is wrong with the robot's own profile, whose file stays as it is; nothing where it is right."""
    info, shell = screen.session.robot.info, screen.app.shell
    screen.profiles.of(info)
    faults = screen.profiles.faults
    if faults and shell is not None and shell.parent is not None:
        path = screen.profiles.store.path(screen.profiles.chosen(info))
        shell.parent.add_widget(FaultDialog(str(path), faults))
