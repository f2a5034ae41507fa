"""What is read while a robot is connected to."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.session.connecting import connecting_words, has_failed
from bridge.client.client import LinkState, Phase


def session(phase: Phase, sentence: str, attempt: int, retry_in: float) -> Any:
    state = LinkState(phase, sentence, attempt, retry_in)
    return SimpleNamespace(link_state=state, retry_in=retry_in, robot=SimpleNamespace(url="ws://robot:9090"))


@pytest.mark.parametrize(
    ("one", "words"),
    [
        (session(Phase.CONNECTING, "Connecting to it.", 1, 0.0), ("Connecting to ws://robot:9090 …", "info")),
        (
            session(Phase.WAITING, "No robot answers.", 1, 1.2),
            ("No robot answers. Trying again in 2 s. Tap to cancel.", "warn"),
        ),
        (session(Phase.CONNECTING, "Connecting …", 2, 0.0), ("Connecting … Tap to cancel.", "warn")),
        (
            session(Phase.CONNECTING, "Cut. Trying again.", 2, 1.0),
            ("Cut. Trying again. Tap to cancel.", "warn"),
        ),
    ],
)
def test_the_first_attempt_is_news_and_later_ones_a_warning(one: Any, words: tuple[str, str]) -> None:
    assert connecting_words(one) == words


@pytest.mark.parametrize(
    ("phase", "attempt", "failed"),
    [(Phase.CLOSED, 1, True), (Phase.CLOSED, 0, False), (Phase.WAITING, 3, False)],
)
def test_a_link_that_is_given_up_has_failed(phase: Phase, attempt: int, failed: bool) -> None:
    assert has_failed(session(phase, "", attempt, 0.0)) is failed
