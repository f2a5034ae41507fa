"""A link that the phone's camera opened: what counts as one."""

from __future__ import annotations

import pytest

from app.device.opened_links import link_of, watch_links

VIEW, MAIN = "android.intent.action.VIEW", "android.intent.action.MAIN"
LINK = "pilothouse://10.0.0.12:9090?c=ab&s=cd"


class Intent:
    """Of Android, as far as it is read."""

    def __init__(self, action: str | None, data: str | None) -> None:
        self._action, self._data = action, data

    def getAction(self) -> str | None:
        return self._action

    def getDataString(self) -> str | None:
        return self._data


@pytest.mark.parametrize(
    ("intent", "link"),
    [
        (Intent(VIEW, LINK), LINK),
        (Intent(MAIN, None), ""),
        (Intent(MAIN, LINK), ""),
        (Intent(VIEW, None), ""),
        (Intent(None, None), ""),
        (Intent(VIEW, "pilothouse://" + "x" * 100_000), ""),
        (None, ""),
    ],
)
def test_only_what_is_to_be_viewed_is_a_link(intent: Intent | None, link: str) -> None:
    assert link_of(intent) == link


def test_elsewhere_than_on_a_phone_nothing_is_watched() -> None:
    told: list[str] = []
    watch_links(told.append)
    assert not told
