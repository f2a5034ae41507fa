"""Fields of a gateway's URL, with the usual values in them."""

from __future__ import annotations

from typing import Any

from kivy.metrics import dp
from kivy.uix.boxlayout import BoxLayout

from app.screens.setup.gateway_form import OWN, ROLES, SITE, BadForm, GatewayForm
from bridge.msgs.pilothouse_msgs import Gateway
from widgets.core.language import mark, tr
from widgets.core.theme import theme
from widgets.parts.kit import Column, Remark, Segmented, TextField

__all__ = ["UrlForm"]

FIELDS = {
    "host": mark("Address"),
    "port": mark("Port"),
    "path": mark("Prefix or path"),
    "user": mark("User"),
    "password": mark("Password"),
    "rate": mark("Rate, at most [Hz]"),
    "payloads": mark("Payloads, empty for all"),
}
"""Name of each field, as in `GatewayForm`, to its label."""
ROWS = (("host", "port"), ("path", "rate"), ("user", "password"), ("payloads",))
"""Fields beside each other."""
HIDDEN = {SITE: ("host", "port", "user", "password"), OWN: ("user", "password")}
"""Fields that a scheme has no use for."""


class UrlForm(Column):
    """What is typed stays until the app leaves the robot."""

    def __init__(self, gateway: Gateway, **kwargs: Any) -> None:
        super().__init__(spacing="8dp", **kwargs)
        self._ports = dict(each.rsplit(":", 1) for each in gateway.schemes if ":" in each)
        self._listens = gateway.listens
        usual = GatewayForm.of(gateway.usual)
        self.scheme = Segmented(options=list(self._ports), value=usual.scheme)
        self.scheme.bind(on_choose=lambda _, scheme: self._choose(scheme))
        self.role = Segmented(options=[(role, tr(words)) for role, words in ROLES], value=usual.role)
        for choice in (self.scheme, self.role):
            choice.height = max(choice.height, theme.target)
        self.fields = {
            name: TextField(
                text=getattr(usual, name), label=tr(label), hint_text=tr(label), password=name == "password"
            )
            for name, label in FIELDS.items()
        }
        port = self.fields["port"]
        port.size_hint_x, port.width = None, dp(132)  # five digits, and the sign of a wrong one
        for field in self.fields.values():
            field.write_tab = False
        for field in self.fields.values():
            field.bind(text=lambda field, _: setattr(field, "wrong", False))
        self.problem = Remark(role="danger")
        self._lay()

    def url(self) -> str:
        """What is typed, as a URL; empty where it is none, which is said in the form."""
        values = {name: field.text for name, field in self.fields.items()}
        try:
            found = GatewayForm(self.scheme.value, role=self.role.value, **values).url(self._ports)
        except BadForm as bad:
            self.problem.text = str(bad)
            self.fields[bad.field].wrong = True
            return ""
        self.problem.text = ""
        return found

    def _choose(self, scheme: str) -> None:
        """Another scheme has another usual port."""
        if self.fields["port"].text in ("", *self._ports.values()):
            self.fields["port"].text = self._ports.get(scheme, "")
        self._lay()

    def _usual_role(self) -> str:
        """At a broker that is not the robot's own everybody watches; what the robot serves itself goes by its own rule."""
        own = self.scheme.value == SITE or self.scheme.value in self._listens
        return tr("as over rosbridge") if own else "watch"

    def _lay(self) -> None:
        hidden = HIDDEN.get(self.scheme.value, ())
        self.clear_widgets()
        if len(self._ports) > 1:
            self.add_widget(self.scheme)
        for names in ROWS:
            shown = [name for name in names if name not in hidden]
            if not shown:
                continue
            row = BoxLayout(size_hint_y=None, spacing="8dp")
            for name in shown:
                field = self.fields[name]
                if field.parent is not None:
                    field.parent.remove_widget(field)
                row.add_widget(field)
            row.height = self.fields[shown[0]].height
            self.fields[shown[0]].bind(height=row.setter("height"))
            self.add_widget(row)
        self.add_widget(
            Remark(
                text=tr("Without a token everybody there may; usual: {role}").format(role=self._usual_role()),
                role="muted",
            )
        )
        self.add_widget(self.role)
        self.add_widget(self.problem)
