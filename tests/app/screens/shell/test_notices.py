"""Cards over the screens come as they are meant to be seen, or not yet."""

from __future__ import annotations

from typing import Any

from kivy.core.window import Window

from app.screens.shell.notices import Notices
from tests.headless import Stage
from widgets import ResetCard


def off_the_glass(card: Any) -> bool:
    return bool(card.right < 0 or card.x > Window.width)


def test_a_card_is_neither_seen_nor_touched_before_it_has_its_place(stage: Stage) -> None:
    notices: Any = stage.show(Notices(), (0, 0))
    notices.width = 560
    stage.frames(2)
    card = ResetCard(name="Aqua-1")
    card.notify("Aqua-1 has sunk.")
    for _ in range(2):  # the second time it is as it was left
        notices.keep(card, shown=True)
        assert off_the_glass(card)
        stage.frames(1)
        assert not off_the_glass(card)
        assert (card.x, card.width) == (notices.x, 560)
        notices.keep(card, shown=False)


def test_the_same_sentence_again_is_one_with_a_count(stage: Stage) -> None:
    notices = Notices(width=400)
    stage.show(notices)

    def told() -> list[str]:
        return [child.text for child in notices.children]

    for _ in range(3):
        notices.say("No link.", "warn", "link", 4.0)
    assert told() == ["No link. (3 times)"]
    notices.say("No link.", "danger", "link", 4.0)
    assert told() == ["No link."], "what weighs more is another thing"
    notices.say("Saved.", "ok", "record", 4.0)
    notices.say("Saved.", "ok", "record", 4.0)
    assert "Saved. (2 times)" in told()
    stage.run_for(5.0, 1 / 8)
    assert told() == []
    notices.say("Saved.", "ok", "record", 4.0)
    assert told() == ["Saved."], "what nobody sees any more is not counted"
