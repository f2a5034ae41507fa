"""Which parts a build has."""

from app.core.optional_parts import is_included


def test_a_part_is_included_by_its_own_name_only():
    assert is_included("app.core.optional_parts")
    assert is_included("app.inputs.voice.talkback")
    assert not is_included("app.core.left_out")
    assert not is_included("app.left_out.part")
