"""One payload: what it is, what it publishes and takes, and whether it is on."""

from __future__ import annotations

from kivy.uix.widget import Widget

from app.session.robot_setup import PAYLOADS, RobotSetup
from bridge.msgs.pilothouse_msgs import Payload
from widgets.core.language import tr
from widgets.parts.kit import Column, QuietButton, Remark, Roll, Text

__all__ = ["PayloadPane"]


class PayloadPane(Roll):
    """Shows what the robot says of a payload, and asks it for what a finger wants."""

    def __init__(self, setup: RobotSetup, payload: Payload) -> None:
        super().__init__()
        self._setup, self.name, self._on = setup, payload.key, payload.on
        self.doc, self.state = Remark(role="muted"), Text(font_size="17sp")
        self.why, self.refusal = Remark(role="muted"), Remark(role="danger")
        self.topics, self.services = Remark(role="text"), Remark(role="text")
        self.switch = QuietButton(size_hint_y=None, height="52dp")
        self.switch.bind(on_release=lambda _: self._setup.switch(self.name, not self._on))
        self.column = Column(spacing="10dp", padding=(0, "2dp", "8dp", "12dp"))
        self.add_widget(self.column)
        self.show(payload)

    def show(self, payload: Payload) -> None:
        """Bring everything up to date with what the robot said last."""
        self._on = payload.on
        self.doc.text, self.why.text = payload.doc, payload.why
        self.state.text, self.state.role = self._setup.on_or_off(payload)
        self.refusal.text = self._setup.refusal(PAYLOADS, self.name)
        self.topics.text = tr("Topics: ") + ", ".join(payload.topics)
        self.services.text = tr("Services: ") + ", ".join(payload.services)
        self.switch.text = tr("Switch off") if payload.on else tr("Switch on")
        self.switch.disabled = not self._setup.may(PAYLOADS, self.name)
        wanted: list[Widget] = [self.doc, self.state]
        wanted += [each for each in (self.why, self.refusal) if each.text]
        wanted += [self.topics] if payload.topics else []
        wanted += [self.services] if payload.services else []
        wanted += [] if payload.fixed else [self.switch]
        if list(reversed(self.column.children)) != wanted:
            self.column.clear_widgets()
            for widget in wanted:
                self.column.add_widget(widget)
            self.scroll_y = 1
