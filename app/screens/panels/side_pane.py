"""Pane beside the board while it is edited: what can be added from this robot, or the panel that is selected."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.scrollview import ScrollView

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.layout.panel_grid import COLUMNS, MAX_ROWS, Place
from app.layout.view_checks import is_signal
from app.layout.views import Panel
from app.screens.panels.offers import CONTROLS, Offer, offer_name, offers_for, widget_name
from widgets.core.language import tr, within
from widgets.core.surfaces import Pressable
from widgets.parts.column import Column
from widgets.parts.kit import QuietButton, Remark, SectionLabel, Text
from widgets.parts.stepper import Stepper
from widgets.parts.text_field import TextField

__all__ = ["AddList", "Inspector", "OfferRow", "SidePane"]

ICONS = {
    "sensor_msgs/Imu": "explore",
    "sensor_msgs/LaserScan": "radar",
    "sensor_msgs/PointCloud2": "radar",
    "sensor_msgs/Range": "sensors",
    "sensor_msgs/CompressedImage": "videocam",
    "sensor_msgs/Image": "videocam",
    "sensor_msgs/BatteryState": "battery_full",
    "sensor_msgs/NavSatFix": "satellite_alt",
    "nav_msgs/Odometry": "route",
    "nav_msgs/Path": "polyline",
    "nav_msgs/OccupancyGrid": "map",
}
"""Icon of a type; any other is a pair of braces."""

Builder.load_string("""
#:import tr widgets.core.language.tr
<OfferRow>:
    size_hint_y: None
    height: max(words.height + dp(16), theme.target)
    padding: dp(12), 0, dp(10), 0
    spacing: dp(12)
    rim: ''
    ground: 'raised'
    Icon:
        name: root.icon
        role: 'accent'
        font_size: sp(25)
        pos_hint: {'center_y': .5}
    BoxLayout:
        id: words
        orientation: 'vertical'
        size_hint_y: None
        height: self.minimum_height
        spacing: dp(2)
        pos_hint: {'center_y': .5}
        Text:
            text: root.topic
            bold: True
            font_size: sp(16)
            text_size: self.width, None
            max_lines: 2
            size_hint_y: None
            height: self.texture_size[1]
        Text:
            text: root.kind
            role: 'muted'
            font_size: sp(13)
            text_size: self.width, None
            max_lines: 2
            size_hint_y: None
            height: self.texture_size[1]
        Text:
            text: root.fits
            role: 'muted'
            font_size: sp(13)
            text_size: self.width, None
            max_lines: 2
            size_hint_y: None
            height: self.texture_size[1] if root.fits else 0
            opacity: 1 if root.fits else 0
    Icon:
        name: 'add_circle'
        role: 'ok'
        font_size: sp(25)
        pos_hint: {'center_y': .5}

<SidePane>:
    orientation: 'vertical'
    size_hint: None, None
    padding: dp(2), 0
    spacing: dp(8)
    canvas.before:
        Rounded:
            rgba: theme.surface if root.sheet else (0, 0, 0, 0)
            pos: self.x - dp(12), self.y - dp(8)
            size: self.width + dp(24), self.height + dp(16)
            radius: [theme.radius, theme.radius, 0, 0]
        Rounded:
            rgba: theme.line if root.sheet else (0, 0, 0, 0)
            pos: self.x - dp(12), self.top + dp(8) - theme.outline
            size: self.width + dp(24), theme.outline
    BoxLayout:
        size_hint_y: None
        height: dp(34)
        SectionLabel:
            title: root.heading
            size_hint_y: 1
            valign: 'middle'
            text_size: self.size
        IconButton:
            id: close
            icon: 'close'
            role: 'muted'
            bare: True
            size_hint: None, 1
            width: theme.target if root.closable else 0
            opacity: 1 if root.closable else 0
            disabled: not root.closable
            on_release: root.dispatch('on_close')
    ScrollView:
        id: scroll
        do_scroll_x: False
        bar_width: dp(3)
        bar_color: theme.muted
        bar_inactive_color: theme.line
        scroll_type: ['bars', 'content']
