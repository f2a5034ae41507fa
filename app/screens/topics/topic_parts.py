"""Parts of the topics screen: a row of the table, and the topic that is open."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import BooleanProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.recycleview.views import RecycleDataViewBehavior

import app.screens.topics.topic_figures  # noqa: F401 - its columns are drawn
import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from widgets.parts.cards import Card

__all__ = ["ICONS", "TopicDetail", "TopicRow"]

ICONS = {
    "sensor_msgs/Imu": "explore",
    "sensor_msgs/LaserScan": "radar",
    "sensor_msgs/PointCloud2": "radar",
    "sensor_msgs/Range": "sensors",
    "sensor_msgs/CompressedImage": "videocam",
    "sensor_msgs/Image": "videocam",
    "sensor_msgs/BatteryState": "bolt",
    "sensor_msgs/NavSatFix": "satellite_alt",
    "nav_msgs/Odometry": "route",
    "nav_msgs/Path": "polyline",
    "nav_msgs/OccupancyGrid": "map",
    "geometry_msgs/Twist": "sports_esports",
    "diagnostic_msgs/DiagnosticArray": "build",
    "std_msgs/String": "text_fields",
}
"""Icon of a type; any other is a pair of braces."""

Builder.load_string("""
#:import wrapped widgets.parts.labels.wrapped
#:import COLUMNS app.screens.topics.topic_figures.COLUMNS
<Cell@Label>:
    column: 'rate'
    font_name: theme.font
    font_size: sp(15)
    color: theme.text
    disabled_color: self.color
    size_hint: None, 1
    share: 1
    width: sp(COLUMNS[self.column]) * self.share
    text_size: self.size
    shorten: True
    halign: 'right'
    valign: 'middle'

<Beside@Label>:
    font_name: theme.font
    font_size: sp(13.5)
    disabled_color: self.color
    size_hint: None, 1
    width: self.texture_size[0] if self.text else 0

<TopicRow>:
    padding: dp(14), 0, dp(14), 0
    spacing: dp(12)
    canvas.before:
        Rounded:
            rgba: theme.accent if root.chosen else theme.line
            pos: self.x, self.y + dp(4)
            size: self.width, self.height - dp(8)
            radius: [theme.corner]
        Rounded:
            rgba: theme.raised
            pos: self.x + root.edge, self.y + dp(4) + root.edge
            size: self.width - 2 * root.edge, self.height - dp(8) - 2 * root.edge
            radius: [theme.corner - root.edge]
        Rounded:
            rgba: theme.accent if root.chosen else (0, 0, 0, 0)  # a mark, and not a hue alone
            pos: self.x + dp(4), self.y + dp(14)
            size: dp(4), self.height - dp(28)
            radius: [dp(2)]
        Rounded:
            rgba: theme.text[:3] + [.14 if root.state == 'down' else 0]
            pos: self.x, self.y + dp(4)
            size: self.width, self.height - dp(8)
            radius: [theme.corner]
    Icon:
        name: root.icon
        role: 'accent' if root.listened else 'muted'
        pos_hint: {'center_y': .5}
    BoxLayout:
        orientation: 'vertical'
        size_hint_y: None
        height: sp(44)
        pos_hint: {'center_y': .5}
        BoxLayout:
            spacing: dp(8) if root.use else 0
            Text:
                text: root.name
                bold: True
                font_size: sp(16)
                size_hint_y: 1
                text_size: self.size
                shorten: True
                shorten_from: 'left'
            Beside:
                text: root.use
                color: theme.accent
            Beside:
                text: root.ties
                color: theme.muted
        BoxLayout:
            spacing: dp(8) if root.pace else 0
            Text:
                text: root.type
                role: 'muted'
                font_size: sp(13.5)
                size_hint_y: 1
                text_size: self.size
                shorten: True
                shorten_from: 'right' if root.stacked else 'left'
            Beside:
                text: root.pace
                color: theme.muted
    BoxLayout:
        size_hint: None, 1
        width: sp(sum(COLUMNS.values())) * root.share if root.wide else 0
        opacity: 1 if root.wide else 0
        Cell:
            share: root.share
            text: root.rate
        Cell:
            share: root.share
            column: 'age'
            text: root.age
        Cell:
            share: root.share
            column: 'bandwidth'
            text: root.bandwidth
        Cell:
            share: root.share
            column: 'publishers'
            text: root.publishers
        Cell:
            share: root.share
            column: 'subscribers'
            text: root.subscribers

