"""The sentence that the operator reads while a robot is being connected to."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from bridge.core.link_state import Phase
from widgets.core.language import tr

if TYPE_CHECKING:
    from app.session.session import Session

__all__ = ["connecting_words", "has_failed"]


def connecting_words(session: Session) -> tuple[str, str]:
    """A sentence and its level: the first attempt is news, a later one a warning."""
    state = session.link_state
    if state.phase is Phase.CONNECTING and state.attempt == 1:
        return tr("Connecting to {url} …").format(url=session.robot.url), "info"
    waits = state.phase is Phase.WAITING and session.retry_in > 0
    waiting = (
        tr(" Trying again in {retry_in} s.").format(retry_in=math.ceil(session.retry_in)) if waits else ""
    )
    sentence = state.sentence + waiting
    if state.attempt > 1 or state.retry_in > 0:
        return tr("{sentence} Tap to cancel.").format(sentence=sentence), "warn"
    return sentence, "info"


def has_failed(session: Session) -> bool:
    """The link was given up after at least one attempt."""
    state = session.link_state
    return state.phase is Phase.CLOSED and bool(state.attempt)
