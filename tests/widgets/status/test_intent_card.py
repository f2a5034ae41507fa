from __future__ import annotations

import pytest

from widgets.status.intent_card import Drain, IntentCard


@pytest.fixture(params=[330, 420])
def card(stage, request):
    return stage.show(IntentCard(size_hint=(None, None), width=request.param))


@pytest.mark.parametrize(
    ("question", "headline"), [(True, "Go home? · 7 s"), (False, "Go home in 7 s")], ids=["asks", "waits"]
)
def test_it_says_in_figures_how_long_it_waits(card, question, headline):
    card.ask(words="Go home", who="mic", heard="Voice: go home, 82 %.", question=question)
    card.count(6.4, 10.0)
    assert card.headline == headline


def test_words_and_the_bar_that_runs_dry_keep_off_its_border(stage, card):
    card.ask(words="Go home", who="mic", heard="Voice: go home, 82 %.", question=True)
    card.count(6.4, 10.0)
    stage.frames(3)
    drain = next(part for part in card.children if isinstance(part, Drain))
    assert drain.y - card.y >= 8
    assert card.top - card.ids.row.top >= 8
