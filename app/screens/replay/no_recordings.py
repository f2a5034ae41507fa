"""What stands in the place of the list while there are no recordings: a picture, a sentence, and two ways to get one."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, StringProperty
from kivy.uix.anchorlayout import AnchorLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.device.file_picking import file_picking

__all__ = ["NoRecordings"]

Builder.load_string("""
<NoRecordings>:
    size_hint_y: None
    height: max(box.height, root.room)
    BoxLayout:
        id: box
        orientation: 'vertical'
        size_hint: None, None
        width: min(root.width, dp(420))
        height: self.minimum_height
        spacing: dp(14)
        padding: dp(12)
        Icon:
            name: 'history'
            role: 'muted'
            font_size: sp(72)
            size_hint: 1, None
            height: self.font_size * 1.1
        Text:
            id: words
            text: tr('No recordings yet.') if root.robot else tr('No recordings yet. Connect to a robot to make one.')
            halign: 'center'
            font_size: sp(18)
        Remark:
            id: problem
            text: root.problem
            role: 'danger'
            halign: 'center'
        PrimaryButton:
            id: record
            text: tr('Stop recording') if root.recording else tr('Record')
            icon: 'fiber_manual_record'
            size_hint_y: None
            height: max(dp(52), theme.target) if root.robot else 0
            opacity: 1 if root.robot else 0
            disabled: not root.robot
            on_release: root.record()
        QuietButton:
            id: open
            text: tr('Open a file')
            icon: 'folder_open'
            size_hint_y: None
            height: max(dp(52), theme.target)
            on_release: root.pick()
""")


class Host(Protocol):
    """The app, as far as this needs it."""

    session: Any
    """None while no robot is connected."""
    records: Any
    """What is recorded."""
    visit: Any
    """Begins and ends a recording."""


class NoRecordings(AnchorLayout):
    """Dispatches `on_open(path)` when a file was chosen."""

    __events__ = ("on_open",)

    room = NumericProperty(0)
    """Height that it is in the middle of [px]."""
    robot = BooleanProperty(False)
    """There is a robot, of which something can be recorded."""
    recording = BooleanProperty(False)
    """A recording runs."""
    problem = StringProperty("")
    """Why a file was not opened, in one sentence."""

    def __init__(self, **kwargs: Any) -> None:
        self._app: Host | None = None
        self._picking = file_picking()
        super().__init__(**kwargs)

    def update(self, app: Host) -> None:
        """Say what can be done now."""
        self._app, self.robot = app, app.session is not None
        self.recording = self.robot and app.records.recorder is not None

    def record(self) -> None:
        """Begin a recording, or end it."""
        if self._app is not None and self.robot:
            self._app.visit.toggle_recording()
            self.update(self._app)

    def pick(self) -> None:
        """Have the operator choose a file."""
        if self._app is not None and self._picking is not None:
            self._picking.pick(self._app.records.folders[0], self._picked)

    def _picked(self, paths: list[Path], problem: str) -> None:
        self.problem = problem
        if paths:
            self.dispatch("on_open", paths[0])

    def on_open(self, path: Path) -> None:
        """The operator chose that file."""
