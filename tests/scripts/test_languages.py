"""The catalogues: complete, in step with the sources, and true to the places for values."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scripts import languages
from tests.looped import looped


@pytest.fixture
def source(tmp_path, monkeypatch):
    monkeypatch.setattr(languages, "ROOT", tmp_path)

    def read(text: str) -> list[tuple[object, object]]:
        path = tmp_path / "one.py"
        path.write_text(text)
        return [(text, context) for text, context, _ in languages.sentences(path)]

    return read


def test_it_finds_what_is_translated_marked_and_counted(source):
    found = source(
        'tr("Start"), mark("Pause"), tr("Home", "verb"), tr("Home", context="place"), trn("{count} robot", "{count} robots", 3), tr(name)'
    )
    assert found == [
        ("Start", None),
        ("Pause", None),
        ("Home", "verb"),
        ("Home", "place"),
        (("{count} robot", "{count} robots"), None),
    ]


def test_it_finds_the_context_of_a_marked_word_and_both_ways_of_a_choice(source):
    found = source(
        'mark("Home", "key"), tr("{days} d {hours} h" if hours else "{days} d"), tr("A" if on else "B", "key")'
    )
    assert found == [
        ("Home", "key"),
        ("{days} d {hours} h", None),
        ("{days} d", None),
        ("A", "key"),
        ("B", "key"),
    ]


def test_it_finds_what_rules_of_kivy_translate_and_nothing_in_docstrings(source):
    found = source(
        '"""Not tr("this")."""\nBuilder.load_string("""\n<A>:\n    text: tr("Map (old)") if self.on else tr(\'No map\')\n    other: tr(root.words)\n""")\n'
    )
    assert [text for text, _ in found] == ["Map (old)", "No map"]


@looped("text", ['tr(f"{age} s old")', 'mark(f"{age}")', 'trn("one", many, 3)'])
def test_it_refuses_what_could_never_be_found_in_a_catalogue(source, text):
    with pytest.raises(SystemExit, match=r"one.py, line 1: "):
        source(text)


@pytest.fixture(scope="module")
def template():
    return languages.template()


@looped("name", languages.NAMES)
def test_every_sentence_is_translated(template, name):
    assert languages.missing(languages.brought_up_to_date(name, template)) == []


@looped("name", languages.NAMES)
def test_the_app_reads_what_the_catalogue_says(name):
    assert languages.compiled(languages.catalogue(name)) == (languages.FOLDER / f"{name}.mo").read_bytes()


def places(text: str) -> list[str]:
    return sorted(re.findall(r"\{[^}]*\}|\[/?\w+[^\]]*\]", text))


@looped("name", languages.NAMES)
def test_a_translation_keeps_the_places_for_values(name):
    wrong = []
    for message in languages.catalogue(name):
        if message.id and not isinstance(message.id, str):
            one, many = message.id
            allowed = (places(one), places(many))
            wrong += [message.id for form in message.string if places(form) not in allowed]
        elif message.id and places(message.id) != places(message.string):
            wrong.append(message.id)
    assert wrong == []


def test_every_language_of_the_app_has_a_catalogue_and_no_other_lies_there():
    from widgets.core.language import LANGUAGES, PSEUDO

    assert set(languages.NAMES) == set(LANGUAGES) - {"en", PSEUDO}
    assert {path.stem for path in Path(languages.FOLDER).glob("*.mo")} == set(languages.NAMES)
