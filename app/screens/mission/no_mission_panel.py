"""The panel beside the map of a robot that stores no missions and offers no tasks: that, and where to go instead."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.link.capabilities import POSE
from app.session.dashboard import Dashboard
from widgets import Readout
from widgets.core.language import mark, tr
from widgets.instruments.readout import ReadoutGrid
from widgets.parts.column import Column

__all__ = ["Figures", "NoMissionPanel"]

Builder.load_string("""
<NoMissionPanel>:
    spacing: dp(12)
    BoxLayout:
        size_hint_y: None
        height: max(dp(24), note.height)
        spacing: dp(9)
        Icon:
            name: 'info'
            role: 'muted'
            font_size: sp(20)
            pos_hint: {'center_y': .5}
        Text:
            id: note
            text: tr('It stores no missions and offers no tasks: drive it by hand, or view its topics.')
            font_size: sp(15)
            pos_hint: {'center_y': .5}
    BoxLayout:
        size_hint_y: None
        height: theme.target
        spacing: dp(10)
        PrimaryButton:
            id: drive
            icon: 'sports_esports'
            text: tr('Drive')
            on_release: root.dispatch('on_choose', 'drive')
        QuietButton:
            id: topics
            icon: 'data_object'
            text: tr('Topics')
            on_release: root.dispatch('on_choose', 'topics')
""")


class NoMissionPanel(Column):
    """One sentence and the two screens that do fit such a robot."""

    __events__ = ("on_choose",)

    def on_choose(self, screen: str) -> None:
        """The operator wants to go to `screen`."""


class Figures(ReadoutGrid):
    """How it moves and where it is, where a task would have told how far it is."""

    def __init__(self, dashboard: Dashboard, **kwargs: Any) -> None:
        super().__init__(**{"cols": 2, "spacing": ("12dp", "6dp"), **kwargs})
        for topic, name, unit, path, scale in (
            ("/odom", mark("Speed"), "m/s", "twist.twist.linear.x", 1.0),
            ("/odom", mark("Turn"), "°/s", "twist.twist.angular.z", 57.29577951308232),
            (POSE, "X", "m", "pose.pose.position.x", 1.0),
            (POSE, "Y", "m", "pose.pose.position.y", 1.0),
        ):
            decimals = {"Speed": 2, "Turn": 0}.get(name, 1)
            figure = Readout(name=tr(name), unit=unit, path=path, scale=scale, decimals=decimals)
            figure.fitted, figure.size_hint_x, figure.font_size = False, 1, "22sp"
            self.add_widget(figure)
            dashboard.bind(figure, topic)