""")


class OfferRow(Pressable, BoxLayout):
    """One topic of the robot, and what it can be shown as."""

    topic = StringProperty("")
    kind = StringProperty("")
    icon = StringProperty("data_object")
    fits = StringProperty("")
    """Names of the widgets that fit it."""


class SidePane(BoxLayout):
    """A heading over what scrolls; dispatches `on_close`."""

    __events__ = ("on_close",)

    heading = StringProperty("")
    closable = BooleanProperty(False)
    sheet = BooleanProperty(False)
    """It lies over the board of a phone."""

    def show(self, heading: str, content: Any, *, closable: bool) -> None:
        """Put that into it in the place of what was there."""
        scroll: ScrollView = self.ids.scroll
        scroll.clear_widgets()
        scroll.add_widget(content)
        scroll.scroll_y = 1
        self.heading, self.closable = heading, closable

    def on_close(self) -> None:
        """A finger is done with it."""


class AddList(Column):
    """Every topic of the robot with the widgets for it, and the controls; calls `add` with what was chosen."""

    def __init__(
        self,
        topics: Sequence[tuple[str, str]],
        add: Callable[[str, Offer], object],
        add_control: Callable[[str], object],
        sends: Callable[[str], bool] = lambda _: False,
        controls: Sequence[tuple[str, str]] = CONTROLS,
    ) -> None:
        """`topics` are names and types. A topic with one widget is added at once, one with several asks which; a bool that the app `sends` has switches among them."""
        super().__init__(spacing="10dp", padding=(0, 0, dp(6), dp(8)))
        self._add, self._open = add, ""
        self._rows: dict[str, OfferRow] = {}
        for name, kind in topics:
            offers = offers_for(name, kind, sends=sends(name))
            words = ", ".join(dict.fromkeys(within(widget_name(one.widget)) for one in offers[:3]))
            row = OfferRow(topic=name, kind=kind, icon=ICONS.get(kind, "data_object"), fits=words)
            row.bind(on_release=lambda _, name=name, offers=offers: self._press(name, offers))
            self._rows[name] = row
            self.add_widget(row)
        if not topics:
            self.add_widget(Remark(text=tr("This robot has not said which topics it has.")))
        self.add_widget(SectionLabel(title=tr("Controls")))
        for widget, title in controls:
            row = OfferRow(topic=tr(title), kind=tr("drives the robot"), icon="joystick")
            row.bind(on_release=lambda _, widget=widget: add_control(widget))
            self.add_widget(row)

    def _press(self, name: str, offers: Sequence[Offer]) -> None:
        for child in [one for one in self.children if isinstance(one, Choices)]:
            self.remove_widget(child)
        if len(offers) == 1 or self._open == name:
            self._open = ""
            if len(offers) == 1:
                self._add(name, offers[0])
            return
        self._open = name
        choices = Choices(spacing="6dp", padding=(dp(18), 0, 0, 0))
        for offer in offers:
            button = QuietButton(text=offer_name(offer), icon="add")
            button.bind(on_release=lambda _, offer=offer: self._add(name, offer))
            choices.add_widget(button)
        self.add_widget(choices, index=self.children.index(self._rows[name]))


class Choices(Column):
    """The widgets of one topic."""


class Inspector(Column):
    """What can be said of the selected panel. Calls `change(**keys)` for its keys, `place(place)`, and `act(what)`."""

    def __init__(
        self,
        panel: Panel,
        place: Place,
        form: str,
        others: Sequence[tuple[int, str]],
        *,
        change: Callable[..., object],
        put: Callable[[Place], object],
        act: Callable[..., object],
    ) -> None:
        """`others` are the panels that it may be stacked with, by index and name."""
        super().__init__(spacing="10dp", padding=(0, 0, dp(6), dp(8)))
        self._change, self._put, self._act = change, put, act
        self._place, self._form = place, form
        self._field(tr("Name"), panel.title, lambda text: change(title=text))
        if panel.topic:
            self._field(tr("Topic"), panel.topic, lambda text: change(topic=text))
        if is_signal(panel.widget):
            state = panel.also[0] if panel.also else ""
            self._field(tr("State from topic"), state, lambda text: change(also=(text,) if text else ()))
        if panel.widget in ("Readout", "Plot"):
            self._field(tr("Field"), panel.field, lambda text: change(field=text))
            self._field(tr("Unit"), panel.unit, lambda text: change(unit=text))
        self._places()
        self._buttons(panel)
        if others:
            for index, name in others:
                self._button(
                    tr("Stack with {name}").format(name=name), "layers", partial(act, "stack", index)
                )

    def _field(self, label: str, text: str, take: Callable[[str], object]) -> None:
        field = TextField(text=text, label=tr(label), hint_text=tr(label))
        field.bind(on_text_validate=lambda one: take(one.text))
        field.bind(focus=lambda one, focus: None if focus or one.text == text else take(one.text))
        self.add_widget(field)

    def _places(self) -> None:
        columns = COLUMNS[self._form]
        rows = (
            ("left", tr("Column"), 0, columns - self._place.width),
            ("top", tr("Row"), 0, MAX_ROWS - 1),
            ("width", tr("Columns wide"), 1, columns - self._place.left),
            ("height", tr("Rows high"), 1, MAX_ROWS),
        )
        for key, words, least, most in rows:
            row = BoxLayout(size_hint_y=None, height="44dp")
            label = Text(text=words, font_size="15sp")
            label.size_hint_y, label.valign = 1, "middle"
            label.bind(size=label.setter("text_size"))
            stepper = Stepper(
                value=getattr(self._place, key), minimum=least, maximum=most, pos_hint={"center_y": 0.5}
            )
            stepper.bind(value=lambda _, value, key=key: self._put(self._place._replace(**{key: int(value)})))
            row.add_widget(label)
            row.add_widget(stepper)
            self.add_widget(row)

    def _buttons(self, panel: Panel) -> None:
        self._button(tr("Show") if panel.hidden else tr("Hide"), "visibility_off", lambda: self._act("hide"))
        if panel.stack:
            self._button(tr("Out of the stack"), "layers", lambda: self._act("unstack"))
        self._button(tr("Remove"), "delete", lambda: self._act("remove"))

    def _button(self, text: str, icon: str, act: Callable[[], object]) -> None:
        button = QuietButton(text=text, icon=icon)
        button.bind(on_release=lambda _: act())
        self.add_widget(button)
