"""The graph of the robot on the glass: what is looked at, and the buttons for what is shown of it."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.screens.topics.ros_graph import GraphWatch
from widgets.core.language import tr, trn
from widgets.graph.graph_model import GROUP, TOPIC, Shown, shown
from widgets.graph.graph_view import BUTTON_STEP, GraphView

__all__ = ["GraphPane"]

Builder.load_string("""
#:import tr widgets.core.language.tr
<GraphPane>:
    roomy: self.width > dp(420)
    orientation: 'vertical'
    size_hint: 1, 1
    pos_hint: {'x': 0, 'y': 0}
    spacing: dp(6)
    FloatLayout:
        id: ground
        Text:
            text: root.sentence
            role: 'muted'
            font_size: sp(15)
            pos_hint: {'x': 0, 'top': 1}
            padding: dp(6), dp(6)
    Text:
        id: about
        text: root.about
        font_size: sp(15)
        height: self.texture_size[1] if root.about else 0
        padding: dp(6), 0
    BoxLayout:
        size_hint_y: None
        height: max(dp(53), theme.least)
        spacing: dp(6)
        IconButton:
            id: hide
            icon: 'visibility' if root.hide else 'visibility_off'
            size: [max(dp(53), theme.least)] * 2
            role: 'accent' if root.hide else 'muted'
            scan_words: tr('Show logs and parameters too') if root.hide else tr('Hide logs and parameters')
            on_release: root.hide = not root.hide
        IconButton:
            id: fold
            icon: 'layers'
            size: [max(dp(53), theme.least)] * 2
            role: 'accent' if root.fold else 'muted'
            scan_words: tr('Unfold alike topics') if root.fold else tr('Fold alike topics')
            on_release: root.turn_fold()
        IconButton:
            id: less
            icon: 'remove'
            role: 'muted'
            size: [max(dp(53), theme.least) if root.roomy else 0, max(dp(53), theme.least)]
            opacity: 1 if root.roomy else 0
            disabled: not root.roomy
            on_release: root.view.zoom(1 / root.step)
        IconButton:
            id: more
            icon: 'add'
            role: 'muted'
            size: [max(dp(53), theme.least) if root.roomy else 0, max(dp(53), theme.least)]
            opacity: 1 if root.roomy else 0
            disabled: not root.roomy
            on_release: root.view.zoom(root.step)
        IconButton:
            id: fit
            icon: 'fit_screen'
            role: 'muted'
            size: [max(dp(53), theme.least)] * 2
            on_release: root.view.fit()
        Widget:
        PrimaryButton:
            id: open
            text: tr('Open')
            size_hint: None, 1
            width: dp(110) if root.openable else 0
            opacity: 1 if root.openable else 0
            disabled: not root.openable
            on_release: root.dispatch('on_open', root.openable)
""")


class GraphPane(BoxLayout):
    """Dispatches `on_open(topic)`."""

    __events__ = ("on_open",)

    step = BUTTON_STEP
    roomy = BooleanProperty(True)
    """There are buttons to zoom; on a phone upright two fingers do that."""
    hide = BooleanProperty(True)
    """Leave out what joins every node with every other."""
    fold = BooleanProperty(True)
    """Show topics that are alike as one box."""
    sentence = StringProperty("")
    about = StringProperty("")
    """What is said of the box that is looked at."""
    openable = StringProperty("")
    """Topic that is looked at; empty for none."""

    def __init__(self, watch: GraphWatch, **kwargs: Any) -> None:
        self.view = GraphView(pos_hint={"x": 0, "y": 0})
        self._watch = watch
        self._unfolded: set[str] = set()
        super().__init__(**kwargs)
        self.ids.ground.add_widget(self.view, index=len(self.ids.ground.children))
        self.view.bind(on_pick=lambda _, name: self.pick(name))
        self.bind(hide=self.show, fold=self.show)

    def show(self, *_: object) -> None:
        """Bring it up to date with what the robot told."""
        graph = self._watch.graph
        self.view.shown = (
            shown(
                graph.nodes,
                graph.publishes,
                graph.subscribes,
                hide=self.hide,
                fold=self.fold,
                unfolded=self._unfolded,
            )
            if graph is not None
            else Shown({}, ())
        )
        self.say()

    def say(self) -> None:
        """Bring the sentences up to date."""
        more = self.view.shown.left_out
        left = trn("{count} more is left out.", "{count} more are left out.", more).format(count=more)
        self.sentence = " ".join(part for part in (self._watch.sentence, left if more else "") if part)
        box = self.view.shown.boxes.get(self.view.selected)
        self.openable = box.name.partition(" ")[2] if box is not None and box.kind == TOPIC else ""
        self.about = self._told(self.view.selected) if box is not None else ""

    def _told(self, name: str) -> str:
        edges, boxes = self.view.shown.edges, self.view.shown.boxes
        into = sum(len(boxes[first].topics) or 1 for first, last in edges if last == name)
        out = sum(len(boxes[last].topics) or 1 for first, last in edges if first == name)
        if self.openable:
            words = tr("{name}: published by {into}, subscribed to by {out}")
        else:
            words = tr("{name}: subscribes to {into}, publishes {out}")
        return words.format(name=name.partition(" ")[2], into=into, out=out)

    def pick(self, name: str) -> None:
        """Look at a box; a group is unfolded. A tap on the same box, or beside all, looks away."""
        box = self.view.shown.boxes.get(name)
        if box is not None and box.kind == GROUP:
            self._unfolded.add(name)
            self.show()
            name = ""
        self.view.selected = "" if name == self.view.selected else name
        self.say()

    def look_at(self, topic: str) -> None:
        """Look at a topic, as the search or the table chose it."""
        self.view.selected = self.view.shown.box_of(topic)
        self.say()

    def turn_fold(self) -> None:
        """Fold alike topics, or show all; what was unfolded by hand is folded again."""
        self._unfolded.clear()
        self.fold = not self.fold

    def on_open(self, topic: str) -> None:
        """The topic shall be shown live."""
