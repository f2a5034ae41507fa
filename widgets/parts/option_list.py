"""Settings of the robot itself: a switch each, with what it does.

options = OptionList()
robot.on("/control/status", options.show)
options.bind(on_command=lambda _, name, value: print(f"{name} is to be {value}"))
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from kivy.lang import Builder
from kivy.properties import DictProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.core.language import mark, tr
from widgets.parts.choices import Toggle
from widgets.parts.listing import Listing
from widgets.parts.rows import ListRow

__all__ = ["OPTIONS", "OptionList"]


@dataclass(frozen=True, slots=True)
class Option:
    """One setting in the operator's words."""

    icon: str
    title: str
    on: str
    """What the robot does while it is on."""
    off: str


OPTIONS = {
    "follow_link": Option(
        "speed",
        mark("Speed follows the link"),
        mark("Slows down from 200 ms round trip, crawls at 400 ms."),
        mark("Full speed on any link."),
    ),
    "lost_link_stops_task": Option(
        "link_off",
        mark("A lost link pauses the task"),
        mark("The task pauses when the handheld in control is lost."),
        mark("The task continues when the handheld in control is lost."),
    ),
}
"""Name of each setting at the robot to its words."""
ASKED = mark("Sent to the robot …")

Builder.load_string("""
<OptionList>:
    spacing: dp(8)
""")


class OptionList(Listing):
    """Dispatches `on_command(name, value)`, of which the value is `on` or `off`. A switch stands as the robot says."""

    accepts = (ControlStatus,)

    values = DictProperty()
    """Name of each setting to whether it is on; without those of which nothing is known."""
    asked = DictProperty()
    """Name of each setting that the robot was asked to change to the value."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._rows: dict[str, tuple[ListRow, Toggle]] = {}
        for name, option in OPTIONS.items():
            row, toggle = ListRow(icon=option.icon, title=tr(option.title), whole=True), Toggle()
            toggle.pos_hint = {"center_y": 0.5}
            row.add_widget(toggle)
            row.bind(on_release=lambda _, name=name: self.ask(name))
            toggle.bind(on_change=lambda *_, name=name: self.ask(name))
            self.ids.column.add_widget(row)
            self._rows[name] = row, toggle
        for name in ("values", "asked", "disabled"):
            self.fbind(name, self._update)
        self._update()

    def show(self, msg: ControlStatus) -> None:
        """Take over how they stand."""
        self.values = {"follow_link": msg.follows_link, "lost_link_stops_task": msg.lost_link_stops_task}

    def ask(self, name: str) -> None:
        """Switch one as a finger would; one of which nothing is known, or that was just asked for, stays."""
        if name in self.values and name not in self.asked and not self.disabled:
            value = "off" if self.values[name] else "on"
            self.asked = {**self.asked, name: value}
            self.dispatch("on_command", name, value)
        self._update()

    def answered(self, name: str) -> None:
        """The robot has answered, or will not: it stands as it says."""
        self.asked = {one: value for one, value in self.asked.items() if one != name}
        self._update()

    def forget(self) -> None:
        """The link is another one now: nothing is under way."""
        self.asked = {}

    def _update(self, *_: object) -> None:
        for name, (row, toggle) in self._rows.items():
            option, known = OPTIONS[name], name in self.values
            toggle.active = bool(self.values.get(name))
            toggle.disabled = row.disabled = not known or self.disabled or name in self.asked
            words = (
                tr(option.on if self.values[name] else option.off)
                if known
                else tr("Not reported by the robot.")
            )
            row.detail = tr(ASKED) if name in self.asked else words
            row.role = "accent" if toggle.active else "muted"


def samples() -> dict[str, Callable[[], Widget]]:
    """Both ways, one asked for, not known, not to be touched."""

    def make(status: ControlStatus | None = None, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            widget = OptionList(size_hint=(None, None), size=("388dp", "190dp"), **kwargs)
            if status is not None:
                widget.show(status)
            return widget

        return build

    return {
        "as usual": make(ControlStatus()),
        "the other way": make(ControlStatus(follows_link=False, lost_link_stops_task=True)),
        "asked": make(ControlStatus(), asked={"follow_link": "off"}),
        "not known": make(),
        "disabled": make(ControlStatus(), state="disabled"),
    }
