"""Checks of a layout file beyond its keys and types: every fault of every table is noted, none hides another."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial

from app.layout.hand_checks import Check, check_hand, check_hand_keys, refuse
from app.layout.layout_faults import FaultList, check_apart, check_field, check_room, one_of
from app.layout.layout_tables import (
    ACTIONS,
    ARRANGEMENTS,
    SHOWN,
    SLIDER,
    SLIDER_SLOT,
    Action,
    Control,
    Instrument,
    LayoutFile,
)
from app.layout.layout_widgets import check_icon, check_instrument, drives
from app.layout.view_checks import check_views
from bridge.core.topics import topic

__all__ = ["check"]


def check(where: str, file: LayoutFile, known: Sequence[str], faults: FaultList) -> None:
    """Note what is wrong with a file that could be read; `known` are the widgets of the catalogue."""
    faults.check("arrangement", one_of, where, "arrangement", file.arrangement, ARRANGEMENTS)
    places = ARRANGEMENTS.get(file.arrangement, ARRANGEMENTS["float"])
    for number, instrument in enumerate(file.instruments):
        key, place = f"instrument[{number}]", f"{where}, instrument {number + 1}"
        _check_instrument(partial(faults.check_key, key), place, instrument, known, places.instruments)
    for number, control in enumerate(file.controls):
        key, place = f"control[{number}]", f"{where}, control {number + 1}"
        _check_control(partial(faults.check_key, key), place, control, known, places.controls)
    for number, action in enumerate(file.actions):
        _check_action(partial(faults.check_key, f"action[{number}]"), f"{where}, action {number + 1}", action)
    rooms = (
        ("instrument", "instruments", [one.slot for one in file.instruments], places.instruments),
        ("control", "controls", [one.slot for one in file.controls], places.controls),
        ("action", "actions", ["the buttons"] * len(file.actions), {"the buttons": places.actions}),
    )
    for key, what, slots, room in rooms:
        faults.check(key, check_room, where, what, slots, room)
    hands = [one for one in file.controls if one.widget != SLIDER and not one.action and one.widget in known]
    said = [(one.slot, one.called, one.says if drives(one.widget) else ()) for one in hands]
    faults.check("control", check_apart, where, said)
    check_views(where, file.views, known, faults)


def _check_instrument(
    check: Check, where: str, made: Instrument, widgets: Iterable[str], slots: Iterable[str]
) -> None:
    right = check("slot", one_of, where, "slot", made.slot, slots)
    right = check("widget", one_of, where, "widget", made.widget, sorted(widgets)) and right
    shown = check("topic", one_of, where, "topic", made.topic, SHOWN)
    if shown and made.widget == "Readout":
        check("field", check_field, where, topic(made.topic).type, made.field)
    for name in made.also:
        shown = check("also", one_of, where, "also", name, SHOWN) and shown
    if right and shown:
        check("widget", check_instrument, where, made.slot, made.widget, made.topics, widgets)


def _check_control(
    check: Check, where: str, made: Control, widgets: Iterable[str], slots: Iterable[str]
) -> None:
    right = check("slot", one_of, where, "slot", made.slot, slots)
    right = check("widget", one_of, where, "widget", made.widget, [*sorted(widgets), SLIDER]) and right
    shown = not made.topic or check("topic", one_of, where, "topic", made.topic, SHOWN)
    for name in made.also:
        shown = check("also", one_of, where, "also", name, SHOWN) and shown
    check_hand_keys(check, where, made)
    if not right:
        return
    if (made.slot == SLIDER_SLOT) != (made.widget == SLIDER):
        check("widget", refuse, f"{where}: {SLIDER} goes into {SLIDER_SLOT}, and nothing else does.")
    elif made.widget != SLIDER and shown:
        check_hand(check, where, made, widgets)


def _check_action(check: Check, where: str, made: Action) -> None:
    check("what", one_of, where, "what", made.what, ACTIONS)
    if made.icon:
        check("icon", check_icon, where, made.icon)
