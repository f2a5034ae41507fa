"""Programs that wait for the next test end with the last one."""

from __future__ import annotations

from collections.abc import Iterator

import pytest


@pytest.fixture(scope="session", autouse=True)
def programs() -> Iterator[None]:
    from tests.clients.peers import PROGRAMS

    yield
    PROGRAMS.close()
