"""The robot's own settings, switched from here and kept by the robot."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.uix.boxlayout import BoxLayout

from app.link.commands import Outcome
from app.screens.parts.pane_head import PaneHead
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets import OptionList
from widgets.core.language import tr
from widgets.parts.kit import QuietButton

__all__ = ["SettingsPane"]

Builder.load_string("""
<SettingsPane>:
    orientation: 'vertical'
    spacing: dp(8)
""")


class SettingsPane(BoxLayout):
    """Dispatches `on_close`, `on_setup` for its protocols and payloads, and `on_reset` when the robot shall be put back."""

    __events__ = ("on_close", "on_reset", "on_setup")

    def __init__(self, session: Session, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session = session
        self.head, self.options = PaneHead(title=tr("The robot's settings")), OptionList()
        self.add_widget(self.head)
        self.add_widget(self.options)
        self.setup = QuietButton(text=tr("Protocols and payloads"), icon="tune")
        self.setup.bind(on_release=lambda _: self.dispatch("on_setup"))
        self.back = QuietButton(text=tr("Put it back to where it started"), icon="replay")
        self.back.bind(on_release=lambda _: self.dispatch("on_reset"))
        self.head.bind(on_close=lambda _: self.dispatch("on_close"))
        self.options.bind(
            on_command=lambda _, name, value: session.command("setting", name=name, value=value)
        )

    def on_outcome(self, outcome: Outcome) -> None:
        """Take in what became of a command."""
        if outcome.name == "setting" and outcome.phase != "sent":
            self.options.answered(outcome.fields["name"])

    def tick(self, may: bool) -> None:
        """Bring up to date what can be switched; `may` when the robot can be asked for something from here."""
        session = self._session
        if not session.connected:
            self.options.forget()
        self.options.state = "live" if may and session.robot.offers("/settings/set") else "disabled"
        self.head.sentence = self._sentence()
        known = session.robot.capabilities is not None
        switches = known and session.robot.offers("/gateways/bring_up")
        if switches != (self.setup.parent is self):
            (self.add_widget if switches else self.remove_widget)(self.setup)
        possible = known and session.robot.offers("/robot/reset")
        if possible != (self.back.parent is self):
            (self.add_widget if possible else self.remove_widget)(self.back)
        self.back.disabled = not may

    def _sentence(self) -> str:
        session = self._session
        status: ControlStatus | None = session.feeds.latest("/control/status")
        if not session.connected:
            return tr("There is no link; they can be switched when it is back.")
        if not session.robot.offers("/settings/set"):
            return tr("This robot has no settings to switch.")
        if session.control == "other" and status is not None:
            return tr("{driver} has control and can switch them.").format(
                driver=status.driver or tr("Another person")
            )
        return tr("Kept by the robot, for everybody who uses it.")

    def on_close(self) -> None:
        """A finger asked to go back to the lists."""

    def on_setup(self) -> None:
        """A finger asked for the setup screen."""

    def on_reset(self) -> None:
        """A finger asked to put the robot back; nobody has confirmed that yet."""
