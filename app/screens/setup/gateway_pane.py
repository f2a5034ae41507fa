"""One protocol: how it is, the form by which it is brought up, and how it is used while it is."""

from __future__ import annotations

from kivy.properties import BooleanProperty
from kivy.uix.widget import Widget

from app.screens.setup.guide_text import GuideText
from app.screens.setup.url_form import UrlForm
from app.session.robot_setup import GATEWAYS, RobotSetup
from bridge.msgs.pilothouse_msgs import Gateway
from widgets.parts.kit import Column, PrimaryButton, QuietButton, Remark, Roll, Text
from widgets.parts.qr_code import QrCode

__all__ = ["GatewayPane"]

QR_SIDE = 190
"""[dp]"""


class GatewayPane(Roll):
    """Shows what the robot says of a protocol, and asks it for what a finger wants."""

    reads = BooleanProperty(False)
    """The guide is open."""

    def __init__(self, setup: RobotSetup, gateway: Gateway) -> None:
        super().__init__()
        self._setup, self.name, self._gateway = setup, gateway.name, gateway
        self.doc, self.state = Remark(role="muted"), Text(font_size="17sp")
        self.refusal, self.options = Remark(role="danger"), Remark(role="muted")
        self.form = None if gateway.fixed else UrlForm(gateway)
        self.up = PrimaryButton(text="Bring up", icon="play_arrow", size_hint_y=None, height="52dp")
        self.down = QuietButton(text="Bring down", icon="stop", size_hint_y=None, height="52dp")
        self.more = QuietButton(text="How it is used", icon="terminal", size_hint_y=None, height="52dp")
        self.qr = QrCode(size_hint=(1, None), height=f"{QR_SIDE}dp")
        self.guide = GuideText()
        self.up.bind(on_release=lambda _: self.bring_up())
        self.down.bind(on_release=lambda _: self._setup.bring_down(self.name))
        self.more.bind(on_release=lambda _: setattr(self, "reads", not self.reads))
        self.bind(reads=lambda *_: self.show(self._gateway))
        self.column = Column(spacing="10dp", padding=("4dp", "2dp", "8dp", "12dp"))
        self.add_widget(self.column)
        self.show(gateway)

    def show(self, gateway: Gateway) -> None:
        """Bring everything up to date with what the robot said last."""
        self._gateway = gateway
        self.doc.text = gateway.doc
        said, self.state.role = self._setup.gateway_state(gateway)
        self.state.text = "Down" if said == gateway.doc else said
        self.refusal.text = self._setup.refusal(GATEWAYS, self.name)
        runs = gateway.state in ("up", "lost")
        self.options.text = " · ".join(
            [*gateway.options, *([gateway.endpoint] if gateway.state == "lost" else [])]
        )
        may = self._setup.may(GATEWAYS, self.name)
        self.up.disabled = not (may and gateway.state == "down" and not gateway.package)
        self.down.disabled = not (may and runs)
        self.more.text = "Close the guide" if self.reads else "How it is used"
        self.qr.rows = gateway.qr_rows if runs else []
        self.guide.show(gateway.guide if self.reads else "")
        wanted: list[Widget] = [self.doc, self.state, *self._parts(gateway, runs=runs)]
        if list(reversed(self.column.children)) != wanted:
            self.column.clear_widgets()
            for widget in wanted:
                self.column.add_widget(widget)

    def _parts(self, gateway: Gateway, *, runs: bool) -> list[Widget]:
        parts: list[Widget] = []
        if self.refusal.text:
            parts.append(self.refusal)
        if self.form is not None and not runs:
            return [*parts, self.form, self.up]
        if gateway.options:
            parts.append(self.options)
        if gateway.qr_rows:
            parts.append(self.qr)
        if gateway.guide:
            parts.append(self.more)
        if self.reads:
            parts.append(self.guide)
        return parts if gateway.fixed else [*parts, self.down]

    def bring_up(self) -> None:
        """Ask for it as the form says; what is wrong with it is said there."""
        url = self.form.url() if self.form is not None else ""
        if url:
            self._setup.bring_up(self.name, url)
