"""Profiles of gamepads: what sticks, triggers and buttons do, by the gamepad's name, checked when they are read.

profile, wrong = read(kept)
profile.lean(state)     # {"left": (ahead, aside), "right": …}
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from app.core.checked_settings import known, number, shown
from app.inputs.gamepad.sdl import PadState
from widgets.core.language import mark, tr

__all__ = [
    "AXES",
    "BUTTONS",
    "DEAD_ZONES",
    "EXPOS",
    "MEANT",
    "WAYS",
    "Profile",
    "axis",
    "button_words",
    "read",
]

DEAD_ZONES = (0.02, 0.5)
"""Of the way of a stick, round its middle, that commands nothing: worn sticks do not come back to the very middle."""
EXPOS = (0.0, 1.0)
"""How much finer a stick is round its middle than at its end; 0 is the same everywhere."""
WAYS = {
    "left_ahead": mark("Left control, ahead and back"),
    "left_aside": mark("Left control, left and right"),
    "right_ahead": mark("Right control, ahead and back"),
    "right_aside": mark("Right control, left and right"),
}
"""What a control on the glass can be pushed along; a screen with one control has the left one."""
AXES = {
    "left_y": mark("Left stick, up and down"),
    "left_x": mark("Left stick, across"),
    "right_y": mark("Right stick, up and down"),
    "right_x": mark("Right stick, across"),
    "triggers": mark("Triggers, right against left"),
    "dpad_y": mark("Cross, up and down"),
    "dpad_x": mark("Cross, left and right"),
    "none": mark("Nothing"),
}
"""What can push, by the words for it. Up and left are positive, and so is the right trigger."""
ROUND = (("left_y", "left_x"), ("right_y", "right_x"))
"""Both axes of one stick: their dead zone is a round one."""
BUTTONS = {
    "a": "A, below",
    "b": "B, right",
    "x": "X, left",
    "y": "Y, above",
    "leftshoulder": mark("Left shoulder"),
    "rightshoulder": mark("Right shoulder"),
    "lefttrigger": mark("Left trigger"),
    "righttrigger": mark("Right trigger"),
    "leftstick": mark("Left stick, pressed"),
    "rightstick": mark("Right stick, pressed"),
    "dpup": mark("Cross, up"),
    "dpdown": mark("Cross, down"),
    "dpleft": mark("Cross, left"),
    "dpright": mark("Cross, right"),
    "back": mark("Back"),
    "start": mark("Start", "key"),
    "guide": mark("Guide"),
}
"""SDL's names of buttons, by the words for them."""
MEANT = {
    "b": "stop",
    "a": "yes",
    "x": "no",
    "y": "take_control",
    "start": "pause_resume",
    "back": "go_home",
    "leftshoulder": "slower",
    "rightshoulder": "faster",
    "dpup": "lights",
    "dpdown": "snapshot",
    "dpleft": "camera",
    "dpright": "record",
    "lefttrigger": "hold.talk",
    "righttrigger": "hold.tilt",
}
"""What the buttons mean before anybody has said otherwise."""
PUSHED = {
    "left_ahead": "left_y",
    "left_aside": "left_x",
    "right_ahead": "right_y",
    "right_aside": "right_x",
}
"""What pushes what before anybody has said otherwise."""
STOP, EAST = "stop", "b"


@dataclass(frozen=True, slots=True)
class Profile:
    """How one gamepad is used."""

    dead_zone: float = 0.12
    expo: float = 0.3
    axes: Mapping[str, str] = field(default_factory=lambda: dict(PUSHED))
    """One of `WAYS` to one of `AXES`."""
    inverted: frozenset[str] = frozenset()
    """Those of `WAYS` that are turned round."""
    buttons: Mapping[str, str] = field(default_factory=lambda: dict(MEANT))
    """Name of a button to what it means; one that is not named means nothing. One of them is always STOP."""

    def lean(self, state: PadState) -> dict[str, tuple[float, float]]:
        """How far either control is pushed ahead and to the left, each -1 to 1."""
        return {side: self._pushed(side, state) for side in ("left", "right")}

    def _pushed(self, side: str, state: PadState) -> tuple[float, float]:
        ways = f"{side}_ahead", f"{side}_aside"
        sources = tuple(self.axes.get(way, "none") for way in ways)
        ahead, aside = (
            self._signed(way, axis(state, source)) for way, source in zip(ways, sources, strict=True)
        )
        if sources in ROUND or sources[::-1] in ROUND:
            return self._eased(ahead, aside)
        return self._eased(ahead, 0.0)[0], self._eased(0.0, aside)[1]

    def _signed(self, way: str, value: float) -> float:
        return -value if way in self.inverted else value

    def _eased(self, ahead: float, aside: float) -> tuple[float, float]:
        """Nothing in the dead zone, the whole at the rim, and no step between: (1 - e) x + e x³."""
        length = math.hypot(ahead, aside)
        if not length > self.dead_zone:  # NaN is no push
            return 0.0, 0.0
        share = (min(1.0, length) - self.dead_zone) / (1.0 - self.dead_zone)
        scale = ((1.0 - self.expo) * share + self.expo * share**3) / length
        return ahead * scale, aside * scale

    def meaning(self, button: str) -> str:
        """What a button means, by its name; empty for nothing. What pushes a control means nothing besides."""
        return "" if button in self.driving else self.buttons.get(button, "")

    @property
    def driving(self) -> frozenset[str]:
        """Buttons that push a control."""
        used = set(self.axes.values())
        triggers = ("lefttrigger", "righttrigger") if "triggers" in used else ()
        upright = ("dpup", "dpdown") if "dpad_y" in used else ()
        return frozenset((*triggers, *upright, *(("dpleft", "dpright") if "dpad_x" in used else ())))

    @property
    def stops(self) -> list[str]:
        """Buttons that are STOP."""
        return [button for button in self.buttons if self.meaning(button) == STOP]

    def with_button(self, button: str, meaning: str) -> Profile:
        """The same with another meaning of one button; empty for nothing. ValueError for taking the last STOP away."""
        changed = replace(self, buttons={**self.buttons, button: meaning})
        if not changed.stops:
            raise ValueError(
                tr("{button} is the only STOP: make another button STOP first.").format(
                    button=button_words(button)
                )
            )
        return changed

    def with_axis(self, way: str, source: str) -> Profile:
        """The same with one of `WAYS` pushed by another of `AXES`. ValueError where that would take the last STOP away."""
        changed = replace(self, axes={**self.axes, way: source})
        if not changed.stops:
            raise ValueError(
                tr("{axes} would take the only STOP: make another button STOP first.").format(
                    axes=tr(AXES[source])
                )
            )
        return changed

    def turned(self, way: str) -> Profile:
        """The same with one of `WAYS` the other way round than now."""
        return replace(self, inverted=self.inverted ^ {way})

    def kept(self) -> dict[str, Any]:
        """As JSON, for the settings."""
        return {**asdict(self), "inverted": sorted(self.inverted)}


