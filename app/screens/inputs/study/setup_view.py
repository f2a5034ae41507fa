"""The form before a study begins: who, which methods, in which posture, how often."""

from __future__ import annotations

from typing import Any

from app.screens.inputs.parts.pane_app import PaneApp
from app.screens.inputs.parts.setting_row import number_row, switch_row
from app.screens.inputs.study.log_view import look_of
from app.study.study import COMMANDS, POSTURES, TRIGGERS, Plan
from widgets.parts.kit import Column, PrimaryButton, Remark, SectionLabel, Segmented, Toggle

__all__ = ["PROMPTED", "SetupView", "commands_of"]

PROMPTED = ("button", "voice", "shake", "switches", "gamepad", "keyboard")
"""Those that can be prompted; a tilt drives and gives no commands."""
USUAL = ("button", "voice", "shake")
EACH = 7.0
"""About how long one prompt takes with the gap before it [s]."""


def commands_of(method: str, app: PaneApp) -> tuple[str, ...]:
    """What a method can be asked for: of a shake only what its directions mean; STOP first.

    STOP of keys and gamepads is only there with a robot: without one Escape is Back.
    """
    if method in ("gamepad", "keyboard") and app.session is None:
        return tuple(one for one in COMMANDS if one != "stop")
    shaking = app.methods.get("shake") if method == "shake" else None
    if method != "shake":
        return COMMANDS
    meanings = getattr(shaking, "meaning", {})
    return tuple(dict.fromkeys(("stop", *(one for one in meanings.values() if one))))


class SetupView(Column):
    """Dispatches `on_begin(plan)`."""

    __events__ = ("on_begin",)

    def __init__(self, app: PaneApp, **kwargs: Any) -> None:
        super().__init__(spacing="8dp", **kwargs)
        self._app = app
        self.person, self.triggers = 1, TRIGGERS
        row, self.number = number_row(
            "person",
            "Person",
            "A number, never a name. It decides the order of the methods.",
            self._count,
            value=1,
            minimum=1,
            maximum=999,
        )
        self.add_widget(row)
        self.add_widget(SectionLabel(title="Methods"))
        self.switches: dict[str, Toggle] = {}
        self._rows: dict[str, Any] = {}
        for method in PROMPTED:
            icon, name = look_of(method)
            self._rows[method], self.switches[method] = switch_row(icon, name, "", lambda _: self.tick())
            self.switches[method].active = method in USUAL
            self.add_widget(self._rows[method])
        self._fill()

    def _fill(self) -> None:
        """Posture, how often, and the way in."""
        self.add_widget(SectionLabel(title="Posture"))
        self.posture = Segmented(
            options=[("standing", "Standing"), ("walking", "Walking"), ("both", "Both")], value="standing"
        )
        self.posture.bind(on_choose=lambda *_: self.tick())
        self.add_widget(self.posture)
        row, self.often = number_row(
            "repeat",
            "How often",
            "Prompts for each command; ten, as in the paper.",
            self._often,
            value=10,
            minimum=1,
            maximum=50,
        )
        self.add_widget(row)
        self.remark = Remark(font_size="15sp")
        self.begin = PrimaryButton(text="Begin the study", icon="play_arrow")
        self.begin.bind(on_release=lambda _: self.dispatch("on_begin", self.plan))
        self.add_widget(self.remark)
        self.add_widget(self.begin)

    @property
    def plan(self) -> Plan:
        """What is chosen."""
        methods = tuple(method for method in PROMPTED if self.switches[method].active)
        postures = POSTURES if self.posture.value == "both" else (self.posture.value,)
        commands = {method: commands_of(method, self._app) for method in methods}
        return Plan(f"P{self.person}", self.person, methods, postures, self.triggers, commands)

    def _count(self, value: float) -> None:
        self.person = int(value)
        self.tick()

    def _often(self, value: float) -> None:
        self.triggers = int(value)
        self.tick()

    def enter(self) -> None:
        """Come onto the glass."""
        self.tick()

    def tick(self) -> None:
        """Say what comes of it, and which methods are not listening."""
        faults = {method: self._fault(method) for method in self._rows}
        for method, row in self._rows.items():
            row.detail, row.whole = faults[method] if self.switches[method].active else "", True
            row.role = "warn" if row.detail else "muted"
        plan = self.plan
        deaf = [look_of(method)[1] for method in plan.methods if faults[method]]
        self.begin.disabled = bool(deaf) or not plan.methods
        self.remark.role = "warn" if self.begin.disabled else "muted"
        if not plan.methods:
            self.remark.text = "Choose a method."
            return
        if deaf:
            self.remark.text = (
                f"{' and '.join(deaf)} cannot answer now: leave out what cannot, or put it right first."
            )
            return
        prompts = sum(len(block.prompts) for block in plan.blocks())
        order = ", ".join(dict.fromkeys(look_of(block.method)[1] for block in plan.blocks()))
        self.remark.text = (
            f"{prompts} prompts, about {max(1, round(prompts * EACH / 60))} min. Person {self.person}: {order}. "
            "Nothing is sent to a robot but STOP, which one that is connected obeys."
        )

    def _fault(self, method: str) -> str:
        """Why a method could not answer a prompt now, as a sentence; empty where it can."""
        made = self._app.methods.get(method)
        if made is None:
            return ""
        return str(made.problem or "") if made.on else "Off: switch it on in the list of inputs first."

    def on_begin(self, plan: Plan) -> None:
        """A finger began it."""
