"""One protocol: how it is, the form by which it is brought up, and how it is used while it is."""

from __future__ import annotations

from urllib.parse import urlsplit

from kivy.metrics import dp, sp
from kivy.properties import BooleanProperty
from kivy.uix.widget import Widget

from app.screens.parts.guide_text import GuideText
from app.screens.setup.setup_row import broken
from app.screens.setup.url_form import UrlForm
from app.session.robot_setup import GATEWAYS, RobotSetup
from bridge.discovery.hello import is_loopback
from bridge.msgs.pilothouse_msgs import Gateway
from widgets.core.language import tr
from widgets.parts.kit import Column, PrimaryButton, QuietButton, Remark, Roll, Text
from widgets.parts.qr_code import QrCode

__all__ = ["GatewayPane"]

QR_SIDE, MIN_QR_SIDE = 190, 120
"""Of the code where there is room, and where a phone is on its side [dp]."""


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
        self.up = PrimaryButton(text=tr("Bring up"), icon="play_arrow", size_hint_y=None, height="52dp")
        self.down = QuietButton(text=tr("Bring down"), icon="stop", size_hint_y=None, height="52dp")
        self.more = QuietButton(text=tr("How it is used"), icon="terminal", size_hint_y=None, height="52dp")
        self.own = Remark(text=tr("Only the robot's own machine reaches it."), role="muted")
        self.qr = QrCode(size_hint=(1, None), height=f"{QR_SIDE}dp")
        self.guide = GuideText()
        self.up.bind(on_release=lambda _: self.bring_up())
        self.down.bind(on_release=lambda _: self._setup.bring_down(self.name))
        self.more.bind(on_release=lambda _: setattr(self, "reads", not self.reads))
        self.bind(reads=lambda *_: self.show(self._gateway))
        self.column = Column(spacing="10dp", padding=(0, "2dp", "8dp", "12dp"))
        self.add_widget(self.column)
        self.show(gateway)

    def show(self, gateway: Gateway) -> None:
        """Bring everything up to date with what the robot said last."""
        self._gateway = gateway
        self.doc.text = tr(gateway.doc)
        said, self.state.role = self._setup.gateway_state(gateway)
        age = self._setup.age
        down = tr("Down {age:.0f} s ago").format(age=age) if age > 0.0 else tr("Down", context="gateway")
        self.state.text = broken(down if said == self.doc.text else said, self.column.width - dp(8), sp(17))
        self.refusal.text = self._setup.refusal(GATEWAYS, self.name)
        runs = gateway.state in ("up", "lost")
        options = [_words(option) for option in gateway.options]
        self.options.text = " · ".join([*options, *([gateway.endpoint] if gateway.state == "lost" else [])])
        may = self._setup.may(GATEWAYS, self.name)
        self.up.disabled = not (may and gateway.state == "down" and not gateway.package)
        self.down.disabled = not (may and runs)
        self.more.text = tr("Close the guide") if self.reads else tr("How it is used")
        self.qr.rows = gateway.qr_rows if runs and not _stays_here(gateway.endpoint) else []
        above = self.doc.height + self.state.height + dp(24)
        self.qr.height = min(dp(QR_SIDE), max(dp(MIN_QR_SIDE), self.height - above))
        self.guide.show(gateway.guide if self.reads else "")
        wanted: list[Widget] = [self.doc, self.state, *self._parts(gateway, runs=runs)]
        if list(reversed(self.column.children)) != wanted:
            self.column.clear_widgets()
            for widget in wanted:
                self.column.add_widget(widget)
            self.scroll_y = 1  # else what is shorter hangs where the end of the other was

    def _parts(self, gateway: Gateway, *, runs: bool) -> list[Widget]:
        parts: list[Widget] = []
        if self.refusal.text:
            parts.append(self.refusal)
        if self.form is not None and not runs:
            return [*parts, self.form, self.up]
        if _stays_here(gateway.endpoint):
            parts.append(self.own)
        elif gateway.qr_rows:
            parts.append(self.qr)
        if self.options.text:
            parts.append(self.options)
        if not gateway.fixed:
            parts.append(self.down)
        if gateway.guide:
            parts.append(self.more)
        return [*parts, self.guide] if self.reads else parts

    def bring_up(self) -> None:
        """Ask for it as the form says; what is wrong with it is said there."""
        url = self.form.url() if self.form is not None else ""
        if url:
            self._setup.bring_up(self.name, url)


def _words(option: str) -> str:
    """An option of its URL as people read it."""
    name, _, value = option.partition("=")
    return tr("{value} Hz per topic").format(value=value) if name == "rate" else option


def _stays_here(endpoint: str) -> bool:
    """It is an address of the robot's own machine, which means another one to whoever reads it from a code."""
    try:
        return is_loopback(urlsplit(endpoint).hostname or "")
    except ValueError:
        return False
