from __future__ import annotations

from widgets.status.notice_card import NoticeCard


def test_it_is_as_tall_as_its_words_and_its_buttons(stage):
    card = stage.show(NoticeCard(headline="The gate is shut", size_hint=(None, None), width=420))
    stage.frames(3)
    low = card.height
    card.said = "It opens at six, and not before, whoever rings and however long: " * 2
    stage.frames(3)
    assert card.height > low
    words = card.height
    (button,) = card.add_below(("Wait", "timer", False))
    stage.frames(3)
    assert card.height >= words + button.height
