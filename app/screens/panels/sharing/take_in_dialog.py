"""Question about a layout that came from outside: what is in it, and whether the robot on the glass shall have it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, StringProperty

from app.layout.layout import Layout, LayoutFault
from app.screens.panels.sharing.fault_dialog import FaultRows
from app.screens.panels.sharing.summary import summary
from app.screens.parts.dialogs import Question
from widgets.core.language import tr, trn

__all__ = ["TakeInDialog"]

Builder.load_string("""
#:import tr widgets.core.language.tr
<TakeInDialog>:
    RoomCard:
        id: card
        room: root.room
        wide: dp(520)
        high: dp(480)
        Text:
            text: tr('A layout from outside')
            bold: True
            font_size: theme.size_title
        ScrollView:
            do_scroll_x: False
            bar_width: dp(3)
            bar_color: theme.muted
            Column:
                spacing: dp(10)
                padding: 0, 0, dp(8), 0
                Text:
                    text: root.told
                    role: 'danger' if root.wrong else 'text'
                    font_size: sp(15)
                Text:
                    text: root.what
                    role: 'muted'
                    font_size: sp(14)
                    height: self.texture_size[1] if self.text else 0
                Column:
                    id: faults
        BoxLayout:
            size_hint_y: None
            height: theme.target
            spacing: dp(12)
            QuietButton:
                id: cancel
                text: tr('Close') if not root.usable else tr('Do not use it')
                on_release: root.close()
            PrimaryButton:
                id: use
                text: tr('Use it for this robot')
                disabled: not root.usable
                on_release: root.dispatch('on_use')
""")


class TakeInDialog(Question):
    """Dispatches `on_use` once the robot on the glass shall have it."""

    __events__ = ("on_use",)

    told = StringProperty("")
    """What is in it, or that it is not used."""
    what = StringProperty("")
    """What using it means."""
    wrong = BooleanProperty(False)
    usable = BooleanProperty(False)
    wanted = (540.0, 420.0)

    def __init__(
        self, layout: Layout | None, robot: str, faults: Sequence[LayoutFault] = (), **kwargs: Any
    ) -> None:
        """`robot` is the name of the one on the glass, empty without one; `faults` are what is wrong with a layout that is None."""
        super().__init__(**kwargs)
        if layout is None:
            told = trn(
                "It has a fault and is not used:", "It has {count} faults and is not used:", len(faults)
            )
            self.told, self.wrong = told.format(count=len(faults)), True
            self.ids.faults.add_widget(FaultRows(faults))
            return
        self.told, self.usable = summary(layout), bool(robot)
        self.what = (
            tr("{robot} is shown by it from now on; the layout of before is kept.").format(robot=robot)
            if robot
            else tr("It is for a robot: connect to that one, and you are asked again.")
        )

    def fail(self, problem: str) -> None:
        """It could not be kept."""
        self.what = problem

    def on_use(self) -> None:
        """A finger wants it."""
