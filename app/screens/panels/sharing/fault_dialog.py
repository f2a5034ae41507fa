"""All that is wrong with a layout file, each with its line, over the screen that shows the built-in layout instead."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout

from app.layout.layout_faults import LayoutFault
from app.screens.parts.dialogs import Question
from widgets.core.language import tr, trn
from widgets.parts.column import Column

__all__ = ["FaultDialog", "FaultRows"]

Builder.load_string("""
#:import tr widgets.core.language.tr
<FaultRow>:
    size_hint_y: None
    height: max(said.height, dp(30))
    spacing: dp(12)
    Text:
        text: root.place
        role: 'warn'
        bold: True
        font_size: sp(14)
        size_hint: None, None
        width: dp(72)
        pos_hint: {'top': 1}
    Text:
        id: said
        text: root.sentence
        font_size: sp(15)
        pos_hint: {'top': 1}

<FaultDialog>:
    Card:
        id: card
        size_hint: None, None
        width: min(dp(680), root.room[2] - dp(28))
        height: min(root.room[3] - dp(28), dp(600))
        x: root.room[0] + (root.room[2] - self.width) / 2
        y: root.room[1] + (root.room[3] - self.height) / 2
        padding: dp(20)
        spacing: dp(12)
        BoxLayout:
            size_hint_y: None
            height: title.height
            spacing: dp(10)
            Icon:
                name: 'warning'
                role: 'warn'
                pos_hint: {'center_y': .5}
            Text:
                id: title
                text: root.title
                bold: True
                font_size: theme.size_title
        Text:
            text: root.detail
            role: 'muted'
            font_size: sp(14)
        ScrollView:
            id: scroll
            do_scroll_x: False
            bar_width: dp(3)
            bar_color: theme.muted
        PrimaryButton:
            id: close
            text: tr('Close')
            on_release: root.close()
""")


class FaultRow(BoxLayout):
    """One fault."""

    place = StringProperty("")
    sentence = StringProperty("")


class FaultRows(Column):
    """Every fault with its line."""

    def __init__(self, faults: Sequence[LayoutFault], **kwargs: Any) -> None:
        super().__init__(**{"spacing": "10dp", **kwargs})
        for fault in faults:
            place = tr("Line {line}").format(line=fault.line) if fault.line else tr("File")
            self.add_widget(FaultRow(place=place, sentence=fault.sentence))


class FaultDialog(Question):
    """Says what is wrong; the file stays as it is."""

    title = StringProperty("")
    detail = StringProperty("")
    wanted = (700.0, 480.0)

    def __init__(self, path: str, faults: Sequence[LayoutFault], **kwargs: Any) -> None:
        """`path` is where the file lies."""
        super().__init__(**kwargs)
        count = len(faults)
        self.title = trn("This profile has a fault", "This profile has {count} faults", count).format(
            count=count
        )
        self.detail = tr("The built-in layout is shown instead. The file stays as it is: {path}").format(
            path=path
        )
        self.ids.scroll.add_widget(FaultRows(faults))
