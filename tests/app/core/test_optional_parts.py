"""Which parts a build has."""

import pytest

from app.core.optional_parts import bring, is_included


def test_a_part_is_included_by_its_own_name_only():
    assert is_included("app.core.optional_parts")
    assert is_included("app.inputs.voice.talkback")
    assert not is_included("app.core.left_out")
    assert not is_included("app.left_out.part")


def test_a_name_in_a_module_is_included_with_its_module_and_brought_when_it_is_needed():
    assert is_included("app.core.optional_parts:bring")
    assert not is_included("app.core.left_out:bring")
    assert bring("app.core.optional_parts:bring") is bring
    with pytest.raises(ModuleNotFoundError):
        bring("app.core.left_out:bring")
    with pytest.raises(AttributeError):
        bring("app.core.optional_parts:left_out")
