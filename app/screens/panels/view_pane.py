"""What can be done about the view as a whole, below the list of what can be added."""

from __future__ import annotations

from collections.abc import Callable

from widgets.core.language import tr
from widgets.parts.column import Column
from widgets.parts.kit import QuietButton, SectionLabel
from widgets.parts.text_field import TextField

__all__ = ["ViewPane"]


class ViewPane(Column):
    """Calls `act` with `rename` and the name, `arrange`, `remove` or `reset`."""

    def __init__(self, title: str, act: Callable[..., object]) -> None:
        """`title` is the view's name."""
        super().__init__(spacing="10dp", padding=(0, "10dp", 0, 0))
        self.add_widget(SectionLabel(title=tr("This view")))
        field = TextField(text=title, label=tr("Name of the view"), hint_text=tr("Name of the view"))
        field.bind(on_text_validate=lambda one: act("rename", one.text))
        field.bind(focus=lambda one, focus: None if focus or one.text == title else act("rename", one.text))
        self.add_widget(field)
        buttons = (
            ("arrange", tr("Arrange automatically"), "dashboard"),
            ("remove", tr("Remove this view"), "delete"),
            ("reset", tr("Reset to built-in"), "replay"),
        )
        for name, words, icon in buttons:
            button = QuietButton(text=words, icon=icon)
            button.bind(on_release=lambda _, name=name: act(name))
            self.add_widget(button)
