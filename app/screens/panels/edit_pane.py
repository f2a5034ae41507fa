"""What the editor offers: its buttons, and in its pane the list of this robot's topics or the selected panel."""

from __future__ import annotations

from typing import Any

from app.screens.panels.offers import shown_topics, title_of
from app.screens.panels.panel_signals import sendable
from app.screens.panels.side_pane import AddList, Inspector, SidePane
from app.screens.panels.view_pane import ViewPane
from app.screens.panels.view_tabs import Act
from app.session.session import Session
from bridge.msgs.std_msgs import Bool
from widgets.core.language import tr

__all__ = ["edit_acts", "fill", "view_acts"]


def view_acts(*, able: bool) -> list[Act]:
    """Buttons while the panels live; `able` to edit them."""
    return [
        ("share", tr("Share"), "qr_code_2", True, False),
        ("edit", tr("Edit"), "edit", able, False),
    ]


def edit_acts(form: str, *, undo: bool, redo: bool) -> list[Act]:
    """Buttons while they are edited, in a window of that form."""
    acts: list[Act] = [
        ("undo", tr("Undo"), "undo", undo, False),
        ("redo", tr("Redo"), "redo", redo, False),
        ("done", tr("Done"), "check", True, True),
    ]
    if form == "wide":
        acts.insert(2, ("share", tr("Export"), "upload", True, False))
    else:
        acts.insert(0, ("list", tr("Add"), "add", True, False))
    return acts


def fill(pane: SidePane, editor: Any, session: Session, form: str) -> None:
    """Show the selected panel in the pane or, where none is, what can be added of what the robot offers."""
    view, index = editor.view, editor.selected
    if index is None:
        offer = session.robot.capabilities
        topics = shown_topics(offer) if offer is not None else []
        listed = AddList(topics, editor.add, editor.add_control, lambda topic: sendable(session, topic, Bool))
        listed.add_widget(ViewPane(tr(view.title), editor.act_on_view))
        pane.show(tr("Add from this robot"), listed, closable=form != "wide")
        return
    panel = view.panels[index]
    others = [
        (number, title_of(one, brief=True))
        for number, one in enumerate(view.panels)
        if number != index and (not panel.stack or one.stack != panel.stack)
    ]
    inspector = Inspector(
        panel,
        editor.places[index],
        form,
        others,
        change=lambda **keys: editor.change(index, **keys),
        put=lambda place: editor.place(index, place),
        act=lambda what, other=-1: editor.act_on(index, what, other),
    )
    pane.show(title_of(panel), inspector, closable=True)
