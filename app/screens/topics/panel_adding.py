"""Put a topic on a panel: on which view, and as which of the widgets that fit it, best first.

The change is made in the editor of the panels screen, so that it can be undone there and is kept by "Done".
"""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder

from app.screens.panels.offers import offer_name, offers_for
from app.screens.panels.panel_signals import sendable
from app.screens.parts.dialogs import Question
from app.screens.shell.screen_host import ScreenHost
from bridge.msgs.std_msgs import Bool
from widgets.core.language import tr
from widgets.fitting import Offer
from widgets.parts.kit import QuietButton

__all__ = ["AddDialog", "add_panel"]

Builder.load_string("""
#:import tr widgets.core.language.tr
<AddDialog>:
    RoomCard:
        id: card
        room: root.room
        wide: dp(460)
        high: dp(560)
        Text:
            text: tr('Add to panel')
            bold: True
            font_size: theme.size_title
        ScrollView:
            do_scroll_x: False
            bar_width: dp(3)
            bar_color: theme.muted
            Column:
                spacing: dp(8)
                padding: 0, 0, dp(8), 0
                SectionLabel:
                    title: tr('View')
                Column:
                    id: views
                    spacing: dp(6)
                SectionLabel:
                    title: tr('Shown as')
                Column:
                    id: ways
                    spacing: dp(6)
        BoxLayout:
            size_hint_y: None
            height: theme.target
            QuietButton:
                id: cancel
                text: tr('Cancel')
                on_release: root.close()
""")


class AddDialog(Question):
    """A tap on a way to show it adds the panel and goes to the panels screen."""

    wanted = (480.0, 580.0)

    def __init__(self, app: ScreenHost, topic: str, kind: str, **kwargs: Any) -> None:
        """`kind` is the ROS 1 name of the topic's type."""
        super().__init__(**kwargs)
        self._app, self._topic = app, topic
        screen = app.screens["panels"]
        titles = [view.title for view in screen.views]
        self.view = int(screen.view) if titles else None
        """Number of the view that is chosen; None for a new one."""
        self.rows: dict[int | None, QuietButton] = {}
        for view, title in [*enumerate(titles), (None, tr("New view"))]:
            self.rows[view] = button = QuietButton(text=title)
            button.bind(on_release=lambda _, view=view: self.choose(view))
            self.ids.views.add_widget(button)
        self.choose(self.view)
        self.ways: dict[str, QuietButton] = {}
        for offer in offers_for(topic, kind, sends=sendable(screen.session, topic, Bool)):
            name = offer_name(offer)
            button = QuietButton(text=name, icon="add")
            button.bind(on_release=lambda _, offer=offer: self.add(offer))
            self.ids.ways.add_widget(button)
            self.ways[name] = button

    def choose(self, view: int | None) -> None:
        """Take a view by its number; None for a new one."""
        self.view = view
        for number, button in self.rows.items():
            button.icon = "radio_button_checked" if number == view else "radio_button_unchecked"

    def add(self, offer: Offer) -> None:
        """Put the topic there as offered, and show it under the editor's hands."""
        self.close()
        add_panel(self._app, self._topic, offer, self.view)


def add_panel(app: ScreenHost, topic: str, offer: Offer, view: int | None) -> None:
    """Add a panel to a view of the robot's profile by its number, None for a new one, in the editor of the panels screen."""
    app.show("panels")
    screen = app.screens["panels"]
    if not screen.editing:
        screen.editor.begin()
    there = len(screen.editor.views)
    if view is None:
        screen.editor.add_view()
        if len(screen.editor.views) == there:
            return  # no room for one more, which was said
    elif view < there:
        screen.choose(view)
    screen.editor.add(topic, offer)
