"""One way in, in the list of them: what it is called, how it stands, and a switch."""

from __future__ import annotations

from typing import Any

from widgets.parts.kit import ListRow, Toggle

__all__ = ["MethodRow"]


class MethodRow(ListRow):
    """Dispatches `on_turn(on)` when its switch is pressed; what is no method has none."""

    __events__ = ("on_turn",)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(role="muted", **kwargs)
        self.switch = Toggle(pos_hint={"center_y": 0.5})
        self.switch.bind(on_change=lambda _, on: self.dispatch("on_turn", on))
        self.whole = True

    def show_method(self, method: Any, fault: str = "") -> None:
        """Say how `method` stands, None for what is none; or why it cannot be used, as one sentence."""
        if (method is not None) != (self.switch.parent is self):
            (self.add_widget if method is not None else self.remove_widget)(self.switch)
        if fault:
            self.detail, self.role = fault, "warn"
        if method is None or fault:
            return
        self.switch.active = method.on
        self.detail = method.problem or method.standing
        self.role = "warn" if method.problem else "accent" if method.on else "muted"

    def on_turn(self, on: bool) -> None:
        """The switch was pressed."""
