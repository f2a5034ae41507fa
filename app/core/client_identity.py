"""The identity of this handheld, by which robots tell it from another of the same name."""

from __future__ import annotations

import uuid

from app.core.settings_store import Settings

__all__ = ["client_identity"]


def client_identity(settings: Settings) -> str:
    """The identity that is kept in the settings; made on the first day."""
    kept = settings.get("client_id")
    if not isinstance(kept, str):
        kept = uuid.uuid4().hex
        settings.set("client_id", kept)
    return kept
