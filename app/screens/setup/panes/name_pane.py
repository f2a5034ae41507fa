"""What this handheld is called where others are told who drives."""

from __future__ import annotations

from collections.abc import Iterable

from kivy.uix.widget import Widget

from app.core.client_identity import MAX_NAME, bad_name
from app.screens.setup.panes.settings_pane import SettingsPane
from widgets.core.language import tr
from widgets.parts.kit import PrimaryButton, Remark, TextField

__all__ = ["NamePane"]


class NamePane(SettingsPane):
    """A field, and what is wrong with what is typed."""

    def fill(self) -> Iterable[Widget]:
        """The field with the name, and a button to keep it."""
        self.field = TextField(text=self.app.client_name, label=tr("Name"), hint_text=tr("Name"))
        self.field.bind(text=lambda *_: self._judge(), on_text_validate=lambda _: self.keep())
        self.problem = Remark(role="danger", font_size="15sp")
        self.save = PrimaryButton(text=tr("Save the name"), icon="check", size_hint_y=None, height="52dp")
        self.save.bind(on_release=lambda _: self.keep())
        self.told = self.remark("")
        yield self.remark(tr("Robots and other operators see this name when you ask for control."))
        yield self.field
        yield self.problem
        yield self.save
        yield self.told
        self._judge()

    def _judge(self) -> None:
        name = self.field.text.strip()
        self.problem.text = bad_name(name)
        self.field.wrong = bool(self.problem.text)
        self.save.disabled = self.field.wrong or name == self.app.client_name

    def keep(self) -> None:
        """Take the name that is typed; nothing for one that is wrong."""
        if self.save.disabled:
            return
        self.app.rename(self.field.text.strip()[:MAX_NAME])
        self.told.text = tr("Saved. A robot that is connected now learns it at the next connection.")
        self._judge()
