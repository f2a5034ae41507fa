"""The table of screens: what of it a window's navigation shows, and that More leads to all the rest."""

from __future__ import annotations

import importlib

import pytest

from app.screens.parts.screen_table import MAX_TABS, MORE, SCREENS, Entry, beyond, names, tabs

FORMS = ("tall", "short", "wide")
MANY = tuple(Entry(f"s{n}", "map", f"S{n}") for n in range(8))
FULL = (*MANY, Entry("hidden", "map", "Hidden", edge=False), Entry(MORE, "more_horiz", "More", edge=False))


@pytest.mark.parametrize("screens", [SCREENS, FULL], ids=["ours", "full"])
@pytest.mark.parametrize("form", FORMS)
def test_every_screen_has_a_tab_or_is_found_under_more(form: str, screens: tuple[Entry, ...]) -> None:
    found = {entry.name for entry in (*tabs(form, screens), *beyond(form, screens))}
    assert found | {MORE} == {entry.name for entry in screens}
    assert not set(tabs(form, screens)) & set(beyond(form, screens))


@pytest.mark.parametrize("form", ["tall", "short"])
def test_a_phone_has_the_first_four_and_more(form: str) -> None:
    assert [entry.name for entry in tabs(form, FULL)] == ["s0", "s1", "s2", "s3", MORE]
    assert len(tabs(form)) == MAX_TABS


def test_a_tablet_has_all_of_its_edge_and_none_of_the_hidden() -> None:
    assert [entry.name for entry in tabs("wide", FULL)] == [entry.name for entry in MANY]
    assert [entry.name for entry in beyond("wide", FULL)] == ["hidden"]


def test_names_are_told_once_and_their_makers_are_there() -> None:
    assert len(set(names())) == len(SCREENS)
    for entry in SCREENS:
        if entry.maker:
            module, _, made = entry.maker.partition(":")
            assert isinstance(getattr(importlib.import_module(module), made), type)
    assert [entry.name for entry in SCREENS if not entry.maker] == ["drive"]