<TopicDetail>:
    padding: dp(12), dp(10), dp(6), dp(10)
    spacing: dp(8)
    BoxLayout:
        size_hint_y: None
        height: max(theme.target, titles.height + dp(6)) if root.name else 0
        opacity: 1 if root.name else 0
        spacing: dp(8)
        padding: 0, 0, dp(6), 0
        IconButton:
            id: close
            icon: 'arrow_back' if root.alone else 'close'
            role: 'muted'
            bare: True
            pos_hint: {'center_y': .5}
            disabled: not root.name
            on_release: root.dispatch('on_close')
        Column:
            id: titles
            spacing: dp(2)
            pos_hint: {'center_y': .5}
            Text:  # whole, on as many lines as it takes: here alone a long name can be read
                id: title
                text: wrapped(root.name, self.width, self.font_size)
                bold: True
                font_size: sp(18)
            Text:
                text: wrapped(root.type, self.width, self.font_size)
                role: 'muted'
                font_size: sp(14)
        IconButton:
            id: add
            icon: 'dashboard'
            role: 'accent'
            scan_words: tr('Add to panel')
            pos_hint: {'center_y': .5}
            disabled: not root.name
            on_release: root.dispatch('on_add')
        Chip:
            id: pace
            icon: root.pace_icon
            role: root.pace_role
            text: root.pace
            usual: '00,0 Hz'
            pos_hint: {'center_y': .5}
            opacity: 1 if root.pace else 0
    Text:
        id: nodes
        text: root.nodes
        role: 'muted'
        font_size: sp(14)
        padding: dp(8), 0
        height: self.texture_size[1] if root.nodes else 0
    BoxLayout:
        size_hint_y: None
        height: note.height if root.notice else 0
        opacity: 1 if root.notice else 0
        spacing: dp(8)
        padding: dp(8), 0, dp(8), 0
        Icon:
            name: 'warning' if root.wrong else 'info'
            role: 'warn' if root.wrong else 'muted'
            font_size: sp(20)
            pos_hint: {'center_y': .5}
        Text:
            id: note
            text: root.notice
            role: 'text' if root.wrong else 'muted'
            font_size: sp(15)
            pos_hint: {'center_y': .5}
    FloatLayout:
        id: ground
""")


class TopicRow(RecycleDataViewBehavior, ButtonBehavior, BoxLayout):
    """One topic of the list, to be pressed."""

    name = StringProperty("")
    type = StringProperty("")
    icon = StringProperty("data_object")
    use = StringProperty("")
    """What a screen shows it as."""
    pace = StringProperty("")
    """How often it comes and how much that is, or how old it is; empty in a wide table."""
    ties = StringProperty("")
    """How many publish it and how many subscribe to it; empty in a wide table."""
    rate, age, bandwidth = StringProperty(""), StringProperty(""), StringProperty("")
    publishers, subscribers = StringProperty(""), StringProperty("")
    wide = BooleanProperty(False)
    """There is room for a column of each figure."""
    share = NumericProperty(1.0)
    """Of their usual widths that the columns have."""
    stacked = BooleanProperty(False)
    """Its name is alone in the first line; the rest is in `type`."""
    listened = BooleanProperty(False)
    """Messages come from it now."""
    chosen = BooleanProperty(False)
    """It is the one that is open."""
    choose = ObjectProperty(None, allownone=True)
    """Called with the name when a finger pressed it."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._pressed = ""

    @property
    def edge(self) -> float:
        """Width of its border [px]."""
        return float(Metrics.density * (1.5 if self.chosen else 1.0))

    def on_press(self) -> None:
        """Keep the topic that the finger is laid on: while it lies there, a topic more may give this row another."""
        self._pressed = self.name

    def on_release(self) -> None:
        """Open the topic that the finger was laid on."""
        if self.choose is not None:
            self.choose(self._pressed)


class TopicDetail(Card):
    """One topic, live."""

    __events__ = ("on_close", "on_add")

    name = StringProperty("")
    type = StringProperty("")
    nodes = StringProperty("")
    """Who publishes it and who subscribes to it; empty while that is not known."""
    notice = StringProperty("")
    wrong = BooleanProperty(False)
    """The notice is about something that failed."""
    pace = StringProperty("")
    pace_icon = StringProperty("sensors")
    pace_role = StringProperty("muted")
    alone = BooleanProperty(False)
    """The list is not beside it."""

    def on_close(self) -> None:
        """The finger wants back to the list."""

    def on_add(self) -> None:
        """It shall be put on a panel."""
