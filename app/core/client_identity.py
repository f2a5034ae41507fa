"""The identity of this handheld, by which robots tell it from another of the same name."""

from __future__ import annotations

import uuid

from app.core.settings_store import Settings
from widgets.core.language import tr

__all__ = ["MAX_NAME", "bad_name", "client_identity"]

MAX_NAME = 40
"""Letters of the name of a handheld."""


def client_identity(settings: Settings) -> str:
    """The identity that is kept in the settings; made on the first day."""
    kept = settings.get("client_id")
    if not isinstance(kept, str):
        kept = uuid.uuid4().hex
        settings.set("client_id", kept)
    return kept


def bad_name(name: str) -> str:
    """Why a handheld cannot be called `name`, as one sentence; empty where it can."""
    if not name.strip():
        return tr("A name is needed: others see by it who drives.")
    if len(name) > MAX_NAME:
        return tr("A name has at most {most} letters, not {count}.").format(most=MAX_NAME, count=len(name))
    if not name.isprintable():
        return tr("A name is of letters that can be seen, on one line.")
    return ""