def axis(state: PadState, name: str) -> float:
    """One of `AXES` as it is now, -1 to 1, before dead zone and expo."""
    down = state.buttons
    return {
        "left_y": state.forward,
        "left_x": state.left,
        "right_y": state.right[0],
        "right_x": state.right[1],
        "triggers": state.triggers[1] - state.triggers[0],
        "dpad_y": float("dpup" in down) - float("dpdown" in down),
        "dpad_x": float("dpleft" in down) - float("dpright" in down),
    }.get(name, 0.0)


def button_words(button: str) -> str:
    """What a button is called, as in `A, below`; one that SDL does not know as in `Button 7`."""
    return tr(BUTTONS.get(button, button.capitalize()))


def read(kept: object, meanings: Mapping[str, object] | None = None) -> tuple[Profile, list[str]]:
    """A profile as the settings have it, and one sentence for each thing in it that cannot be; that is as it was at first.

    `meanings` are those that there are; None for any.
    """
    if not isinstance(kept, Mapping):
        return Profile(), [] if kept is None else [
            tr("The gamepad's profile is not a table but {kept}.").format(kept=shown(kept))
        ]
    wrong: list[str] = []
    profile = Profile(
        dead_zone=_number(kept, "dead_zone", DEAD_ZONES, Profile().dead_zone, wrong),
        expo=_number(kept, "expo", EXPOS, Profile().expo, wrong),
        axes=PUSHED | _chosen(kept, "axes", AXES, wrong, keys=WAYS),
        inverted=frozenset(_ways(kept.get("inverted", ()), wrong)),
        buttons=_chosen(kept, "buttons", meanings, wrong) if "buttons" in kept else dict(MEANT),
    )
    if not profile.stops:
        wrong.append(tr("The gamepad's profile has no STOP: B is STOP."))
        profile = replace(profile, axes=dict(PUSHED), buttons={**profile.buttons, EAST: STOP})
    return profile, wrong


def _number(
    kept: Mapping[Any, Any], name: str, ends: tuple[float, float], usual: float, wrong: list[str]
) -> float:
    value = kept.get(name, usual)
    if (found := number(value, *ends)) is not None:
        return found
    wrong.append(
        tr("The gamepad's {name} is from {ends} to {ends2}, not {value}: {usual} is used.").format(
            name=name, ends=ends[0], ends2=ends[1], value=shown(value), usual=usual
        )
    )
    return usual


def _chosen(
    kept: Mapping[Any, Any],
    name: str,
    allowed: Mapping[str, object] | None,
    wrong: list[str],
    keys: Mapping[str, object] | None = None,
) -> dict[str, str]:
    """A table of words, without those that are not allowed."""
    table = kept.get(name, {})
    if not isinstance(table, Mapping):
        wrong.append(
            tr("The gamepad's {name} are not a table but {table}.").format(name=name, table=shown(table))
        )
        return {}
    found = {}
    for key, value in table.items():
        meant = value == "" or (isinstance(value, str) and (allowed is None or value in allowed))
        if isinstance(key, str) and meant and (keys is None or key in keys):
            found[key] = value
        else:
            wrong.append(
                tr("The gamepad's {name} know no {key}: {value}.").format(
                    name=name, key=shown(key), value=shown(value)
                )
            )
    return found


def _ways(value: object, wrong: list[str]) -> list[str]:
    given = value if isinstance(value, list | tuple) else [value]
    unknown = [way for way in given if not known(way, WAYS)]
    if unknown:
        wrong.append(
            tr("The gamepad's inverted are some of {ways}, not {unknown}.").format(
                ways=", ".join(WAYS), unknown=shown(unknown[0])
            )
        )
    return [way for way in given if known(way, WAYS)]
