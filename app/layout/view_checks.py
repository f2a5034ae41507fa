"""Checks of the views in a layout file: widgets, topics, controls that would say the same, and places that overlap."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial
from itertools import combinations

from app.layout.hand_checks import Check, check_hand, check_hand_keys, refuse
from app.layout.layout_faults import FaultList, check_apart, check_field, one_of
from app.layout.layout_tables import SAYS, SLIDER
from app.layout.layout_widgets import check_shows, drives, is_hand, only_shows, tells
from app.layout.panel_grid import COLUMNS, FORMS, MAX_ROWS, Place
from app.layout.views import MAX_PANELS, MAX_VIEWS, Panel, View, stacks_of
from app.link.commands import SERVICES
from bridge.core.toml_files import shown
from bridge.core.topics import TOPICS

__all__ = ["check_views", "is_control", "is_signal", "says"]

TOPIC_NAME = re.compile(r"/[A-Za-z][A-Za-z0-9_]*(/[A-Za-z0-9_]+)*")
FIELD_PATH = re.compile(r"[A-Za-z_][A-Za-z0-9_]*(\[\d{1,4}\])?(\.[A-Za-z_][A-Za-z0-9_]*(\[\d{1,4}\])?)*")
_TYPES = {entry.name: entry.type for entry in TOPICS if entry.to == "handheld"}


def is_control(widget: str) -> bool:
    """The widget of that name, which the catalogue has, drives or asks for something."""
    return widget == SLIDER or is_hand(widget)


def is_signal(widget: str) -> bool:
    """The widget of that name, which the catalogue has, tells the robot something that does not drive it."""
    return widget != SLIDER and tells(widget)


def says(panel: Panel) -> tuple[str, ...]:
    """Which of `app.link.control_mixer.PARTS` a panel says; nothing for one that does not drive."""
    if panel.widget == SLIDER or not drives(panel.widget):
        return ()
    return SAYS.get(panel.widget, tuple(part for part in (panel.forward, panel.left) if part))


def check_views(where: str, views: Sequence[View], known: Sequence[str], faults: FaultList) -> None:
    """Note everything that is wrong with the views; `known` are the widgets of the catalogue."""
    if len(views) > MAX_VIEWS:
        faults.add("view", f"{where} has {len(views)} views, where {MAX_VIEWS} fit.")
    for number, view in enumerate(views):
        key, place = f"view[{number}]", f"{where}, view {number + 1}"
        if not view.title.strip():
            faults.check(f"{key}.title", refuse, f"{place}: title must not be empty.")
        if len(view.panels) > MAX_PANELS:
            faults.add(f"{key}.panel", f"{place} has {len(view.panels)} panels, where {MAX_PANELS} fit.")
        for index, panel in enumerate(view.panels[:MAX_PANELS]):
            check = partial(faults.check_key, f"{key}.panel[{index}]")
            _check_panel(check, f"{place}, panel {index + 1}", panel, known)
        _check_together(key, place, view.panels[:MAX_PANELS], known, faults)


def _check_panel(check: Check, where: str, panel: Panel, known: Sequence[str]) -> None:
    right = check("widget", one_of, where, "widget", panel.widget, [*sorted(known), SLIDER])
    named = [check("topic", _check_topic, where, "topic", panel.topic)] if panel.topic else []
    named += [check("also", _check_topic, where, "also", name) for name in panel.also]
    check_hand_keys(check, where, panel)
    paths = panel.field.split(",") if panel.widget == "Plot" else [panel.field]
    if panel.field and not all(FIELD_PATH.fullmatch(path.strip()) for path in paths):
        check("field", refuse, f"{where}: field is a path as in twist.linear.x, not {shown(panel.field)}.")
    for form in FORMS:
        check(form, _check_place, where, form, panel.place(form))
    if not right or not all(named) or panel.widget == SLIDER:
        return
    usual = [name for name in panel.topics if name in _TYPES]
    if is_hand(panel.widget):
        check_hand(check, where, _Usual(panel, usual), known)
    elif tells(panel.widget):
        check("topic", _check_told, where, panel)
    elif not only_shows(panel.widget):
        check("widget", refuse, f"{where}: {panel.widget} shows no topic, so it is no panel.")
    elif not panel.topic:
        check("topic", refuse, f"{where}: topic is missing.")
    elif panel.widget != "Video":
        check("topic", check_shows, where, panel.widget, usual)
        if panel.widget == "Readout" and panel.topic in _TYPES:
            check("field", check_field, where, _TYPES[panel.topic], panel.field)


def _check_told(where: str, panel: Panel) -> None:
    """A switch names a topic of the robot's own, none that Pilothouse uses itself."""
    if not panel.topic:
        refuse(f"{where}: topic is missing.")
    if panel.topic in SERVICES or any(entry.name == panel.topic for entry in TOPICS):
        refuse(f"{where}: {panel.widget} sends to a topic of the robot's own, not to {panel.topic}.")


class _Usual:
    """A panel of which only the topics are checked whose types every robot of ours has."""

    def __init__(self, panel: Panel, topics: Sequence[str]) -> None:
        self.topics = tuple(topics)
        self.widget, self.forward, self.left = panel.widget, panel.forward, panel.left
        self.pad, self.action, self.icon = panel.pad, panel.action, panel.icon


def _check_topic(where: str, what: str, name: str) -> None:
    if not TOPIC_NAME.fullmatch(name):
        refuse(f"{where}: {what} is a name as in /imu/data, not {shown(name)}.")


def _check_place(where: str, form: str, place: Place | None) -> None:
    if place is None:
        return
    fits = place.left >= 0 and place.top >= 0 and place.width >= 1 and place.height >= 1
    if not fits or place.right > COLUMNS[form] or place.bottom > MAX_ROWS:
        refuse(
            f"{where}: {form} is left, top, width, height within {COLUMNS[form]} columns and {MAX_ROWS} rows, "
            f"not {shown(list(place))}."
        )


def _check_together(
    key: str, where: str, panels: Sequence[Panel], known: Sequence[str], faults: FaultList
) -> None:
    """No two controls say the same, and no two places that were set by hand overlap, but within a stack."""
    hands = [
        (panel.stack or f"panel {number}", panel.title or f"{panel.widget} {number}", says(panel))
        for number, panel in enumerate(panels, 1)
        if panel.widget in known and is_hand(panel.widget) and drives(panel.widget)
    ]
    faults.check(key, check_apart, where, hands)
    firsts = [(group[0], panels[group[0]]) for group in stacks_of(panels)]
    for form in FORMS:
        placed = [(index, place) for index, panel in firsts if (place := panel.place(form)) is not None]
        for (one, place), (other, beside) in combinations(placed, 2):
            if place.overlaps(beside):
                sentence = f"{where}: panels {one + 1} and {other + 1} overlap in {form}."
                faults.check(f"{key}.panel[{other}].{form}", refuse, sentence)
